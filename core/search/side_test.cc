#include "search/side_test.hh"

#include <algorithm>

namespace layout_embedding {

SideTest::SideTest(const EmbeddingProblem& problem, Strands& strands)
    : strands_(strands),
      next_(2 * std::size_t{problem.layout->edge_count()}, kNone),
      previous_(next_.size(), kNone)
{
    const Layout& layout = *problem.layout;
    const PathGraph& graph = strands.graph();
    const auto join = [&](Index h, Index next) {
        next_[h] = next;
        previous_[next] = h;
    };
    for (Index f = 0; f < layout.face_count(); ++f) {
        const auto halfedges = layout.face_halfedges(f);
        for (std::size_t i = 0; i < halfedges.size(); ++i) {
            join(halfedges[i], halfedges[(i + 1) % halfedges.size()]);
        }
    }
    for (const auto& loop : layout.boundary_loops()) {
        for (std::size_t i = 0; i < loop.size(); ++i) {
            if (!graph.is_boundary(strands.landmark_node(layout.head(loop[i])))) {
                join(loop[i], loop[(i + 1) % loop.size()]);
            }
        }
    }
    for (Index v = 0; v < layout.vertex_count(); ++v) {
        layout_vertices_.push_back(v);
    }
    std::sort(layout_vertices_.begin(), layout_vertices_.end(), [&](Index a, Index b) {
        return strands.landmark_node(a) < strands.landmark_node(b);
    });
}

bool SideTest::accepts(Index layout_edge, const std::vector<Index>& darts)
{
    const auto trace = strands_.trace(layout_edge, darts);
    if (!trace) {
        return false;
    }
    const Index start = strands_.graph().tail(darts.front());
    const Index slot = trace->slots.front();
    strands_.insert(layout_edge, darts);
    // The strand parts its slot in one to its right and one to its left.
    const bool accepted =
        target_side(start, darts.front(), slot + 1) == layout_side(2 * layout_edge) &&
        target_side(start, darts.front(), slot) == layout_side(2 * layout_edge + 1);
    strands_.undo();
    return accepted;
}

SideTest::VertexSet SideTest::layout_side(Index layout_halfedge) const
{
    const Layout& layout = strands_.layout();
    VertexSet vertices(layout.vertex_count(), false);
    std::vector<bool> seen(next_.size(), false);
    std::vector<Index> stack{layout_halfedge};
    while (!stack.empty()) {
        const Index h = stack.back();
        stack.pop_back();
        if (h == kNone || seen[h]) {
            continue;
        }
        seen[h] = true;
        vertices[layout.tail(h)] = true;
        vertices[layout.head(h)] = true;
        stack.push_back(next_[h]);
        stack.push_back(previous_[h]);
        if (!strands_.is_embedded(Layout::edge(h))) {
            stack.push_back(Layout::twin(h));
        }
    }
    return vertices;
}

SideTest::VertexSet SideTest::target_side(Index start_node, Index dart, Index slot)
{
    const PathGraph& graph = strands_.graph();
    VertexSet landmarks(strands_.layout().vertex_count(), false);
    seen_.assign(strands_.state_bound(), false);
    stack_.clear();
    reach(start_node, dart, slot, landmarks);
    // Back again, for the landmark at the start.
    const Index twin_slot = strands_.strand_count(start_node, dart) - slot;
    reach(graph.head(dart), graph.twin(dart), twin_slot, landmarks);
    while (!stack_.empty()) {
        const Index state = stack_.back();
        stack_.pop_back();
        const Index node = strands_.node_of_state(state);
        const Index region = strands_.region_of_state(state);
        for (Index d = graph.first_dart(node); d < graph.first_dart(node + 1); ++d) {
            // Landmarks only end paths: a dart has at most one slot per region.
            const Index through = strands_.slot_in_region(node, d, region);
            if (through != kNone) {
                reach(node, d, through, landmarks);
            }
        }
    }
    return landmarks;
}

// Goes along a slot of a dart. Landmarks are noted and not passed: what surrounds them is connected
// by itself wherever no strand ends there.
void SideTest::reach(Index tail, Index dart, Index slot, VertexSet& landmarks)
{
    const Dart& along = strands_.graph().dart(dart);
    if (!strands_.passable()[along.head]) {
        const auto vertex =
            std::lower_bound(layout_vertices_.begin(), layout_vertices_.end(), along.head,
                             [&](Index v, Index node) { return strands_.landmark_node(v) < node; });
        landmarks[*vertex] = true;
        return;
    }
    const Index twin_slot = strands_.strand_count(tail, dart) - slot;
    const Index state =
        strands_.state(along.head, strands_.region(along.head, along.twin, twin_slot));
    if (!seen_[state]) {
        seen_[state] = true;
        stack_.push_back(state);
    }
}

}  // namespace layout_embedding
