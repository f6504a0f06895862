#pragma once

#include <memory>

#include "layout/embedding_problem.hh"
#include "search/branch_and_bound.hh"
#include "search/search_space.hh"
#include "search/solver.hh"
#include "search/starting_search.hh"

namespace layout_embedding {

struct SequenceSolverOptions {
    BranchAndBoundOptions branch_and_bound;
    /// Start with the embedding of plain greedy insertion (paper, Sec. 4.2).
    bool greedy_start = true;
    /// Improve the start by insertion that looks ahead and local search on insertion orders.
    bool local_search = true;
    /// Answer questions for shortest paths from memory where that is possible.
    bool remember = true;
};

/// The best of all insertion sequences: the start as in StartingSearch, then branch and bound
/// (paper, Sec. 4; design, Sec. 2).
class SequenceSolver : public Solver {
public:
    /// Keeps references to problem and graph.
    SequenceSolver(const EmbeddingProblem& problem, const PathGraph& graph,
                   std::uint64_t field_bytes, const SequenceSolverOptions& options);

    Outcome run(WorkBudget& budget) override;
    Length lower_bound() const override;
    BoundScope bound_scope() const override;
    Length incumbent_cost() const override { return space_.incumbent.cost(); }
    const WeakEmbedding& incumbent() const override { return space_.incumbent.weak_embedding(); }
    std::vector<Index> incumbent_order() const override { return space_.incumbent_order(); }
    const std::vector<Index>& current_path(Index layout_edge) const override
    {
        return space_.strands.darts(layout_edge);
    }
    double progress() const override { return start_ ? start_->progress() : 0; }
    SearchCounters counters() const override;

private:
    Length root_bound() const;

    SearchSpace space_;
    std::unique_ptr<StartingSearch> start_;  // null without a start
    bool started_;
    BranchAndBound branch_and_bound_;
};

}  // namespace layout_embedding
