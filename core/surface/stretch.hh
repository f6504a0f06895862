#pragma once

#include <vector>

#include "base/types.hh"
#include "surface/path_graph.hh"

namespace layout_embedding {

/// Whether x comes before y going around from `from`, that is whether the three, all different, are
/// in cyclic order. The darts that leave a node are numbered counter-clockwise, so that it works on
/// darts of one node, and as well on places and ranks around a landmark.
inline bool is_before(Index from, Index x, Index y)
{
    return (from < x && x < y) || (x < y && y < from) || (y < from && from < x);
}

/// A stretch is a maximal common part of two passes of walks, perhaps one node, run through in the
/// same or in opposite directions. It crosses if the second walk enters and leaves it on opposite
/// sides of the first; one that ends at the end of a walk does not (proof.md, Sec. 0).
///
/// Whether the stretch crosses that begins at inner node i of a and j of b (after their darts i and
/// j), as seen along a; false if none begins there.
bool stretch_crosses(const PathGraph& graph, const std::vector<Index>& a, Index i,
                     const std::vector<Index>& b, Index j);

}  // namespace layout_embedding
