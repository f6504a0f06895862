#pragma once

#include <string_view>

#include "base/result.hh"
#include "mesh/polygon_mesh.hh"

namespace layout_embedding {

/// Reads Wavefront OBJ: `v` lines (further numbers behind x y z are left aside) and `f` lines, with
/// texture and normal indices left aside, negative indices counting back from the last vertex
/// read, and `\` at the end of a line continuing it. All other lines (normals, groups, materials,
/// lines, curves) are skipped. Nothing is triangulated or merged. Positions are correctly rounded,
/// the same on every platform.
///
/// `subject` begins the messages. Errors, with the line: syntaxError, indexOutOfRange,
/// faceTooLarge (over 255 corners), tooLarge. Linear in the bytes.
Result<PolygonMesh> read_obj(std::string_view bytes, std::string_view subject);

}  // namespace layout_embedding
