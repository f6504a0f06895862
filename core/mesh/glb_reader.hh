#pragma once

#include <string_view>

#include "base/result.hh"
#include "mesh/mesh_attributes.hh"
#include "mesh/polygon_mesh.hh"

namespace layout_embedding {

/// Reads binary glTF 2.0 (GLB): the triangles (lists, strips and fans) of all meshes of its scene,
/// placed by their nodes and put together; other primitives and everything else are skipped.
/// Vertices that are apart only for the sake of normals or texture coordinates become one
/// (without_seams() in mesh/seams.hh). Positions are single precision in the file, and turned by
/// nodes in double precision.
///
/// Where `attributes` is not null, it is filled with TEXCOORD_0 (v turned upwards) and COLOR_0,
/// whatever their components are, as groups with the names of nodes or meshes, and with names of
/// materials. Values stay with the corners of faces where vertices become one. Textures are not
/// read.
///
/// `subject` begins the messages. Errors: unknownFormat (another version, compressed, sparse or
/// external data), syntaxError (a structure that makes no sense), indexOutOfRange, tooLarge (parts
/// used so often that there are more vertices or triangles than bytes, and over a million).
/// Near-linear in the bytes.
Result<PolygonMesh> read_glb(std::string_view bytes, std::string_view subject,
                             MeshAttributes* attributes = nullptr);

}  // namespace layout_embedding
