#include "surface/polylines.hh"

namespace layout_embedding {

void Polylines::add(const PathGraph& graph, Index layout_edge, const std::vector<Index>& darts)
{
    points.push_back(graph.position(graph.tail(darts.front())));
    for (const Index dart : darts) {
        points.push_back(graph.position(graph.head(dart)));
    }
    offsets.push_back(static_cast<Index>(points.size()));
    layout_edges.push_back(layout_edge);
}

}  // namespace layout_embedding
