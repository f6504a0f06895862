#pragma once

#include "embedding/normal_form.hh"
#include "embedding/refined_mesh.hh"
#include "mesh/triangle_mesh.hh"

namespace layout_embedding {

/// Whether a refined mesh has vertices besides those of the target and the crossings of its chains
/// with edges of the target (embedding/angle_refinement.hh adds such).
bool has_added_vertices(const TriangleMesh& target, const RefinedMesh& refined);

/// The chains of a refined mesh as strands in normal form: cut_along() makes the same embedding
/// again, without added vertices. `target` must outlive the form. O(#triangles log #triangles).
NormalForm strands_of(const TriangleMesh& target, const RefinedMesh& refined);

}  // namespace layout_embedding
