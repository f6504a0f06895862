#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "base/index_set.hh"
#include "base/types.hh"
#include "surface/strands.hh"

namespace layout_embedding {

/// The different walks that a search has met, each stored once under an id, and how they lie to
/// each other. On the whole of a search there are only a few dozen per layout edge.
///
/// Walks that are shortest in their homotopy classes can be embedded together if and only if no two
/// of them cross and they leave every landmark in the layout's order (design, Sec. 3; proof.md,
/// Theorem 1): what is known here decides questions for which Strands would have to be moved.
class WalkPool {
public:
    /// Takes path graph, layout, landmarks and weights from `strands`, whatever is embedded there.
    explicit WalkPool(const Strands& strands);

    /// The id of a walk of a layout edge, from tail(2e) to head(2e), new or known. The walk is
    /// simple in the sense that it does not cross itself.
    Index add(Index layout_edge, const std::vector<Index>& darts);

    Index size() const { return static_cast<Index>(walks_.size()); }
    Index layout_edge(Index walk) const { return walks_[walk].layout_edge; }
    const std::vector<Index>& darts(Index walk) const { return walks_[walk].darts; }
    /// Its length times the edge's weight.
    Length cost(Index walk) const { return walks_[walk].cost; }

    /// The walks of other edges that truly cross this one (a shared stretch entered and left on
    /// opposite sides; stretches that end at a landmark do not count).
    const IndexSet& crossing(Index walk) const { return walks_[walk].crossing; }
    bool cross(Index a, Index b) const { return walks_[a].crossing.contains(b); }

    /// The place of a walk among all walks known at the tail of layout halfedge h, which belongs to
    /// the walk's edge: counter-clockwise, walks that share a dart ordered by where they diverge.
    /// Places change when walks are added; their order does not.
    Index place(Index layout_halfedge, Index walk) const
    {
        return walks_[walk].places[layout_halfedge % 2];
    }

private:
    struct Walk {
        Index layout_edge;
        std::vector<Index> darts;
        Length cost;
        IndexSet crossing;
        Index places[2];  // at its start and at its end

        Index inner_count() const { return static_cast<Index>(darts.size() - 1); }
    };
    /// A walk as it leaves a landmark.
    struct Leaving {
        Index walk;
        Index from_end;  // 1 if the landmark is at the walk's end
    };
    /// Inner node k of a walk, between its darts k and k + 1.
    struct Visit {
        Index walk;
        Index k;
    };

    bool leaves_before(const Leaving& x, const Leaving& y) const;
    void find_crossings(Index walk);
    void find_place(Index walk, Index from_end);

    const PathGraph& graph_;
    const Layout& layout_;
    const EdgeWeights& weights_;
    std::vector<Walk> walks_;
    std::unordered_multimap<std::uint64_t, Index> ids_by_hash_;      // looked up, never iterated
    std::unordered_map<Index, std::vector<Visit>> visits_of_nodes_;  // likewise
    std::vector<std::vector<Leaving>> leaving_;                      // per layout vertex, in order
};

}  // namespace layout_embedding
