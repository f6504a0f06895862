#include "search/other_routes.hh"

#include <algorithm>

namespace layout_embedding {

OtherRoutes::OtherRoutes(SearchSpace& space, std::vector<Index> root_walks)
    : space_(space),
      root_walks_(std::move(root_walks)),
      second_(space.cuts, space.strands, space.fields)
{}

OtherRoutes::Outcome OtherRoutes::find_routes(WorkBudget& budget)
{
    if (!space_.embedding.move_strands()) {
        return Outcome::tied;
    }
    for (; next_edge_ < root_walks_.size(); ++next_edge_) {
        switch (second_.run(next_edge_, budget)) {
            case SecondClass::Outcome::running:
                return Outcome::running;
            case SecondClass::Outcome::tied:
                return Outcome::tied;
            case SecondClass::Outcome::bounded:
                break;
            case SecondClass::Outcome::found:
                if (space_.constraints.admit(next_edge_, second_.darts())) {
                    const Index walk = space_.pool.add(next_edge_, second_.darts());
                    routes_.push_back(
                        {walk, space_.pool.cost(walk) - space_.pool.cost(root_walks_[next_edge_])});
                }
                break;
        }
    }
    std::stable_sort(routes_.begin(), routes_.end(),
                     [](const Route& a, const Route& b) { return a.extra < b.extra; });
    return Outcome::finished;
}

OtherRoutes::Outcome OtherRoutes::run(WorkBudget& budget)
{
    if (next_edge_ < root_walks_.size()) {
        const Outcome outcome = find_routes(budget);
        if (outcome != Outcome::finished) {
            return outcome;
        }
    }
    for (;;) {
        if (!lookahead_) {
            space_.embedding.go_to({});
            if (next_route_ == routes_.size()) {
                return Outcome::finished;
            }
            const Index walk = routes_[next_route_++].walk;
            const Index edge = space_.pool.layout_edge(walk);
            std::vector<Index> candidates = root_walks_;
            candidates[edge] = walk;
            lookahead_ = std::make_unique<LookaheadInsertion>(
                space_.embedding, space_.oracle, std::move(candidates), std::vector<Index>{edge});
        }
        const auto outcome = lookahead_->run(budget);
        if (outcome == LookaheadInsertion::Outcome::running) {
            return Outcome::running;
        }
        lookahead_.reset();
        if (outcome == LookaheadInsertion::Outcome::tied) {
            return Outcome::tied;
        }
        if (outcome == LookaheadInsertion::Outcome::complete) {
            return Outcome::complete;
        }
    }
}

}  // namespace layout_embedding
