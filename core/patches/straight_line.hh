#pragma once

#include <optional>
#include <vector>

#include "base/types.hh"
#include "patches/parametrisation.hh"
#include "patches/patch.hh"

namespace layout_embedding {

/// Where a line crosses an edge of a parametrisation, from the triangle on the left of the edge,
/// seen from its right end, to the one beyond.
struct LineCrossing {
    /// Of Parametrisation::corners: the triangle that the line leaves.
    Index triangle;
    /// The ends of the edge, on the right and on the left of the line.
    Index right;
    Index left;
    /// 0 at the right end, 1 at the left one; strictly between.
    double share;
};

/// The straight line through a parametrised patch between two corners of its domain that no side
/// joins, given as boundary vertices: the edges that it crosses, in order. Which side a vertex is
/// on is decided once, so that the way is a sound one whatever rounding does. Nothing where the
/// corners are joined by an inner edge, which then is the line; no value if there is no way, which
/// does not happen in a one-to-one map. O(#triangles log #triangles).
std::optional<std::vector<LineCrossing>> straight_line(const Patch& patch,
                                                       const Parametrisation& map, Index from,
                                                       Index to);

}  // namespace layout_embedding
