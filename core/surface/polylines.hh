#pragma once

#include <vector>

#include "base/types.hh"
#include "surface/path_graph.hh"

namespace layout_embedding {

/// Paths as polylines, ready to draw.
struct Polylines {
    /// Per path: its first place in `points`; #paths + 1.
    std::vector<Index> offsets{0};
    std::vector<Vec3> points;
    /// Per path: the layout edge.
    std::vector<Index> layout_edges;

    /// Appends the walk of a layout edge, which has at least one dart.
    void add(const PathGraph& graph, Index layout_edge, const std::vector<Index>& darts);
};

}  // namespace layout_embedding
