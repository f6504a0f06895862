#pragma once

#include <string_view>

#include "base/result.hh"
#include "mesh/polygon_mesh.hh"

namespace layout_embedding {

/// What a surface is to be used for.
enum class SurfaceKind {
    /// Triangles with usable positions.
    target,
    /// Polygons read for their connectivity; positions only have to be finite.
    layout,
};

/// The largest number of faces, so that the darts of the path graph (at most 24 per face) have
/// 32-bit ids.
inline constexpr Index kMaxFaces = kNone / 24;

/// Confirms that `mesh` is a connected, consistently oriented manifold surface, with or without
/// boundary, that fits its use. `subject` begins the messages, for example "the target spot.obj".
/// The first problem found is returned, with its first place (0-based ids of vertices and faces),
/// in this order:
/// - noFaces, tooLarge (more than kMaxFaces), indexOutOfRange (of a corner, or of a face's offset);
/// - layoutLoop (two consecutive corners of a layout face are one vertex), degenerateFace (fewer
///   than three corners; any repeated corner in a target), notTriangles (target);
/// - nonFinitePosition;
/// - for targets: coordinateTooLarge (a coordinate beyond 1e60, or a bounding
///   box with a diagonal below 1e-60: areas could not be compared in double precision);
///   degenerateFace (three corners on one line);
/// - unusedVertex;
/// - duplicateFace (the same corners in the same cyclic order or in its reverse; but two polygons
///   glued along their whole boundary are a layout of the sphere);
/// - nonManifoldEdge, inconsistentOrientation, nonManifoldVertex;
/// - for targets: coincidentVertices, only where the mesh falls into several components or has a
///   boundary because edges that lie exactly on each other do not share their vertices;
/// - severalComponents.
///
/// A layout face may run along both sides of an edge (a dangling edge inside the face).
/// O(n log n), whatever the degrees.
Status check_surface(const PolygonMesh& mesh, SurfaceKind kind, std::string_view subject);

/// Whether the three points lie exactly on one line, as far as double precision can tell.
bool has_no_area(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace layout_embedding
