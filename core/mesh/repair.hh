#pragma once

#include <string>
#include <vector>

#include "base/types.hh"
#include "mesh/face_origins.hh"
#include "mesh/polygon_mesh.hh"
#include "mesh/validation.hh"

namespace layout_embedding {

struct RepairResult {
    PolygonMesh mesh;
    /// Per vertex of the input its vertex in `mesh`, kNone where it was dropped.
    std::vector<Index> vertex_map;
    /// What became of the input's faces.
    FaceOrigins face_origins;
    /// What was done, one sentence each; empty if nothing was.
    std::vector<std::string> notes;
};

/// Mends what can be mended without changing the shape:
/// - drops faces of fewer than three different corners and all but one of faces with the same
///   corners;
/// - targets that fall apart or are open because their faces do not share vertices (STL files):
///   makes one vertex of those at exactly the same position, edge by edge (mesh/weld.hh);
/// - triangle targets: mends triangles without area, by collapsing an edge of no length, by
/// flipping
///   the longest edge, or by dropping the triangle (at the boundary, or if it shares no edge with
///   others), where that is safe;
/// - drops vertices in no face.
///
/// A mesh that passes check_surface() comes back as it is, without notes. The result need not pass:
/// check again. Deterministic. O(n log n) per round of mending triangles, of which there are at
/// most 100.
RepairResult repair_surface(const PolygonMesh& mesh, SurfaceKind kind);

}  // namespace layout_embedding
