#include "embedding/checker.hh"

#include "embedding/checker_chains.hh"
#include "embedding/checker_homotopy.hh"
#include "embedding/checker_subdivision.hh"
#include "embedding/checker_surface.hh"

namespace layout_embedding {

namespace {

using namespace checker;

/// The target as a surface of triangles with finite positions.
bool build_target(const PolygonMesh& mesh, Violations& violations, Surface& surface)
{
    const std::size_t before = violations.total();
    if (!build_surface(mesh.vertex_count(), mesh.face_offsets, mesh.corners, "targetNotSurface",
                       "The target", violations, surface)) {
        return false;
    }
    for (Index f = 0; f < surface.polygon_count; ++f) {
        if (mesh.face_offsets[f + 1] != 3 * (f + 1)) {
            violations.add("targetNotSurface", "The target has face ", f,
                           ", which is not a triangle.");
            break;
        }
    }
    for (Index v = 0; v < surface.vertex_count; ++v) {
        if (!mesh.positions[v].allFinite()) {
            violations.add("targetNotSurface", "The target has a position at vertex ", v,
                           " that is not finite.");
        }
    }
    return violations.total() == before;
}

void check(const CheckInput& input, Violations& violations)
{
    Surface layout;
    Surface target;
    const bool layout_good =
        build_surface(input.layout.vertex_count(), input.layout.face_offsets, input.layout.corners,
                      "layoutNotSurface", "The layout", violations, layout);
    const bool target_good = build_target(input.target, violations, target);
    const bool landmarks_good =
        layout_good && target_good && check_landmarks(layout, target, input.landmarks, violations);
    if (!target_good) {
        return;
    }
    Surface surface;
    std::vector<Carrier> carriers;
    const std::size_t before = violations.total();
    if (!check_subdivision(input.target, target, input.refined, violations, surface, carriers) ||
        !landmarks_good) {
        return;
    }
    const bool subdivided = violations.total() == before;
    std::vector<Index> chain_halfedges;
    if (!check_chains(layout, input.landmarks, input.layout_edges, input.refined, surface,
                      violations, chain_halfedges)) {
        return;
    }
    check_orders(layout, input.landmarks, surface, chain_halfedges, violations);
    check_patches(layout, input.landmarks, input.refined, surface, chain_halfedges, violations);
    if (subdivided) {
        check_homotopy(input, target, surface, carriers, violations);
    }
}

}  // namespace

CheckReport check_embedding(const CheckInput& input)
{
    Violations violations;
    check(input, violations);
    return {std::move(violations.list())};
}

}  // namespace layout_embedding
