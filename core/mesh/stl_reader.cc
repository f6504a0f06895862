#include "mesh/stl_reader.hh"

#include <string>

#include "base/bytes.hh"
#include "base/line_scanner.hh"
#include "mesh/seams.hh"

namespace layout_embedding {
namespace {

constexpr std::size_t kHeaderSize = 84;
constexpr std::size_t kTriangleSize = 50;

void add_triangle(PolygonMesh& mesh)
{
    const Index first = mesh.vertex_count() - 3;
    mesh.add_face(std::array<Index, 3>{first, first + 1, first + 2});
}

PolygonMesh read_binary(std::string_view bytes)
{
    PolygonMesh mesh;
    const auto count = value_of_bytes<std::uint32_t>(bytes.substr(kHeaderSize - 4));
    mesh.positions.reserve(std::size_t{3} * count);
    mesh.corners.reserve(std::size_t{3} * count);
    mesh.face_offsets.reserve(std::size_t{count} + 1);
    for (std::size_t i = 0; i < count; ++i) {
        const std::string_view triangle = bytes.substr(kHeaderSize + i * kTriangleSize);
        for (std::size_t corner = 0; corner < 3; ++corner) {
            Vec3 position;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                position[static_cast<int>(axis)] = static_cast<double>(
                    value_of_bytes<float>(triangle.substr(12 + 12 * corner + 4 * axis)));
            }
            mesh.positions.push_back(position);
        }
        add_triangle(mesh);
    }
    return mesh;
}

Result<PolygonMesh> read_text(std::string_view bytes, const std::string& subject)
{
    PolygonMesh mesh;
    LineScanner lines(bytes);
    Index corners = 0;
    const auto fail = [&](const std::string& what) {
        return make_error(ErrorCode::syntaxError,
                          subject + " has " + what + " in line " + std::to_string(lines.number()),
                          {{"line", lines.number()}});
    };
    while (lines.next()) {
        std::string_view line = without_leading_blanks(lines.line());
        const std::string_view keyword = take_token(line);
        if (keyword == "vertex") {
            Vec3 position;
            for (int axis = 0; axis < 3; ++axis) {
                if (!take_number(line, position[axis])) {
                    return fail("a vertex without three numbers");
                }
            }
            if (++corners > 3) {
                return fail("a facet with more than three vertices");
            }
            mesh.positions.push_back(position);
        } else if (keyword == "endloop") {
            if (corners != 3) {
                return fail("the end of a facet with fewer than three vertices");
            }
            corners = 0;
            add_triangle(mesh);
        } else if (!keyword.empty() && keyword != "facet" && keyword != "outer" &&
                   keyword != "endfacet" && keyword != "solid" && keyword != "endsolid") {
            return fail("a line that is no part of STL");
        }
    }
    if (corners != 0) {
        return fail("an unfinished facet");
    }
    return mesh;
}

}  // namespace

bool is_binary_stl(std::string_view bytes)
{
    return bytes.size() >= kHeaderSize && (bytes.size() - kHeaderSize) % kTriangleSize == 0 &&
           (bytes.size() - kHeaderSize) / kTriangleSize ==
               value_of_bytes<std::uint32_t>(bytes.substr(kHeaderSize - 4));
}

Result<PolygonMesh> read_stl(std::string_view bytes, std::string_view subject)
{
    const std::string name(subject);
    if (bytes.size() / kTriangleSize >= kNone / 3) {
        return make_error(ErrorCode::tooLarge,
                          name + " has more triangles than 32-bit ids can number");
    }
    if (is_binary_stl(bytes)) {
        return without_seams(read_binary(bytes));
    }
    LineScanner start(bytes);
    std::string_view line = start.next() ? start.line() : std::string_view();
    if (take_token(line) != "solid") {
        return make_error(ErrorCode::syntaxError,
                          name + " is neither text STL nor as long as its count of triangles says");
    }
    const Result<PolygonMesh> soup = read_text(bytes, name);
    if (!soup) {
        return soup.error();
    }
    return without_seams(*soup);
}

}  // namespace layout_embedding
