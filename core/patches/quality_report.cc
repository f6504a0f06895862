#include "patches/quality_report.hh"

#include <algorithm>
#include <cmath>
#include <limits>

#include "patches/parametrisation.hh"
#include "patches/patch.hh"
#include "patches/patch_shape.hh"

namespace layout_embedding {
namespace {

constexpr double kDegrees = 57.29577951308232;

/// Per boundary vertex of a patch: the angle of its triangles there, in degrees.
std::vector<double> boundary_angles(const Patch& patch, const RefinedMesh& refined)
{
    std::vector<double> angles(patch.boundary_size(), 0);
    for (const auto& corners : patch.corners) {
        for (std::size_t i = 0; i < 3; ++i) {
            if (corners[i] >= angles.size()) {
                continue;
            }
            const auto at = [&](std::size_t k) -> const Vec3& {
                return refined.positions[patch.vertices[corners[k % 3]]];
            };
            const Vec3 u = at(i + 1) - at(i);
            const Vec3 v = at(i + 2) - at(i);
            angles[corners[i]] += std::atan2(u.cross(v).norm(), u.dot(v)) * kDegrees;
        }
    }
    return angles;
}

double stretch_of(const Patch& patch, const RefinedMesh& refined)
{
    const Domain domain = patch.side_count() == 4 ? fitting_rectangle(patch, refined.positions)
                                                  : regular_polygon(patch.side_count());
    const auto map = parametrise(patch, refined.positions, domain);
    return map ? map->stretch : std::numeric_limits<double>::infinity();
}

}  // namespace

Result<QualityReport> quality_report(const Layout& layout, const RefinedMesh& refined)
{
    const auto patches = patches_of(layout, refined);
    if (!patches) {
        return patches.error();
    }
    QualityReport report;
    report.edges.resize(layout.edge_count());
    // Per edge and inner vertex, the smaller of the two angles.
    std::vector<std::vector<double>> angles(layout.edge_count());
    for (Index edge = 0; edge < layout.edge_count(); ++edge) {
        report.edges[edge].length = chain_length(refined, refined.chains[edge]);
        angles[edge].assign(refined.chains[edge].size(), 180);
    }
    const std::vector<PatchShape> shapes = patch_shapes(layout, refined);
    for (const Patch& patch : *patches) {
        const PatchShape& shape = shapes[patch.face];
        report.patches.push_back(
            {shape.area, shape.perimeter, shape.quotient(), stretch_of(patch, refined)});
        const std::vector<double> of_boundary = boundary_angles(patch, refined);
        const auto halfedges = layout.face_halfedges(patch.face);
        for (Index side = 0; side < patch.side_count(); ++side) {
            std::vector<double>& of_edge = angles[Layout::edge(halfedges[side])];
            for (Index v = patch.sides[side] + 1; v < patch.sides[side + 1]; ++v) {
                const Index place = v - patch.sides[side];
                double& angle =
                    halfedges[side] % 2 == 0 ? of_edge[place] : of_edge[of_edge.size() - 1 - place];
                angle = std::min(angle, of_boundary[v]);
            }
        }
    }
    for (Index edge = 0; edge < layout.edge_count(); ++edge) {
        for (const double angle : angles[edge]) {
            report.edges[edge].turning += 180 - angle;
        }
    }
    return report;
}

}  // namespace layout_embedding
