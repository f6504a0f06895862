#include "search/greedy.hh"

#include <numeric>

namespace layout_embedding {

GreedySearch::GreedySearch(Strands& strands, CutSurfaceSearch& search)
    : strands_(strands),
      search_(search),
      hole_guard_(strands),
      edge_count_(strands.layout().edge_count()),
      candidates_(edge_count_),
      refused_(edge_count_, false),
      parents_(strands.layout().vertex_count()),
      component_count_(strands.layout().vertex_count())
{
    std::iota(parents_.begin(), parents_.end(), Index{0});
}

Index GreedySearch::component(Index layout_vertex)
{
    while (parents_[layout_vertex] != layout_vertex) {
        parents_[layout_vertex] = parents_[parents_[layout_vertex]];
        layout_vertex = parents_[layout_vertex];
    }
    return layout_vertex;
}

bool GreedySearch::is_admitted(Index layout_edge)
{
    if (strands_.is_embedded(layout_edge) || refused_[layout_edge] ||
        candidates_[layout_edge].cost == kInfiniteLength) {
        return false;
    }
    const Layout& layout = strands_.layout();
    return component_count_ == 1 ||
           component(layout.tail(2 * layout_edge)) != component(layout.head(2 * layout_edge));
}

Index GreedySearch::cheapest_admitted()
{
    Index best = kNone;
    for (Index e = 0; e < edge_count_; ++e) {
        if (is_admitted(e) && (best == kNone || candidates_[e].cost < candidates_[best].cost)) {
            best = e;
        }
    }
    return best;
}

GreedySearch::Outcome GreedySearch::finish_search(CutSurfaceSearch::Outcome outcome)
{
    const Index edge = searching_;
    searching_ = kNone;
    if (outcome == CutSurfaceSearch::Outcome::tied) {
        return Outcome::tied;
    }
    candidates_[edge].cost = search_.cost();
    candidates_[edge].darts = search_.darts();
    if (has_root_bound()) {
        return Outcome::running;
    }
    ++next_root_;
    const bool blocked = outcome == CutSurfaceSearch::Outcome::blocked;
    lower_bound_ = blocked || lower_bound_ == kInfiniteLength ? kInfiniteLength
                                                              : lower_bound_ + search_.cost();
    return has_root_bound() ? Outcome::bounded : Outcome::running;
}

// Keeps the strand just inserted, unless a hole got to the wrong side.
GreedySearch::Outcome GreedySearch::keep_inserted(Index layout_edge)
{
    if (!hole_guard_.accepts()) {
        strands_.undo();
        refused_[layout_edge] = true;
        return Outcome::running;
    }
    refused_.assign(edge_count_, false);
    embedded_cost_ += candidates_[layout_edge].cost;
    const Index a = component(strands_.layout().tail(2 * layout_edge));
    const Index b = component(strands_.layout().head(2 * layout_edge));
    if (a != b) {
        parents_[a] = b;
        --component_count_;
    }
    return strands_.insertion_order().size() == edge_count_ ? Outcome::complete : Outcome::inserted;
}

GreedySearch::Outcome GreedySearch::run(std::uint64_t max_expansions)
{
    for (;;) {
        if (searching_ != kNone) {
            const std::uint64_t before = search_.expansion_count();
            const auto outcome = search_.run(max_expansions);
            max_expansions -= search_.expansion_count() - before;
            if (outcome == CutSurfaceSearch::Outcome::running) {
                return Outcome::running;
            }
            const Outcome next = finish_search(outcome);
            if (next != Outcome::running) {
                return next;
            }
        }
        if (!has_root_bound()) {
            searching_ = next_root_;
        } else {
            const Index edge = cheapest_admitted();
            if (edge == kNone) {
                return Outcome::failed;
            }
            if (strands_.insert(edge, candidates_[edge].darts)) {
                const Outcome next = keep_inserted(edge);
                if (next != Outcome::running) {
                    return next;
                }
                continue;
            }
            searching_ = edge;
        }
        search_.begin(searching_);
    }
}

}  // namespace layout_embedding
