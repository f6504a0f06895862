#pragma once

#include <vector>

#include "apps/quad_mesh.hh"

namespace layout_embedding {

/// Moves the vertices of `mesh` that are not `fixed` towards the means of their neighbours and back
/// to the target, one after the other, `rounds` times or until they hardly move. A move is made
/// only if the smallest scaled Jacobian of the quads around the vertex stays above 0.5 or grows.
/// Vertices of quads that are still bad then look around themselves for better places.
void relax_quads(const TriangleMesh& target, const std::vector<bool>& fixed, Index rounds,
                 QuadMesh& mesh);

/// Per quad, the mean of the target's normals at its corners.
std::vector<Vec3> surface_normals(const TriangleMesh& target, const QuadMesh& mesh);

}  // namespace layout_embedding
