#include <cmath>
#include <functional>
#include <gtest/gtest.h>

#include "base/bytes.hh"
#include "embedded_forms.hh"
#include "embedding/carried_attributes.hh"
#include "embedding/refined_obj.hh"
#include "embedding_checks.hh"
#include "formats/refined_glb.hh"
#include "formats/refined_ply.hh"
#include "formats/refined_vtp.hh"
#include "mesh/glb_reader.hh"
#include "mesh/mesh_reader.hh"
#include "mesh/mesh_writer.hh"
#include "mesh/repair.hh"
#include "mesh/validation.hh"
#include "zoo.hh"

// What files say of targets besides places, on refined meshes. The files are written by hand;
// values are linear functions of the place, so that it is known what lies in between.

namespace layout_embedding {
namespace {

/// Texture coordinates, on a chart of its own for every face with a number divisible by three.
std::array<double, 2> place_at(const Vec3& p, Index face)
{
    return {0.25 * p.x() + 0.125 * p.y() + (face % 3 == 0 ? 4 : 0), 0.5 * p.z() - 0.125 * p.x()};
}

/// On one chart.
std::array<double, 2> place_at(const Vec3& p)
{
    return place_at(p, 1);
}

/// Between 0 and 1 on meshes within 4 of the origin.
std::array<double, 4> colour_at(const Vec3& p)
{
    return {0.5 + p.x() / 8, 0.5 + p.y() / 8, 0.5 + p.z() / 8, 0.5 + (p.x() - p.y()) / 16};
}

std::string group_of(Index face)
{
    return face % 3 == 0 ? "" : face % 3 == 1 ? "head left" : "tail";
}

std::string text(double number)
{
    char digits[40];
    std::snprintf(digits, sizeof digits, "%.17g ", number);
    return digits;
}

std::string text(const Vec3& p)
{
    return text(p.x()) + text(p.y()) + text(p.z());
}

std::string text_corners(const PolygonMesh& mesh, Index f)
{
    std::string line = std::to_string(mesh.face(f).size());
    for (const Index v : mesh.face(f)) {
        line += " " + std::to_string(v);
    }
    return line;
}

/// Texture coordinates of every corner, counted back, on charts; colours, groups and materials.
std::string painted_obj(const PolygonMesh& mesh)
{
    std::string obj = "mtllib paint.mtl\n";
    for (const Vec3& p : mesh.positions) {
        const auto [r, g, b, a] = colour_at(p);
        obj += "v " + text(p) + text(r) + text(g) + text(b) + "\n";
    }
    for (Index f = 0; f < mesh.face_count(); ++f) {
        std::string corners;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [u, v] = place_at(mesh.positions[mesh.face(f)[i]], f);
            obj += "vt " + text(u) + text(v) + "\n";
            corners += " " + std::to_string(mesh.face(f)[i] + 1) + "/" +
                       std::to_string(static_cast<int>(i) - 3);
        }
        obj +=
            "g " + group_of(f) + "\nusemtl paint" + std::to_string(f % 2) + "\nf" + corners + "\n";
    }
    return obj;
}

std::string painted_off(const PolygonMesh& mesh)
{
    std::string off = "STCOFF\n" + std::to_string(mesh.vertex_count()) + " " +
                      std::to_string(mesh.face_count()) + " 0\n";
    for (const Vec3& p : mesh.positions) {
        const auto [r, g, b, a] = colour_at(p);
        const auto [u, v] = place_at(p);
        off += text(p) + text(255 * r) + text(255 * g) + text(255 * b) + text(255 * a) + text(u) +
               text(v) + "\n";
    }
    for (Index f = 0; f < mesh.face_count(); ++f) {
        off += text_corners(mesh, f) + (f % 2 == 0 ? " 255 0 128\n" : " 0 0 0\n");
    }
    return off;
}

/// Floating-point colours, texture coordinates of vertices, and a number of faces.
std::string painted_text_ply(const PolygonMesh& mesh)
{
    std::string ply = "ply\nformat ascii 1.0\nelement vertex " +
                      std::to_string(mesh.vertex_count()) +
                      "\nproperty double x\nproperty double y\nproperty double z\n"
                      "property double s\nproperty double t\nproperty double red\n"
                      "property double green\nproperty double blue\nproperty double alpha\n"
                      "element face " +
                      std::to_string(mesh.face_count()) +
                      "\nproperty list uchar int vertex_indices\nproperty int region\n"
                      "property float quality\nend_header\n";
    for (const Vec3& p : mesh.positions) {
        const auto [r, g, b, a] = colour_at(p);
        const auto [u, v] = place_at(p);
        ply += text(p) + text(u) + text(v) + text(r) + text(g) + text(b) + text(a) + "\n";
    }
    for (Index f = 0; f < mesh.face_count(); ++f) {
        ply += text_corners(mesh, f) + " " + std::to_string(f % 2) + " 0.5\n";
    }
    return ply;
}

template <typename T>
void append(std::string& bytes, T value, bool swapped)
{
    std::string plain;
    append_bytes(plain, value);
    if (swapped) {
        plain.assign(plain.rbegin(), plain.rend());
    }
    bytes += plain;
}

/// As MeshLab writes them: colours in 16 bits, texture coordinates and colours of faces, textures.
std::string painted_ply(const PolygonMesh& mesh, bool big_endian)
{
    std::string ply = std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
                      "_endian 1.0\ncomment TextureFile skin.png\nelement face " +
                      std::to_string(mesh.face_count()) +
                      "\nproperty list uchar uint vertex_indices\n"
                      "property list uchar double texcoord\nproperty int texnumber\n"
                      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                      "element vertex " +
                      std::to_string(mesh.vertex_count()) +
                      "\nproperty double x\nproperty double y\nproperty double z\n"
                      "property ushort red\nproperty ushort green\nproperty ushort blue\n"
                      "property ushort alpha\nend_header\n";
    for (Index f = 0; f < mesh.face_count(); ++f) {
        append(ply, std::uint8_t{3}, big_endian);
        for (const Index v : mesh.face(f)) {
            append(ply, v, big_endian);
        }
        append(ply, std::uint8_t{6}, big_endian);
        for (const Index v : mesh.face(f)) {
            for (const double number : place_at(mesh.positions[v], f)) {
                append(ply, number, big_endian);
            }
        }
        append(ply, std::int32_t{f % 2 == 0 ? 0 : -1}, big_endian);
        for (const int part : {255, f % 2 == 0 ? 128 : 0, 0}) {
            append(ply, static_cast<std::uint8_t>(part), big_endian);
        }
    }
    for (const Vec3& p : mesh.positions) {
        for (int axis = 0; axis < 3; ++axis) {
            append(ply, p[axis], big_endian);
        }
        for (const double part : colour_at(p)) {
            append(ply, static_cast<std::uint16_t>(std::lround(65535 * part)), big_endian);
        }
    }
    return ply;
}

/// Two primitives with vertices of their own for every face: floating-point values in the one,
/// normalised 16 bits in the other.
std::string painted_glb(const PolygonMesh& mesh)
{
    std::string binary;
    std::string views;
    std::string accessors;
    int count = 0;
    std::size_t begin = 0;
    const auto finish = [&](const std::string& rest) {
        const std::string comma = count == 0 ? "" : ",";
        views += comma + R"({"buffer":0,"byteOffset":)" + std::to_string(begin) +
                 R"(,"byteLength":)" + std::to_string(binary.size() - begin) + "}";
        accessors += comma + R"({"bufferView":)" + std::to_string(count) + "," + rest + "}";
        begin = binary.size();
        return std::to_string(count++);
    };
    std::array<std::string, 2> primitives;
    for (const Index half : {0U, 1U}) {
        std::vector<std::pair<Index, Vec3>> corners;
        for (Index f = 0; f < mesh.face_count(); ++f) {
            for (const Index v : mesh.face(f)) {
                if (f % 2 == half) {
                    corners.emplace_back(f, mesh.positions[v]);
                }
            }
        }
        const std::string size = R"("count":)" + std::to_string(corners.size());
        for (const auto& [f, p] : corners) {
            for (int axis = 0; axis < 3; ++axis) {
                append_bytes(binary, static_cast<float>(p[axis]));
            }
        }
        const auto positions = finish(size + R"(,"componentType":5126,"type":"VEC3")");
        for (const auto& [f, p] : corners) {
            const auto [u, v] = place_at(p, f);
            append_bytes(binary, static_cast<float>(u));
            append_bytes(binary, static_cast<float>(1 - v));
        }
        const auto texture = finish(size + R"(,"componentType":5126,"type":"VEC2")");
        for (const auto& [f, p] : corners) {
            for (const double part : colour_at(p)) {
                if (half == 0) {
                    append_bytes(binary, static_cast<float>(part));
                } else {
                    append_bytes(binary, static_cast<std::uint16_t>(std::lround(65535 * part)));
                }
            }
        }
        const auto colours =
            finish(size + (half == 0 ? R"(,"componentType":5126,"type":"VEC4")"
                                     : R"(,"componentType":5123,"normalized":true,"type":"VEC4")"));
        primitives[half] = R"({"attributes":{"POSITION":)" + positions + R"(,"TEXCOORD_0":)" +
                           texture + R"(,"COLOR_0":)" + colours + R"(},"material":)" +
                           std::to_string(half) + "}";
    }
    std::string json =
        R"({"asset":{"version":"2.0"},"nodes":[{"mesh":0,"name":"the body"}],"scenes":[{"nodes":[0]}],)"
        R"("materials":[{"name":"skin"},{}],"meshes":[{"primitives":[)" +
        primitives[0] + "," + primitives[1] + R"(]}],"accessors":[)" + accessors +
        R"(],"bufferViews":[)" + views + R"(],"buffers":[{"byteLength":)" +
        std::to_string(binary.size()) + "}]}";
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::string bytes = "glTF";
    append_bytes(bytes, std::uint32_t{2});
    append_bytes(bytes, static_cast<std::uint32_t>(28 + json.size() + binary.size()));
    append_bytes(bytes, static_cast<std::uint32_t>(json.size()));
    bytes += "JSON" + json;
    append_bytes(bytes, static_cast<std::uint32_t>(binary.size()));
    return bytes + std::string("BIN\0", 4) + binary;
}

struct Painted {
    PolygonMesh mesh;
    MeshAttributes attributes;
};

Painted read(const std::string& bytes)
{
    Painted painted;
    auto mesh = read_mesh(bytes, MeshFormat::detect, "it", &painted.attributes);
    EXPECT_TRUE(mesh.ok()) << mesh.error().message;
    if (mesh) {
        painted.mesh = std::move(*mesh);
    }
    return painted;
}

/// An embedding in a target as it was read, checked, and what it took along.
struct Embedding {
    RefinedMesh refined;
    MeshAttributes attributes;
    /// The target, and what was read with it.
    Painted target;
};

Embedding embedding_in(Painted target)
{
    const PolygonMesh layout = zoo::octahedron();
    const auto instance = test::embedded("painted", layout, target.mesh,
                                         zoo::displaced_landmarks(layout, target.mesh, 0.4, 3), 5);
    const NormalForm form = test::straight_form(instance);
    test::expect_valid(instance, form);
    RefinedMesh refined = test::cut(instance, form);
    MeshAttributes attributes =
        carried_attributes(target.attributes, *instance.problem.target, refined);
    EXPECT_GT(refined.positions.size(), target.mesh.positions.size());
    return {std::move(refined), std::move(attributes), std::move(target)};
}

/// Whether every corner's value is what `wanted` says of its place and its triangle's target face.
template <typename Wanted>
void expect_values(const CornerValues& values, const RefinedMesh& refined, std::size_t size,
                   double tolerance, Wanted wanted)
{
    ASSERT_EQ(values.ids.size(), refined.corners.size());
    ASSERT_GE(values.size, size);
    double worst = 0;
    for (std::size_t i = 0; i < refined.corners.size(); ++i) {
        ASSERT_LT(values.ids[i], values.count());
        const auto expected =
            wanted(refined.positions[refined.corners[i]], refined.triangle_faces[i / 3]);
        for (std::size_t k = 0; k < size; ++k) {
            worst = std::max(worst, std::abs(values.value(values.ids[i])[k] - expected[k]));
        }
    }
    EXPECT_LE(worst, tolerance);
}

const auto kOnCharts = [](const Vec3& p, Index face) { return place_at(p, face); };
const auto kOnOneChart = [](const Vec3& p, Index) { return place_at(p); };
const auto kColours = [](const Vec3& p, Index) { return colour_at(p); };

std::vector<std::string> names_of(const FaceNames& names, std::size_t count)
{
    std::vector<std::string> all;
    for (Index f = 0; f < count; ++f) {
        all.emplace_back(names.of_face(f));
    }
    return all;
}

/// Names of refined triangles are those of the target's faces, as `wanted` says.
void expect_names(const FaceNames& names, const RefinedMesh& refined,
                  const std::function<std::string(Index)>& wanted)
{
    for (std::size_t t = 0; t < refined.triangle_faces.size(); ++t) {
        ASSERT_EQ(names.of_face(static_cast<Index>(t)), wanted(refined.triangle_faces[t]));
    }
}

PolygonMesh target_mesh()
{
    return zoo::bumpy_sphere(3, 4);
}

PolygonMesh single_precision(PolygonMesh mesh)
{
    for (Vec3& p : mesh.positions) {
        p = p.cast<float>().cast<double>();
    }
    return mesh;
}

TEST(Attributes, of_obj_are_linear_on_the_refined_mesh_and_keep_seams)
{
    const auto [refined, carried, target] = embedding_in(read(painted_obj(target_mesh())));
    expect_values(carried.texture_coordinates, refined, 2, 1e-12, kOnCharts);
    expect_values(carried.colours, refined, 3, 1e-12, kColours);
    expect_names(carried.groups, refined, group_of);
    expect_names(carried.materials, refined,
                 [](Index f) { return "paint" + std::to_string(f % 2); });
    EXPECT_EQ(carried.material_files, std::vector<std::string>{"paint.mtl"});
    EXPECT_EQ(carried.unusable, 0);

    // Faces on the same chart share values where the file gave every corner its own.
    EXPECT_LT(carried.texture_coordinates.count(), 2 * refined.positions.size() + 100);
    EXPECT_EQ(carried.colours.count(), refined.positions.size());

    // What is written reads back as the same.
    const std::string obj = write_refined_obj(refined, carried);
    const Painted again = read(obj);
    EXPECT_EQ(again.mesh.positions, refined.positions);
    EXPECT_EQ(again.mesh.corners, refined.corners);
    expect_values(again.attributes.texture_coordinates, refined, 2, 1e-12, kOnCharts);
    expect_values(again.attributes.colours, refined, 3, 1e-12, kColours);
    EXPECT_EQ(names_of(again.attributes.materials, refined.triangle_faces.size()),
              names_of(carried.materials, refined.triangle_faces.size()));
    for (Index t = 0; t < refined.triangle_faces.size(); ++t) {
        const std::string behind = group_of(refined.triangle_faces[t]);
        EXPECT_EQ(again.attributes.groups.of_face(t),
                  "patch_" + std::to_string(refined.triangle_patches[t]) +
                      (behind.empty() ? "" : " " + behind));
    }
    // Without attributes there is none of this.
    EXPECT_EQ(write_refined_obj(refined).find("vt "), std::string::npos);
}

TEST(Attributes, of_off_are_linear_on_the_refined_mesh)
{
    const auto [refined, carried, target] = embedding_in(read(painted_off(target_mesh())));
    expect_values(carried.texture_coordinates, refined, 2, 1e-12, kOnOneChart);
    expect_values(carried.colours, refined, 4, 1e-12, kColours);
    expect_names(carried.groups, refined,
                 [](Index f) { return f % 2 == 0 ? "colour_ff0080" : "colour_000000"; });
}

TEST(Attributes, of_text_ply_are_linear_on_the_refined_mesh)
{
    const auto [refined, carried, target] = embedding_in(read(painted_text_ply(target_mesh())));
    expect_values(carried.texture_coordinates, refined, 2, 1e-12, kOnOneChart);
    expect_values(carried.colours, refined, 4, 1e-12, kColours);
    expect_names(carried.groups, refined,
                 [](Index f) { return "region_" + std::to_string(f % 2); });
    EXPECT_TRUE(carried.materials.empty());
}

TEST(Attributes, of_binary_ply_are_linear_on_the_refined_mesh_and_keep_seams)
{
    for (const bool big_endian : {false, true}) {
        const auto [refined, carried, target] =
            embedding_in(read(painted_ply(target_mesh(), big_endian)));
        expect_values(carried.texture_coordinates, refined, 2, 1e-12, kOnCharts);
        expect_values(carried.colours, refined, 4, 0.51 / 65535, kColours);
        expect_names(carried.groups, refined,
                     [](Index f) { return f % 2 == 0 ? "colour_ff8000" : "colour_ff0000"; });
        expect_names(carried.materials, refined,
                     [](Index f) { return f % 2 == 0 ? "skin.png" : ""; });
    }
}

TEST(Attributes, of_glb_are_linear_on_the_refined_mesh_and_keep_seams)
{
    const PolygonMesh mesh = single_precision(target_mesh());
    const auto [refined, carried, target] = embedding_in(read(painted_glb(mesh)));
    // Vertices that were apart have become one.
    EXPECT_EQ(target.mesh.vertex_count(), mesh.vertex_count());
    // Faces come primitive by primitive.
    const Index half = (mesh.face_count() + 1) / 2;
    const auto original = [&](Index f) { return f < half ? 2 * f : 2 * (f - half) + 1; };
    expect_values(carried.texture_coordinates, refined, 2, 1e-6,
                  [&](const Vec3& p, Index f) { return place_at(p, original(f)); });
    expect_values(carried.colours, refined, 4, 0.51 / 65535, kColours);
    expect_names(carried.groups, refined, [](Index) { return "the_body"; });
    expect_names(carried.materials, refined,
                 [&](Index f) { return f < half ? "skin" : "material_1"; });
}

TEST(Attributes, are_in_refined_ply_glb_and_vtp)
{
    const auto [refined, carried, target] = embedding_in(read(painted_obj(target_mesh())));

    const Painted ply = read(write_refined_ply(refined, carried));
    EXPECT_EQ(ply.mesh.corners, refined.corners);
    expect_values(ply.attributes.texture_coordinates, refined, 2, 1e-6, kOnCharts);
    expect_values(ply.attributes.colours, refined, 3, 0.51 / 255, kColours);
    EXPECT_NE(ply.attributes.groups.of_face(0).find("patch_"), std::string_view::npos);
    // Without colours of its own, patches are coloured.
    MeshAttributes pale = carried;
    pale.colours = {};
    const Painted patches = read(write_refined_ply(refined, pale));
    EXPECT_TRUE(patches.attributes.colours.empty());
    EXPECT_NE(patches.attributes.groups.of_face(0).find("colour_"), std::string_view::npos);

    const Painted glb = read(write_refined_glb(refined, carried));
    const auto& places = glb.attributes.texture_coordinates;
    const auto& colours = glb.attributes.colours;
    std::size_t textured = 0;
    std::size_t seams = 0;
    for (std::size_t i = 0; i < places.ids.size(); ++i) {
        if (places.ids[i] == kNone) {
            continue;  // paths
        }
        ++textured;
        const Vec3& p = glb.mesh.positions[glb.mesh.corners[i]];
        const auto value = places.value(places.ids[i]);
        const double chart = std::round((value[0] - place_at(p)[0]) / 4) * 4;
        seams += chart == 4 ? 1 : 0;
        EXPECT_NEAR(value[0], place_at(p)[0] + chart, 1e-5);
        EXPECT_NEAR(value[1], place_at(p)[1], 1e-5);
        ASSERT_NE(colours.ids[i], kNone);
        for (std::size_t k = 0; k < 3; ++k) {
            EXPECT_NEAR(colours.value(colours.ids[i])[k], colour_at(p)[k], 1e-5);
        }
    }
    EXPECT_EQ(textured, refined.corners.size());
    std::size_t expected = 0;
    for (const Index f : refined.triangle_faces) {
        expected += f % 3 == 0 ? 3 : 0;
    }
    EXPECT_EQ(seams, expected);

    const std::string vtp = write_refined_vtp(refined, carried);
    for (const std::string name : {"colour", "texture_coordinates", "group", "material"}) {
        EXPECT_NE(vtp.find("Name=\"" + name + "\""), std::string::npos);
    }
    EXPECT_EQ(write_refined_vtp(refined).find("PointData"), std::string::npos);
}

TEST(Attributes, do_not_change_the_mesh_that_is_read)
{
    const PolygonMesh mesh = target_mesh();
    for (const std::string& bytes :
         {painted_obj(mesh), painted_off(mesh), painted_text_ply(mesh), painted_ply(mesh, true),
          painted_ply(mesh, false), painted_glb(mesh)}) {
        const auto plain = read_mesh(bytes, MeshFormat::detect, "it");
        const Painted painted = read(bytes);
        ASSERT_TRUE(plain.ok());
        EXPECT_EQ(plain->positions, painted.mesh.positions);
        EXPECT_EQ(plain->corners, painted.mesh.corners);
        EXPECT_EQ(plain->face_offsets, painted.mesh.face_offsets);
        EXPECT_FALSE(painted.attributes.empty());
    }
    EXPECT_TRUE(read(write_obj(mesh)).attributes.empty());
    EXPECT_TRUE(read(write_off(mesh)).attributes.empty());
    EXPECT_TRUE(read(write_ply(mesh)).attributes.empty());
}

const std::string kTetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";

TEST(Attributes, may_be_there_in_part)
{
    // Colours without texture coordinates.
    const auto coloured = read("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n").attributes;
    EXPECT_EQ(coloured.colours.ids, (std::vector<Index>{0, 1, 2}));
    EXPECT_TRUE(coloured.texture_coordinates.empty());
    EXPECT_TRUE(coloured.groups.empty());

    // A weight is no colour, and colours of some vertices are theirs alone.
    const auto some = read("v 0 0 0 1 0 0\nv 1 0 0 1\nv 0 1 0\nf 1 2 3\n").attributes;
    EXPECT_EQ(some.colours.ids, (std::vector<Index>{0, kNone, kNone}));
    EXPECT_EQ(some.unusable, 0);

    // Texture coordinates on one face, groups without materials, normals between.
    const Painted part = read(kTetrahedron +
                              "vt 0.5\nvt 1 0.25\nvn 0 0 1\ng base\nf 1/1/1 3/2/1 2/-1/1\n"
                              "g\nf 1//1 2//1 4//1\nf 2 3 4\ng side\nf 3 1 4\n");
    const auto& places = part.attributes.texture_coordinates;
    EXPECT_EQ(std::vector<Index>(places.ids.begin(), places.ids.begin() + 4),
              (std::vector<Index>{0, 1, 1, kNone}));
    EXPECT_EQ(places.value(0)[1], 0);
    EXPECT_EQ(names_of(part.attributes.groups, 4),
              (std::vector<std::string>{"base", "", "", "side"}));
    EXPECT_TRUE(part.attributes.materials.empty());
    EXPECT_EQ(part.attributes.unusable, 0);
    // They survive writing.
    const std::string again = write_obj(part.mesh, {{}, "", {}, &part.attributes});
    EXPECT_EQ(read(again).attributes.texture_coordinates.ids, places.ids);
    EXPECT_NE(again.find("f 2 3 4\n"), std::string::npos);
}

TEST(Attributes, of_off_have_colours_of_either_scale_in_any_number)
{
    const std::string body = "0 0 0 0 0 1 1 0.5 0\n1 0 0 0 0 1 0 0 1\n0 1 0 0 0 1 1 1 1\n";
    const auto bright = read("CNOFF\n3 1 0\n" + body + "3 0 1 2 1 0.5 0 1\n").attributes;
    EXPECT_EQ(bright.colours.size, 3);
    EXPECT_EQ(bright.colours.value(0)[1], 0.5);
    EXPECT_EQ(bright.groups.of_face(0), "colour_ff8000");
    // The number of a colour is none of its parts.
    const auto numbered =
        read("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 7\n3 0 2 1 0 1 0\n").attributes;
    EXPECT_EQ(numbered.groups.of_face(0), "colour_7");
    EXPECT_EQ(numbered.groups.of_face(1), "colour_00ff00");
    EXPECT_TRUE(numbered.colours.empty());
}

TEST(Attributes, that_are_there_in_part_stay_so_on_the_refined_mesh)
{
    const PolygonMesh mesh = target_mesh();
    Painted painted = read(painted_obj(mesh));
    auto& ids = painted.attributes.texture_coordinates.ids;
    for (std::size_t i = 0; i < ids.size(); ++i) {
        ids[i] = i / 3 % 5 == 0 ? kNone : ids[i];
    }
    const auto [refined, carried, target] = embedding_in(std::move(painted));
    for (std::size_t i = 0; i < refined.corners.size(); ++i) {
        EXPECT_EQ(carried.texture_coordinates.ids[i] == kNone,
                  refined.triangle_faces[i / 3] % 5 == 0);
    }
    for (const std::string& bytes :
         {write_refined_obj(refined, carried), write_refined_ply(refined, carried)}) {
        const auto again = read(bytes).attributes.texture_coordinates;
        ASSERT_EQ(again.ids.size(), refined.corners.size());
        for (std::size_t i = 0; i < refined.corners.size(); ++i) {
            EXPECT_EQ(again.ids[i] == kNone, refined.triangle_faces[i / 3] % 5 == 0);
        }
    }
    EXPECT_TRUE(read_glb(write_refined_glb(refined, carried), "it").ok());
}

TEST(Attributes, that_make_no_sense_are_left_out_and_counted)
{
    const auto unusable = [](const std::string& bytes) { return read(bytes).attributes.unusable; };
    // OBJ: indices that are not there, numbers that are none, colours of two numbers.
    EXPECT_EQ(unusable(kTetrahedron + "vt 0 0\nf 1/1 2/2 3/-7\n"), 2);
    EXPECT_EQ(unusable(kTetrahedron + "vt nan 0\nvt x 0\nvt 0 inf\nf 1/1 2/2 3/3\n"), 3);
    EXPECT_EQ(unusable("v 0 0 0 1 1\nv 1 0 0 1 nan 0\nv 0 1 0 0 0 0\nf 1 2 3\n"), 2);
    // A texture coordinate that comes after its face.
    EXPECT_EQ(unusable(kTetrahedron + "f 1/1 2/1 3/1\nvt 0 0\n"), 0);

    EXPECT_EQ(unusable("COFF\n3 1 0\n0 0 0 1 0 0\n1 0 0 1 0\n0 1 0 nan 0 0\n3 0 1 2\n"), 2);
    EXPECT_EQ(unusable("STOFF\n3 1 0\n0 0 0 1 0\n1 0 0 1\n0 1 0 0 0 7\n3 0 1 2\n"), 2);

    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nproperty float red\nproperty float green\nproperty float blue\n"
        "element face 2\nproperty list uchar int vertex_indices\n"
        "property list uchar float texcoord\nend_header\n";
    // A short list counts; an empty one says that there is nothing.
    EXPECT_EQ(unusable(ply + "0 0 0 1 1 1\n1 0 0 1 1 1\n0 1 0 nan 1 1\n3 0 1 2 4 0 0 1 0\n"
                             "3 0 2 1 0\n"),
              3 + 2);
    // One of three colours is none.
    EXPECT_TRUE(read("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                     "property float y\nproperty float z\nproperty uchar red\nelement face 1\n"
                     "property list uchar int vertex_indices\nend_header\n0 0 0 1\n1 0 0 1\n"
                     "0 1 0 1\n3 0 1 2\n")
                    .attributes.empty());

    // GLB: arrays that end early or cannot be read; the mesh is there all the same.
    const PolygonMesh mesh = zoo::octahedron();
    const std::string glb = painted_glb(mesh);
    const auto damaged = [&](const std::string& from, const std::string& to) {
        std::string bytes = glb;
        bytes.replace(bytes.find(from), from.size(), to);
        return read(bytes);
    };
    const Painted wrong_type = damaged(R"("VEC2")", R"("VEC3")");
    EXPECT_EQ(wrong_type.mesh.face_count(), 8);
    EXPECT_EQ(wrong_type.attributes.unusable, 12);
    const Painted wrong_array = damaged(R"("TEXCOORD_0":1,)", R"("TEXCOORD_0":9,)");
    EXPECT_EQ(wrong_array.attributes.unusable, 0);
    EXPECT_EQ(wrong_array.attributes.texture_coordinates.ids[0], kNone);
}

TEST(Attributes, of_quads_belong_to_their_corners)
{
    const Painted quad = read(
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
        "f 1/1 2/2 3/3 4/4\n");
    EXPECT_EQ(quad.attributes.texture_coordinates.ids, (std::vector<Index>{0, 1, 2, 3}));
    // As a target it is refused like any mesh of quads.
    EXPECT_EQ(check_surface(quad.mesh, SurfaceKind::target, "it").error().code,
              ErrorCode::notTriangles);
}

TEST(Attributes, follow_repairs)
{
    // A soup of faces, one of them twice, one thin, and one without area, where an edge has a third
    // vertex on one side: 0 1 2 becomes 0 m 2, m 1 2 and 0 1 m.
    PolygonMesh mesh = single_precision(target_mesh());  // where middles are exact
    const auto first = mesh.face(0);
    const Vec3 middle = (mesh.positions[first[0]] + mesh.positions[first[1]]) / 2;
    const std::array<Index, 3> corners{first[0], first[1], first[2]};
    const Index fresh = mesh.vertex_count();
    mesh.positions.push_back(middle);
    PolygonMesh broken;
    broken.positions = mesh.positions;
    for (const auto& face : {std::array<Index, 3>{corners[0], fresh, corners[2]},
                             {fresh, corners[1], corners[2]},
                             {corners[0], corners[1], fresh}}) {
        broken.add_face(face);
    }
    for (Index f = 1; f < mesh.face_count(); ++f) {
        broken.add_face(mesh.face(f));
    }
    broken = zoo::soup(broken);
    const auto seventh = broken.face(7);
    broken.add_face(std::vector<Index>(seventh.begin(), seventh.end()));
    broken.add_face(std::array<Index, 3>{0, 1, 0});

    const Painted painted = read(painted_obj(broken));
    const RepairResult repaired = repair_surface(painted.mesh, SurfaceKind::target);
    const Status mended = check_surface(repaired.mesh, SurfaceKind::target, "it");
    ASSERT_TRUE(mended.ok()) << mended.error().message;
    EXPECT_EQ(repaired.mesh.face_count(), mesh.face_count() + 2);
    const MeshAttributes attributes =
        through_repair(painted.attributes, painted.mesh, repaired.face_origins);
    const auto& places = attributes.texture_coordinates;
    ASSERT_EQ(places.ids.size(), repaired.mesh.corners.size());
    int flipped = 0;
    for (Index f = 0; f < repaired.mesh.face_count(); ++f) {
        const Index origin = repaired.face_origins.face(f);
        flipped += repaired.face_origins.is_whole(f) ? 0 : 1;
        EXPECT_EQ(attributes.groups.of_face(f), group_of(origin));
        for (Index i = 3 * f; i < 3 * f + 3; ++i) {
            const Vec3& p = repaired.mesh.positions[repaired.mesh.corners[i]];
            const auto wanted = place_at(p, origin);
            EXPECT_NEAR(places.value(places.ids[i])[0], wanted[0], 1e-12);
            EXPECT_NEAR(places.value(places.ids[i])[1], wanted[1], 1e-12);
            EXPECT_NEAR(attributes.colours.value(attributes.colours.ids[i])[2], colour_at(p)[2],
                        1e-12);
        }
    }
    EXPECT_EQ(flipped, 2);
    // And an embedding takes them along.
    const auto [refined, carried, target] = embedding_in({repaired.mesh, attributes});
    expect_values(carried.texture_coordinates, refined, 2, 1e-12, [&](const Vec3& p, Index f) {
        return place_at(p, repaired.face_origins.face(f));
    });
}

}  // namespace
}  // namespace layout_embedding
