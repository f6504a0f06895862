#pragma once

#include <vector>

#include "base/random.hh"
#include "base/types.hh"
#include "search/incumbent.hh"
#include "search/partial_embedding.hh"
#include "search/path_oracle.hh"
#include "search/work_budget.hh"

namespace layout_embedding {

/// Improves an embedding by changing the order in which its paths are inserted (design, Sec. 2).
///
/// A path that is longer than it would have to be is inserted earlier: right before one of those
/// that cross its unconstrained path, or leave a landmark in its way. Descends to an order that no
/// such move improves, then moves a few random edges, or puts all paths around a vertex back in
/// another order, and descends again, as long as that helps. When it goes on after a break, every
/// second trial on the way is one that puts the paths around a vertex back: where many are in each
/// other's way, that brings more than single moves.
class LocalSearch {
public:
    enum class Outcome {
        running,
        /// The incumbent has improved.
        improved,
        /// Nothing helps any more, or the work allowed is done.
        finished,
        /// Equal lengths: start again with other perturbations.
        tied,
    };

    /// Keeps references. The incumbent exists, and `root_walks` are the unconstrained paths per
    /// layout edge. Does nothing before allow(). Leaves `embedding` in any state.
    LocalSearch(PartialEmbedding& embedding, PathOracle& oracle, Incumbent& incumbent,
                std::vector<Index> root_walks);

    /// Begins no order after `work` units more. Goes on from the incumbent if it is better by now.
    void allow(std::uint64_t work);

    Outcome run(WorkBudget& budget);
    /// Whether nothing helps any more.
    bool is_exhausted() const { return is_exhausted_; }
    /// Units of work so far.
    std::uint64_t work() const { return work_; }

private:
    /// Take the edge at place `from` and insert it at place `to` < `from`.
    struct Move {
        Index from;
        Index to;
    };

    void find_moves();
    void begin_trial(const Move& move);
    bool begin_kick();
    void begin_reinsertion();
    Outcome evaluate(WorkBudget& budget);
    bool in_the_way(Index walk, Index root_walk) const;

    PartialEmbedding& embedding_;
    PathOracle& oracle_;
    Incumbent& incumbent_;
    std::vector<Index> root_walks_;
    std::uint64_t max_work_ = 0;
    std::uint64_t work_ = 0;
    bool is_exhausted_ = false;

    std::vector<Index> current_;  // walks in order: what moves start from
    Length current_cost_ = 0;
    std::vector<Move> moves_;
    std::size_t next_move_ = 0;
    std::vector<Index> trial_;  // edges in order
    std::size_t trial_next_ = 0;
    Length rest_bound_ = 0;    // unconstrained lengths of trial_[trial_next_ ..]
    Length trial_limit_ = 0;   // trials of this cost or more are given up
    bool is_resumed_ = false;  // allow() was called again
    bool in_trial_ = false;
    bool is_kick_ = false;
    Index kicks_ = 0;  // since the last improvement
    Random random_{1};
};

}  // namespace layout_embedding
