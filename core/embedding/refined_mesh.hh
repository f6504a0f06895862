#pragma once

#include <array>
#include <vector>

#include "base/types.hh"

namespace layout_embedding {

/// The result of an embedding (paper, Sec. 3.3): the target, subdivided so that every layout edge
/// is a chain of mesh edges and every layout face a patch of triangles.
struct RefinedMesh {
    /// The target's vertices keep their ids 0 .. #V-1, new vertices follow.
    std::vector<Vec3> positions;
    /// 3 vertex ids per triangle, counter-clockwise.
    std::vector<Index> corners;
    /// Per new vertex (vertex #V + k at place k): a target face that holds it ...
    std::vector<Index> vertex_faces;
    /// ... and its barycentric coordinates there, in the order of the face's corners.
    std::vector<std::array<double, 3>> vertex_barycentrics;
    /// Per triangle: the target face it lies in.
    std::vector<Index> triangle_faces;
    /// Per triangle: the layout face whose patch it belongs to, kNone outside all of them (a layout
    /// with boundary).
    std::vector<Index> triangle_patches;
    /// Per layout edge e: the vertex ids of its chain from the landmark of tail(2e) to that of
    /// head(2e).
    std::vector<std::vector<Index>> chains;
};

}  // namespace layout_embedding
