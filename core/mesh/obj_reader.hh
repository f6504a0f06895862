#pragma once

#include <string_view>

#include "base/result.hh"
#include "mesh/mesh_attributes.hh"
#include "mesh/polygon_mesh.hh"

namespace layout_embedding {

/// Reads Wavefront OBJ: `v` lines and `f` lines, negative indices counting back from the last
/// vertex read, and `\` at the end of a line continuing it. All other lines (normals, lines,
/// curves) are skipped. Nothing is triangulated or merged. Positions are correctly rounded, the
/// same on every platform.
///
/// Where `attributes` is not null, it is filled with texture coordinates (`vt`, whose indices may
/// count back), colours of vertices (`v x y z r g b`), groups (`g`) and materials (`usemtl`,
/// `mtllib`).
///
/// `subject` begins the messages. Errors, with the line: syntaxError, indexOutOfRange,
/// faceTooLarge (over 255 corners), tooLarge. Linear in the bytes.
Result<PolygonMesh> read_obj(std::string_view bytes, std::string_view subject,
                             MeshAttributes* attributes = nullptr);

}  // namespace layout_embedding
