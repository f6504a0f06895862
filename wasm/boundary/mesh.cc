// Meshes, layouts, targets and landmarks: read, repaired, validated, looked at.
#include <algorithm>

#include "apps/template_layout.hh"
#include "boundary/boundary.hh"
#include "layout/embedding_problem.hh"
#include "layout/landmark_reader.hh"
#include "layout/proximity.hh"
#include "mesh/mesh_reader.hh"
#include "mesh/mesh_writer.hh"
#include "mesh/repair.hh"
#include "mesh/validation.hh"

namespace layout_embedding::boundary {

namespace {

MeshObject& mesh_object(std::uint32_t handle)
{
    return handles<MeshObject>().get(handle);
}

/// Gives the value a handle, or makes its error the last one and returns 0.
template <typename Object, typename T>
std::uint32_t add_or_fail(Result<T> result, Object (*make)(T))
{
    if (!result) {
        set_error(result.error());
        return 0;
    }
    return handles<Object>().add(std::make_unique<Object>(make(std::move(*result))));
}

/// Views a note; false beyond the last one.
std::uint32_t view_note(const std::vector<std::string>& notes, std::size_t place)
{
    if (place >= notes.size()) {
        return 0;
    }
    set_view(std::string_view(notes[place]));
    return 1;
}

void view_counts(double vertices, double edges, double faces, double boundary_loops)
{
    set_owned_view(std::vector<double>{vertices, edges, faces, boundary_loops});
}

}  // namespace

/// Reads a mesh from the bytes of a file. `format` is a MeshFormat; where that is detect, the
/// ending of `name` counts. `subject` begins the messages. With attributes, unless
/// `with_attributes` is 0. Returns a mesh.
BOUNDARY_EXPORT(boundary_mesh_read)
std::uint32_t boundary_mesh_read(const char* bytes, std::size_t size, std::uint32_t format,
                                 const char* name, std::size_t name_size, const char* subject,
                                 std::size_t subject_size, std::uint32_t with_attributes)
{
    return guarded(0U, [&] {
        auto kind = static_cast<MeshFormat>(format);
        if (kind == MeshFormat::detect) {
            kind = format_of_file_name({name, name_size});
        }
        auto attributes = with_attributes != 0 ? std::make_shared<MeshAttributes>() : nullptr;
        auto mesh = read_mesh({bytes, size}, kind, {subject, subject_size}, attributes.get());
        if (!mesh) {
            set_error(mesh.error());
            return 0U;
        }
        std::vector<std::string> notes;
        if (attributes != nullptr && attributes->unusable > 0) {
            notes.push_back("Left out texture coordinates or colours of " +
                            std::to_string(attributes->unusable) +
                            (attributes->unusable == 1 ? " corner" : " corners") +
                            " of faces, where they are no numbers or do not exist.");
        }
        return handles<MeshObject>().add(std::make_unique<MeshObject>(
            MeshObject{std::move(*mesh), std::move(notes), {}, std::move(attributes)}));
    });
}

/// Makes a mesh of arrays. Offsets must rise from 0 to the number of corners; corners are looked at
/// when a layout or target is made. Returns a mesh.
BOUNDARY_EXPORT(boundary_mesh_from_arrays)
std::uint32_t boundary_mesh_from_arrays(const Vec3* positions, std::size_t vertex_count,
                                        const Index* corners, std::size_t corner_count,
                                        const Index* offsets, std::size_t offset_count)
{
    return guarded(0U, [&] {
        auto object = std::make_unique<MeshObject>();
        object->mesh.positions.assign(positions, positions + vertex_count);
        object->mesh.corners.assign(corners, corners + corner_count);
        object->mesh.face_offsets.assign(offsets, offsets + offset_count);
        return handles<MeshObject>().add(std::move(object));
    });
}

/// Mends a mesh for the use that `kind`, a SurfaceKind, stands for. Returns another mesh, with
/// notes and a vertex map; it is still to be validated.
BOUNDARY_EXPORT(boundary_mesh_repair)
std::uint32_t boundary_mesh_repair(std::uint32_t mesh, std::uint32_t kind)
{
    return guarded(0U, [&] {
        const MeshObject& given = mesh_object(mesh);
        RepairResult repaired = repair_surface(given.mesh, static_cast<SurfaceKind>(kind));
        std::shared_ptr<const MeshAttributes> attributes;
        if (given.attributes != nullptr) {
            attributes = std::make_shared<const MeshAttributes>(
                through_repair(*given.attributes, given.mesh, repaired.face_origins));
        }
        std::vector<std::string> notes = given.notes;
        notes.insert(notes.end(), repaired.notes.begin(), repaired.notes.end());
        return handles<MeshObject>().add(std::make_unique<MeshObject>(
            MeshObject{std::move(repaired.mesh), std::move(notes), std::move(repaired.vertex_map),
                       std::move(attributes)}));
    });
}

/// Views a note on what was left out or mended; 0 beyond the last one.
BOUNDARY_EXPORT(boundary_mesh_note)
std::uint32_t boundary_mesh_note(std::uint32_t mesh, std::size_t place)
{
    return guarded(0U, [&] { return view_note(mesh_object(mesh).notes, place); });
}

/// Views per vertex before the repair its id after it, all bits set where there is none.
BOUNDARY_EXPORT(boundary_mesh_vertex_map) std::uint32_t boundary_mesh_vertex_map(std::uint32_t mesh)
{
    return guarded(0U, [&] {
        set_view(mesh_object(mesh).vertex_map);
        return 1U;
    });
}

/// Views a mesh: 3 doubles per vertex.
BOUNDARY_EXPORT(boundary_mesh_positions) std::uint32_t boundary_mesh_positions(std::uint32_t mesh)
{
    return guarded(0U, [&] {
        set_view(mesh_object(mesh).mesh.positions);
        return 1U;
    });
}

BOUNDARY_EXPORT(boundary_mesh_corners) std::uint32_t boundary_mesh_corners(std::uint32_t mesh)
{
    return guarded(0U, [&] {
        set_view(mesh_object(mesh).mesh.corners);
        return 1U;
    });
}

BOUNDARY_EXPORT(boundary_mesh_offsets) std::uint32_t boundary_mesh_offsets(std::uint32_t mesh)
{
    return guarded(0U, [&] {
        set_view(mesh_object(mesh).mesh.face_offsets);
        return 1U;
    });
}

/// Views the texture coordinates of a mesh: 2 doubles per corner, none where some corner has none.
BOUNDARY_EXPORT(boundary_mesh_texture_coordinates)
std::uint32_t boundary_mesh_texture_coordinates(std::uint32_t mesh)
{
    return guarded(0U, [&] {
        std::vector<double> places;
        if (const auto& attributes = mesh_object(mesh).attributes; attributes != nullptr) {
            const CornerValues& values = attributes->texture_coordinates;
            const bool complete =
                std::find(values.ids.begin(), values.ids.end(), kNone) == values.ids.end();
            for (std::size_t i = 0; complete && i < values.ids.size(); ++i) {
                const auto value = values.value(values.ids[i]);
                places.insert(places.end(), value.begin(), value.end());
            }
        }
        set_owned_view(places);
        return 1U;
    });
}

/// Views a mesh as the bytes of an OBJ file.
BOUNDARY_EXPORT(boundary_mesh_write_obj) std::uint32_t boundary_mesh_write_obj(std::uint32_t mesh)
{
    return guarded(0U, [&] {
        set_owned_view(write_obj(mesh_object(mesh).mesh));
        return 1U;
    });
}

BOUNDARY_EXPORT(boundary_mesh_write_off) std::uint32_t boundary_mesh_write_off(std::uint32_t mesh)
{
    return guarded(0U, [&] {
        set_owned_view(write_off(mesh_object(mesh).mesh));
        return 1U;
    });
}

BOUNDARY_EXPORT(boundary_mesh_write_ply) std::uint32_t boundary_mesh_write_ply(std::uint32_t mesh)
{
    return guarded(0U, [&] {
        set_owned_view(write_ply(mesh_object(mesh).mesh));
        return 1U;
    });
}

/// Makes a layout of a mesh, which it does not need any further.
BOUNDARY_EXPORT(boundary_layout_create)
std::uint32_t boundary_layout_create(std::uint32_t mesh, const char* subject,
                                     std::size_t subject_size)
{
    return guarded(0U, [&] {
        return add_or_fail<LayoutObject>(
            Layout::from_polygons(mesh_object(mesh).mesh, {subject, subject_size}),
            +[](Layout layout) {
                return LayoutObject{std::make_shared<const Layout>(std::move(layout))};
            });
    });
}

/// Views the numbers of vertices, edges, faces and boundary loops as doubles.
BOUNDARY_EXPORT(boundary_layout_counts) std::uint32_t boundary_layout_counts(std::uint32_t layout)
{
    return guarded(0U, [&] {
        const Layout& object = *handles<LayoutObject>().get(layout).layout;
        view_counts(object.vertex_count(), object.edge_count(), object.face_count(),
                    static_cast<double>(object.boundary_loops().size()));
        return 1U;
    });
}

/// Views two vertex ids per layout edge, start and end.
BOUNDARY_EXPORT(boundary_layout_edges) std::uint32_t boundary_layout_edges(std::uint32_t layout)
{
    return guarded(0U, [&] {
        const Layout& object = *handles<LayoutObject>().get(layout).layout;
        std::vector<Index> ends;
        for (Index halfedge = 0; halfedge < 2 * object.edge_count(); ++halfedge) {
            ends.push_back(object.tail(halfedge));
        }
        set_owned_view(ends);
        return 1U;
    });
}

/// Makes a target of a mesh, which it does not need any further. The mesh's attributes go along to
/// refined meshes, unless `with_attributes` is 0.
BOUNDARY_EXPORT(boundary_target_create)
std::uint32_t boundary_target_create(std::uint32_t mesh, const char* subject,
                                     std::size_t subject_size, std::uint32_t with_attributes)
{
    return guarded(0U, [&] {
        const MeshObject& given = mesh_object(mesh);
        const PolygonMesh& polygons = given.mesh;
        const Status valid = check_surface(polygons, SurfaceKind::target, {subject, subject_size});
        if (!valid) {
            set_error(valid.error());
            return 0U;
        }
        return handles<TargetObject>().add(std::make_unique<TargetObject>(
            TargetObject{std::make_shared<const TriangleMesh>(polygons),
                         with_attributes != 0 ? given.attributes : nullptr}));
    });
}

/// Whether a target has attributes that go along.
BOUNDARY_EXPORT(boundary_target_has_attributes)
std::uint32_t boundary_target_has_attributes(std::uint32_t target)
{
    return guarded(0U, [&] {
        const auto& attributes = handles<TargetObject>().get(target).attributes;
        return attributes != nullptr && !attributes->empty() ? 1U : 0U;
    });
}

BOUNDARY_EXPORT(boundary_target_counts) std::uint32_t boundary_target_counts(std::uint32_t target)
{
    return guarded(0U, [&] {
        const TriangleMesh& object = *handles<TargetObject>().get(target).target;
        view_counts(object.vertex_count(), object.edge_count(), object.face_count(),
                    object.boundary_loop_count());
        return 1U;
    });
}

/// Reads landmarks from the bytes of a file. `target_mesh` is the mesh that positions in the file
/// are compared with, 0 for none. Returns landmarks.
BOUNDARY_EXPORT(boundary_landmarks_read)
std::uint32_t boundary_landmarks_read(const char* bytes, std::size_t size, const char* subject,
                                      std::size_t subject_size, std::uint32_t target_mesh)
{
    return guarded(0U, [&] {
        std::span<const Vec3> positions;
        if (target_mesh != 0) {
            positions = mesh_object(target_mesh).mesh.positions;
        }
        return add_or_fail<LandmarksObject>(
            read_landmarks({bytes, size}, {subject, subject_size}, positions),
            +[](Landmarks landmarks) {
                return LandmarksObject{std::move(landmarks.vertices), std::move(landmarks.names),
                                       std::move(landmarks.notes)};
            });
    });
}

/// Assigns target vertices to the vertices of a layout, made from `layout_mesh`, by least total
/// squared distance. Returns landmarks.
BOUNDARY_EXPORT(boundary_landmarks_by_proximity)
std::uint32_t boundary_landmarks_by_proximity(std::uint32_t layout, std::uint32_t layout_mesh,
                                              std::uint32_t target)
{
    return guarded(0U, [&] {
        return add_or_fail<LandmarksObject>(
            landmarks_by_proximity(*handles<LayoutObject>().get(layout).layout,
                                   mesh_object(layout_mesh).mesh.positions,
                                   *handles<TargetObject>().get(target).target),
            +[](std::vector<Index> landmarks) {
                return LandmarksObject{std::move(landmarks), {}, {}};
            });
    });
}

/// Views the target vertex of each landmark.
BOUNDARY_EXPORT(boundary_landmarks_ids)
std::uint32_t boundary_landmarks_ids(std::uint32_t landmarks)
{
    return guarded(0U, [&] {
        set_view(handles<LandmarksObject>().get(landmarks).landmarks);
        return 1U;
    });
}

/// Views the name of a landmark; 0 beyond the last one.
BOUNDARY_EXPORT(boundary_landmarks_name)
std::uint32_t boundary_landmarks_name(std::uint32_t landmarks, std::size_t place)
{
    return guarded(
        0U, [&] { return view_note(handles<LandmarksObject>().get(landmarks).names, place); });
}

/// Views a note on landmarks; 0 beyond the last one.
BOUNDARY_EXPORT(boundary_landmarks_note)
std::uint32_t boundary_landmarks_note(std::uint32_t landmarks, std::size_t place)
{
    return guarded(
        0U, [&] { return view_note(handles<LandmarksObject>().get(landmarks).notes, place); });
}

/// Makes a template layout of a target and landmarks on it, with quads unless `quads` is 0. Returns
/// a mesh, and views as doubles how many vertices were removed by collapses, after edge flips, and
/// without regard to shapes, and how many edges were flipped since the other diagonal is shorter.
BOUNDARY_EXPORT(boundary_template_create)
std::uint32_t boundary_template_create(std::uint32_t target, const Index* landmarks,
                                       std::size_t landmark_count, std::uint32_t quads)
{
    return guarded(0U, [&] {
        auto made = template_layout(*handles<TargetObject>().get(target).target,
                                    {landmarks, landmark_count}, {.quads = quads != 0});
        if (!made) {
            set_error(made.error());
            return 0U;
        }
        const DecimationCounts& counts = made->counts;
        set_owned_view(std::vector<double>{
            static_cast<double>(counts.collapses), static_cast<double>(counts.after_flips),
            static_cast<double>(counts.in_any_shape), static_cast<double>(made->flips)});
        return handles<MeshObject>().add(
            std::make_unique<MeshObject>(MeshObject{std::move(made->mesh), {}, {}, {}}));
    });
}

/// Confirms that layout, target and landmarks fit together.
BOUNDARY_EXPORT(boundary_check_problem)
std::uint32_t boundary_check_problem(std::uint32_t layout, std::uint32_t target,
                                     const Index* landmarks, std::size_t landmark_count)
{
    return guarded(0U, [&] {
        const auto problem = make_problem(handles<LayoutObject>().get(layout).layout,
                                          handles<TargetObject>().get(target).target,
                                          {landmarks, landmarks + landmark_count});
        if (!problem) {
            set_error(problem.error());
            return 0U;
        }
        return 1U;
    });
}

}  // namespace layout_embedding::boundary
