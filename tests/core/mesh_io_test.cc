#include <cmath>
#include <cstring>
#include <gtest/gtest.h>

#include "base/random.hh"
#include "embedding/refined_obj.hh"
#include "mesh/mesh_reader.hh"
#include "mesh/mesh_writer.hh"
#include "mesh/obj_reader.hh"
#include "mesh/off_reader.hh"
#include "test_data.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

void expect_identical(const PolygonMesh& a, const PolygonMesh& b)
{
    ASSERT_EQ(a.positions.size(), b.positions.size());
    for (Index v = 0; v < a.vertex_count(); ++v) {
        EXPECT_EQ(std::memcmp(a.positions[v].data(), b.positions[v].data(), 3 * sizeof(double)), 0)
            << "vertex " << v;
    }
    EXPECT_EQ(a.face_offsets, b.face_offsets);
    EXPECT_EQ(a.corners, b.corners);
}

PolygonMesh read(const std::string& text)
{
    Result<PolygonMesh> mesh = read_mesh(text, MeshFormat::detect, "the mesh");
    EXPECT_TRUE(mesh.ok()) << mesh.error().message;
    return mesh.ok() ? *mesh : PolygonMesh();
}

void expect_error(const std::string& text, ErrorCode code, const std::string& words,
                  MeshFormat format = MeshFormat::detect)
{
    const Result<PolygonMesh> mesh = read_mesh(text, format, "the mesh");
    ASSERT_FALSE(mesh.ok()) << text;
    EXPECT_EQ(error_info(mesh.error().code).name, error_info(code).name) << mesh.error().message;
    EXPECT_NE(mesh.error().message.find(words), std::string::npos) << mesh.error().message;
}

/// Positions with all 53 bits in use, of all sizes.
PolygonMesh with_random_positions(PolygonMesh mesh, std::uint64_t seed)
{
    Random random(seed);
    for (Vec3& p : mesh.positions) {
        for (int i = 0; i < 3; ++i) {
            p[i] = std::ldexp(2 * random.unit() - 1, static_cast<int>(random.below(60)) - 30);
        }
    }
    return mesh;
}

TEST(MeshFiles, written_meshes_read_back_bit_by_bit)
{
    for (const auto& zoo : {zoo::targets(), zoo::layouts()}) {
        for (const auto& [name, mesh] : zoo) {
            SCOPED_TRACE(name);
            expect_identical(read(write_obj(mesh)), mesh);
            expect_identical(read(write_off(mesh)), mesh);
            const PolygonMesh random = with_random_positions(mesh, 1);
            expect_identical(read(write_obj(random)), random);
            expect_identical(read(write_off(random)), random);
        }
    }
}

TEST(MeshFiles, groups_and_chains_do_not_disturb_vertices_and_faces)
{
    RefinedMesh refined;
    const PolygonMesh mesh = with_random_positions(zoo::octahedron(), 2);
    refined.positions = mesh.positions;
    refined.corners = mesh.corners;
    refined.triangle_patches = {0, 0, 1, 1, kNone, kNone, 0, 2};
    refined.chains = {{0, 1, 2}, {2, 5}};
    const std::string text = write_refined_obj(refined);
    expect_identical(read(text), mesh);
    const std::size_t faces = text.find("g patch_0\n");
    EXPECT_EQ(text.substr(faces),
              "g patch_0\nf 1 2 5\nf 2 3 5\ng patch_1\nf 3 4 5\nf 4 1 5\ng outside\nf 2 1 6\n"
              "f 3 2 6\ng patch_0\nf 4 3 6\ng patch_2\nf 1 4 6\ng layout_edges\nl 1 2 3\nl 3 6\n");
}

TEST(ObjReader, takes_the_dialects_it_meets_in_the_wild)
{
    const std::string text =
        "\xEF\xBB\xBF# comment \\\r\n"
        "mtllib some.mtl\r\no thing\ng a b\ng\nusemtl red\ns off\n"
        "  v\t0 0 0 # trailing\n"
        "v 1 0 0 1.0\r\n"
        "v 1 1 0 0.5 0.5 0.5\rv 0 1e0 0\n"
        "vn 0 0 1\nvt 0 0\n"
        "f 1/1/1 2/1/1 3/1/1 4/1/1\n"
        "f -4//1 -3//-1 -2//1 # the same face again\n"
        "f 1/1 2/1 \\\n  3/1\n"
        "f 1 2 5\n"
        "l 1 2\np 1\ncurv2 1 2\n"
        "v 2 2 2";
    const PolygonMesh mesh = read(text);
    ASSERT_EQ(mesh.vertex_count(), 5U);
    EXPECT_EQ(mesh.positions[2], Vec3(1, 1, 0));
    EXPECT_EQ(mesh.positions[4], Vec3(2, 2, 2));
    EXPECT_EQ(mesh.face_offsets, (std::vector<Index>{0, 4, 7, 10, 13}));
    EXPECT_EQ(mesh.corners, (std::vector<Index>{0, 1, 2, 3, 0, 1, 2, 0, 1, 2, 0, 1, 4}));
}

TEST(ObjReader, polygons_stay_polygons_up_to_255_corners)
{
    const PolygonMesh mesh = read(write_obj(zoo::polygon(255)));
    EXPECT_EQ(mesh.face(0).size(), 255U);
    expect_error("v 0 0 0\n" + write_obj(zoo::polygon(256)), ErrorCode::faceTooLarge,
                 "256 corners in line 258");
    expect_error(write_obj(zoo::polygon(3000)), ErrorCode::faceTooLarge, "3000 corners");
    expect_error(write_off(zoo::polygon(256)), ErrorCode::faceTooLarge, "256 corners in line 259");
}

TEST(ObjReader, errors_name_the_line)
{
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n\n";
    expect_error(vertices + "f 1 2 4\n", ErrorCode::indexOutOfRange,
                 "index 4 of 3 vertices in line 5");
    expect_error(vertices + "f 1 2 0\n", ErrorCode::indexOutOfRange, "index 0 in line 5");
    expect_error(vertices + "f 1 2 -4\n", ErrorCode::indexOutOfRange, "index -4 in line 5");
    expect_error(vertices + "f 1 2 99999999999999999999\n", ErrorCode::indexOutOfRange, "line 5");
    expect_error(vertices + "f 1 2 4294967297\n", ErrorCode::indexOutOfRange, "line 5");
    expect_error(vertices + "f 1 2 x\n", ErrorCode::syntaxError, "line 5");
    expect_error(vertices + "f 1 2 3.5\n", ErrorCode::syntaxError, "line 5");
    expect_error(vertices + "f 1 2 /3\n", ErrorCode::syntaxError, "line 5");
    expect_error(vertices + "f 1 2 3/1/1/1\n", ErrorCode::syntaxError, "line 5");
    expect_error(vertices + "f\n", ErrorCode::syntaxError, "line 5");
    expect_error(vertices + "v 1 2\n", ErrorCode::syntaxError, "line 5");
    expect_error(vertices + "v 1 2 three\n", ErrorCode::syntaxError, "line 5");
    expect_error(vertices + "v 1 2 1.#INF\n", ErrorCode::syntaxError, "line 5");
    expect_error("v 0 0 0\r\nf 1 2 3\r\nv x\r\n", ErrorCode::syntaxError, "line 3");
}

TEST(ObjReader, numbers_that_are_none_are_left_to_validation)
{
    const PolygonMesh mesh = read("v nan inf -inf\nv 1e400 0 0\nf 1 2 1\n");
    EXPECT_TRUE(std::isnan(mesh.positions[0].x()));
    EXPECT_TRUE(std::isinf(mesh.positions[0].y()));
    EXPECT_TRUE(std::isinf(mesh.positions[1].x()));
}

TEST(OffReader, takes_headers_counts_and_colours_as_they_come)
{
    const std::string body = "\n# comment\n0 0 0\n1 0 0 # x\n0 1 0\n\n3 0 1 2 255 0 0\n";
    for (const std::string header :
         {"OFF\n3 1 0", "OFF 3 1 0", "3 1 0", "COFF\n3 1 3", "NOFF\n3 1 0", "STOFF\n3 1 0",
          "# first\n\nOFF # second\n3 1"}) {
        const Result<PolygonMesh> mesh = read_off(header + body, "the mesh");
        ASSERT_TRUE(mesh.ok()) << header << ": " << mesh.error().message;
        EXPECT_EQ(mesh->vertex_count(), 3U);
        EXPECT_EQ(mesh->corners, (std::vector<Index>{0, 1, 2}));
    }
}

TEST(OffReader, errors_name_the_line)
{
    expect_error("OFF\n3 1 0\n0 0 0\n1 0 0\n", ErrorCode::syntaxError, "2 of 3 vertices");
    expect_error("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", ErrorCode::syntaxError,
                 "1 of 2 faces");
    expect_error("OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n", ErrorCode::syntaxError, "line 4");
    expect_error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n", ErrorCode::syntaxError, "line 6");
    expect_error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", ErrorCode::indexOutOfRange,
                 "vertex 3 of 3 (counted from 0) in line 6");
    expect_error("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n9 9\n", ErrorCode::syntaxError,
                 "line 7");
    expect_error("OFF\n99999999999 1 0\n", ErrorCode::tooLarge, "line 2");
    expect_error("OFF\nmany\n", ErrorCode::syntaxError, "line 2");
    expect_error("4OFF\n3 1 0\n", ErrorCode::unknownFormat, "line 1");
    expect_error("OFF BINARY\n3 1 0\n", ErrorCode::unknownFormat, "binary");
}

TEST(MeshReader, formats_are_told_apart)
{
    EXPECT_EQ(format_of_file_name("a/b.OBJ"), MeshFormat::obj);
    EXPECT_EQ(format_of_file_name("b.off"), MeshFormat::off);
    EXPECT_EQ(format_of_file_name("b.off.txt"), MeshFormat::detect);
    expect_error("", ErrorCode::fileEmpty, "holds nothing");
    expect_error(" \r\n\t\n", ErrorCode::fileEmpty, "holds nothing");
    expect_error("cube\nfacet normal 0 0 1\n", ErrorCode::unknownFormat, "neither OBJ, OFF");
    expect_error(std::string("\x89PNG\r\n\x1a\n\0\0v", 11), ErrorCode::unknownFormat, "neither");
    expect_error(write_off(zoo::cube()), ErrorCode::unknownFormat, "holds OFF", MeshFormat::obj);
    expect_error(write_obj(zoo::cube()), ErrorCode::unknownFormat, "holds OBJ", MeshFormat::off);
}

TEST(RealMeshes, all_are_read_and_are_surfaces)
{
    LAYOUT_EMBEDDING_NEED_DATA("data");
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(test_data_path("data"))) {
        const std::string name = entry.path().filename().string();
        const MeshFormat format = format_of_file_name(name);
        if (format == MeshFormat::detect) {
            continue;
        }
        ++count;
        const Result<PolygonMesh> mesh = read_mesh(read_bytes(entry.path()), format, name);
        ASSERT_TRUE(mesh.ok()) << mesh.error().message;
        const bool layout = name.find("control_mesh") != std::string::npos;
        const Status status =
            check_surface(*mesh, layout ? SurfaceKind::layout : SurfaceKind::target, name);
        EXPECT_TRUE(status.ok()) << status.error().message;
        expect_identical(read(write_obj(*mesh)), *mesh);
    }
    EXPECT_GE(count, 20U);
}

}  // namespace
}  // namespace layout_embedding
