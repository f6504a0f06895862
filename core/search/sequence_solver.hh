#pragma once

#include <memory>

#include "layout/embedding_problem.hh"
#include "search/branch_and_bound.hh"
#include "search/greedy.hh"
#include "search/incumbent.hh"
#include "search/local_search.hh"
#include "search/partial_embedding.hh"
#include "search/path_oracle.hh"
#include "search/solver.hh"
#include "surface/cut_surface_search.hh"
#include "surface/distance_field.hh"
#include "surface/strands.hh"
#include "surface/walk_pool.hh"

namespace layout_embedding {

struct SequenceSolverOptions {
    BranchAndBoundOptions branch_and_bound;
    /// Start with the embedding of plain greedy insertion (paper, Sec. 4.2).
    bool greedy_start = true;
    /// Improve the start by local search on insertion orders.
    bool local_search = true;
    /// Answer questions for shortest paths from memory where that is possible.
    bool remember = true;
};

/// The best of all insertion sequences: plain greedy, local search, branch and bound (paper, Sec.
/// 4; design, Sec. 2).
class SequenceSolver : public Solver {
public:
    /// Keeps references to problem and graph.
    SequenceSolver(const EmbeddingProblem& problem, const PathGraph& graph,
                   std::uint64_t field_bytes, const SequenceSolverOptions& options);

    Outcome run(WorkBudget& budget) override;
    Length lower_bound() const override;
    BoundScope bound_scope() const override;
    Length incumbent_cost() const override { return incumbent_.cost(); }
    const WeakEmbedding& incumbent() const override { return incumbent_.weak_embedding(); }
    std::vector<Index> incumbent_order() const override;
    const std::vector<Index>& current_path(Index layout_edge) const override
    {
        return strands_.darts(layout_edge);
    }
    double progress() const override;
    SearchCounters counters() const override;

private:
    enum class Stage { greedy, local_search, branch_and_bound };

    Outcome run_greedy(WorkBudget& budget);
    Outcome run_local_search(WorkBudget& budget);
    Outcome run_branch_and_bound(WorkBudget& budget);
    Outcome take_greedy_embedding();

    SequenceSolverOptions options_;
    Strands strands_;
    DistanceFields fields_;
    CutSurfaceSearch search_;
    WalkPool pool_;
    PartialEmbedding embedding_;
    PathOracle oracle_;
    Incumbent incumbent_;
    Stage stage_;
    std::unique_ptr<GreedySearch> greedy_;
    std::unique_ptr<LocalSearch> local_search_;
    BranchAndBound branch_and_bound_;
    std::vector<Index> root_walks_;  // per layout edge, once known
    Length root_bound_ = 0;
};

}  // namespace layout_embedding
