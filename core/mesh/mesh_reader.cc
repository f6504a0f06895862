#include "mesh/mesh_reader.hh"

#include <string>

#include "base/line_scanner.hh"
#include "mesh/glb_reader.hh"
#include "mesh/obj_reader.hh"
#include "mesh/off_reader.hh"
#include "mesh/ply_reader.hh"
#include "mesh/stl_reader.hh"

namespace layout_embedding {
namespace {

bool has_extension(std::string_view name, std::string_view extension)
{
    if (name.size() < extension.size()) {
        return false;
    }
    name.remove_prefix(name.size() - extension.size());
    for (std::size_t i = 0; i < name.size(); ++i) {
        const char c = name[i];
        if ((c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c) != extension[i]) {
            return false;
        }
    }
    return true;
}

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

constexpr std::string_view kGlbMagic = "glTF";

/// How the name of a format is written.
std::string name_of(MeshFormat format)
{
    switch (format) {
        case MeshFormat::obj:
            return "OBJ";
        case MeshFormat::off:
            return "OFF";
        case MeshFormat::ply:
            return "PLY";
        case MeshFormat::stl:
            return "STL";
        case MeshFormat::glb:
            return "GLB";
        default:
            return "a mesh";
    }
}

/// GLB by its first bytes; binary STL by its length; PLY, text STL and OFF if the first line that
/// says something begins with their word; OBJ if any line begins with a vertex or a face.
MeshFormat format_of_content(std::string_view bytes)
{
    if (bytes.substr(0, kGlbMagic.size()) == kGlbMagic) {
        return MeshFormat::glb;
    }
    if (is_binary_stl(bytes)) {
        return MeshFormat::stl;
    }
    LineScanner lines(bytes);
    bool first = true;
    while (lines.next()) {
        std::string_view line = without_comment(lines.line());
        const std::string_view keyword = take_token(line);
        if (keyword.empty()) {
            continue;
        }
        if (first && keyword.size() >= 3 && keyword.substr(keyword.size() - 3) == "OFF") {
            return MeshFormat::off;
        }
        if (first && (keyword == "ply" || keyword == "solid")) {
            return keyword == "ply" ? MeshFormat::ply : MeshFormat::stl;
        }
        first = false;
        if (keyword == "v" || keyword == "f") {
            return MeshFormat::obj;
        }
    }
    return MeshFormat::detect;
}

}  // namespace

MeshFormat format_of_file_name(std::string_view name)
{
    using enum MeshFormat;
    for (const auto& [extension, format] : {std::pair<std::string_view, MeshFormat>{".obj", obj},
                                            {".off", off},
                                            {".ply", ply},
                                            {".stl", stl},
                                            {".glb", glb}}) {
        if (has_extension(name, extension)) {
            return format;
        }
    }
    return detect;
}

Result<PolygonMesh> read_mesh(std::string_view bytes, MeshFormat format, std::string_view subject,
                              MeshAttributes* attributes)
{
    if (bytes.substr(0, kByteOrderMark.size()) == kByteOrderMark) {
        bytes.remove_prefix(kByteOrderMark.size());
    }
    if (bytes.find_first_not_of(" \t\r\n") == std::string_view::npos) {
        return make_error(ErrorCode::fileEmpty, std::string(subject) + " holds nothing");
    }
    const MeshFormat content = format_of_content(bytes);
    if (content == MeshFormat::detect) {
        return make_error(ErrorCode::unknownFormat,
                          std::string(subject) +
                              " is neither OBJ, OFF, PLY, STL nor GLB: no line of it is a "
                              "vertex, a face or a header");
    }
    if (format != MeshFormat::detect && format != content) {
        return make_error(ErrorCode::unknownFormat, std::string(subject) + " is called " +
                                                        name_of(format) + " but holds " +
                                                        name_of(content));
    }
    switch (content) {
        case MeshFormat::off:
            return read_off(bytes, subject, attributes);
        case MeshFormat::ply:
            return read_ply(bytes, subject, attributes);
        case MeshFormat::stl:
            return read_stl(bytes, subject);
        case MeshFormat::glb:
            return read_glb(bytes, subject, attributes);
        default:
            return read_obj(bytes, subject, attributes);
    }
}

}  // namespace layout_embedding
