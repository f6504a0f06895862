#pragma once

#include <string_view>

#include "base/result.hh"
#include "mesh/mesh_attributes.hh"
#include "mesh/polygon_mesh.hh"

namespace layout_embedding {

/// Reads PLY 1.0, as text or in either order of bytes: x, y and z of the element `vertex`, and the
/// list `vertex_indices` (or `vertex_index`) of the element `face`, each of any of the format's
/// types; all other properties and elements are skipped. Nothing is triangulated or merged. Numbers
/// in text are correctly rounded, the same on every platform.
///
/// Where `attributes` is not null, it is filled with colours of vertices (red, green, blue, and
/// alpha; whole numbers up to 255, 65535 in 16 bits, or fractions up to 1), texture coordinates
/// (lists `texcoord` of faces as MeshLab writes them, else u and v, s and t, or the like, of
/// vertices), as groups with whole numbers and colours of faces (`label_3`, `colour_ff8000`), and
/// as materials with textures (`comment TextureFile`, `texnumber`).
///
/// `subject` begins the messages. Errors, with the line in the header and the element behind it:
/// unknownFormat (another version, triangle strips), syntaxError, indexOutOfRange, faceTooLarge
/// (over 255 corners), tooLarge. Linear in the bytes.
Result<PolygonMesh> read_ply(std::string_view bytes, std::string_view subject,
                             MeshAttributes* attributes = nullptr);

}  // namespace layout_embedding
