#pragma once

#include <string_view>

#include "base/result.hh"
#include "mesh/polygon_mesh.hh"

namespace layout_embedding {

/// Reads ASCII OFF: an optional header word (OFF, or COFF, NOFF, STOFF and their combinations,
/// whose colours, normals and texture coordinates are left aside), the counts of vertices, faces
/// and edges, then one line per vertex and one per face. `#` starts a comment. Nothing is
/// triangulated or merged. Positions are correctly rounded, the same on every platform.
///
/// `subject` begins the messages. Errors, with the line: unknownFormat (4D, nD or binary OFF),
/// syntaxError, indexOutOfRange, faceTooLarge (over 255 corners), tooLarge. Linear in the bytes.
Result<PolygonMesh> read_off(std::string_view bytes, std::string_view subject);

}  // namespace layout_embedding
