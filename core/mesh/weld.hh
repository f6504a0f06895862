#pragma once

#include <vector>

#include "base/types.hh"
#include "mesh/polygon_mesh.hh"

namespace layout_embedding {

/// Which vertices would have to become one to close the gaps between boundary edges that lie
/// exactly on each other in opposite directions, as in triangle soups (STL). Per vertex the
/// smallest vertex of its class; the vertex itself if it stays alone.
///
/// Works on edges rather than on vertices, so that it never makes two sheets touch in a single
/// vertex; edges where more than two faces would meet are left open. The corners of `mesh` must be
/// its vertices and its positions finite. O(#H log #H).
std::vector<Index> weld_classes(const PolygonMesh& mesh);

/// `mesh` with every corner replaced by its class; the vertices stay, also those that are no
/// longer used.
PolygonMesh welded(const PolygonMesh& mesh, const std::vector<Index>& classes);

/// Whether `mesh`, welded to `classes`, falls into fewer components than before, or is the first
/// to be closed: whether its gaps are no more than vertices that are not shared.
bool welding_helps(const PolygonMesh& mesh, const std::vector<Index>& classes);

}  // namespace layout_embedding
