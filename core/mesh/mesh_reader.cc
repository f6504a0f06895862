#include "mesh/mesh_reader.hh"

#include <string>

#include "base/line_scanner.hh"
#include "mesh/obj_reader.hh"
#include "mesh/off_reader.hh"

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

/// OFF if the first line that says something begins with an OFF header, OBJ if any line begins
/// with a vertex or a face.
MeshFormat format_of_content(std::string_view bytes)
{
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
    if (has_extension(name, ".obj")) {
        return MeshFormat::obj;
    }
    return has_extension(name, ".off") ? MeshFormat::off : MeshFormat::detect;
}

Result<PolygonMesh> read_mesh(std::string_view bytes, MeshFormat format, std::string_view subject)
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
                              " is neither OBJ nor OFF: no line of it is a "
                              "vertex, a face or an OFF header");
    }
    if (format != MeshFormat::detect && format != content) {
        return make_error(ErrorCode::unknownFormat,
                          std::string(subject) + (format == MeshFormat::obj
                                                      ? " is called OBJ but holds OFF"
                                                      : " is called OFF but has no OFF header"));
    }
    return content == MeshFormat::off ? read_off(bytes, subject) : read_obj(bytes, subject);
}

}  // namespace layout_embedding
