#pragma once

#include <array>
#include <vector>

#include "base/types.hh"
#include "embedding/checker.hh"
#include "layout/layout.hh"
#include "mesh/polygon_mesh.hh"
#include "mesh/triangle_mesh.hh"
#include "surface/path_graph.hh"
#include "surface/weak_embedding.hh"

namespace layout_embedding {

// What the library holds, as the plain arrays that the checker takes: the checker itself knows none
// of these classes.

/// The faces of a layout; all positions are zero.
PolygonMesh to_polygons(const Layout& layout);
/// The faces and positions of a target.
PolygonMesh to_polygons(const TriangleMesh& target);
/// Tail and head of every layout edge.
std::vector<std::array<Index, 2>> layout_edges(const Layout& layout);
/// The points of every path, in terms of target vertices.
std::vector<std::vector<WeakPoint>> weak_points(const TriangleMesh& target, const PathGraph& graph,
                                                const WeakEmbedding& embedding);

}  // namespace layout_embedding
