#include "search/greedy_solver.hh"

namespace layout_embedding {

GreedySolver::GreedySolver(const EmbeddingProblem& problem, const PathGraph& graph,
                           std::uint64_t field_bytes, const GreedyRule& rule)
    : strands_(problem, graph),
      fields_(graph, strands_.passable(), field_bytes),
      search_(strands_, fields_),
      greedy_(problem, strands_, search_, rule)
{}

Solver::Outcome GreedySolver::run(WorkBudget& budget)
{
    if (cost_ != kInfiniteLength) {
        return Outcome::finished;
    }
    const std::uint64_t before = search_.expansion_count();
    const auto outcome = greedy_.run(budget.left());
    budget.charge(search_.expansion_count() - before);
    switch (outcome) {
        case GreedySearch::Outcome::running:
            return Outcome::running;
        case GreedySearch::Outcome::bounded:
            return Outcome::bounded;
        case GreedySearch::Outcome::inserted:
            return Outcome::advanced;
        case GreedySearch::Outcome::complete:
            cost_ = greedy_.embedded_cost();
            weak_ = strands_.weak_embedding();
            return Outcome::improved;
        case GreedySearch::Outcome::failed:
            return Outcome::finished;
        case GreedySearch::Outcome::tied:
            return Outcome::tied;
    }
    return Outcome::finished;
}

SearchCounters GreedySolver::counters() const
{
    SearchCounters counters;
    counters.searches = search_.search_count();
    counters.expansions = search_.expansion_count();
    counters.field_nodes = fields_.settled_count();
    counters.insertions = strands_.insertion_order().size();
    return counters;
}

}  // namespace layout_embedding
