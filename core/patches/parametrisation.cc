#include "patches/parametrisation.hh"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "base/sparse_lu.hh"
#include "mesh/mean_value_weights.hh"
#include "mesh/triangle_mesh.hh"

namespace layout_embedding {
namespace {

// Relative to the mean; keeps weights finite where triangles have collapsed in the domain.
constexpr double kLargestStretch = 1e8;
constexpr double kSmallestStretch = 1e-4;

/// Whether a, b, c are counter-clockwise beyond every doubt about rounding (Shewchuk, "Adaptive
/// precision floating-point arithmetic and fast robust geometric predicates", 1997).
bool certainly_ccw(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c)
{
    const double left = (a.x() - c.x()) * (b.y() - c.y());
    const double right = (a.y() - c.y()) * (b.x() - c.x());
    constexpr double kBound = 3.3306690738754716e-16;
    return left - right > kBound * (std::abs(left) + std::abs(right));
}

/// Which sides a boundary vertex lies on: one, or two at a corner.
class Sides {
public:
    explicit Sides(const Patch& patch) : patch_(patch), side_of_(patch.boundary_size())
    {
        for (Index side = 0; side < patch.side_count(); ++side) {
            for (Index v = patch.sides[side]; v < patch.sides[side + 1]; ++v) {
                side_of_[v] = side;
            }
        }
    }

    /// Whether two vertices of the patch lie on one side.
    bool share(Index a, Index b) const
    {
        return a < side_of_.size() && b < side_of_.size() &&
               (on(a, side_of_[b]) || on(b, side_of_[a]));
    }

private:
    bool on(Index v, Index side) const { return side_of_[v] == side || other(v) == side; }
    /// The side that ends at v, that of v itself inside of it.
    Index other(Index v) const
    {
        const Index side = side_of_[v];
        if (v != patch_.sides[side]) {
            return side;
        }
        return side == 0 ? patch_.side_count() - 1 : side - 1;
    }

    const Patch& patch_;
    std::vector<Index> side_of_;
};

/// Splits inner edges that join two vertices of one side; fills in all but points and stretch.
void split_edges(const Patch& patch, Parametrisation& map)
{
    const Sides sides(patch);
    const Index boundary = patch.boundary_size();
    std::map<std::array<Index, 2>, Index> middles;
    const auto middle_of = [&](Index a, Index b) {
        // Neighbours along the boundary are joined by a boundary edge.
        if (a >= boundary || b >= boundary || (a + 1) % boundary == b || (b + 1) % boundary == a ||
            !sides.share(a, b)) {
            return kNone;
        }
        const std::array<Index, 2> ends{std::min(a, b), std::max(a, b)};
        const auto next = static_cast<Index>(patch.vertices.size() + map.splits.size());
        const auto [place, fresh] = middles.try_emplace(ends, next);
        if (fresh) {
            map.splits.push_back(ends);
        }
        return place->second;
    };
    const auto add = [&](Index parent, Index a, Index b, Index c) {
        map.corners.push_back({a, b, c});
        map.parents.push_back(parent);
    };
    for (Index t = 0; t < patch.corners.size(); ++t) {
        std::array<Index, 3> v = patch.corners[t];
        std::array<Index, 3> m{middle_of(v[0], v[1]), middle_of(v[1], v[2]), middle_of(v[2], v[0])};
        const auto count = 3 - std::count(m.begin(), m.end(), kNone);
        // Turned so that side 0 is split, or, with two split sides, side 2 is not.
        while ((count == 1 && m[0] == kNone) || (count == 2 && m[2] != kNone)) {
            std::rotate(v.begin(), v.begin() + 1, v.end());
            std::rotate(m.begin(), m.begin() + 1, m.end());
        }
        switch (count) {
            case 0:
                add(t, v[0], v[1], v[2]);
                break;
            case 1:
                add(t, v[0], m[0], v[2]);
                add(t, m[0], v[1], v[2]);
                break;
            case 2:
                add(t, m[0], v[1], m[1]);
                add(t, v[0], m[0], m[1]);
                add(t, v[0], m[1], v[2]);
                break;
            default:
                add(t, v[0], m[0], m[2]);
                add(t, m[0], v[1], m[1]);
                add(t, m[2], m[1], v[2]);
                add(t, m[0], m[1], m[2]);
                break;
        }
    }
}

/// Places boundary vertices on the sides of the domain by arc length.
void place_boundary(const Patch& patch, std::span<const Vec3> positions, const Domain& domain,
                    std::vector<PlanePoint>& points)
{
    const Index boundary = patch.boundary_size();
    for (Index side = 0; side < patch.side_count(); ++side) {
        const Index begin = patch.sides[side];
        const Index end = patch.sides[side + 1];
        std::vector<double> steps;
        double length = 0;
        for (Index v = begin; v < end; ++v) {
            const Vec3& to = positions[v + 1 == boundary ? 0 : v + 1];
            steps.push_back((to - positions[v]).norm());
            length += steps.back();
        }
        // Vertices that coincide on the surface still get places of their own.
        const double least = length > 0 ? 1e-9 * length : 1;
        std::vector<double> lengths{0};
        for (const double step : steps) {
            lengths.push_back(lengths.back() + std::max(step, least));
        }
        const PlanePoint& from = domain[side];
        const PlanePoint& to = domain[side + 1 == domain.size() ? 0 : side + 1];
        for (Index v = begin; v < end; ++v) {
            const double share = lengths[v - begin] / lengths.back();
            points[v] = (1 - share) * from + share * to;
        }
    }
}

/// A sparse system for the inner vertices with weights that can be changed.
class Placement {
public:
    Placement(const Patch& patch, const Parametrisation& map, const std::vector<Vec3>& positions)
        : map_(map), positions_(positions), boundary_(patch.boundary_size())
    {
        PolygonMesh polygons;
        polygons.positions = positions;
        for (const auto& corners : map.corners) {
            polygons.add_face(corners);
        }
        const TriangleMesh mesh(polygons);
        const auto weights = mean_value_weights(mesh);
        neighbours_.resize(positions.size());
        for (Index e = 0; e < mesh.edge_count(); ++e) {
            const Index tail = mesh.tail(mesh.halfedge(e));
            const Index head = mesh.head(mesh.halfedge(e));
            neighbours_[tail].push_back({head, std::max(weights[e][0], 1e-300)});
            neighbours_[head].push_back({tail, std::max(weights[e][1], 1e-300)});
        }
    }

    /// All weights 1, as Tutte has it.
    void make_uniform()
    {
        for (auto& list : neighbours_) {
            for (Neighbour& neighbour : list) {
                neighbour.weight = 1;
            }
        }
    }

    /// Places the inner vertices by the current weights.
    void solve(std::vector<PlanePoint>& points) const
    {
        const Index count = static_cast<Index>(points.size()) - boundary_;
        SparseRows matrix;
        std::array<std::vector<double>, 2> sides;
        for (Index v = boundary_; v < points.size(); ++v) {
            double sum = 0;
            for (const Neighbour& neighbour : neighbours_[v]) {
                sum += neighbour.weight;
            }
            matrix.columns.push_back(v - boundary_);
            matrix.values.push_back(1);
            PlanePoint constant(0, 0);
            for (const Neighbour& neighbour : neighbours_[v]) {
                const double share = neighbour.weight / sum;
                if (neighbour.vertex < boundary_) {
                    constant += share * points[neighbour.vertex];
                } else {
                    matrix.columns.push_back(neighbour.vertex - boundary_);
                    matrix.values.push_back(-share);
                }
            }
            matrix.offsets.push_back(static_cast<Index>(matrix.columns.size()));
            sides[0].push_back(constant.x());
            sides[1].push_back(constant.y());
        }
        if (count == 0) {
            return;
        }
        const SparseLu factors(matrix);
        factors.solve(sides[0]);
        factors.solve(sides[1]);
        for (Index i = 0; i < count; ++i) {
            points[boundary_ + i] = PlanePoint(sides[0][i], sides[1][i]);
        }
    }

    bool is_one_to_one(const std::vector<PlanePoint>& points) const
    {
        return std::all_of(map_.corners.begin(), map_.corners.end(), [&](const auto& c) {
            return certainly_ccw(points[c[0]], points[c[1]], points[c[2]]);
        });
    }

    /// The stretch of the whole map, and of the triangles around each vertex.
    double stretch(const std::vector<PlanePoint>& points, double domain_area,
                   std::vector<double>& of_vertices) const
    {
        std::vector<double> areas(positions_.size(), 0);
        of_vertices.assign(positions_.size(), 0);
        double total_area = 0;
        for (const auto& c : map_.corners) {
            const Vec3 u = positions_[c[1]] - positions_[c[0]];
            const Vec3 v = positions_[c[2]] - positions_[c[0]];
            total_area += u.cross(v).norm() / 2;
        }
        const double scale = total_area > 0 ? domain_area / total_area : 1;
        double sum = 0;
        for (const auto& c : map_.corners) {
            const Vec3 u = positions_[c[1]] - positions_[c[0]];
            const Vec3 v = positions_[c[2]] - positions_[c[0]];
            const double surface_area = u.cross(v).norm() / 2;
            const PlanePoint p = points[c[1]] - points[c[0]];
            const PlanePoint q = points[c[2]] - points[c[0]];
            const double determinant = std::abs(cross(p, q));
            // The derivatives of the surface point by the coordinates of the domain.
            const Vec3 by_x = u * q.y() - v * p.y();
            const Vec3 by_y = v * p.x() - u * q.x();
            const double squares = (by_x.squaredNorm() + by_y.squaredNorm()) / 2 * scale;
            const double floor = kSmallestStretch * kSmallestStretch;
            const double ceiling = kLargestStretch * kLargestStretch;
            double square = ceiling;
            if (squares < ceiling * determinant * determinant) {
                square = std::max(squares / (determinant * determinant), floor);
            }
            sum += surface_area * square;
            for (const Index corner : c) {
                areas[corner] += surface_area;
                of_vertices[corner] += surface_area * square;
            }
        }
        for (Index v = 0; v < of_vertices.size(); ++v) {
            of_vertices[v] = areas[v] > 0 ? std::sqrt(of_vertices[v] / areas[v]) : 1;
        }
        return total_area > 0 ? std::sqrt(sum / total_area) : 1;
    }

    /// Pulls towards vertices whose triangles are squeezed less.
    void adapt(const std::vector<double>& stretch_of_vertices)
    {
        for (auto& list : neighbours_) {
            double sum = 0;
            for (Neighbour& neighbour : list) {
                neighbour.weight /= stretch_of_vertices[neighbour.vertex];
                sum += neighbour.weight;
            }
            for (Neighbour& neighbour : list) {
                neighbour.weight = std::max(neighbour.weight / sum, 1e-300);
            }
        }
    }

private:
    struct Neighbour {
        Index vertex;
        double weight;
    };

    const Parametrisation& map_;
    const std::vector<Vec3>& positions_;
    Index boundary_;
    std::vector<std::vector<Neighbour>> neighbours_;
};

/// Adapts the weights for as long as it helps; false if no placement was one-to-one.
bool minimise_stretch(Placement& placement, Parametrisation& map, double domain_area, Index rounds)
{
    // What is not one-to-one yet may become it.
    constexpr Index kRoundsToMend = 12;
    std::vector<PlanePoint> points = map.points;
    std::vector<double> of_vertices;
    bool found = false;
    for (Index round = 0;; ++round) {
        placement.solve(points);
        const bool one_to_one = placement.is_one_to_one(points);
        const double stretch = placement.stretch(points, domain_area, of_vertices);
        if (found && !(one_to_one && stretch < map.stretch)) {
            return true;
        }
        if (one_to_one) {
            found = true;
            map.points = points;
            map.stretch = stretch;
        }
        if (round >= (found ? rounds : kRoundsToMend)) {
            return found;
        }
        placement.adapt(of_vertices);
    }
}

}  // namespace

std::vector<Vec3> Parametrisation::positions(const Patch& patch,
                                             std::span<const Vec3> refined) const
{
    std::vector<Vec3> all;
    all.reserve(patch.vertices.size() + splits.size());
    for (const Index vertex : patch.vertices) {
        all.push_back(refined[vertex]);
    }
    for (const auto& [a, b] : splits) {
        all.push_back((all[a] + all[b]) / 2);
    }
    return all;
}

std::array<double, 3> Parametrisation::weights_in_parent(const Patch& patch, Index triangle,
                                                         const std::array<double, 3>& weights) const
{
    const auto& parent = patch.corners[parents[triangle]];
    std::array<double, 3> sums{0, 0, 0};
    const auto add = [&](Index vertex, double weight) {
        for (std::size_t i = 0; i < 3; ++i) {
            if (parent[i] == vertex) {
                sums[i] += weight;
            }
        }
    };
    for (std::size_t i = 0; i < 3; ++i) {
        const Index vertex = corners[triangle][i];
        if (vertex < patch.vertices.size()) {
            add(vertex, weights[i]);
        } else {
            const auto& [a, b] = splits[vertex - patch.vertices.size()];
            add(a, weights[i] / 2);
            add(b, weights[i] / 2);
        }
    }
    return sums;
}

Parametrisation unplaced_map(const Patch& patch)
{
    Parametrisation map;
    split_edges(patch, map);
    return map;
}

Result<Parametrisation> parametrise(const Patch& patch, std::span<const Vec3> positions,
                                    const Domain& domain, const ParametriseOptions& options)
{
    Parametrisation map = unplaced_map(patch);
    const std::vector<Vec3> all = map.positions(patch, positions);
    map.points.assign(all.size(), PlanePoint(0, 0));
    if (options.boundary.empty()) {
        place_boundary(patch, all, domain, map.points);
    } else {
        std::copy(options.boundary.begin(), options.boundary.end(), map.points.begin());
    }
    Placement placement(patch, map, all);
    const double domain_area = area(domain);
    if (minimise_stretch(placement, map, domain_area, options.stretch_rounds)) {
        return map;
    }
    placement.make_uniform();
    if (minimise_stretch(placement, map, domain_area, options.stretch_rounds)) {
        return map;
    }
    return make_error(ErrorCode::parametrisationFailed,
                      "the patch of layout face " + std::to_string(patch.face) + " with " +
                          std::to_string(patch.triangles.size()) +
                          " triangles is too long and thin for double precision",
                      {{"face", patch.face}});
}

std::vector<double> side_lengths(const Patch& patch, std::span<const Vec3> positions)
{
    std::vector<double> lengths(patch.side_count(), 0);
    for (Index side = 0; side < patch.side_count(); ++side) {
        for (Index v = patch.sides[side]; v < patch.sides[side + 1]; ++v) {
            const Index to = v + 1 == patch.boundary_size() ? 0 : v + 1;
            lengths[side] += (positions[patch.vertices[to]] - positions[patch.vertices[v]]).norm();
        }
    }
    return lengths;
}

Domain fitting_rectangle(const Patch& patch, std::span<const Vec3> positions)
{
    const std::vector<double> lengths = side_lengths(patch, positions);
    const double width = (lengths[0] + lengths[2]) / 2;
    const double height = (lengths[1] + lengths[3]) / 2;
    // A side without length would leave no domain.
    const double least = 1e-6 * (width + height);
    return least > 0 ? rectangle(std::max(width, least), std::max(height, least)) : rectangle(1, 1);
}

}  // namespace layout_embedding
