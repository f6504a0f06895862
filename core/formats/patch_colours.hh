#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "embedding/refined_mesh.hh"

namespace layout_embedding {

/// Red, green, blue.
using Colour = std::array<std::uint8_t, 3>;

/// What patches are painted with: light colours that colour-blind eyes tell apart (after Tol,
/// "Colour schemes", 2021), and last the grey of triangles outside all patches.
const std::vector<Colour>& patch_palette();

/// Per triangle its place in patch_palette(). Patches that share an edge differ wherever eight
/// colours suffice for that in the order of their ids.
std::vector<Index> triangle_colours(const RefinedMesh& refined);

/// The colour of the paths.
inline constexpr Colour kPathColour{34, 34, 34};

}  // namespace layout_embedding
