#pragma once

#include <string_view>

#include "base/result.hh"
#include "mesh/mesh_attributes.hh"
#include "mesh/polygon_mesh.hh"

namespace layout_embedding {

enum class MeshFormat {
    /// Look at the content.
    detect,
    obj,
    off,
    ply,
    stl,
    glb,
};

/// The format that the extension of a file name stands for (.obj, .off, .ply, .stl,
/// .glb, in any case), else detect.
MeshFormat format_of_file_name(std::string_view name);

/// Reads a mesh from the bytes of a file: positions and polygons, exactly as they stand there
/// (check_surface() in mesh/validation.hh looks at their meaning). Where `attributes` is not null,
/// it is filled with what else the file says of vertices and faces; the mesh is the same. `subject`
/// begins the messages, for example "the target spot.obj". Errors: fileEmpty (nothing but blanks),
/// unknownFormat (the content is of no known format, or not of the one asked for), and those of
/// read_obj(), read_off(), read_ply(), read_stl() and read_glb(). Near-linear in the bytes.
Result<PolygonMesh> read_mesh(std::string_view bytes, MeshFormat format, std::string_view subject,
                              MeshAttributes* attributes = nullptr);

}  // namespace layout_embedding
