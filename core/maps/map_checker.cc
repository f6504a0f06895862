#include "maps/map_checker.hh"

#include <algorithm>
#include <cmath>
#include <map>

namespace layout_embedding {
namespace {

__extension__ using Exact = __int128;

/// A point of the plane in whole steps of 2^-52.
struct ExactPoint {
    Exact x;
    Exact y;
};

/// The point as integers; false if it is not on the grid or beyond it.
bool exact_point(const PlanePoint& point, ExactPoint& result)
{
    const double steps = std::ldexp(1.0, 52);
    const double x = point.x() * steps;
    const double y = point.y() * steps;
    if (!(std::abs(x) <= steps && std::abs(y) <= steps) || std::floor(x) != x ||
        std::floor(y) != y) {
        return false;
    }
    result = {static_cast<std::int64_t>(x), static_cast<std::int64_t>(y)};
    return true;
}

Exact doubled_area(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c)
{
    return (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
}

class MapCheck {
public:
    MapCheck(const Layout& layout, CheckReport& report) : layout_(layout), report_(report) {}

    void compare_domains(const PlacedTarget& a, const PlacedTarget& b)
    {
        if (a.domains() != b.domains() || a.domains().size() != layout_.face_count()) {
            add("domainsDiffer", "the two targets are placed on different domains");
        }
    }

    void check(const PlacedTarget& placed, const std::vector<Index>& landmarks,
               const std::string& name)
    {
        placed_ = &placed;
        landmarks_ = &landmarks;
        name_ = name;
        std::vector<bool> seen(placed.refined().triangle_faces.size(), false);
        if (placed.patches().size() != layout_.face_count() ||
            placed.shares().size() != layout_.edge_count()) {
            add("mapIncomplete", name_ + " has not one map per layout face");
            return;
        }
        for (Index face = 0; face < layout_.face_count(); ++face) {
            check_face(face, seen);
        }
        for (std::size_t t = 0; t < seen.size(); ++t) {
            if (!seen[t] && placed.refined().triangle_patches[t] != kNone) {
                add("mapIncomplete",
                    name_ + ": refined triangle " + std::to_string(t) + " is in no map");
                break;
            }
        }
    }

private:
    void add(const std::string& code, const std::string& message)
    {
        const auto same = std::count_if(report_.violations.begin(), report_.violations.end(),
                                        [&](const Violation& v) { return v.code == code; });
        if (static_cast<std::size_t>(same) < kMaxViolationsPerCode) {
            report_.violations.push_back({code, message + "."});
        }
    }

    void check_face(Index face, std::vector<bool>& seen)
    {
        const PlacedPatch& placed = placed_->patches()[face];
        const Parametrisation& map = placed.map;
        const std::string where = name_ + ", layout face " + std::to_string(face);
        std::vector<ExactPoint> corners(placed_->domains()[face].size());
        std::vector<ExactPoint> points(map.points.size());
        bool sound = map.points.size() == placed.patch.vertices.size() + map.splits.size() &&
                     map.parents.size() == map.corners.size() &&
                     corners.size() == layout_.face_halfedges(face).size() &&
                     placed.patch.sides.size() == corners.size() + 1;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            sound = sound && exact_point(placed_->domains()[face][i], corners[i]);
        }
        for (std::size_t i = 0; i < points.size(); ++i) {
            sound = sound && exact_point(map.points[i], points[i]);
        }
        for (const auto& triangle : map.corners) {
            for (const Index v : triangle) {
                sound = sound && v < points.size();
            }
        }
        if (!sound) {
            add("mapIncomplete", where + " has arrays that do not fit together");
            return;
        }
        check_convex(corners, where);
        check_parts(placed, where, seen);
        check_boundary(face, placed, corners, points, where);
        Exact sum = 0;
        for (std::size_t t = 0; t < map.corners.size(); ++t) {
            const auto& c = map.corners[t];
            const Exact area = doubled_area(points[c[0]], points[c[1]], points[c[2]]);
            if (area <= 0) {
                add("triangleFlipped",
                    where + ": triangle " + std::to_string(t) + " is not positively oriented");
            }
            sum += area;
        }
        for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
            sum -= doubled_area(corners[0], corners[i], corners[i + 1]);
        }
        if (sum != 0) {
            add("areaMismatch", where + ": the triangles do not cover the domain once");
        }
    }

    void check_convex(const std::vector<ExactPoint>& corners, const std::string& where)
    {
        const std::size_t n = corners.size();
        for (std::size_t i = 0; i < n; ++i) {
            for (std::size_t j = 0; j < n; ++j) {
                const std::size_t k = (i + 1) % n;
                if (j != i && j != k && doubled_area(corners[i], corners[k], corners[j]) <= 0) {
                    add("domainNotConvex", where + ": the domain is not strictly convex");
                    return;
                }
            }
        }
    }

    /// Every refined triangle is covered once by its parts, and these are those of the patch.
    void check_parts(const PlacedPatch& placed, const std::string& where, std::vector<bool>& seen)
    {
        const RefinedMesh& refined = placed_->refined();
        // In eighths of a triangle; splits lie in the middle of edges.
        std::vector<double> covered(placed.patch.triangles.size(), 0);
        bool sound = placed.patch.corners.size() == placed.patch.triangles.size();
        const auto fit = [&](Index patch_vertex, Index refined_vertex) {
            return patch_vertex < placed.patch.vertices.size() &&
                   placed.patch.vertices[patch_vertex] == refined_vertex;
        };
        for (std::size_t t = 0; sound && t < placed.patch.triangles.size(); ++t) {
            const Index triangle = placed.patch.triangles[t];
            sound = triangle < seen.size() && !seen[triangle] &&
                    refined.triangle_patches[triangle] == placed.patch.face;
            for (std::size_t i = 0; sound && i < 3; ++i) {
                sound =
                    fit(placed.patch.corners[t][i], refined.corners[3 * std::size_t{triangle} + i]);
            }
            if (sound) {
                seen[triangle] = true;
            }
        }
        for (std::size_t p = 0; sound && p < placed.map.corners.size(); ++p) {
            const Index parent = placed.map.parents[p];
            sound = parent < covered.size();
            std::array<std::array<double, 3>, 3> b{};
            for (std::size_t i = 0; sound && i < 3; ++i) {
                const Index v = placed.map.corners[p][i];
                const auto add_corner = [&](Index vertex, double weight) {
                    const auto& of_parent = placed.patch.corners[parent];
                    const auto at = std::find(of_parent.begin(), of_parent.end(), vertex);
                    sound = sound && at != of_parent.end();
                    if (sound) {
                        b[i][static_cast<std::size_t>(at - of_parent.begin())] += weight;
                    }
                };
                if (v < placed.patch.vertices.size()) {
                    add_corner(v, 1);
                } else {
                    const auto& split = placed.map.splits[v - placed.patch.vertices.size()];
                    add_corner(split[0], 0.5);
                    add_corner(split[1], 0.5);
                }
            }
            if (sound) {
                // Halves are exact.
                const double part = (b[1][0] - b[0][0]) * (b[2][1] - b[0][1]) -
                                    (b[2][0] - b[0][0]) * (b[1][1] - b[0][1]);
                sound = part > 0;
                covered[parent] += part;
            }
        }
        sound = sound && std::all_of(covered.begin(), covered.end(),
                                     [](double whole) { return whole == 1; });
        if (!sound) {
            add("mapIncomplete", where + ": the map is not one of the patch's triangles");
        }
    }

    void check_boundary(Index face, const PlacedPatch& placed,
                        const std::vector<ExactPoint>& corners,
                        const std::vector<ExactPoint>& points, const std::string& where)
    {
        const Patch& patch = placed.patch;
        const std::size_t n = corners.size();
        const auto halfedges = layout_.face_halfedges(face);
        for (std::size_t side = 0; side < n; ++side) {
            const ExactPoint& from = corners[side];
            const ExactPoint& to = corners[(side + 1) % n];
            const Index landmark = (*landmarks_)[layout_.tail(halfedges[side])];
            const Index begin = patch.sides[side];
            const Index end = patch.sides[side + 1];
            if (begin >= end || end > patch.vertices.size() || patch.vertices[begin] != landmark ||
                points[begin].x != from.x || points[begin].y != from.y) {
                add("landmarkMisplaced",
                    where + ": corner " + std::to_string(side) + " is not at its landmark");
                return;
            }
            const ChainShares& shares = placed_->shares()[halfedges[side] / 2];
            const auto& chain = placed_->refined().chains[halfedges[side] / 2];
            if (shares.size() != chain.size() || shares.size() != end - begin + 1U) {
                add("sidesDisagree", where + ": side " + std::to_string(side) +
                                         " has not the vertices of its chain");
                return;
            }
            Exact last = -1;
            for (Index v = begin; v < end; ++v) {
                const ExactPoint& p = points[v];
                const Exact across = doubled_area(from, to, p);
                const Exact along =
                    (p.x - from.x) * (to.x - from.x) + (p.y - from.y) * (to.y - from.y);
                const Exact whole =
                    (to.x - from.x) * (to.x - from.x) + (to.y - from.y) * (to.y - from.y);
                if (across != 0 || along <= last || along >= whole) {
                    add("boundaryOffSide",
                        where + ": boundary vertex " + std::to_string(v) + " is off its side");
                    return;
                }
                last = along;
                // The share of the chain's vertex, from this side's tail; `whole` is a multiple of
                // its steps.
                const std::size_t i = v - begin;
                const bool forward = halfedges[side] % 2 == 0;
                const std::size_t place = forward ? i : chain.size() - 1 - i;
                const Exact steps = Exact{1} << 32;
                const Exact share = forward ? Exact{shares[place]} : steps - shares[place];
                const Exact scale = whole / steps;
                if (scale * steps != whole || along != share * scale ||
                    chain[place] != patch.vertices[v]) {
                    add("sidesDisagree", where + ": boundary vertex " + std::to_string(v) +
                                             " is not where its chain has it");
                    return;
                }
            }
        }
    }

    const Layout& layout_;
    CheckReport& report_;
    const PlacedTarget* placed_ = nullptr;
    const std::vector<Index>* landmarks_ = nullptr;
    std::string name_;
};

}  // namespace

CheckReport check_maps(const Layout& layout, const std::vector<Index>& landmarks_a,
                       const PlacedTarget& a, const std::vector<Index>& landmarks_b,
                       const PlacedTarget& b)
{
    CheckReport report;
    MapCheck check(layout, report);
    check.compare_domains(a, b);
    if (report.valid()) {
        check.check(a, landmarks_a, "target a");
        check.check(b, landmarks_b, "target b");
    }
    return report;
}

}  // namespace layout_embedding
