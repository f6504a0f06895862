#include "mesh/area_repair.hh"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

#include "mesh/polygon_halfedges.hh"
#include "mesh/validation.hh"

namespace layout_embedding {
namespace {

/// One pass over the triangles without area. What one operation changed, its vertices, is left
/// alone until the next pass: the halfedges are those of the beginning.
class MendingRound {
public:
    MendingRound(PolygonMesh& mesh, std::vector<Index>& representatives, FaceOrigins& origins)
        : mesh_(mesh),
          before_(mesh),
          halfedges_(before_),
          representatives_(representatives),
          origins_(origins),
          touched_(mesh.vertex_count(), false),
          dropped_(mesh.face_count(), false)
    {}

    Index run()
    {
        if (halfedges_.non_manifold()[0] != kNone || halfedges_.inconsistent()[0] != kNone) {
            return 0;
        }
        Index mended = 0;
        for (Index f = 0; f < before_.face_count(); ++f) {
            if (!dropped_[f] && !is_touched(before_.face(f)) && has_no_area(before_, 3 * f) &&
                mend(f)) {
                ++mended;
            }
        }
        if (mended > 0) {
            remove_dropped();
        }
        return mended;
    }

private:
    const Vec3& position(Index v) const { return before_.positions[v]; }

    static bool has_no_area(const PolygonMesh& mesh, Index corner)
    {
        return layout_embedding::has_no_area(mesh.positions[mesh.corners[corner]],
                                             mesh.positions[mesh.corners[corner + 1]],
                                             mesh.positions[mesh.corners[corner + 2]]);
    }

    bool is_touched(std::span<const Index> vertices) const
    {
        return std::any_of(vertices.begin(), vertices.end(), [&](Index v) { return touched_[v]; });
    }

    void touch(std::span<const Index> vertices)
    {
        for (const Index v : vertices) {
            touched_[v] = true;
        }
    }

    double squared_length(Index h) const
    {
        return (position(halfedges_.head(h)) - position(halfedges_.tail(h))).squaredNorm();
    }

    bool mend(Index f)
    {
        if (is_alone(f)) {
            dropped_[f] = true;
            return true;
        }
        Index longest = 3 * f;
        for (Index h = 3 * f; h < 3 * f + 3; ++h) {
            if (position(halfedges_.tail(h)) == position(halfedges_.head(h))) {
                return collapse(h);
            }
            if (squared_length(h) > squared_length(longest)) {
                longest = h;
            }
        }
        return halfedges_.opposite(longest) == kNone ? drop_at_boundary(longest) : flip(longest);
    }

    /// Whether no other face shares an edge with f, as with the debris in triangle soups.
    bool is_alone(Index f) const
    {
        return before_.face_count() > 1 && halfedges_.opposite(3 * f) == kNone &&
               halfedges_.opposite(3 * f + 1) == kNone && halfedges_.opposite(3 * f + 2) == kNone;
    }

    /// All halfedges that leave the tail of `start`, and whether that is a boundary vertex (to
    /// whose first neighbour no halfedge leads; see neighbours()).
    std::vector<Index> fan(Index start, bool& boundary) const
    {
        std::vector<Index> result;
        Index h = start;
        do {
            result.push_back(h);
            h = halfedges_.opposite(halfedges_.previous(h));
        } while (h != kNone && h != start);
        boundary = h == kNone;
        if (boundary) {
            for (h = halfedges_.opposite(start); h != kNone; h = halfedges_.opposite(h)) {
                h = halfedges_.next(h);
                result.push_back(h);
            }
        }
        return result;
    }

    std::vector<Index> neighbours(const std::vector<Index>& fan) const
    {
        std::vector<Index> result;
        for (const Index h : fan) {
            result.push_back(halfedges_.head(h));
            result.push_back(halfedges_.tail(halfedges_.previous(h)));
        }
        std::sort(result.begin(), result.end());
        result.erase(std::unique(result.begin(), result.end()), result.end());
        return result;
    }

    /// Makes one vertex of the two ends of h, which lie at the same place.
    bool collapse(Index h)
    {
        const Index twin = halfedges_.opposite(h);
        bool tail_on_boundary = false;
        bool head_on_boundary = false;
        const auto tail_fan = fan(h, tail_on_boundary);
        const auto head_fan = fan(halfedges_.next(h), head_on_boundary);
        const auto around_tail = neighbours(tail_fan);
        const auto around_head = neighbours(head_fan);
        if (is_touched(around_tail) || is_touched(around_head)) {
            return false;
        }
        // The link condition: the two share no neighbours but those across the edge's faces.
        std::vector<Index> common;
        std::set_intersection(around_tail.begin(), around_tail.end(), around_head.begin(),
                              around_head.end(), std::back_inserter(common));
        if (common.size() != (twin == kNone ? 1U : 2U) ||
            (twin != kNone && tail_on_boundary && head_on_boundary) ||
            std::max(around_tail.size(), around_head.size()) <= 2 ||
            (!tail_on_boundary && !head_on_boundary && around_tail.size() == 3 &&
             around_head.size() == 3)) {
            return false;
        }
        const Index kept = std::min(halfedges_.tail(h), halfedges_.head(h));
        const Index gone = std::max(halfedges_.tail(h), halfedges_.head(h));
        for (const auto& corners : {tail_fan, head_fan}) {
            for (const Index corner : corners) {
                mesh_.corners[corner] = kept;
            }
        }
        dropped_[halfedges_.face(h)] = true;
        if (twin != kNone) {
            dropped_[halfedges_.face(twin)] = true;
        }
        representatives_[gone] = kept;
        touch(around_tail);
        touch(around_head);
        return true;
    }

    /// Flips the longest edge of a triangle whose third corner lies on it.
    bool flip(Index h)
    {
        const Index twin = halfedges_.opposite(h);
        const Index a = halfedges_.tail(h);
        const Index b = halfedges_.head(h);
        const Index c = halfedges_.tail(halfedges_.previous(h));
        const Index d = halfedges_.tail(halfedges_.previous(twin));
        bool boundary = false;
        const auto around_c = neighbours(fan(halfedges_.previous(h), boundary));
        if (touched_[d] || c == d || std::binary_search(around_c.begin(), around_c.end(), d)) {
            return false;
        }
        const auto normal = [&](Index p, Index q, Index r) -> Vec3 {
            return (position(q) - position(p)).cross(position(r) - position(p));
        };
        const Vec3 wanted = normal(b, a, d);
        if (!(normal(a, d, c).dot(wanted) > 0) || !(normal(d, b, c).dot(wanted) > 0)) {
            return false;
        }
        const Vec3 along = position(b) - position(a);
        follow_flip(h, (position(c) - position(a)).dot(along) / along.squaredNorm());
        set_face(halfedges_.face(h), {a, d, c});
        set_face(halfedges_.face(twin), {d, b, c});
        touch(std::array<Index, 4>{a, b, c, d});
        return true;
    }

    /// Both new faces lie in the one across h, the third corner at the share `t` of h.
    void follow_flip(Index h, double t)
    {
        const Index face = halfedges_.face(h);
        const Index across = halfedges_.face(halfedges_.opposite(h));
        const FaceOrigins::Places places = origins_.places(across);
        const std::size_t k = halfedges_.opposite(h) - 3 * across;
        const auto& at_b = places[k];
        const auto& at_a = places[(k + 1) % 3];
        const auto& at_d = places[(k + 2) % 3];
        std::array<double, 3> at_c{};
        for (std::size_t i = 0; i < 3; ++i) {
            at_c[i] = (1 - t) * at_a[i] + t * at_b[i];
        }
        const Index origin = origins_.face(across);
        origins_.set(face, origin, {at_a, at_d, at_c});
        origins_.set(across, origin, {at_d, at_b, at_c});
    }

    /// Drops a triangle whose longest edge lies on the boundary and whose third corner, on that
    /// edge, takes its place there.
    bool drop_at_boundary(Index h)
    {
        const Index c = halfedges_.tail(halfedges_.previous(h));
        bool boundary = false;
        fan(halfedges_.previous(h), boundary);
        if (boundary) {
            return false;
        }
        dropped_[halfedges_.face(h)] = true;
        touch(std::array<Index, 3>{halfedges_.tail(h), halfedges_.head(h), c});
        return true;
    }

    void set_face(Index f, const std::array<Index, 3>& corners)
    {
        std::copy(corners.begin(), corners.end(), mesh_.corners.begin() + 3 * f);
    }

    void remove_dropped()
    {
        PolygonMesh result;
        result.positions = mesh_.positions;
        for (Index f = 0; f < mesh_.face_count(); ++f) {
            if (!dropped_[f]) {
                result.add_face(mesh_.face(f));
            }
        }
        mesh_ = std::move(result);
        origins_.keep_if([&](Index f) { return !dropped_[f]; });
    }

    PolygonMesh& mesh_;
    const PolygonMesh before_;
    const PolygonHalfedges halfedges_;
    std::vector<Index>& representatives_;
    FaceOrigins& origins_;
    std::vector<bool> touched_;
    std::vector<bool> dropped_;
};

}  // namespace

Index mend_triangles_without_area(PolygonMesh& mesh, std::vector<Index>& representatives,
                                  FaceOrigins& origins)
{
    constexpr int kMaxRounds = 100;
    Index mended = 0;
    for (int round = 0; round < kMaxRounds; ++round) {
        const Index now = MendingRound(mesh, representatives, origins).run();
        if (now == 0) {
            break;
        }
        mended += now;
    }
    return mended;
}

}  // namespace layout_embedding
