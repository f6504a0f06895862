#pragma once

#include <cstdint>

#include "mesh/polygon_mesh.hh"

namespace layout_embedding::shapes {

/// Moves every vertex of a triangle mesh along its normal by smooth noise and a little
/// uncorrelated noise, like a scanner's: at most `amplitude` times the length of the shortest edge
/// at the vertex. Boundary vertices move as well. The same on every platform.
void add_surface_noise(PolygonMesh& mesh, double amplitude, std::uint64_t seed);

}  // namespace layout_embedding::shapes
