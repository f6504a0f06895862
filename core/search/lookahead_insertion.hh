#pragma once

#include <map>
#include <utility>
#include <vector>

#include "base/types.hh"
#include "search/partial_embedding.hh"
#include "search/path_oracle.hh"
#include "search/work_budget.hh"

namespace layout_embedding {

/// Insertion of all layout edges that looks one step ahead. Shortest paths that are in nobody's way
/// are embedded at once; of those in conflict, the one that lengthens the others the least comes
/// next. One dive through the tree of the paper's branch and bound (Sec. 4), with far fewer
/// searches: what one path does to another is looked up where it was asked before, even if more is
/// embedded by now.
class LookaheadInsertion {
public:
    enum class Outcome {
        running,
        /// All edges are embedded.
        complete,
        /// For some edge no path is left.
        failed,
        /// Equal lengths: start again with other perturbations.
        tied,
    };

    /// Keeps references. `candidates`: the unconstrained path per layout edge. `first`: edges that
    /// are embedded before all others, in this order. Nothing is embedded.
    LookaheadInsertion(PartialEmbedding& embedding, PathOracle& oracle,
                       std::vector<Index> candidates, std::vector<Index> first = {});

    Outcome run(WorkBudget& budget);

private:
    enum class Stage { first, update, compare };

    Outcome insert_first(WorkBudget& budget);
    Outcome update(WorkBudget& budget);
    Outcome find(Index layout_edge, WorkBudget& budget);
    Outcome compare(WorkBudget& budget);
    bool insert(Index layout_edge, Outcome& outcome);

    PartialEmbedding& embedding_;
    PathOracle& oracle_;
    std::vector<Index> candidates_;  // the shortest path per layout edge that is left
    std::vector<Index> first_;
    std::size_t next_first_ = 0;
    Stage stage_ = Stage::first;
    Index next_ = 0;  // edge whose path is looked at

    std::vector<Index> contested_;  // edges whose candidates are in conflict
    std::size_t next_contested_ = 0;
    std::vector<Index> others_;  // edges in conflict with that one
    std::size_t next_other_ = 0;
    bool is_trying_ = false;  // contested_[next_contested_] is embedded for the time being
    Length damage_ = 0;       // that it does, as far as it is known
    Length least_damage_ = kInfiniteLength;
    Index best_ = kNone;
    /// By how much a walk lengthens the path of another edge, by that edge's candidate; at least.
    std::map<std::pair<Index, Index>, Length> damages_;
};

}  // namespace layout_embedding
