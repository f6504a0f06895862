#include "search/swirl_test.hh"

#include <algorithm>

namespace layout_embedding {

SwirlTest::SwirlTest(const Strands& strands)
    : strands_(strands),
      visits_(strands.graph().node_count(), kNone),
      distances_(strands.graph().node_count(), kInfiniteLength)
{}

bool SwirlTest::suspects(Index layout_edge, std::span<const Index> darts)
{
    // A walk that visits a node twice is judged there by its first visit.
    const PathGraph& graph = strands_.graph();
    for (Index i = static_cast<Index>(darts.size()); i-- > 0;) {
        visits_[graph.tail(darts[i])] = i;
    }
    visits_[graph.head(darts.back())] = static_cast<Index>(darts.size());
    const bool suspected = first_side(2 * layout_edge, darts) == Side::right ||
                           first_side(2 * layout_edge + 1, darts) == Side::left;
    for (const Index dart : darts) {
        visits_[graph.tail(dart)] = kNone;
        visits_[graph.head(dart)] = kNone;
    }
    return suspected;
}

// Which side of the path (always of the edge's own direction) is reached first from the other
// corners of the face left of h.
SwirlTest::Side SwirlTest::first_side(Index layout_halfedge, std::span<const Index> darts)
{
    const Layout& layout = strands_.layout();
    const PathGraph& graph = strands_.graph();
    const Index face = layout.face(layout_halfedge);
    if (face == kNone) {
        return Side::none;
    }
    queue_.clear();
    for (const Index h : layout.face_halfedges(face)) {
        const Index corner = layout.tail(h);
        if (corner != layout.tail(layout_halfedge) && corner != layout.head(layout_halfedge)) {
            push(strands_.landmark_node(corner), 0, kNone);
        }
    }
    Side side = Side::none;
    while (!queue_.empty() && side == Side::none) {
        const Item item = queue_.front();
        std::pop_heap(queue_.begin(), queue_.end());
        queue_.pop_back();
        if (item.dart != kNone) {
            side = side_at(item.node, item.dart, darts);
            continue;
        }
        if (item.distance > distances_[item.node]) {
            continue;
        }
        // Along each edge of the target, by its midpoint to the other end.
        for (Index d = graph.first_dart(item.node); d < graph.first_dart(item.node + 1); ++d) {
            const Index midpoint = graph.head(d);
            if (graph.element(midpoint).kind != NodeKind::edge_midpoint) {
                continue;
            }
            const Length half = item.distance + graph.dart(d).length;
            if (visits_[midpoint] != kNone) {
                push(midpoint, half, d);
                continue;
            }
            for (Index m = graph.first_dart(midpoint); m < graph.first_dart(midpoint + 1); ++m) {
                const Index next = graph.head(m);
                if (m == graph.twin(d) || graph.element(next).kind != NodeKind::vertex) {
                    continue;
                }
                const Index visit = visits_[next];
                if (visit == kNone) {
                    push(next, half + graph.dart(m).length, kNone);
                } else if (visit != 0 && visit != darts.size()) {
                    push(next, half + graph.dart(m).length, m);
                }
            }
        }
    }
    for (const Index vertex : reached_) {
        distances_[vertex] = kInfiniteLength;
    }
    reached_.clear();
    return side;
}

// The left of a walk lies counter-clockwise between the dart on which it goes on and the dart back
// where it came from.
SwirlTest::Side SwirlTest::side_at(Index node, Index arriving_dart,
                                   std::span<const Index> darts) const
{
    const PathGraph& graph = strands_.graph();
    const Index visit = visits_[node];
    const Index degree = graph.degree(node);
    const Index ahead = darts[visit];
    const auto steps_from_ahead = [&](Index dart) { return (dart + degree - ahead) % degree; };
    return steps_from_ahead(graph.twin(arriving_dart)) <
                   steps_from_ahead(graph.twin(darts[visit - 1]))
               ? Side::left
               : Side::right;
}

void SwirlTest::push(Index node, Length distance, Index dart)
{
    if (dart == kNone) {
        if (distance >= distances_[node]) {
            return;
        }
        if (distances_[node] == kInfiniteLength) {
            reached_.push_back(node);
        }
        distances_[node] = distance;
    }
    queue_.push_back({distance, dart, node});
    std::push_heap(queue_.begin(), queue_.end());
}

}  // namespace layout_embedding
