#pragma once

#include <vector>

#include "base/types.hh"
#include "mesh/face_origins.hh"
#include "mesh/polygon_mesh.hh"

namespace layout_embedding {

/// Mends triangles of `mesh` without area, where that is safe: collapses an edge of no length (the
/// vertex of larger id becomes the other, both in the faces and in `representatives`), flips the
/// longest edge of a triangle on a line, or drops such a triangle where that edge is a boundary
/// edge; drops one that shares no edge with others. `origins` follows. Returns how many triangles
/// were mended. All positions must be finite. See repair_surface().
Index mend_triangles_without_area(PolygonMesh& mesh, std::vector<Index>& representatives,
                                  FaceOrigins& origins);

}  // namespace layout_embedding
