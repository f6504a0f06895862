#pragma once

#include <string_view>

#include "base/result.hh"
#include "mesh/polygon_mesh.hh"

namespace layout_embedding {

/// What a surface is to be used for.
enum class SurfaceKind {
    /// Triangles with usable positions.
    target,
    /// Polygons read for their connectivity; positions are not looked at.
    layout,
};

/// Confirms that `mesh` is a connected, consistently oriented manifold surface, with or without
/// boundary, that fits its use. `subject` begins the messages, for example "the target spot.obj".
/// The first problem found is returned, in this order: noFaces, tooLarge, indexOutOfRange,
/// layoutLoop or degenerateFace (repeated corner), notTriangles, nonFinitePosition,
/// coordinateTooLarge, coincidentVertices, degenerateFace (no area), unusedVertex, duplicateFace,
/// nonManifoldEdge, inconsistentOrientation, nonManifoldVertex, severalComponents.
Status check_surface(const PolygonMesh& mesh, SurfaceKind kind, std::string_view subject);

}  // namespace layout_embedding
