#pragma once

#include <vector>

#include "base/types.hh"
#include "embedding/refined_mesh.hh"
#include "layout/layout.hh"

namespace layout_embedding {

/// Size and roundness of a patch on the surface, in the target's units.
struct PatchShape {
    double area = 0;
    /// Summed over its sides; a chain with the patch on both sides counts twice.
    double perimeter = 0;

    /// Isoperimetric quotient: 4 pi area / perimeter^2, 1 for a flat disk, near 0 for a thin patch.
    double quotient() const;
};

/// Of all patches of an embedding, by layout face. O(#triangles).
std::vector<PatchShape> patch_shapes(const Layout& layout, const RefinedMesh& refined);

/// The length of a chain of refined vertices.
double chain_length(const RefinedMesh& refined, const std::vector<Index>& chain);

}  // namespace layout_embedding
