#pragma once

#include "base/types.hh"
#include "embedding/refined_mesh.hh"
#include "mesh/triangle_mesh.hh"

namespace layout_embedding {

/// Adds vertices to a refined mesh where its triangles are thin: between paths that run side by
/// side, and between a path and a vertex that it passes. Chains, patches and the surface stay as
/// they are; new vertices lie on edges of the target, on chains, and inside of faces.
///
/// Delaunay refinement in the plane of each target face (Chew, "Guaranteed-quality mesh generation
/// for curved surfaces", 1993; off-centers of Ungor, "Off-centers: a new type of Steiner points",
/// 2004): the worst triangle gets a vertex near its circumcenter, or, where an edge of the target
/// or of a chain is in the way, in the middle of that edge. Angles are wanted to be at least a
/// third of the least one of the target, and at least kThinAngle where a third of the least angle
/// of their own face is no less. Angles between two edges that must stay, of the target or of
/// chains, are as they are. It ends when all others are large enough, or with as many vertices as
/// the cut added.
///
/// `refined` as cut_along() makes it. Returns the number of new vertices. Plain doubles, in a fixed
/// order. O(#triangles + new vertices * log).
Index refine_thin_triangles(const TriangleMesh& target, RefinedMesh& refined);

}  // namespace layout_embedding
