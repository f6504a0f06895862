#pragma once

#include <string>

#include "embedding/refined_mesh.hh"

namespace layout_embedding {

/// `refined` as binary PLY (little-endian, positions in double precision): per face the integer
/// property `patch`, its layout face or -1, and a colour; the chains as the element `edge` with
/// vertex1, vertex2 and `layout_edge`.
std::string write_refined_ply(const RefinedMesh& refined);

}  // namespace layout_embedding
