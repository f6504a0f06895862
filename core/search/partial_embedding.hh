#pragma once

#include <span>
#include <vector>

#include "base/types.hh"
#include "search/walk_pool.hh"
#include "surface/hole_guard.hh"
#include "surface/strands.hh"

namespace layout_embedding {

/// A state of a search over insertion sequences: strands, known by the ids of their walks. Moving
/// to another state undoes and redoes only what differs.
class PartialEmbedding {
public:
    /// Keeps references; `strands` is empty.
    PartialEmbedding(Strands& strands, WalkPool& pool);

    const Strands& strands() const { return strands_; }
    const WalkPool& pool() const { return pool_; }
    WalkPool& pool() { return pool_; }
    /// The walk of a layout edge, kNone if it is not embedded.
    Index walk(Index layout_edge) const { return walks_[layout_edge]; }
    /// The walks in the order of insertion.
    const std::vector<Index>& sequence() const { return sequence_; }
    /// The length of all embedded paths.
    Length cost() const { return cost_; }
    bool is_complete() const { return sequence_.size() == walks_.size(); }
    std::uint64_t insertion_count() const { return insertion_count_; }

    /// Embeds a walk; false, without any change, if strands are in its way or a hole of the target
    /// would get into the wrong layout face.
    bool insert(Index walk);
    void undo();
    /// Goes to the state with these walks, which is one that can be built in this order.
    void go_to(std::span<const Index> sequence);

    /// Whether a walk could be embedded now, holes aside.
    bool traces(Index walk) const
    {
        return strands_.trace(pool_.layout_edge(walk), pool_.darts(walk)).has_value();
    }

private:
    Strands& strands_;
    WalkPool& pool_;
    HoleGuard hole_guard_;
    std::vector<Index> walks_;  // per layout edge
    std::vector<Index> sequence_;
    Length cost_ = 0;
    std::uint64_t insertion_count_ = 0;
};

}  // namespace layout_embedding
