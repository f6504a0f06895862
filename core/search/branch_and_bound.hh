#pragma once

#include <cstdint>
#include <set>
#include <unordered_map>
#include <vector>

#include "base/types.hh"
#include "search/incumbent.hh"
#include "search/pairwise_bound.hh"
#include "search/partial_embedding.hh"
#include "search/path_oracle.hh"
#include "search/solver.hh"
#include "search/work_budget.hh"

namespace layout_embedding {

/// Switches of the paper's branch and bound, for its ablation (Secs. 4.3 to 4.5, Fig. 12); all on
/// by default. None of them changes the optimum.
struct BranchAndBoundOptions {
    /// Tolerance alpha: states within this share of the incumbent's cost are pruned (Sec. 4.2).
    double gap = 0.01;
    /// Count candidate paths in lower bounds (Sec. 4.3), not only embedded ones.
    bool candidate_bounds = true;
    /// Add what conflicting pairs of edges cost together (design, Sec. 2): not in the paper.
    bool pairwise_bounds = true;
    /// Drop states whose embedding has been met before (Sec. 4.4.1).
    bool detect_redundant_states = true;
    /// Branch on conflicting edges only (Sec. 4.4.2).
    bool delay_non_conflicting = true;
    /// Visit by number of conflicting edges times lower bound (Sec. 4.5), not by lower bound alone.
    bool mixed_priority = true;
    /// States kept at most, about 200 bytes each: beyond, new ones are dropped, and their bounds
    /// limit what can be proved.
    std::size_t max_states = std::size_t{1} << 18U;
};

/// The paper's branch and bound over insertion sequences (Sec. 4) on strands of zero width, where
/// its lower bound is exactly valid (design, Secs. 1 and 2). Stepped; its bound holds for
/// embeddings that insert paths one by one, each as the shortest that is left.
class BranchAndBound {
public:
    enum class Outcome {
        running,
        /// lower_bound() has risen: to that of the root state, which bounds every embedding, or by
        /// a thousandth since it was last told.
        bounded,
        /// The incumbent has improved.
        improved,
        /// Nothing is left to be explored, or the gap is reached.
        finished,
        /// Equal lengths: start again with other perturbations.
        tied,
    };

    /// Keeps references; `embedding` is empty. The incumbent may be given one by others at any
    /// time.
    BranchAndBound(PartialEmbedding& embedding, PathOracle& oracle, DistanceFields& fields,
                   Incumbent& incumbent, const BranchAndBoundOptions& options);

    /// Continues until something happens or the budget is spent.
    Outcome run(WorkBudget& budget);

    /// The cost of every embedding that insertion sequences reach is at least this.
    Length lower_bound() const;
    /// The sum of the unconstrained paths, with what pairs of edges add: bounds all embeddings. 0
    /// while it is not known.
    Length root_bound() const { return next_root_ < edge_count_ ? 0 : root_bound_; }
    /// The counts of states, and the expansions by enumerations; the others are 0.
    SearchCounters counters() const;

private:
    /// A state of the search: its parent's, and one walk more.
    struct Node {
        Index parent;
        Index walk;
        Length bound;
        std::uint64_t hash;
        std::vector<Index> updates;  // candidates that differ from the parent's
    };
    struct QueueItem {
        double priority;
        Index node;
        friend bool operator<(const QueueItem& a, const QueueItem& b)
        {
            return a.priority != b.priority ? a.priority > b.priority : a.node > b.node;
        }
    };
    /// The child that is being evaluated.
    struct Child {
        Length bound = 0;
        std::vector<Index> open;  // edges whose candidate does not fit any more
        std::size_t next = 0;
        std::vector<Index> updates;
    };

    Outcome find_root(WorkBudget& budget);
    Outcome find_pairs(WorkBudget& budget);
    Length pair_surplus();
    bool take_node();
    Outcome evaluate_child(WorkBudget& budget);
    Outcome begin_child(Index edge);
    Outcome finish_child(Index edge);
    void drop(Length bound);
    void end_child();
    Length prune_threshold() const;
    Outcome add_state(Index walk, std::uint64_t hash);
    Outcome accept_candidates();
    std::vector<Index> find_branches(std::size_t& conflict_count);
    bool bound_has_risen();
    std::vector<Index> sequence(Index node) const;
    bool is_redundant(std::uint64_t hash, Index walk);

    PartialEmbedding& embedding_;
    PathOracle& oracle_;
    Incumbent& incumbent_;
    BranchAndBoundOptions options_;
    Index edge_count_;
    PairwiseBound pairs_;
    bool has_pairs_ = false;
    Index next_root_ = 0;
    bool finished_ = false;
    Length root_bound_ = 0;

    std::vector<Node> nodes_;
    std::vector<QueueItem> queue_;
    std::set<std::pair<Length, Index>> open_bounds_;
    std::unordered_multimap<std::uint64_t, Index> nodes_by_hash_;  // looked up, never iterated
    Length pruned_bound_ = kInfiniteLength;

    Index current_ = kNone;          // node being expanded
    Length candidate_bound_ = 0;     // of the current node: embedded paths and candidates
    std::vector<Index> candidates_;  // walk per layout edge, of the current node or child
    std::vector<Length> costs_;      // likewise
    std::vector<Index> branches_;    // edges to insert, and the next of them
    std::size_t next_branch_ = 0;
    bool in_child_ = false;
    Child child_;

    Length told_bound_ = 0;
    SearchCounters counters_;
};

}  // namespace layout_embedding
