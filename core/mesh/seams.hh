#pragma once

#include "mesh/polygon_mesh.hh"

namespace layout_embedding {

/// `mesh` with its seams closed: in formats that give every face, or every side of a texture's
/// seam, vertices of its own (STL, GLB), vertices become one where boundary edges lie exactly on
/// each other (weld_classes() in mesh/weld.hh). Vertices that no face uses any longer are dropped;
/// the others keep their order. A mesh with a position that is not finite stays as it is.
PolygonMesh without_seams(const PolygonMesh& mesh);

}  // namespace layout_embedding
