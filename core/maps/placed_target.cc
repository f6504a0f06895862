#include "maps/placed_target.hh"

#include <algorithm>
#include <string>

#include "embedding/refined_origin.hh"

namespace layout_embedding {
namespace {

/// The narrowest rectangle that a domain may be.
constexpr double kLeastAspect = 1.0 / 16;

PlanePoint snapped_corner(const PlanePoint& corner)
{
    return {std::round(corner.x() * kCornerSteps) / kCornerSteps,
            std::round(corner.y() * kCornerSteps) / kCornerSteps};
}

bool is_strictly_convex(const Domain& domain)
{
    const std::size_t n = domain.size();
    for (std::size_t i = 0; i < n; ++i) {
        const GridPoint a = to_grid(domain[i]);
        for (std::size_t j = 1; j + 1 < n; ++j) {
            // Every other corner lies to the left of every side.
            if (orientation(a, to_grid(domain[(i + 1) % n]), to_grid(domain[(i + 1 + j) % n])) <=
                0) {
                return false;
            }
        }
    }
    return true;
}

double patch_area(const Patch& patch, const RefinedMesh& refined)
{
    double sum = 0;
    for (const auto& c : patch.corners) {
        const Vec3& a = refined.positions[patch.vertices[c[0]]];
        sum += (refined.positions[patch.vertices[c[1]]] - a)
                   .cross(refined.positions[patch.vertices[c[2]]] - a)
                   .norm() /
               2;
    }
    return sum;
}

Error failed_patch(const Patch& patch, const std::string& what)
{
    return make_error(ErrorCode::parametrisationFailed,
                      "the patch of layout face " + std::to_string(patch.face) + " with " +
                          std::to_string(patch.triangles.size()) + " triangles " + what,
                      {{"face", patch.face}});
}

/// The barycentric coordinates of p in a triangle given by barycentric coordinates of its corners.
std::array<double, 3> coordinates_in(const std::array<std::array<double, 3>, 3>& corners,
                                     const std::array<double, 3>& p)
{
    // In the plane of the first two coordinates.
    const auto plane = [](const std::array<double, 3>& b) { return PlanePoint(b[0], b[1]); };
    const PlanePoint a = plane(corners[0]) - plane(p);
    const PlanePoint b = plane(corners[1]) - plane(p);
    const PlanePoint c = plane(corners[2]) - plane(p);
    const std::array<double, 3> areas{cross(b, c), cross(c, a), cross(a, b)};
    const double sum = areas[0] + areas[1] + areas[2];
    return sum > 0 ? std::array<double, 3>{areas[0] / sum, areas[1] / sum, areas[2] / sum}
                   : std::array<double, 3>{-1, -1, 3};
}

std::array<double, 3> clamped(std::array<double, 3> weights)
{
    double sum = 0;
    for (double& weight : weights) {
        weight = std::max(weight, 0.0);
        sum += weight;
    }
    for (double& weight : weights) {
        weight /= sum;
    }
    return weights;
}

}  // namespace

Result<std::vector<Domain>> common_domains(const Layout& layout,
                                           std::span<const EmbeddedTarget> targets,
                                           std::span<const std::vector<Patch>> patches)
{
    std::vector<std::vector<double>> lengths(layout.face_count());
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const RefinedMesh& refined = *targets[i].refined;
        double area = 0;
        for (const Patch& patch : patches[i]) {
            area += patch_area(patch, refined);
        }
        // Targets of different sizes count the same.
        const double scale = area > 0 ? 1 / std::sqrt(area) : 1;
        for (const Patch& patch : patches[i]) {
            const std::vector<double> sides = side_lengths(patch, refined.positions);
            std::vector<double>& sums = lengths[patch.face];
            sums.resize(sides.size(), 0);
            for (std::size_t s = 0; s < sides.size(); ++s) {
                sums[s] += scale * sides[s];
            }
        }
    }
    std::vector<Domain> domains;
    for (Index face = 0; face < layout.face_count(); ++face) {
        const std::vector<double>& sides = lengths[face];
        Domain domain;
        if (sides.size() == 4) {
            const double width = sides[0] + sides[2];
            const double height = sides[1] + sides[3];
            const double most = std::max({width, height, 1e-300});
            domain = rectangle(std::max(width / most, kLeastAspect),
                               std::max(height / most, kLeastAspect));
        } else {
            domain = inscribed_polygon(sides);
        }
        auto on_grid = snapped(std::move(domain));
        if (!on_grid) {
            return make_error(ErrorCode::parametrisationFailed,
                              "layout face " + std::to_string(face) + " has " +
                                  std::to_string(sides.size()) +
                                  " sides, too many for a domain of its own",
                              {{"face", face}});
        }
        domains.push_back(std::move(*on_grid));
    }
    return domains;
}

ChainShares arc_length_shares(const RefinedMesh& refined, const std::vector<Index>& chain)
{
    const std::size_t steps = chain.size() - 1;
    std::vector<double> reached{0};
    for (std::size_t i = 1; i < chain.size(); ++i) {
        reached.push_back(reached.back() +
                          (refined.positions[chain[i]] - refined.positions[chain[i - 1]]).norm());
    }
    // Vertices that nearly coincide still get places of their own.
    const std::int64_t least =
        std::min<std::int64_t>(64, kWholeShare / (2 * static_cast<std::int64_t>(steps)));
    const auto room = static_cast<double>(kWholeShare - least * static_cast<std::int64_t>(steps));
    ChainShares shares;
    for (std::size_t i = 0; i < chain.size(); ++i) {
        const double share = reached.back() > 0
                                 ? reached[i] / reached.back()
                                 : static_cast<double>(i) / static_cast<double>(steps);
        shares.push_back(static_cast<std::int64_t>(std::round(share * room)) +
                         least * static_cast<std::int64_t>(i));
    }
    return shares;
}

std::array<std::int64_t, 2> corner_steps(const Domain& domain, std::size_t corner)
{
    const PlanePoint& p = domain[corner % domain.size()];
    return {static_cast<std::int64_t>(p.x() * kCornerSteps),
            static_cast<std::int64_t>(p.y() * kCornerSteps)};
}

std::optional<Domain> snapped(Domain domain)
{
    std::transform(domain.begin(), domain.end(), domain.begin(), snapped_corner);
    return is_strictly_convex(domain) ? std::optional(std::move(domain)) : std::nullopt;
}

std::vector<PlanePoint> boundary_points(std::span<const Index> halfedges, const Patch& patch,
                                        const Domain& domain,
                                        const std::vector<ChainShares>& shares)
{
    std::vector<PlanePoint> points(patch.boundary_size());
    for (Index side = 0; side < patch.side_count(); ++side) {
        const ChainShares& list = shares[Layout::edge(halfedges[side])];
        const auto from = corner_steps(domain, side);
        const auto to = corner_steps(domain, side + 1);
        for (Index v = patch.sides[side]; v < patch.sides[side + 1]; ++v) {
            const std::size_t i = v - patch.sides[side];
            const std::int64_t share =
                halfedges[side] % 2 == 0 ? list[i] : kWholeShare - list[list.size() - 1 - i];
            points[v] = to_plane({from[0] * kWholeShare + share * (to[0] - from[0]),
                                  from[1] * kWholeShare + share * (to[1] - from[1])});
        }
    }
    return points;
}

TriangleMesh mesh_of_map(const Parametrisation& map)
{
    PolygonMesh polygons;
    polygons.positions.resize(map.points.size(), Vec3(0, 0, 0));
    for (const auto& corners : map.corners) {
        polygons.add_face(corners);
    }
    return TriangleMesh(polygons);
}

Result<PlacedPatch> place_patch(Patch patch, std::span<const Vec3> positions, const Domain& domain,
                                std::span<const PlanePoint> boundary)
{
    ParametriseOptions options;
    options.boundary = boundary;
    auto map = parametrise(patch, positions, domain, options);
    if (!map) {
        return map.error();
    }
    for (PlanePoint& point : map->points) {
        point = to_plane(to_grid(point));
    }
    if (!is_positive(*map)) {
        return failed_patch(patch, "is too long and thin for the plane grid");
    }
    TriangleMesh mesh = mesh_of_map(*map);
    return PlacedPatch{std::move(patch), std::move(*map), std::move(mesh)};
}

bool is_positive(const Parametrisation& map)
{
    return std::all_of(map.corners.begin(), map.corners.end(), [&](const auto& c) {
        return orientation(to_grid(map.points[c[0]]), to_grid(map.points[c[1]]),
                           to_grid(map.points[c[2]])) > 0;
    });
}

Result<PlacedTarget> PlacedTarget::place(const Layout& layout, EmbeddedTarget embedded,
                                         std::vector<Patch> patches,
                                         const std::vector<Domain>& domains)
{
    const RefinedMesh& refined = *embedded.refined;
    std::vector<ChainShares> shares;
    for (const std::vector<Index>& chain : refined.chains) {
        shares.push_back(arc_length_shares(refined, chain));
    }
    std::vector<PlacedPatch> placed;
    for (Patch& patch : patches) {
        const Domain& domain = domains[patch.face];
        const auto boundary =
            boundary_points(layout.face_halfedges(patch.face), patch, domain, shares);
        auto made = place_patch(std::move(patch), refined.positions, domain, boundary);
        if (!made) {
            return made.error();
        }
        placed.push_back(std::move(*made));
    }
    return PlacedTarget(std::move(embedded), domains, std::move(placed), std::move(shares));
}

PlacedTarget::PlacedTarget(EmbeddedTarget embedded, std::vector<Domain> domains,
                           std::vector<PlacedPatch> patches, std::vector<ChainShares> shares)
    : embedded_(std::move(embedded)),
      domains_(std::move(domains)),
      patches_(std::move(patches)),
      shares_(std::move(shares))
{
    find_triangles_of_faces();
}

void PlacedTarget::find_triangles_of_faces()
{
    const std::vector<Index>& faces = refined().triangle_faces;
    face_offsets_.assign(target().face_count() + 1, 0);
    for (const Index face : faces) {
        ++face_offsets_[face + 1];
    }
    for (std::size_t f = 1; f < face_offsets_.size(); ++f) {
        face_offsets_[f] += face_offsets_[f - 1];
    }
    face_triangles_.resize(faces.size());
    std::vector<Index> ends(face_offsets_.begin(), face_offsets_.end() - 1);
    for (Index t = 0; t < faces.size(); ++t) {
        face_triangles_[ends[faces[t]]++] = t;
    }
    place_in_patch_.assign(faces.size(), kNone);
    for (const PlacedPatch& placed : patches_) {
        for (Index i = 0; i < placed.patch.triangles.size(); ++i) {
            place_in_patch_[placed.patch.triangles[i]] = i;
        }
        // Parts of a triangle follow each other.
        std::vector<Index>& offsets = part_offsets_.emplace_back(placed.patch.triangles.size() + 1);
        for (const Index parent : placed.map.parents) {
            ++offsets[parent + 1];
        }
        for (std::size_t i = 1; i < offsets.size(); ++i) {
            offsets[i] += offsets[i - 1];
        }
    }
}

DomainPoint PlacedTarget::to_domain(const SurfacePoint& point) const
{
    const RefinedOrigin origin(target(), refined());
    Index best = kNone;
    std::array<double, 3> weights{};
    double best_least = -1;
    for (Index i = face_offsets_[point.face]; i < face_offsets_[point.face + 1]; ++i) {
        const Index triangle = face_triangles_[i];
        if (place_in_patch_[triangle] == kNone) {
            continue;
        }
        std::array<std::array<double, 3>, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] =
                origin.in_face(refined().corners[3 * std::size_t{triangle} + k], point.face);
        }
        const auto inside = coordinates_in(corners, point.barycentrics);
        const double least = std::min({inside[0], inside[1], inside[2]});
        if (best == kNone || least > best_least) {
            best = triangle;
            best_least = least;
            weights = inside;
        }
    }
    // A face may lie outside of all patches, and a point beside them only by rounding.
    if (best == kNone || best_least < -1e-6) {
        return {};
    }
    weights = clamped(weights);
    const Index face = refined().triangle_patches[best];
    const PlacedPatch& placed = patches_[face];
    const Index parent = place_in_patch_[best];
    Index part = kNone;
    std::array<double, 3> in_part{};
    best_least = -1;
    for (Index t = part_offsets_[face][parent]; t < part_offsets_[face][parent + 1]; ++t) {
        std::array<std::array<double, 3>, 3> corners{};
        for (std::size_t k = 0; k < 3; ++k) {
            std::array<double, 3> unit{0, 0, 0};
            unit[k] = 1;
            corners[k] = placed.map.weights_in_parent(placed.patch, t, unit);
        }
        const auto inside = coordinates_in(corners, weights);
        const double least = std::min({inside[0], inside[1], inside[2]});
        if (part == kNone || least > best_least) {
            part = t;
            best_least = least;
            in_part = inside;
        }
    }
    in_part = clamped(in_part);
    DomainPoint result{face, PlanePoint(0, 0)};
    for (std::size_t k = 0; k < 3; ++k) {
        result.point += in_part[k] * placed.map.points[placed.map.corners[part][k]];
    }
    return result;
}

SurfacePoint PlacedTarget::to_surface(Index face, Index triangle,
                                      const std::array<double, 3>& weights) const
{
    const PlacedPatch& placed = patches_[face];
    const RefinedOrigin origin(target(), refined());
    return origin.in_triangle(placed.patch.triangles[placed.map.parents[triangle]],
                              placed.map.weights_in_parent(placed.patch, triangle, weights));
}

std::vector<Vec3> PlacedTarget::positions(Index face) const
{
    return patches_[face].map.positions(patches_[face].patch, refined().positions);
}

}  // namespace layout_embedding
