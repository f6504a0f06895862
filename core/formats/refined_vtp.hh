#pragma once

#include <string>

#include "embedding/refined_mesh.hh"

namespace layout_embedding {

/// `refined` as VTK PolyData (.vtp, XML text), with positions that read back as the same doubles:
/// chains as lines, in the order of the layout's edges, and triangles as polygons. Cell data, lines
/// first: `patch` (layout face), `layout_edge` and `target_face`; -1 where a cell has none.
std::string write_refined_vtp(const RefinedMesh& refined);

}  // namespace layout_embedding
