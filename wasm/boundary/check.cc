// The checker, fed with the arrays of a claimed embedding.
#include "boundary/boundary.hh"

namespace layout_embedding::boundary {

namespace {

CheckObject& check_object(std::uint32_t handle)
{
    return handles<CheckObject>().get(handle);
}

}  // namespace

/// Makes an empty claim; the functions below fill it in. Returns its handle.
BOUNDARY_EXPORT(boundary_check_create) std::uint32_t boundary_check_create()
{
    return guarded(0U, [] { return handles<CheckObject>().add(std::make_unique<CheckObject>()); });
}

BOUNDARY_EXPORT(boundary_check_set_vertices)
std::uint32_t boundary_check_set_vertices(std::uint32_t check, const Vec3* positions,
                                          std::size_t count, const Index* new_vertex_faces,
                                          const std::array<double, 3>* barycentrics,
                                          std::size_t new_count)
{
    return guarded(0U, [&] {
        RefinedMesh& refined = check_object(check).refined;
        refined.positions.assign(positions, positions + count);
        refined.vertex_faces.assign(new_vertex_faces, new_vertex_faces + new_count);
        refined.vertex_barycentrics.assign(barycentrics, barycentrics + new_count);
        return 1U;
    });
}

BOUNDARY_EXPORT(boundary_check_set_triangles)
std::uint32_t boundary_check_set_triangles(std::uint32_t check, const Index* corners,
                                           const Index* faces, const Index* patches,
                                           std::size_t count)
{
    return guarded(0U, [&] {
        RefinedMesh& refined = check_object(check).refined;
        refined.corners.assign(corners, corners + 3 * count);
        refined.triangle_faces.assign(faces, faces + count);
        refined.triangle_patches.assign(patches, patches + count);
        return 1U;
    });
}

/// `count` chains with their layout edges; offsets have one more entry than there are chains.
BOUNDARY_EXPORT(boundary_check_set_chains)
std::uint32_t boundary_check_set_chains(std::uint32_t check, const std::array<Index, 2>* edges,
                                        const Index* vertices, const Index* offsets,
                                        std::size_t count)
{
    return guarded(0U, [&] {
        CheckObject& object = check_object(check);
        object.layout_edges.assign(edges, edges + count);
        object.refined.chains = unflattened(vertices, offsets, count);
        return 1U;
    });
}

/// One weak path per chain, as boundary_job_weak_points() gives them; without this call homotopy
/// classes are not compared.
BOUNDARY_EXPORT(boundary_check_set_weak_paths)
std::uint32_t boundary_check_set_weak_paths(std::uint32_t check, const WeakPoint* points,
                                            const Index* offsets, std::size_t count)
{
    return guarded(0U, [&] {
        check_object(check).weak_paths = unflattened(points, offsets, count);
        return 1U;
    });
}

/// Checks the claim against two meshes and landmarks: the number of violations, kFailed where the
/// check could not be made.
BOUNDARY_EXPORT(boundary_check_run)
std::int32_t boundary_check_run(std::uint32_t check, std::uint32_t layout_mesh,
                                std::uint32_t target_mesh, const Index* landmarks,
                                std::size_t landmark_count)
{
    return guarded(kFailed, [&] {
        CheckObject& object = check_object(check);
        const std::vector<Index> landmark_list(landmarks, landmarks + landmark_count);
        object.report = check_embedding({handles<MeshObject>().get(layout_mesh).mesh,
                                         handles<MeshObject>().get(target_mesh).mesh, landmark_list,
                                         object.refined, object.layout_edges, object.weak_paths});
        return static_cast<std::int32_t>(object.report.violations.size());
    });
}

/// Views the name of a violation found.
BOUNDARY_EXPORT(boundary_check_violation_code)
std::uint32_t boundary_check_violation_code(std::uint32_t check, std::size_t place)
{
    return guarded(0U, [&] {
        set_view(std::string_view(check_object(check).report.violations.at(place).code));
        return 1U;
    });
}

BOUNDARY_EXPORT(boundary_check_violation_message)
std::uint32_t boundary_check_violation_message(std::uint32_t check, std::size_t place)
{
    return guarded(0U, [&] {
        set_view(std::string_view(check_object(check).report.violations.at(place).message));
        return 1U;
    });
}

}  // namespace layout_embedding::boundary
