#pragma once

#include <string_view>

#include "base/result.hh"
#include "mesh/polygon_mesh.hh"

namespace layout_embedding {

/// Whether `bytes` are binary STL: their number is what the count of triangles in them says.
bool is_binary_stl(std::string_view bytes);

/// Reads STL, as text or binary. Its triangles share no vertices, so equal positions along common
/// edges become one (without_seams() in mesh/seams.hh); vertices are numbered in the order in which
/// they first appear. Normals and attributes are skipped.
///
/// `subject` begins the messages. Errors: syntaxError (with the line in text), tooLarge.
/// Near-linear in the bytes.
Result<PolygonMesh> read_stl(std::string_view bytes, std::string_view subject);

}  // namespace layout_embedding
