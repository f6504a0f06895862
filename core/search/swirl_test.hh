#pragma once

#include <span>
#include <vector>

#include "base/types.hh"
#include "surface/strands.hh"

namespace layout_embedding {

/// The swirl test of [PSS01], as the paper's Sec. 5 uses it: a tentative path of the directed
/// layout edge i -> j is suspected of a swirl if the landmarks of the other corners of the layout
/// face on its left come nearer to its right side than to its left; the same for the opposite
/// direction.
///
/// "Nearer" is a shortest-path search on the target's vertices and edges, from all these landmarks
/// at once, until it meets the path somewhere between its ends: at a vertex it reaches, or at the
/// midpoint of an edge that it would follow. Embedded paths do not stand in its way, so that the
/// answer depends on the path alone and can be kept as long as the path stays.
class SwirlTest {
public:
    /// Keeps a reference. Scratch memory: 4 bytes per node and 12 per target vertex.
    explicit SwirlTest(const Strands& strands);

    /// Whether the walk, from the landmark of tail(2e) to that of head(2e), is suspected.
    /// O(#V log #V) at worst; the search ends where it meets the path.
    bool suspects(Index layout_edge, std::span<const Index> darts);

private:
    enum class Side { none, left, right };
    struct Item {
        Length distance;
        Index dart;  // leads to the path if side is set; otherwise kNone
        Index node;
        friend bool operator<(const Item& a, const Item& b)
        {
            return a.distance != b.distance ? a.distance > b.distance
                   : a.node != b.node       ? a.node > b.node
                                            : a.dart > b.dart;
        }
    };

    Side first_side(Index layout_halfedge, std::span<const Index> darts);
    Side side_at(Index node, Index arriving_dart, std::span<const Index> darts) const;
    void push(Index node, Length distance, Index dart);

    const Strands& strands_;
    std::vector<Index> visits_;      // per node: the path's visit of it, kNone if none
    std::vector<Length> distances_;  // per target vertex, kInfiniteLength if not reached
    std::vector<Index> reached_;     // vertices whose distance is set
    std::vector<Item> queue_;
};

}  // namespace layout_embedding
