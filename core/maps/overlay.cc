#include "maps/overlay.hh"

#include <algorithm>
#include <limits>
#include <map>
#include <string>

#include "maps/exact_location.hh"

namespace layout_embedding {
namespace {

/// What a segment meets in a triangulation: a vertex, or an edge crossed inside of both.
struct Meeting {
    Index vertex = kNone;
    Index edge = kNone;
    /// The triangle that leads to it, kNone along an edge.
    Index through = kNone;
};

/// Follows straight segments through a triangulation of the same domain, exactly.
class SegmentWalk {
public:
    explicit SegmentWalk(const ExactLocation& map) : map_(map), mesh_(map.mesh()) {}

    /// Everything that the segment meets strictly between its ends, in order; the last entry has
    /// neither vertex nor edge and tells the triangle that leads to the end. False if it leaves the
    /// domain.
    bool run(const GridPoint& from, const ExactPlace& start, const GridPoint& to,
             const ExactPlace& end, std::vector<Meeting>& meetings)
    {
        from_ = from;
        to_ = to;
        end_ = end;
        failed_ = false;
        meetings.clear();
        State state{start.vertex, start.halfedge,
                    start.vertex == kNone && start.halfedge == kNone ? start.triangle : kNone};
        // No edge is crossed twice, and no vertex met twice.
        for (Index step = 0; step <= 2 * mesh_.edge_count() + 2; ++step) {
            const bool ended = state.vertex != kNone     ? leave_vertex(state, meetings)
                               : state.halfedge != kNone ? leave_edge(state, meetings)
                                                         : leave_triangle(state, meetings);
            if (ended) {
                return !failed_;
            }
        }
        return false;
    }

private:
    /// At a vertex, on an edge (only at the start), or inside of a triangle or on its rim.
    struct State {
        Index vertex = kNone;
        Index halfedge = kNone;
        Index triangle = kNone;
    };

    const GridPoint& at(Index vertex) const { return map_.point(vertex); }

    bool ends_on_edge(Index h) const
    {
        return end_.halfedge != kNone && mesh_.edge(end_.halfedge) == mesh_.edge(h);
    }

    bool ends_in(Index triangle) const
    {
        for (Index h = 3 * triangle; h < 3 * triangle + 3; ++h) {
            if (end_.vertex == mesh_.tail(h) || ends_on_edge(h)) {
                return true;
            }
        }
        return end_.vertex == kNone && end_.halfedge == kNone && end_.triangle == triangle;
    }

    /// Along an edge to the vertex `next`.
    bool along(Index h, Index next, State& state, std::vector<Meeting>& meetings)
    {
        if (ends_on_edge(h) || end_.vertex == next) {
            meetings.push_back({});
            return true;
        }
        meetings.push_back({next, kNone, kNone});
        state = {next, kNone, kNone};
        return false;
    }

    bool leave_vertex(State& state, std::vector<Meeting>& meetings)
    {
        const Index v = state.vertex;
        const Index first = mesh_.outgoing(v);
        for (Index h = first; h != kNone;) {
            const Index right = mesh_.head(h);
            const Index left = mesh_.tail(TriangleMesh::previous(h));
            const WideInteger of_right = orientation(at(v), at(right), to_);
            const WideInteger of_left = orientation(at(v), at(left), to_);
            if (of_right == 0 && inner(at(v), at(right), at(v), to_) > 0) {
                return along(h, right, state, meetings);
            }
            if (of_left == 0 && inner(at(v), at(left), at(v), to_) > 0) {
                return along(TriangleMesh::previous(h), left, state, meetings);
            }
            if (of_right > 0 && of_left < 0) {
                state = {kNone, kNone, TriangleMesh::face_of(h)};
                return false;
            }
            h = mesh_.rotated_ccw(h);
            if (h == first) {
                break;
            }
        }
        failed_ = true;
        return true;
    }

    bool leave_edge(State& state, std::vector<Meeting>& meetings)
    {
        const Index h = state.halfedge;
        const Index tail = mesh_.tail(h);
        const Index head = mesh_.head(h);
        const WideInteger side = orientation(at(tail), at(head), to_);
        if (side == 0) {
            const bool forwards = inner(at(tail), at(head), from_, to_) > 0;
            return along(h, forwards ? head : tail, state, meetings);
        }
        const Index into = side > 0 ? h : mesh_.opposite(h);
        if (into == kNone) {
            failed_ = true;
            return true;
        }
        state = {kNone, kNone, TriangleMesh::face_of(into)};
        return false;
    }

    bool leave_triangle(State& state, std::vector<Meeting>& meetings)
    {
        const Index triangle = state.triangle;
        if (ends_in(triangle)) {
            meetings.push_back({kNone, kNone, triangle});
            return true;
        }
        std::array<int, 3> sides{};
        for (Index i = 0; i < 3; ++i) {
            const WideInteger side = orientation(from_, to_, at(mesh_.tail(3 * triangle + i)));
            sides[i] = side > 0 ? 1 : side < 0 ? -1 : 0;
        }
        for (Index i = 0; i < 3; ++i) {
            const Index j = (i + 1) % 3;
            const Index k = (i + 2) % 3;
            const Index h = 3 * triangle + i;
            if (sides[i] == 0 && sides[j] > 0 && sides[k] < 0) {
                meetings.push_back({mesh_.tail(h), kNone, triangle});
                state = {mesh_.tail(h), kNone, kNone};
                return false;
            }
            if (sides[i] < 0 && sides[j] > 0) {
                const Index opposite = mesh_.opposite(h);
                if (opposite == kNone) {
                    break;
                }
                meetings.push_back({kNone, mesh_.edge(h), triangle});
                state = {kNone, kNone, TriangleMesh::face_of(opposite)};
                return false;
            }
        }
        failed_ = true;
        return true;
    }

    const ExactLocation& map_;
    const TriangleMesh& mesh_;
    GridPoint from_;
    GridPoint to_;
    ExactPlace end_;
    bool failed_ = false;
};

/// A node of the overlay of one patch.
struct OverlayNode {
    /// The vertices of the two maps that it is, kNone for a vertex of only one of them.
    std::array<Index, 2> vertices{kNone, kNone};
    /// The edges that cross here, where it is no vertex.
    std::array<Index, 2> edges{kNone, kNone};
    PlanePoint point{0, 0};
    /// Per map: a triangle that holds it, and the weights of its corners there.
    std::array<Index, 2> triangles{kNone, kNone};
    std::array<std::array<double, 3>, 2> weights{};
};

/// A piece of an edge between two nodes, as seen from one of them, with the triangles on its left.
struct OverlayDart {
    Index from;
    Index to;
    /// An exact point in the direction of the dart.
    GridPoint towards;
    /// Per map: the triangle on its left, kNone where only other darts know or there is none.
    std::array<Index, 2> left;
};

class PatchOverlay {
public:
    PatchOverlay(const PlacedPatch& a, const PlacedPatch& b)
        : maps_{ExactLocation(a), ExactLocation(b)}
    {}

    bool run()
    {
        add_vertices();
        if (!walk(0) || !walk(1)) {
            return false;
        }
        sort_darts();
        return trace();
    }

    const std::vector<OverlayNode>& nodes() const { return nodes_; }
    const std::vector<std::array<Index, 3>>& corners() const { return corners_; }
    const std::vector<std::array<Index, 2>>& triangles() const { return triangles_; }
    double area_of(const std::array<Index, 3>& c) const
    {
        return cross(nodes_[c[1]].point - nodes_[c[0]].point,
                     nodes_[c[2]].point - nodes_[c[0]].point) /
               2;
    }

private:
    const TriangleMesh& mesh(std::size_t side) const { return maps_[side].mesh(); }

    void add_vertices()
    {
        for (const std::size_t side : {0U, 1U}) {
            const std::size_t other = 1 - side;
            const Index count = mesh(side).vertex_count();
            node_of_[side].assign(count, kNone);
            places_[side].resize(count);
            for (Index v = 0; v < count; ++v) {
                const GridPoint& point = maps_[side].point(v);
                const ExactPlace place = maps_[other].find(point);
                places_[side][v] = place;
                if (side == 1 && place.vertex != kNone) {
                    node_of_[1][v] = node_of_[0][place.vertex];
                    nodes_[node_of_[1][v]].vertices[1] = v;
                    continue;
                }
                OverlayNode node;
                node.point = to_plane(point);
                node.vertices[side] = v;
                // A triangle of its own map around it.
                const Index h = mesh(side).outgoing(v);
                node.triangles[side] = TriangleMesh::face_of(h);
                node.weights[side][h % 3] = 1;
                node.triangles[other] = place.triangle;
                node.weights[other] = maps_[other].weights(place.triangle, point);
                node_of_[side][v] = static_cast<Index>(nodes_.size());
                nodes_.push_back(node);
            }
        }
    }

    Index crossing_node(Index edge_a, Index edge_b)
    {
        const auto [place, fresh] =
            crossings_.try_emplace({edge_a, edge_b}, static_cast<Index>(nodes_.size()));
        if (fresh) {
            nodes_.push_back(crossing(edge_a, edge_b));
        }
        return place->second;
    }

    OverlayNode crossing(Index edge_a, Index edge_b) const
    {
        OverlayNode node;
        node.edges = {edge_a, edge_b};
        std::array<std::array<GridPoint, 2>, 2> ends;
        std::array<Index, 2> halfedges{};
        for (const std::size_t side : {0U, 1U}) {
            halfedges[side] = mesh(side).halfedge(node.edges[side]);
            ends[side] = {maps_[side].point(mesh(side).tail(halfedges[side])),
                          maps_[side].point(mesh(side).head(halfedges[side]))};
        }
        for (const std::size_t side : {0U, 1U}) {
            const auto& other = ends[1 - side];
            const double before =
                std::abs(static_cast<double>(orientation(other[0], other[1], ends[side][0])));
            const double behind =
                std::abs(static_cast<double>(orientation(other[0], other[1], ends[side][1])));
            const double share = before / (before + behind);
            const Index h = halfedges[side];
            node.triangles[side] = TriangleMesh::face_of(h);
            node.weights[side][h % 3] = 1 - share;
            node.weights[side][TriangleMesh::next(h) % 3] = share;
            if (side == 0) {
                node.point = (1 - share) * to_plane(ends[0][0]) + share * to_plane(ends[0][1]);
            }
        }
        return node;
    }

    /// Cuts the edges of one map at everything that they meet in the other one.
    bool walk(std::size_t side)
    {
        const std::size_t other = 1 - side;
        SegmentWalk walk(maps_[other]);
        std::vector<Meeting> meetings;
        for (Index e = 0; e < mesh(side).edge_count(); ++e) {
            const Index h = mesh(side).halfedge(e);
            const Index tail = mesh(side).tail(h);
            const Index head = mesh(side).head(h);
            const GridPoint& from = maps_[side].point(tail);
            const GridPoint& to = maps_[side].point(head);
            if (!walk.run(from, places_[side][tail], to, places_[side][head], meetings)) {
                return false;
            }
            const Index opposite = mesh(side).opposite(h);
            std::array<Index, 2> own{TriangleMesh::face_of(h),
                                     opposite == kNone ? kNone : TriangleMesh::face_of(opposite)};
            Index last = node_of_[side][tail];
            for (const Meeting& meeting : meetings) {
                Index node = node_of_[side][head];
                if (meeting.vertex != kNone) {
                    node = node_of_[other][meeting.vertex];
                } else if (meeting.edge != kNone) {
                    node =
                        side == 0 ? crossing_node(e, meeting.edge) : crossing_node(meeting.edge, e);
                }
                std::array<Index, 2> left{};
                std::array<Index, 2> right{};
                left[side] = own[0];
                right[side] = own[1];
                left[other] = right[other] = meeting.through;
                darts_.push_back({last, node, to, left});
                darts_.push_back({node, last, from, right});
                last = node;
            }
        }
        return true;
    }

    /// The exact place of a node that is a vertex.
    const GridPoint& place_of(const OverlayNode& node) const
    {
        return node.vertices[0] != kNone ? maps_[0].point(node.vertices[0])
                                         : maps_[1].point(node.vertices[1]);
    }

    /// 0 for directions in [0, 180) degrees, 1 for the others.
    static int half_plane(const GridPoint& origin, const GridPoint& towards)
    {
        return towards.y > origin.y || (towards.y == origin.y && towards.x > origin.x) ? 0 : 1;
    }

    /// Whether a comes before b around their node, counter-clockwise. At a crossing, where edges
    /// have no exact common point, directions are those of the edges themselves.
    bool turns_before(const OverlayDart& a, const OverlayDart& b) const
    {
        const OverlayNode& node = nodes_[a.from];
        if (node.vertices[0] == kNone && node.vertices[1] == kNone) {
            return false;
        }
        const GridPoint& origin = place_of(node);
        const int half_a = half_plane(origin, a.towards);
        const int half_b = half_plane(origin, b.towards);
        return half_a != half_b ? half_a < half_b : orientation(origin, a.towards, b.towards) > 0;
    }

    /// The four darts of a crossing, counter-clockwise.
    void order_crossing(Index node, std::vector<OverlayDart>::iterator begin) const
    {
        // Edge a forwards comes first; b forwards is on its left or right.
        const std::array<Index, 2> h{mesh(0).halfedge(nodes_[node].edges[0]),
                                     mesh(1).halfedge(nodes_[node].edges[1])};
        const GridPoint& a_from = maps_[0].point(mesh(0).tail(h[0]));
        const GridPoint& a_to = maps_[0].point(mesh(0).head(h[0]));
        const GridPoint& b_from = maps_[1].point(mesh(1).tail(h[1]));
        const GridPoint& b_to = maps_[1].point(mesh(1).head(h[1]));
        const bool left = orientation(a_from, a_to, b_to) > 0;
        const std::array<GridPoint, 4> order =
            left ? std::array<GridPoint, 4>{a_to, b_to, a_from, b_from}
                 : std::array<GridPoint, 4>{a_to, b_from, a_from, b_to};
        std::sort(begin, begin + 4, [&](const OverlayDart& x, const OverlayDart& y) {
            return std::find(order.begin(), order.end(), x.towards) <
                   std::find(order.begin(), order.end(), y.towards);
        });
    }

    /// Sorts darts by node and around it, and makes those one that run along each other.
    void sort_darts()
    {
        std::stable_sort(
            darts_.begin(), darts_.end(),
            [](const OverlayDart& a, const OverlayDart& b) { return a.from < b.from; });
        std::vector<OverlayDart> sorted;
        offsets_.assign(nodes_.size() + 1, 0);
        for (auto begin = darts_.begin(); begin != darts_.end();) {
            const Index node = begin->from;
            const auto end = std::find_if(
                begin, darts_.end(), [&](const OverlayDart& dart) { return dart.from != node; });
            if (nodes_[node].vertices[0] == kNone && nodes_[node].vertices[1] == kNone) {
                if (end - begin == 4) {
                    order_crossing(node, begin);
                }
            } else {
                std::stable_sort(begin, end, [&](const OverlayDart& a, const OverlayDart& b) {
                    return turns_before(a, b);
                });
            }
            const std::size_t first = sorted.size();
            for (; begin != end; ++begin) {
                if (sorted.size() > first && sorted.back().to == begin->to) {
                    for (std::size_t side = 0; side < 2; ++side) {
                        if (sorted.back().left[side] == kNone) {
                            sorted.back().left[side] = begin->left[side];
                        }
                    }
                } else {
                    sorted.push_back(*begin);
                }
            }
            offsets_[node + 1] = static_cast<Index>(sorted.size());
        }
        for (std::size_t i = 1; i < offsets_.size(); ++i) {
            offsets_[i] = std::max(offsets_[i], offsets_[i - 1]);
        }
        darts_ = std::move(sorted);
    }

    Index find_dart(Index from, Index to) const
    {
        for (Index d = offsets_[from]; d < offsets_[from + 1]; ++d) {
            if (darts_[d].to == to) {
                return d;
            }
        }
        return kNone;
    }

    /// Finds the faces between the darts and triangulates them.
    bool trace()
    {
        std::vector<bool> seen(darts_.size(), false);
        std::vector<Index> polygon;
        for (Index first = 0; first < darts_.size(); ++first) {
            if (seen[first]) {
                continue;
            }
            polygon.clear();
            std::array<Index, 2> triangles{kNone, kNone};
            Index d = first;
            do {
                if (seen[d]) {
                    return false;
                }
                seen[d] = true;
                polygon.push_back(darts_[d].from);
                for (std::size_t side = 0; side < 2; ++side) {
                    if (darts_[d].left[side] != kNone) {
                        triangles[side] = darts_[d].left[side];
                    }
                }
                const Index twin = find_dart(darts_[d].to, darts_[d].from);
                if (twin == kNone) {
                    return false;
                }
                // The next one clockwise after the twin keeps the face on the left.
                const Index node = darts_[d].to;
                d = twin == offsets_[node] ? offsets_[node + 1] - 1 : twin - 1;
            } while (d != first);
            if (triangles[0] == kNone || triangles[1] == kNone) {
                continue;  // outside of the domain
            }
            if (polygon.size() < 3) {
                return false;
            }
            triangulate(polygon, triangles);
        }
        return true;
    }

    /// Of all triangulations of a convex polygon, one whose smallest area is largest.
    void triangulate(const std::vector<Index>& polygon, const std::array<Index, 2>& triangles)
    {
        const std::size_t n = polygon.size();
        const auto area = [&](std::size_t i, std::size_t j, std::size_t k) {
            return area_of({polygon[i], polygon[j], polygon[k]});
        };
        std::vector<double> best(n * n, std::numeric_limits<double>::infinity());
        std::vector<std::size_t> apex(n * n, 0);
        for (std::size_t gap = 2; gap < n; ++gap) {
            for (std::size_t i = 0; i + gap < n; ++i) {
                const std::size_t k = i + gap;
                double most = -std::numeric_limits<double>::infinity();
                for (std::size_t j = i + 1; j < k; ++j) {
                    const double least =
                        std::min({best[i * n + j], best[j * n + k], area(i, j, k)});
                    if (least > most) {
                        most = least;
                        apex[i * n + k] = j;
                    }
                }
                best[i * n + k] = most;
            }
        }
        std::vector<std::array<std::size_t, 2>> open{{0, n - 1}};
        while (!open.empty()) {
            const auto [i, k] = open.back();
            open.pop_back();
            if (k < i + 2) {
                continue;
            }
            const std::size_t j = apex[i * n + k];
            corners_.push_back({polygon[i], polygon[j], polygon[k]});
            triangles_.push_back(triangles);
            open.push_back({i, j});
            open.push_back({j, k});
        }
    }

    std::array<ExactLocation, 2> maps_;
    std::vector<OverlayNode> nodes_;
    std::array<std::vector<Index>, 2> node_of_;      // per vertex of either map
    std::array<std::vector<ExactPlace>, 2> places_;  // per vertex of either map, in the other one
    std::map<std::pair<Index, Index>, Index> crossings_;
    std::vector<OverlayDart> darts_;
    std::vector<Index> offsets_;  // per node
    std::vector<std::array<Index, 3>> corners_;
    std::vector<std::array<Index, 2>> triangles_;
};

}  // namespace

std::vector<OverlayPiece> overlay_pieces(const PlacedPatch& a, const PlacedPatch& b)
{
    PatchOverlay patch(a, b);
    std::vector<OverlayPiece> pieces;
    if (patch.run()) {
        for (std::size_t t = 0; t < patch.corners().size(); ++t) {
            pieces.push_back({patch.triangles()[t], patch.area_of(patch.corners()[t])});
        }
    }
    return pieces;
}

Result<Overlay> overlay(const Layout& layout, const PlacedTarget& a, const PlacedTarget& b)
{
    Overlay result;
    const std::array<const PlacedTarget*, 2> targets{&a, &b};
    // Vertices on sides by layout edge and share, or as a layout vertex.
    std::map<std::pair<Index, std::int64_t>, Index> on_sides;
    std::vector<Index> landmarks(layout.vertex_count(), kNone);
    for (Index face = 0; face < layout.face_count(); ++face) {
        const std::array<const PlacedPatch*, 2> placed{&a.patches()[face], &b.patches()[face]};
        PatchOverlay patch(*placed[0], *placed[1]);
        if (!patch.run()) {
            return make_error(
                ErrorCode::internal,
                "the maps of layout face " + std::to_string(face) + " do not lie over each other",
                {{"face", face}});
        }
        std::vector<Index> ids;
        for (const OverlayNode& node : patch.nodes()) {
            Index* known = nullptr;
            for (std::size_t side = 0; side < 2 && known == nullptr; ++side) {
                const Patch& own = placed[side]->patch;
                const Index v = node.vertices[side];
                if (v >= own.boundary_size()) {
                    continue;
                }
                const auto after = std::upper_bound(own.sides.begin(), own.sides.end(), v);
                const auto s = static_cast<Index>(after - own.sides.begin() - 1);
                const Index h = layout.face_halfedges(face)[s];
                if (v == own.sides[s]) {
                    known = &landmarks[layout.tail(h)];
                    continue;
                }
                const ChainShares& shares = targets[side]->shares()[Layout::edge(h)];
                const std::size_t i = v - own.sides[s];
                const std::int64_t share = h % 2 == 0 ? shares[i] : shares[shares.size() - 1 - i];
                known = &on_sides.try_emplace({Layout::edge(h), share}, kNone).first->second;
            }
            if (known != nullptr && *known != kNone) {
                ids.push_back(*known);
                continue;
            }
            const auto id = static_cast<Index>(result.points.size());
            if (known != nullptr) {
                *known = id;
            }
            ids.push_back(id);
            result.points.push_back({a.to_surface(face, node.triangles[0], node.weights[0]),
                                     b.to_surface(face, node.triangles[1], node.weights[1])});
        }
        for (std::size_t t = 0; t < patch.corners().size(); ++t) {
            const auto& c = patch.corners()[t];
            result.corners.push_back({ids[c[0]], ids[c[1]], ids[c[2]]});
            result.layout_faces.push_back(face);
            result.map_triangles.push_back(patch.triangles()[t]);
            result.domain_areas.push_back(patch.area_of(c));
            std::array<Index, 2> faces{};
            for (std::size_t side = 0; side < 2; ++side) {
                const Index parent = placed[side]->map.parents[patch.triangles()[t][side]];
                faces[side] =
                    targets[side]->refined().triangle_faces[placed[side]->patch.triangles[parent]];
            }
            result.faces.push_back(faces);
        }
    }
    return result;
}

}  // namespace layout_embedding
