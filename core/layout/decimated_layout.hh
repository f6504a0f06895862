#pragma once

#include <span>
#include <string_view>

#include "base/result.hh"
#include "mesh/decimation.hh"
#include "mesh/polygon_mesh.hh"
#include "mesh/triangle_mesh.hh"

namespace layout_embedding {

struct DecimatedLayout {
    /// A valid layout (layout/layout.hh) of triangles: vertex i is landmark i and lies at its
    /// position.
    PolygonMesh mesh;
    /// How the other vertices of the target were removed.
    DecimationCounts counts;
    /// How often edges had to be flipped away from the vertices that were still to be removed
    /// (Decimation::unblock()).
    Index times_unblocked = 0;
};

/// Makes a layout of a landmarked target (paper, Sec. 5.1): all vertices but the landmarks
/// are removed by halfedge collapses in the order of their quadric error (mesh/decimation.hh), with
/// edge flips and finally without regard to shapes where nothing else is left. The layout is a
/// triangulation of the target's surface, of any genus.
///
/// Boundary loops with at least three landmarks stay: the layout has the same loop, through its
/// landmarks in their order. A loop with fewer cannot be one of the layout's edges alone; it is
/// closed by a cone during the decimation, so that the layout has a loop around it, through the
/// landmarks on it, if any, and inner ones.
///
/// Errors: landmarkOutOfRange, duplicateLandmark, tooFewLandmarks (less than three);
/// tooFewLandmarksForSurface (the genus or the boundary loops admit no triangulation without
/// parallel edges with so few vertices); templateNotReached (practically only with hardly more
/// landmarks than that). O(n log n), a few seconds for a million triangles; deterministic.
Result<DecimatedLayout> decimated_layout(const TriangleMesh& target,
                                         std::span<const Index> landmarks);

}  // namespace layout_embedding
