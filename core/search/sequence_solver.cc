#include "search/sequence_solver.hh"

#include <algorithm>

namespace layout_embedding {

namespace {

// Where local search goes on for long, bounds are what is missing.
constexpr std::uint64_t kLocalSearchWork = 6'000'000;

}  // namespace

SequenceSolver::SequenceSolver(const EmbeddingProblem& problem, const PathGraph& graph,
                               std::uint64_t field_bytes, const SequenceSolverOptions& options)
    : space_(problem, graph, field_bytes, options.remember),
      start_(options.greedy_start
                 ? std::make_unique<StartingSearch>(problem, space_,
                                                    options.local_search ? kLocalSearchWork : 0,
                                                    options.branch_and_bound.gap)
                 : nullptr),
      started_(!options.greedy_start),
      branch_and_bound_(space_.embedding, space_.oracle, space_.fields, space_.incumbent,
                        options.branch_and_bound)
{}

Solver::Outcome SequenceSolver::run(WorkBudget& budget)
{
    if (!started_) {
        const Outcome outcome = start_->run(budget);
        if (outcome != Outcome::finished) {
            return outcome;
        }
        started_ = true;
    }
    for (;;) {
        const Length before = root_bound();
        switch (branch_and_bound_.run(budget)) {
            case BranchAndBound::Outcome::running:
                return Outcome::running;
            case BranchAndBound::Outcome::bounded:
                if (branch_and_bound_.lower_bound() <= before) {
                    continue;  // known since the start
                }
                return Outcome::bounded;
            case BranchAndBound::Outcome::improved:
                return Outcome::improved;
            case BranchAndBound::Outcome::finished:
                return Outcome::finished;
            case BranchAndBound::Outcome::tied:
                return Outcome::tied;
        }
    }
}

Length SequenceSolver::root_bound() const
{
    return std::max(start_ ? start_->root_bound() : 0, branch_and_bound_.root_bound());
}

Length SequenceSolver::lower_bound() const
{
    return std::max(root_bound(), branch_and_bound_.lower_bound());
}

BoundScope SequenceSolver::bound_scope() const
{
    return lower_bound() == root_bound() ? BoundScope::embeddings : BoundScope::insertion_sequences;
}

SearchCounters SequenceSolver::counters() const
{
    SearchCounters counters = branch_and_bound_.counters();
    counters += space_.counters();
    return counters;
}

}  // namespace layout_embedding
