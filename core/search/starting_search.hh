#pragma once

#include <memory>
#include <vector>

#include "layout/embedding_problem.hh"
#include "search/greedy.hh"
#include "search/local_search.hh"
#include "search/lookahead_insertion.hh"
#include "search/other_routes.hh"
#include "search/search_space.hh"
#include "search/solver.hh"

namespace layout_embedding {

/// The first embeddings: plain greedy insertion, insertion that looks ahead, or a heuristic where
/// both fail, then local search on the order of insertion, which can go on later. Where classes are
/// constrained, insertion that looks ahead alone knows of it; where all this leads to embeddings
/// that are excluded, other routes are tried. Also the unconstrained path of every edge, whose sum
/// bounds every embedding.
class StartingSearch {
public:
    /// Keeps references. `local_search`: units of work that local search may take; 0 for greedy
    /// insertion alone. Ends where the gap between incumbent and root bound is at most `gap`.
    StartingSearch(const EmbeddingProblem& problem, SearchSpace& space, std::uint64_t local_search,
                   double gap);

    /// Continues until something happens; `finished` also where no embedding was found. Nothing is
    /// embedded any more then.
    Solver::Outcome run(WorkBudget& budget);
    /// After run() has finished: lets local search go on for so much more work, to be run again.
    /// False if there is nothing that could go on. Nothing may be going on in `space`.
    bool resume(std::uint64_t local_search);

    /// The sum of the unconstrained paths; 0 while it is not known, kInfiniteLength if an edge has
    /// none.
    Length root_bound() const { return root_bound_; }
    /// The unconstrained path per layout edge, once root_bound() is known and finite.
    const std::vector<Index>& root_walks() const { return root_walks_; }
    /// Units of work that local search has done.
    std::uint64_t local_search_work() const { return local_search_ ? local_search_->work() : 0; }
    double progress() const;

private:
    enum class Stage { greedy, find_roots, look_ahead, other_routes, local_search, finished };

    Solver::Outcome run_greedy(WorkBudget& budget);
    Solver::Outcome find_roots(WorkBudget& budget);
    void begin_lookahead();
    Solver::Outcome look_ahead(WorkBudget& budget);
    Solver::Outcome try_other_routes(WorkBudget& budget);
    Solver::Outcome after_insertion();
    bool gap_is_reached() const;
    Solver::Outcome run_local_search(WorkBudget& budget);
    Solver::Outcome take_greedy_embedding();
    void begin_local_search(std::uint64_t work);
    void empty_strands();

    const EmbeddingProblem& problem_;
    SearchSpace& space_;
    std::uint64_t first_local_search_;
    double gap_;
    Stage stage_ = Stage::greedy;
    std::unique_ptr<GreedySearch> greedy_;
    std::size_t rule_ = 0;
    Index next_root_ = 0;
    std::unique_ptr<LookaheadInsertion> lookahead_;
    bool has_looked_ahead_ = false;
    std::unique_ptr<OtherRoutes> other_routes_;
    std::unique_ptr<LocalSearch> local_search_;
    std::vector<Index> root_walks_;
    Length root_bound_ = 0;
};

}  // namespace layout_embedding
