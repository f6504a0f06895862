#pragma once

#include <string>

#include "embedding/refined_mesh.hh"
#include "mesh/mesh_attributes.hh"

namespace layout_embedding {

/// `refined` as binary PLY (little-endian, positions in double precision): per face the integer
/// property `patch`, its layout face or -1, and a colour; the chains as the element `edge` with
/// vertex1, vertex2 and `layout_edge`.
///
/// With `attributes` of the refined mesh: colours of vertices in bytes (the first of several, white
/// for none) instead of the patches' colours; lists `texcoord` of faces in single precision, empty
/// where a corner has none; `group` and `material` of faces, whose names stand in comments, -1 for
/// none.
std::string write_refined_ply(const RefinedMesh& refined, const MeshAttributes& attributes = {});

}  // namespace layout_embedding
