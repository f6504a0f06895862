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

GreedySearch::Outcome GreedySearch::finish_search(Index layout_edge,
                                                  CutSurfaceSearch::Outcome outcome)
{
    if (outcome == CutSurfaceSearch::Outcome::tied) {
        return Outcome::tied;
    }
    const bool found = outcome == CutSurfaceSearch::Outcome::found;
    candidates_[layout_edge].cost = found ? search_.cost() : kInfiniteLength;
    candidates_[layout_edge].darts = search_.darts();
    if (has_root_bound()) {
        return Outcome::running;
    }
    ++next_root_;
    if (!found || lower_bound_ == kInfiniteLength) {
        lower_bound_ = kInfiniteLength;
    } else {
        lower_bound_ += search_.cost();
    }
    return Outcome::running;
}

GreedySearch::Outcome GreedySearch::run(std::uint64_t max_expansions)
{
    const std::uint64_t end = search_.expansion_count() + max_expansions < max_expansions
                                  ? UINT64_MAX
                                  : search_.expansion_count() + max_expansions;
    while (strands_.insertion_order().size() < edge_count_) {
        if (searching_ == kNone && !has_root_bound()) {
            searching_ = next_root_;
            search_.begin(searching_);
        }
        if (searching_ == kNone) {
            const Index edge = cheapest_admitted();
            if (edge == kNone) {
                return Outcome::failed;
            }
            if (strands_.insert(edge, candidates_[edge].darts)) {
                if (!hole_guard_.accepts()) {
                    strands_.undo();
                    refused_[edge] = true;
                    continue;
                }
                refused_.assign(edge_count_, false);
                embedded_cost_ += candidates_[edge].cost;
                const Layout& layout = strands_.layout();
                const Index a = component(layout.tail(2 * edge));
                const Index b = component(layout.head(2 * edge));
                if (a != b) {
                    parents_[a] = b;
                    --component_count_;
                }
                continue;
            }
            searching_ = edge;
            search_.begin(edge);
        }
        const auto outcome = search_.run(end - search_.expansion_count());
        if (outcome == CutSurfaceSearch::Outcome::running) {
            return Outcome::running;
        }
        const Index edge = searching_;
        searching_ = kNone;
        if (finish_search(edge, outcome) == Outcome::tied) {
            return Outcome::tied;
        }
    }
    return Outcome::complete;
}

}  // namespace layout_embedding
