#pragma once

#include <string>

#include "embedding/refined_mesh.hh"
#include "mesh/mesh_attributes.hh"

namespace layout_embedding {

/// `refined` as VTK PolyData (.vtp, XML text), with positions that read back as the same doubles:
/// chains as lines, in the order of the layout's edges, and triangles as polygons. Cell data, lines
/// first: `patch` (layout face), `layout_edge` and `target_face`; -1 where a cell has none.
///
/// With `attributes` of the refined mesh: point data `colour` (the first of several, white for
/// none), cell data `texture_coordinates` (u and v of three corners, 0 for none), and the numbers
/// of `group` and `material`, -1 for none.
std::string write_refined_vtp(const RefinedMesh& refined, const MeshAttributes& attributes = {});

}  // namespace layout_embedding
