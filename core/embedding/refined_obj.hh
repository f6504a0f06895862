#pragma once

#include <string>

#include "embedding/refined_mesh.hh"
#include "mesh/mesh_attributes.hh"

namespace layout_embedding {

/// `refined` as Wavefront OBJ: patches as groups `patch_<layout face>`, faces outside all patches
/// as group `outside`, layout edges as `l` lines in the order of the layout's edges. Vertices and
/// triangles keep their order; read_obj() gives back the same doubles. `attributes` of the refined
/// mesh are written as in mesh/mesh_writer.hh: groups behind the patch of a face.
std::string write_refined_obj(const RefinedMesh& refined, const MeshAttributes& attributes = {});

}  // namespace layout_embedding
