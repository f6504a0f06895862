#pragma once

#include <string_view>

#include "base/result.hh"
#include "mesh/polygon_mesh.hh"

namespace layout_embedding {

/// Reads PLY 1.0, as text or in either order of bytes: x, y and z of the element `vertex`, and the
/// list `vertex_indices` (or `vertex_index`) of the element `face`, each of any of the format's
/// types; all other properties and elements are skipped. Nothing is triangulated or merged. Numbers
/// in text are correctly rounded, the same on every platform.
///
/// `subject` begins the messages. Errors, with the line in the header and the element behind it:
/// unknownFormat (another version, triangle strips), syntaxError, indexOutOfRange, faceTooLarge
/// (over 255 corners), tooLarge. Linear in the bytes.
Result<PolygonMesh> read_ply(std::string_view bytes, std::string_view subject);

}  // namespace layout_embedding
