#pragma once

#include <cstdint>
#include <set>
#include <unordered_map>
#include <vector>

#include "base/types.hh"
#include "search/partial_embedding.hh"
#include "search/path_oracle.hh"

namespace layout_embedding {

/// Switches of the paper's branch and bound, for its ablation (Secs. 4.3 to 4.5, Fig. 12); all on
/// by default. None of them changes the optimum.
struct BranchAndBoundOptions {
    /// Tolerance alpha: states within this share of the incumbent's cost are pruned (Sec. 4.2).
    double gap = 0.01;
    /// Count candidate paths in lower bounds (Sec. 4.3), not only embedded ones.
    bool candidate_bounds = true;
    /// Drop states whose embedding has been met before (Sec. 4.4.1).
    bool detect_redundant_states = true;
    /// Branch on conflicting edges only (Sec. 4.4.2).
    bool delay_non_conflicting = true;
    /// Visit by number of conflicting edges times lower bound (Sec. 4.5), not by lower bound alone.
    bool mixed_priority = true;
};

/// The paper's branch and bound over insertion sequences (Sec. 4) on strands of zero width, where
/// its lower bound is exactly valid (design, Secs. 1 and 2). Stepped; its bound holds for
/// embeddings that insert paths one by one, each as the shortest that is left.
class BranchAndBound {
public:
    enum class Outcome {
        running,
        /// lower_bound() of the root state is known: it bounds every embedding.
        bounded,
        /// incumbent() has improved.
        improved,
        /// Nothing is left to be explored, or the gap is reached.
        finished,
        /// Equal lengths: start again with other perturbations.
        tied,
    };

    struct Counters {
        std::uint64_t created = 0;    // states given to the queue
        std::uint64_t expanded = 0;   // states taken from it and branched
        std::uint64_t pruned = 0;     // states dropped by their bound
        std::uint64_t redundant = 0;  // states met before
        std::uint64_t dead_ends = 0;  // states in which an edge has no path left
    };

    /// Keeps references; `embedding` is empty.
    BranchAndBound(PartialEmbedding& embedding, PathOracle& oracle,
                   const BranchAndBoundOptions& options);

    /// Continues for at most `budget` units of work: node expansions, and one per layout edge for
    /// every state that is evaluated. At least as many as there are layout edges, or nothing is
    /// done.
    Outcome run(std::uint64_t budget = UINT64_MAX);

    /// Takes a complete embedding found elsewhere, given as walks in an order in which they can be
    /// inserted, as the incumbent if it is better.
    bool offer(const std::vector<Index>& walks, Length cost);

    /// The cost of every embedding that insertion sequences reach is at least this.
    Length lower_bound() const;
    /// The sum of the unconstrained paths: bounds all embeddings.
    Length root_bound() const { return root_bound_; }
    /// Walks in order of insertion, empty without an incumbent.
    const std::vector<Index>& incumbent() const { return incumbent_; }
    Length incumbent_cost() const { return incumbent_cost_; }
    const Counters& counters() const { return counters_; }

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
        std::vector<Index> open;  // edges whose candidate has to be found again
        std::size_t next = 0;
        std::vector<Index> updates;
    };

    Outcome find_root();
    bool take_node();
    Outcome evaluate_child(std::uint64_t& budget);
    void begin_child(Index edge);
    Outcome finish_child(Index edge);
    void drop(Length bound);
    void end_child();
    Length prune_threshold() const;
    Outcome add_state(Index walk, std::uint64_t hash);
    Outcome accept_candidates();
    std::vector<Index> find_branches(std::size_t& conflict_count) const;
    std::vector<Index> sequence(Index node) const;
    bool is_redundant(std::uint64_t hash, Index walk);

    PartialEmbedding& embedding_;
    PathOracle& oracle_;
    BranchAndBoundOptions options_;
    Index edge_count_;
    Index next_root_ = 0;
    bool finished_ = false;
    Length root_bound_ = 0;

    std::vector<Node> nodes_;
    std::vector<QueueItem> queue_;
    std::set<std::pair<Length, Index>> open_bounds_;
    std::unordered_multimap<std::uint64_t, Index> nodes_by_hash_;  // looked up, never iterated
    Length pruned_bound_ = kInfiniteLength;

    Index current_ = kNone;          // node being expanded
    std::vector<Index> candidates_;  // walk per layout edge, of the current node or child
    std::vector<Index> branches_;    // edges to insert, and the next of them
    std::size_t next_branch_ = 0;
    bool in_child_ = false;
    Child child_;

    std::vector<Index> incumbent_;
    Length incumbent_cost_ = kInfiniteLength;
    Counters counters_;
};

}  // namespace layout_embedding
