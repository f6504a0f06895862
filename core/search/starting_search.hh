#pragma once

#include <memory>
#include <vector>

#include "layout/embedding_problem.hh"
#include "search/greedy.hh"
#include "search/local_search.hh"
#include "search/search_space.hh"
#include "search/solver.hh"

namespace layout_embedding {

/// The first embeddings: plain greedy insertion, or a heuristic where that fails, then local search
/// on the order of insertion. Also the unconstrained path of every edge, whose sum bounds every
/// embedding.
class StartingSearch {
public:
    /// Keeps references. With `local_search` unset, greedy insertion alone. Ends where the gap
    /// between incumbent and root bound is at most `gap`.
    StartingSearch(const EmbeddingProblem& problem, SearchSpace& space, bool local_search,
                   double gap);

    /// Continues until something happens; `finished` also where no embedding was found. Nothing is
    /// embedded any more then.
    Solver::Outcome run(WorkBudget& budget);

    /// The sum of the unconstrained paths; 0 while it is not known, kInfiniteLength if an edge has
    /// none.
    Length root_bound() const { return root_bound_; }
    /// The unconstrained path per layout edge, once root_bound() is known and finite.
    const std::vector<Index>& root_walks() const { return root_walks_; }
    double progress() const { return greedy_->progress(); }

private:
    enum class Stage { greedy, local_search, finished };

    Solver::Outcome run_greedy(WorkBudget& budget);
    Solver::Outcome run_local_search(WorkBudget& budget);
    Solver::Outcome take_greedy_embedding();
    void empty_strands();

    const EmbeddingProblem& problem_;
    SearchSpace& space_;
    bool wants_local_search_;
    double gap_;
    Stage stage_ = Stage::greedy;
    std::unique_ptr<GreedySearch> greedy_;
    std::size_t rule_ = 0;
    std::unique_ptr<LocalSearch> local_search_;
    std::vector<Index> root_walks_;
    Length root_bound_ = 0;
};

}  // namespace layout_embedding
