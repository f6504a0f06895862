#pragma once

#include <string_view>

#include "base/result.hh"
#include "mesh/polygon_mesh.hh"

namespace layout_embedding {

/// Reads binary glTF 2.0 (GLB): the triangles (lists, strips and fans) of all meshes of its scene,
/// placed by their nodes and put together; other primitives, materials and everything else are
/// skipped. Vertices that are apart only for the sake of normals or texture coordinates become one
/// (without_seams() in mesh/seams.hh). Positions are single precision in the file, and turned by
/// nodes in double precision.
///
/// `subject` begins the messages. Errors: unknownFormat (another version, compressed, sparse or
/// external data), syntaxError (a structure that makes no sense), indexOutOfRange, tooLarge (parts
/// used so often that there are more vertices or triangles than bytes, and over a million).
/// Near-linear in the bytes.
Result<PolygonMesh> read_glb(std::string_view bytes, std::string_view subject);

}  // namespace layout_embedding
