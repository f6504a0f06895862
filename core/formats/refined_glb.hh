#pragma once

#include <string>

#include "embedding/refined_mesh.hh"
#include "mesh/mesh_attributes.hh"

namespace layout_embedding {

/// `refined` as binary glTF 2.0: a node `patch_<layout face>` for every patch (`outside` for the
/// rest) in one of a few colours that differ between neighbours, a tube `edge_<layout edge>` for
/// every chain, and `landmarks`, balls at the chains' ends. Vertices of all patches share one array
/// in the order of the refined mesh, with normals; positions are single precision about the centre
/// of the bounding box, which is the translation of the root node.
///
/// With `attributes` of the refined mesh: TEXCOORD_0 ((0, 0) of an image's upper left corner for
/// none) and COLOR_0 (white for none, on a white material instead of the patches' colours), in
/// single precision; vertices with several values are there several times, the further ones behind
/// all others.
std::string write_refined_glb(const RefinedMesh& refined, const MeshAttributes& attributes = {});

}  // namespace layout_embedding
