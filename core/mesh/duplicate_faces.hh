#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/types.hh"
#include "mesh/polygon_mesh.hh"

namespace layout_embedding {

/// The faces with the same corners as an earlier one, in the same cyclic order or in its reverse:
/// pairs of the first such face and the duplicate, sorted by the duplicate. O(#H log #F) for faces
/// of bounded size.
std::vector<std::array<Index, 2>> duplicate_faces(const PolygonMesh& mesh);

/// Whether two faces with the same different corners, up to reversal, run the same way around.
bool same_direction(std::span<const Index> a, std::span<const Index> b);

}  // namespace layout_embedding
