#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/types.hh"
#include "layout/layout.hh"
#include "search/face_loops.hh"
#include "surface/walk_pool.hh"

namespace layout_embedding {

/// What is known of the homotopy classes that layout edges can take, each by its shortest walk:
/// which there are, what those that are not known cost at least, and which go together. Costs are
/// in path-graph lengths times the edges' weights.
class KnownClasses {
public:
    /// All classes of the edge that cost less than `excess` beyond its base and could be embedded
    /// together with the walks of other edges are known. kInfiniteLength: all that could be.
    struct Bound {
        Index layout_edge;
        std::vector<Index> walks;
        Length excess;
    };

    /// Keeps references. `is_linear`: per layout vertex, whether the orders of the edges there are
    /// linear. `faces` may be missing.
    KnownClasses(const Layout& layout, const WalkPool& pool, std::optional<FaceLoops> faces,
                 std::vector<bool> is_linear);

    const Layout& layout() const { return layout_; }
    const WalkPool& pool() const { return pool_; }
    /// nullptr if nothing is asked of faces.
    FaceLoops* faces() { return faces_ ? &*faces_ : nullptr; }

    /// Every class of the edge costs at least this.
    void set_base(Index layout_edge, Length bound);
    Length base(Index layout_edge) const { return edges_[layout_edge].base; }
    /// Of all edges.
    Length base() const { return base_; }
    /// What the walk costs beyond its edge's base.
    Length excess(Index walk) const { return pool_.cost(walk) - base(pool_.layout_edge(walk)); }
    /// Choices of this cost or more do not matter.
    void lower_upper_bound(Length cost) { upper_bound_ = std::min(upper_bound_, cost); }
    Length upper_bound() const { return upper_bound_; }

    /// False if the class is known already.
    bool add(Index walk);
    void add_bound(Bound bound) { bounds_.push_back(std::move(bound)); }
    /// These cannot all be chosen together.
    void forbid(std::span<const Index> walks)
    {
        forbidden_.emplace_back(walks.begin(), walks.end());
    }

    bool contains(Index walk) const { return walk < is_known_.size() && is_known_[walk]; }
    /// All, in the order in which they became known; likewise the following.
    const std::vector<Index>& walks() const { return walks_; }
    const std::vector<Index>& walks(Index layout_edge) const { return edges_[layout_edge].walks; }
    const std::vector<Bound>& bounds() const { return bounds_; }
    const std::vector<std::vector<Index>>& forbidden() const { return forbidden_; }

    bool is_linear(Index layout_vertex) const { return is_linear_[layout_vertex]; }
    /// Calls `visit` with the known walks that leave a landmark on the boundary on the wrong side
    /// of this one.
    template <typename Visit>
    void for_each_in_wrong_order(Index walk, const Visit& visit) const;
    /// Whether three halfedges that leave a landmark, ascending in rank, do so in the wrong cyclic
    /// order along these walks.
    bool is_wrong(const std::array<Index, 3>& halfedges, const std::array<Index, 3>& walks) const;
    /// Whether two walks of different edges may be in a choice that matters.
    bool can_go_together(Index walk_a, Index walk_b) const;

private:
    struct Edge {
        Length base = 0;
        std::vector<Index> walks;
    };

    const Layout& layout_;
    const WalkPool& pool_;
    std::optional<FaceLoops> faces_;
    std::vector<bool> is_linear_;
    Length base_ = 0;
    Length upper_bound_ = kInfiniteLength;
    std::vector<Edge> edges_;
    std::vector<bool> is_known_;  // per walk, as far as needed
    std::vector<Index> walks_;
    std::vector<Bound> bounds_;
    std::vector<std::vector<Index>> forbidden_;
};

template <typename Visit>
void KnownClasses::for_each_in_wrong_order(Index walk, const Visit& visit) const
{
    const Index e = pool_.layout_edge(walk);
    for (const Index h : {2 * e, 2 * e + 1}) {
        const Index v = layout_.tail(h);
        if (!is_linear_[v]) {
            continue;
        }
        for (const Index g : layout_.outgoing(v)) {
            if (Layout::edge(g) == e) {
                continue;
            }
            for (const Index other : edges_[Layout::edge(g)].walks) {
                if ((pool_.place(h, walk) < pool_.place(g, other)) !=
                    (layout_.rank(h) < layout_.rank(g))) {
                    visit(other);
                }
            }
        }
    }
}

}  // namespace layout_embedding
