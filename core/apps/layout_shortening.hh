#pragma once

#include <memory>
#include <vector>

#include "mesh/polygon_mesh.hh"
#include "mesh/triangle_mesh.hh"

namespace layout_embedding {

/// A layout of triangles with other edges between its vertices.
struct ShortenedLayout {
    PolygonMesh mesh;
    /// Edges that were flipped on the way.
    Index flips = 0;
};

/// Flips edges of a triangulated layout until its best known embedding in a target has no path that
/// the others force away from the shortest one although the other diagonal of its two faces is
/// shorter beside them. Every flip makes the embedding shorter; layout edges that follow their
/// shortest paths stay. What decimation down to a few vertices leaves twisted around handles and
/// thin limbs is straightened that way.
///
/// `landmarks`: one target vertex per layout vertex. Boundary edges stay, no parallel edges are
/// made. The layout is given back as it is where no embedding is found quickly. Deterministic.
ShortenedLayout shortened_layout(const PolygonMesh& layout,
                                 const std::shared_ptr<const TriangleMesh>& target,
                                 const std::vector<Index>& landmarks);

}  // namespace layout_embedding
