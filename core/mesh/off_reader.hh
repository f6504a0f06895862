#pragma once

#include <string_view>

#include "base/result.hh"
#include "mesh/mesh_attributes.hh"
#include "mesh/polygon_mesh.hh"

namespace layout_embedding {

/// Reads ASCII OFF: an optional header word (OFF, or COFF, NOFF, STOFF and their combinations),
/// the counts of vertices, faces
/// and edges, then one line per vertex and one per face. `#` starts a comment. Nothing is
/// triangulated or merged. Positions are correctly rounded, the same on every platform.
///
/// Where `attributes` is not null, it is filled with the colours of vertices (C, three or four
/// numbers from 0 to 1, or to 255 where one is above 1), their texture coordinates (ST, behind the
/// colour), and as groups with the colours of faces, that stand behind their corners.
///
/// `subject` begins the messages. Errors, with the line: unknownFormat (4D, nD or binary OFF),
/// syntaxError, indexOutOfRange, faceTooLarge (over 255 corners), tooLarge. Linear in the bytes.
Result<PolygonMesh> read_off(std::string_view bytes, std::string_view subject,
                             MeshAttributes* attributes = nullptr);

}  // namespace layout_embedding
