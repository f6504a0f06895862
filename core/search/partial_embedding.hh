#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "base/types.hh"
#include "surface/hole_guard.hh"
#include "surface/strands.hh"
#include "surface/walk_pool.hh"

namespace layout_embedding {

/// What keeps candidate paths from being embedded together (paper, Sec. 4.4.2 and Fig. 9), by
/// layout edge. Candidates without a conflict can be inserted in any order, all along the same
/// walks.
struct CandidateConflicts {
    /// Edges (a, b), a < b, whose candidates cross or would leave a common sector in the wrong
    /// order. Sorted.
    std::vector<std::pair<Index, Index>> pairs;
    /// Three edges around a landmark where nothing is embedded yet whose candidates are in the
    /// wrong cyclic order; no two of them conflict there. Sorted.
    std::vector<std::array<Index, 3>> triples;

    /// The edges with a conflict, ascending.
    std::vector<Index> edges() const;
};

/// A state of a search: some layout edges embedded along walks, which are known by their ids.
///
/// Whether a walk fits, and which candidates conflict, follows from how the walks lie to each
/// other. Strands are moved only when the cut surface itself is asked for.
class PartialEmbedding {
public:
    /// Keeps references; `strands` is empty and moved by this object alone.
    PartialEmbedding(Strands& strands, WalkPool& pool);

    const Layout& layout() const { return strands_.layout(); }
    const WalkPool& pool() const { return pool_; }
    WalkPool& pool() { return pool_; }
    /// The walk of a layout edge, kNone if it is not embedded.
    Index walk(Index layout_edge) const { return walks_[layout_edge]; }
    /// The walks in the order of insertion.
    const std::vector<Index>& sequence() const { return sequence_; }
    /// What all embedded paths cost.
    Length cost() const { return cost_; }
    bool is_complete() const { return sequence_.size() == walks_.size(); }
    /// Insertions so far.
    std::uint64_t insertion_count() const { return insertion_count_; }

    /// Whether a walk of an edge that is not embedded could be embedded now, holes aside.
    bool fits(Index walk) const;
    enum class Insertion {
        done,
        /// Without any change: a hole of the target would get into the wrong layout face.
        refused,
        /// Without any change: the strands cannot be moved, see move_strands().
        torn,
    };
    /// Embeds a walk that fits.
    Insertion insert(Index walk);
    void undo();
    /// Goes to the state with these walks, which is one that can be built in this order.
    void go_to(std::span<const Index> sequence);

    /// The conflicts between candidates that fit. `candidates[e]` is a walk for every edge that is
    /// not embedded.
    CandidateConflicts conflicts(std::span<const Index> candidates) const;
    /// The edges whose candidates would not fit any more after that of `layout_edge` was inserted:
    /// its partners in conflicts().pairs. Ascending.
    std::vector<Index> conflicting_with(Index layout_edge, std::span<const Index> candidates) const;

    /// Walks that keep a hole of the target in the wrong layout face, none if every hole is where
    /// the layout wants one. The strands are as of move_strands().
    std::vector<Index> walks_around_misplaced_hole() const;

    /// Moves the strands to this state; false if they cannot get there, which only a tie of lengths
    /// that went unnoticed could cause.
    bool move_strands();
    /// The strands as of the last move_strands().
    const Strands& strands() const { return strands_; }

private:
    bool in_order(Index halfedge, Index walk) const;
    bool order_conflict(Index halfedge_a, Index walk_a, Index halfedge_b, Index walk_b) const;
    Index embedded_at(Index layout_vertex) const;
    bool is_linear(Index layout_vertex) const { return linear_[layout_vertex]; }

    Strands& strands_;
    WalkPool& pool_;
    HoleGuard hole_guard_;
    bool has_holes_;
    std::vector<bool> linear_;  // per layout vertex: its landmark lies on the boundary
    std::vector<Index> walks_;  // per layout edge
    std::vector<Index> sequence_;
    std::vector<Index> strand_walks_;  // as inserted in strands_
    Length cost_ = 0;
    std::uint64_t insertion_count_ = 0;
};

}  // namespace layout_embedding
