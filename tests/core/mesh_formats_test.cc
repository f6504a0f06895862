#include <gtest/gtest.h>

#include "base/bytes.hh"
#include "base/json.hh"
#include "mesh/mesh_reader.hh"
#include "mesh/validation.hh"
#include "zoo.hh"

// PLY, STL and GLB files, written here by hand: the readers share no code with them.

namespace layout_embedding {
namespace {

template <typename T>
void append_swapped(std::string& bytes, T value)
{
    std::string plain;
    append_bytes(plain, value);
    bytes.append(plain.rbegin(), plain.rend());
}

std::string text_ply(const PolygonMesh& mesh)
{
    std::string ply = "ply\nformat ascii 1.0\ncomment by hand\nelement vertex " +
                      std::to_string(mesh.vertex_count()) +
                      "\nproperty double x\nproperty double y\nproperty double z\n"
                      "property uchar red\nelement face " +
                      std::to_string(mesh.face_count()) +
                      "\nproperty float quality\nproperty list uchar int vertex_indices\n"
                      "end_header\n";
    for (const Vec3& p : mesh.positions) {
        for (int i = 0; i < 3; ++i) {
            char digits[40];
            std::snprintf(digits, sizeof digits, "%.17g ", p[i]);
            ply += digits;
        }
        ply += "255\n";
    }
    for (Index f = 0; f < mesh.face_count(); ++f) {
        ply += "0.5 " + std::to_string(mesh.face(f).size());
        for (const Index v : mesh.face(f)) {
            ply += " " + std::to_string(v);
        }
        ply += "\n";
    }
    return ply;
}

std::string big_endian_ply(const PolygonMesh& mesh)
{
    // Faces before vertices, and other types.
    std::string ply = "ply\r\nformat binary_big_endian 1.0\r\nelement face " +
                      std::to_string(mesh.face_count()) +
                      "\r\nproperty list uint16 uint32 vertex_index\r\nproperty uchar label\r\n"
                      "element vertex " +
                      std::to_string(mesh.vertex_count()) +
                      "\r\nproperty float64 z\r\nproperty float64 y\r\nproperty float64 x\r\n"
                      "end_header\r\n";
    for (Index f = 0; f < mesh.face_count(); ++f) {
        append_swapped(ply, static_cast<std::uint16_t>(mesh.face(f).size()));
        for (const Index v : mesh.face(f)) {
            append_swapped(ply, v);
        }
        ply += '\1';
    }
    for (const Vec3& p : mesh.positions) {
        append_swapped(ply, p.z());
        append_swapped(ply, p.y());
        append_swapped(ply, p.x());
    }
    return ply;
}

std::string binary_stl(const PolygonMesh& mesh)
{
    std::string stl(80, ' ');
    stl.replace(0, 5, "solid");  // as many programs do
    append_bytes(stl, mesh.face_count());
    for (Index f = 0; f < mesh.face_count(); ++f) {
        stl.append(12, '\0');
        for (const Index v : mesh.face(f)) {
            for (int i = 0; i < 3; ++i) {
                append_bytes(stl, static_cast<float>(mesh.positions[v][i]));
            }
        }
        stl.append(2, '\0');
    }
    return stl;
}

std::string text_stl(const PolygonMesh& mesh)
{
    std::string stl = "solid by hand\n";
    for (Index f = 0; f < mesh.face_count(); ++f) {
        stl += "  facet normal 0 0 1\n    outer loop\n";
        for (const Index v : mesh.face(f)) {
            char line[120];
            std::snprintf(line, sizeof line, "      vertex %.17g %.17g %.17g\n",
                          mesh.positions[v].x(), mesh.positions[v].y(), mesh.positions[v].z());
            stl += line;
        }
        stl += "    endloop\n  endfacet\n";
    }
    return stl + "endsolid\n";
}

std::string glb(const std::string& json, const std::string& binary)
{
    std::string padded = json;
    padded.resize((json.size() + 3) / 4 * 4, ' ');
    std::string bytes = "glTF";
    append_bytes(bytes, std::uint32_t{2});
    append_bytes(bytes, static_cast<std::uint32_t>(28 + padded.size() + binary.size()));
    append_bytes(bytes, static_cast<std::uint32_t>(padded.size()));
    bytes += "JSON" + padded;
    append_bytes(bytes, static_cast<std::uint32_t>(binary.size()));
    bytes += std::string("BIN\0", 4) + binary;
    return bytes;
}

/// A mesh as GLB, with vertices of its own for every face, under a node with `node` in it.
std::string glb_of(const PolygonMesh& mesh, const std::string& node)
{
    std::string binary;
    for (const Index corner : mesh.corners) {
        for (int i = 0; i < 3; ++i) {
            append_bytes(binary, static_cast<float>(mesh.positions[corner][i]));
        }
    }
    const std::string count = std::to_string(mesh.corners.size());
    return glb(R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[1]}],"nodes":[{"mesh":0},)"
               R"({"children":[0])" +
                   node +
                   R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
                   R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":)" +
                   count + R"(}],"bufferViews":[{"buffer":0,"byteLength":)" +
                   std::to_string(binary.size()) + R"(}],"buffers":[{"byteLength":)" +
                   std::to_string(binary.size()) + "}]}",
               binary);
}

/// Fails the test unless both are the same surface: positions of the corners, face by face.
void expect_same_surface(const Result<PolygonMesh>& read, const PolygonMesh& mesh, double tolerance)
{
    ASSERT_TRUE(read.ok()) << read.error().message;
    ASSERT_EQ(read->face_offsets, mesh.face_offsets);
    EXPECT_EQ(read->vertex_count(), mesh.vertex_count());
    for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
        EXPECT_LE((read->positions[read->corners[i]] - mesh.positions[mesh.corners[i]]).norm(),
                  tolerance);
    }
}

TEST(MeshFormats, ply_reads_back_whatever_its_encoding)
{
    for (const zoo::NamedMesh& named : zoo::layouts()) {
        SCOPED_TRACE(named.name);
        for (const std::string& bytes : {text_ply(named.mesh), big_endian_ply(named.mesh)}) {
            for (const MeshFormat format : {MeshFormat::detect, MeshFormat::ply}) {
                const auto read = read_mesh(bytes, format, "it");
                ASSERT_TRUE(read.ok()) << read.error().message;
                EXPECT_EQ(read->positions, named.mesh.positions);
                EXPECT_EQ(read->face_offsets, named.mesh.face_offsets);
                EXPECT_EQ(read->corners, named.mesh.corners);
            }
        }
    }
}

TEST(MeshFormats, stl_becomes_a_surface)
{
    for (const zoo::NamedMesh& named : zoo::targets()) {
        SCOPED_TRACE(named.name);
        expect_same_surface(read_mesh(text_stl(named.mesh), MeshFormat::detect, "it"), named.mesh,
                            0);
        const auto read = read_mesh(binary_stl(named.mesh), MeshFormat::detect, "it");
        expect_same_surface(read, named.mesh, 1e-5);
        EXPECT_TRUE(check_surface(*read, SurfaceKind::target, "it").ok());
    }
}

TEST(MeshFormats, glb_becomes_a_surface_where_its_nodes_put_it)
{
    for (const zoo::NamedMesh& named : zoo::targets()) {
        SCOPED_TRACE(named.name);
        expect_same_surface(read_mesh(glb_of(named.mesh, ""), MeshFormat::detect, "it"), named.mesh,
                            1e-5);
    }
    const PolygonMesh mesh = zoo::tetrahedron();
    PolygonMesh moved = mesh;
    for (Vec3& p : moved.positions) {
        p = Vec3(1 - 2 * p.y(), 2 + 2 * p.x(), 3 + 2 * p.z());  // a quarter turn about z
    }
    expect_same_surface(
        read_mesh(glb_of(mesh, R"(,"translation":[1,2,3],"scale":[2,2,2],)"
                               R"("rotation":[0,0,0.7071067811865476,0.7071067811865476])"),
                  MeshFormat::glb, "it"),
        moved, 1e-6);
    // A mirror keeps the outside outside.
    const auto mirrored = read_mesh(glb_of(mesh, R"(,"matrix":[-1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1])"),
                                    MeshFormat::glb, "it");
    ASSERT_TRUE(mirrored.ok());
    double volume = 0;
    for (Index f = 0; f < mirrored->face_count(); ++f) {
        const auto c = mirrored->face(f);
        volume += mirrored->positions[c[0]].dot(
            mirrored->positions[c[1]].cross(mirrored->positions[c[2]]));
    }
    EXPECT_GT(volume, 0);
}

TEST(MeshFormats, glb_strips_and_fans_are_triangles)
{
    std::string binary;
    for (const auto& [x, y] : {std::pair{0.0F, 0.0F}, {1.0F, 0.0F}, {0.0F, 1.0F}, {1.0F, 1.0F}}) {
        for (const float value : {x, y, 0.0F}) {
            append_bytes(binary, value);
        }
    }
    for (const std::uint8_t index : {0, 1, 2, 3, 0, 1, 3, 2}) {
        append_bytes(binary, index);
    }
    const auto bytes = [&](int mode, int offset) {
        return glb(R"({"meshes":[{"primitives":[{"mode":)" + std::to_string(mode) +
                       R"(,"attributes":{"POSITION":0},"indices":1}]}],"accessors":[)"
                       R"({"bufferView":0,"componentType":5126,"type":"VEC3","count":4},)"
                       R"({"bufferView":1,"byteOffset":)" +
                       std::to_string(offset) +
                       R"(,"componentType":5121,"type":"SCALAR","count":4}],"bufferViews":)"
                       R"([{"buffer":0,"byteLength":48},)"
                       R"({"buffer":0,"byteOffset":48,"byteLength":8}],"buffers":[{}]})",
                   binary);
    };
    for (const auto& [mode, offset] : {std::pair{5, 0}, {6, 4}}) {
        const auto mesh = read_mesh(bytes(mode, offset), MeshFormat::glb, "it");
        ASSERT_TRUE(mesh.ok()) << mesh.error().message;
        EXPECT_EQ(mesh->face_count(), 2U);
        EXPECT_EQ(mesh->vertex_count(), 4U);
        for (Index f = 0; f < 2; ++f) {
            const auto c = mesh->face(f);
            const Vec3& a = mesh->positions[c[0]];
            EXPECT_GT((mesh->positions[c[1]] - a).cross(mesh->positions[c[2]] - a).z(), 0);
        }
    }
}

ErrorCode code_of(const std::string& bytes, MeshFormat format = MeshFormat::detect)
{
    const auto mesh = read_mesh(bytes, format, "it");
    return mesh.ok() ? ErrorCode::none : mesh.error().code;
}

TEST(MeshFormats, what_is_damaged_is_refused)
{
    const PolygonMesh mesh = zoo::tetrahedron();
    const std::vector<std::string> whole{text_ply(mesh), big_endian_ply(mesh), text_stl(mesh),
                                         glb_of(mesh, "")};
    for (const std::string& bytes : whole) {
        ASSERT_EQ(code_of(bytes), ErrorCode::none);
        for (std::size_t size = 0; size < bytes.size(); size += 7) {
            if (bytes.compare(0, 5, "solid") == 0) {
                code_of(bytes.substr(0, size));  // text may end between two triangles
            } else if (size + 16 < bytes.size()) {
                EXPECT_NE(code_of(bytes.substr(0, size)), ErrorCode::none) << size;
            }
        }
    }
    const std::string head = "ply\nformat ascii 1.0\n";
    const std::string vertices =
        "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
    const std::string faces = "element face 1\nproperty list uchar int vertex_indices\n";
    const std::string end = "end_header\n";
    EXPECT_EQ(code_of("ply\nformat ascii 2.0\n" + end), ErrorCode::unknownFormat);
    EXPECT_EQ(code_of(head), ErrorCode::syntaxError);
    EXPECT_EQ(code_of(head + "element vertex -1\n" + end), ErrorCode::syntaxError);
    EXPECT_EQ(code_of(head + "element vertex 99999999999\n" + end), ErrorCode::tooLarge);
    EXPECT_EQ(code_of(head + "property float x\n" + end), ErrorCode::syntaxError);
    EXPECT_EQ(code_of(head + "element vertex 1\nproperty float x\n" + end + "0\n"),
              ErrorCode::syntaxError);
    EXPECT_EQ(code_of(head + vertices + faces + end + "0 0 0\n3 0 0 1\n"),
              ErrorCode::indexOutOfRange);
    EXPECT_EQ(code_of(head + vertices + faces + end + "0 0 x\n3 0 0 0\n"), ErrorCode::syntaxError);
    EXPECT_EQ(code_of(head + vertices + "element face 1\nproperty list int int vertex_indices\n" +
                      end + "0 0 0\n256 0\n"),
              ErrorCode::faceTooLarge);
    EXPECT_EQ(code_of("solid\nfacet\nouter loop\nvertex 0 0\n"), ErrorCode::syntaxError);
    EXPECT_EQ(code_of("solid\nfacet\nouter loop\nvertex 0 0 0\nendloop\n"), ErrorCode::syntaxError);
    EXPECT_EQ(code_of("v 0 0 0\n", MeshFormat::stl), ErrorCode::unknownFormat);
    EXPECT_EQ(code_of(glb("{", "")), ErrorCode::syntaxError);
    EXPECT_EQ(code_of(glb(R"({"scenes":[{"nodes":[0]}]})", "")), ErrorCode::syntaxError);
    EXPECT_EQ(code_of(glb(R"({"scenes":[{"nodes":[0]}],"nodes":[{"children":[0]}]})", "")),
              ErrorCode::syntaxError);
    EXPECT_EQ(code_of(glb(R"({"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
                          R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3",)"
                          R"("count":3}],"bufferViews":[{"buffer":0,"byteLength":36}],)"
                          R"("buffers":[{}]})",
                          std::string(24, '\0'))),
              ErrorCode::syntaxError);
    EXPECT_EQ(code_of(glb(R"({"meshes":[{"primitives":[{"attributes":{"POSITION":0},)"
                          R"("extensions":{"KHR_draco_mesh_compression":{}}}]}]})",
                          "")),
              ErrorCode::unknownFormat);
}

TEST(MeshFormats, vertices_that_a_header_only_announces_do_not_exist)
{
    const std::string faces =
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    EXPECT_EQ(code_of("ply\nformat ascii 1.0\nelement vertex 3\n" + faces + "3 0 1 2\n"),
              ErrorCode::syntaxError);
    EXPECT_EQ(code_of("ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\n"
                      "property float y\nproperty float z\n" +
                      faces + "0 0 0\n3 0 0 0\n"),
              ErrorCode::syntaxError);
    // An array without elements may lie anywhere.
    EXPECT_EQ(code_of(glb(R"({"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
                          R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3",)"
                          R"("byteOffset":4000000000,"count":0}],)"
                          R"("bufferViews":[{"buffer":0,"byteLength":4}],"buffers":[{}]})",
                          std::string(4, '\0'))),
              ErrorCode::none);
    // Ten thousand nodes with one mesh of a thousand vertices.
    std::string nodes;
    std::string ids;
    for (int node = 0; node < 10000; ++node) {
        nodes += node == 0 ? R"({"mesh":0})" : R"(,{"mesh":0})";
        ids += (node == 0 ? "" : ",") + std::to_string(node);
    }
    EXPECT_EQ(code_of(glb(R"({"scenes":[{"nodes":[)" + ids + R"(]}],"nodes":[)" + nodes +
                              R"(],"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
                              R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3",)"
                              R"("count":1000}],"bufferViews":[{"buffer":0,"byteLength":12000}],)"
                              R"("buffers":[{}]})",
                          std::string(12000, '\0'))),
              ErrorCode::tooLarge);
}

TEST(MeshFormats, extensions_are_known_in_any_case)
{
    EXPECT_EQ(format_of_file_name("a.PLY"), MeshFormat::ply);
    EXPECT_EQ(format_of_file_name("b.Stl"), MeshFormat::stl);
    EXPECT_EQ(format_of_file_name("c.glb"), MeshFormat::glb);
    EXPECT_EQ(format_of_file_name("d.gltf"), MeshFormat::detect);
}

TEST(Json, values_are_read_as_they_stand)
{
    const auto value = parse_json(
        R"( {"a": [1, -2.5e3, true, false, null], "b": "x\"\\\/\n\u00e9\ud83d\ude00", "c": {}} )",
        "it");
    ASSERT_TRUE(value.ok()) << value.error().message;
    const JsonValue& list = *value->find("a");
    ASSERT_EQ(list.items.size(), 5U);
    EXPECT_EQ(list.items[1].number, -2500);
    EXPECT_TRUE(list.items[2].boolean);
    EXPECT_TRUE(list.items[4].is(JsonValue::Kind::null));
    EXPECT_EQ(value->find("b")->string, "x\"\\/\n\xC3\xA9\xF0\x9F\x98\x80");
    EXPECT_TRUE(value->find("c")->is(JsonValue::Kind::object));
    EXPECT_EQ(value->find("d"), nullptr);
    std::string again;
    append_json_string(again, "x\"\\\n\x01");
    EXPECT_EQ(parse_json(again, "it")->string, "x\"\\\n\x01");
}

TEST(Json, anything_else_is_refused_with_its_line)
{
    for (const std::string text :
         {"", "[1,]", "{\"a\" 1}", "{a:1}", "[1 2]", "\"a", "nul", "+1", "[", "{\"a\":1,}", "-nan",
          "-inf", "\"\\x\"", "\"\\ud800\\u0041\"", "1 2", "\"\t\""}) {
        const auto value = parse_json(text, "it");
        ASSERT_FALSE(value.ok()) << text;
        EXPECT_EQ(value.error().code, ErrorCode::syntaxError);
    }
    EXPECT_EQ(parse_json("[1,\n2,\nx]", "it").error().details[0].second, 3);
    EXPECT_FALSE(parse_json(std::string(100000, '['), "it").ok());
}

}  // namespace
}  // namespace layout_embedding
