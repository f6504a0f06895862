#include <array>
#include <limits>
#include <utility>

#include "zoo.hh"

namespace layout_embedding::zoo {
namespace {

void set_corner(PolygonMesh& mesh, Index face, Index corner, Index vertex)
{
    mesh.corners[mesh.face_offsets[face] + corner] = vertex;
}

void flip_face(PolygonMesh& mesh, Index face)
{
    std::swap(mesh.corners[mesh.face_offsets[face] + 1], mesh.corners[mesh.face_offsets[face] + 2]);
}

PolygonMesh without_face(const PolygonMesh& mesh, Index face)
{
    PolygonMesh result;
    result.positions = mesh.positions;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        if (f != face) {
            result.add_face(mesh.face(f));
        }
    }
    return result;
}

/// Both meshes in one, the second moved by `offset`.
PolygonMesh together(PolygonMesh first, const PolygonMesh& second, const Vec3& offset)
{
    const Index shift = first.vertex_count();
    for (const Vec3& p : second.positions) {
        first.positions.push_back(p + offset);
    }
    for (Index f = 0; f < second.face_count(); ++f) {
        std::vector<Index> face;
        for (const Index corner : second.face(f)) {
            face.push_back(corner + shift);
        }
        first.add_face(face);
    }
    return first;
}

/// Two octahedra that share vertex 4.
PolygonMesh bow_tie()
{
    PolygonMesh mesh = together(octahedron(), octahedron(), {0, 0, 2});
    for (Index& corner : mesh.corners) {
        corner = corner == 11 ? 4 : corner;  // the lower tip of the second is the first's upper one
    }
    // Vertex 11, now unused, is the last one.
    mesh.positions.pop_back();
    return mesh;
}

/// The octahedron with a fin on the edge from 0 to 1.
PolygonMesh fin()
{
    PolygonMesh mesh = octahedron();
    mesh.positions.emplace_back(2, 2, 0);
    mesh.add_face(std::array<Index, 3>{0, 1, 6});
    return mesh;
}

/// A grid disk with an edge split at its midpoint on one side of it alone, and the gap filled with
/// a triangle of three corners on one line.
PolygonMesh with_cap(PolygonMesh mesh, Index face)
{
    const auto corners = mesh.face(face);
    const Index a = corners[0];
    const Index b = corners[1];
    const Index c = corners[2];
    const Index m = mesh.vertex_count();
    mesh.positions.push_back((mesh.positions[a] + mesh.positions[b]) / 2);
    set_corner(mesh, face, 1, m);
    mesh.add_face(std::array<Index, 3>{m, b, c});
    mesh.add_face(std::array<Index, 3>{a, b, m});
    return mesh;
}

/// An edge opened into two: a needle with two corners at one position.
PolygonMesh with_needle(PolygonMesh mesh)
{
    // Vertex 4 of the octahedron gets a twin that takes over faces 0 and 1.
    const Index twin = mesh.vertex_count();
    mesh.positions.push_back(mesh.positions[4]);
    set_corner(mesh, 0, 2, twin);
    set_corner(mesh, 1, 2, twin);
    mesh.add_face(std::array<Index, 3>{2, twin, 4});
    mesh.add_face(std::array<Index, 3>{0, 4, twin});
    return mesh;
}

PolygonMesh with_position(PolygonMesh mesh, Index vertex, double x)
{
    mesh.positions[vertex].x() = x;
    return mesh;
}

PolygonMesh scaled(PolygonMesh mesh, double factor)
{
    for (Vec3& p : mesh.positions) {
        p *= factor;
    }
    return mesh;
}

}  // namespace

std::vector<BrokenMesh> broken_meshes()
{
    constexpr SurfaceKind kTarget = SurfaceKind::target;
    constexpr SurfaceKind kLayout = SurfaceKind::layout;
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    using enum ErrorCode;
    std::vector<BrokenMesh> zoo;
    const auto add = [&](std::string name, PolygonMesh mesh, SurfaceKind kind, ErrorCode code,
                         std::string where, bool mendable = false) {
        zoo.push_back({std::move(name), std::move(mesh), kind, code, std::move(where), mendable});
    };

    PolygonMesh points;
    points.positions = octahedron().positions;
    add("points without faces", points, kTarget, noFaces, "6 vertices");
    add("nothing", {}, kLayout, noFaces, "0 vertices");

    PolygonMesh mesh = octahedron();
    set_corner(mesh, 3, 1, 6);
    add("corner out of range", mesh, kTarget, indexOutOfRange, "face 3 with the vertex 6");
    mesh = octahedron();
    mesh.face_offsets.back() = 100;
    add("offsets beyond the corners", mesh, kTarget, indexOutOfRange, "24 corners");

    mesh = cube();
    set_corner(mesh, 2, 1, 0);
    add("layout loop", mesh, kLayout, layoutLoop, "face 2");
    mesh = cube();
    mesh.add_face(std::array<Index, 2>{0, 1});
    add("face of two corners", mesh, kLayout, degenerateFace, "face 6", true);
    mesh = octahedron();
    mesh.add_face(std::array<Index, 3>{0, 1, 0});
    add("repeated corner", mesh, kTarget, degenerateFace, "face 8", true);
    add("quads", cube(), kTarget, notTriangles, "face 0");

    add("not a number", with_position(octahedron(), 3, kNan), kTarget, nonFinitePosition,
        "vertex 3");
    add("infinite", with_position(octahedron(), 2, -kInfinity), kTarget, nonFinitePosition,
        "vertex 2");
    add("layout that is not a number", with_position(cube(), 6, kNan), kLayout, nonFinitePosition,
        "vertex 6");
    add("one huge coordinate", with_position(octahedron(), 5, 1e200), kTarget, coordinateTooLarge,
        "vertex 5");
    add("huge", scaled(octahedron(), 1e150), kTarget, coordinateTooLarge, "vertex 0");
    add("tiny", scaled(octahedron(), 1e-200), kTarget, coordinateTooLarge, "vertex 0");

    add("triangle on a line", with_cap(grid_disk(4, 4), 9), kTarget, degenerateFace, "face 33",
        true);
    add("triangle on a line at the boundary", with_cap(grid_disk(4, 4), 0), kTarget, degenerateFace,
        "face 33", true);
    add("triangle on a line, closed", with_cap(icosphere(1), 7), kTarget, degenerateFace, "face 81",
        true);
    add("needle", with_needle(octahedron()), kTarget, degenerateFace, "face 8", true);

    mesh = octahedron();
    mesh.positions.insert(mesh.positions.begin() + 2, Vec3(5, 5, 5));
    for (Index& corner : mesh.corners) {
        corner += corner >= 2 ? 1 : 0;
    }
    add("unused vertex", mesh, kTarget, unusedVertex, "vertex 2", true);
    mesh = cube();
    mesh.positions.emplace_back(0, 0, 0);
    mesh.positions.emplace_back(0, 0, 0);
    add("unused layout vertices", mesh, kLayout, unusedVertex, "vertex 8", true);

    mesh = octahedron();
    mesh.add_face(std::array<Index, 3>{1, 2, 4});
    add("duplicate face", mesh, kTarget, duplicateFace, "faces 1 and 8", true);
    mesh = octahedron();
    mesh.add_face(std::array<Index, 3>{2, 1, 4});
    add("duplicate face, reversed", mesh, kTarget, duplicateFace, "faces 1 and 8", true);
    mesh = cube();
    mesh.add_face(std::array<Index, 4>{5, 6, 7, 4});
    add("duplicate layout face", mesh, kLayout, duplicateFace, "faces 1 and 6", true);

    add("non-manifold edge", fin(), kTarget, nonManifoldEdge, "vertex 0 to vertex 1");
    add("non-manifold layout edge", fin(), kLayout, nonManifoldEdge, "vertex 0 to vertex 1");
    mesh = icosphere(1);
    flip_face(mesh, 40);
    add("flipped face", mesh, kTarget, inconsistentOrientation, "face 40");
    mesh = cube();
    std::swap(mesh.corners[5], mesh.corners[7]);
    add("flipped layout face", mesh, kLayout, inconsistentOrientation, "face 1");
    add("bow tie", bow_tie(), kTarget, nonManifoldVertex, "vertex 4");
    add("bow tie layout", bow_tie(), kLayout, nonManifoldVertex, "vertex 4");
    mesh = without_face(without_face(octahedron(), 2), 0);
    add("two faces missing at a vertex", mesh, kTarget, nonManifoldVertex, "vertex 4");

    add("soup", soup(icosphere(2)), kTarget, coincidentVertices, "vertices ", true);
    add("soup of a disk", soup(grid_disk(5, 4)), kTarget, coincidentVertices, "vertices ", true);
    add("soup of a torus", soup(torus(8, 5)), kTarget, coincidentVertices, "vertices ", true);
    // A seam from pole to pole: everything is there, but for the vertices 0, 4 on it.
    mesh = octahedron();
    mesh.positions.push_back(mesh.positions[0]);
    set_corner(mesh, 3, 1, 6);
    set_corner(mesh, 7, 0, 6);
    add("seam", mesh, kTarget, coincidentVertices, "vertices 0 and 6", true);

    add("two components", together(octahedron(), octahedron(), {5, 0, 0}), kTarget,
        severalComponents, "vertex 0 to vertex 6");
    add("two layout components", together(cube(), cube(), {5, 0, 0}), kLayout, severalComponents,
        "vertex 3 to vertex 11");
    add("two components that touch in a point", together(octahedron(), octahedron(), {0, 0, 2}),
        kTarget, severalComponents, "2 components");
    return zoo;
}

}  // namespace layout_embedding::zoo
