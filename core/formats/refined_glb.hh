#pragma once

#include <string>

#include "embedding/refined_mesh.hh"

namespace layout_embedding {

/// `refined` as binary glTF 2.0: a node `patch_<layout face>` for every patch (`outside` for the
/// rest) in one of a few colours that differ between neighbours, a tube `edge_<layout edge>` for
/// every chain, and `landmarks`, balls at the chains' ends. Vertices of all patches share one array
/// in the order of the refined mesh, with normals; positions are single precision about the centre
/// of the bounding box, which is the translation of the root node.
std::string write_refined_glb(const RefinedMesh& refined);

}  // namespace layout_embedding
