#pragma once

#include <unordered_map>
#include <vector>

#include "base/types.hh"
#include "surface/path_graph.hh"

namespace layout_embedding {

/// The different walks that a search has met, each stored once. On the whole of a search there are
/// only a few dozen per layout edge, so that states are told apart by walk ids.
class WalkPool {
public:
    /// Keeps a reference.
    explicit WalkPool(const PathGraph& graph) : graph_(graph) {}

    /// The id of a walk of a layout edge, new or known.
    Index add(Index layout_edge, const std::vector<Index>& darts);

    Index layout_edge(Index walk) const { return walks_[walk].layout_edge; }
    const std::vector<Index>& darts(Index walk) const { return walks_[walk].darts; }
    Length cost(Index walk) const { return walks_[walk].cost; }
    Index size() const { return static_cast<Index>(walks_.size()); }

private:
    struct Walk {
        Index layout_edge;
        std::vector<Index> darts;
        Length cost;
    };
    const PathGraph& graph_;
    std::vector<Walk> walks_;
    std::unordered_multimap<std::uint64_t, Index> ids_by_hash_;  // looked up, never iterated
};

}  // namespace layout_embedding
