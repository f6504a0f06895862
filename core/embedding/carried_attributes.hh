#pragma once

#include "embedding/refined_mesh.hh"
#include "mesh/mesh_attributes.hh"
#include "mesh/triangle_mesh.hh"

namespace layout_embedding {

/// The attributes of `target` on a refined mesh of it: triangles have the names of the target's
/// face they lie in, and their corners what lies between the values at the corners of that face, so
/// that seams stay seams. A corner between values some of which are missing has none; corners of
/// one vertex with the same numbers share a value (among the last few of a vertex). `attributes`
/// are those of the target's faces and their corners. Linear.
MeshAttributes carried_attributes(const MeshAttributes& attributes, const TriangleMesh& target,
                                  const RefinedMesh& refined);

}  // namespace layout_embedding
