#include <Eigen/Geometry>
#include <gtest/gtest.h>
#include <numeric>

#include "mesh/repair.hh"
#include "mesh/triangle_mesh.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

double area(const PolygonMesh& mesh)
{
    double sum = 0;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const auto face = mesh.face(f);
        for (std::size_t i = 2; i < face.size(); ++i) {
            const Vec3& a = mesh.positions[face[0]];
            sum += (mesh.positions[face[i - 1]] - a).cross(mesh.positions[face[i]] - a).norm() / 2;
        }
    }
    return sum;
}

void expect_map_keeps_positions(const PolygonMesh& before, const RepairResult& repaired)
{
    ASSERT_EQ(repaired.vertex_map.size(), before.positions.size());
    for (Index v = 0; v < before.vertex_count(); ++v) {
        if (repaired.vertex_map[v] != kNone) {
            ASSERT_LT(repaired.vertex_map[v], repaired.mesh.vertex_count());
            EXPECT_EQ(repaired.mesh.positions[repaired.vertex_map[v]], before.positions[v]);
        }
    }
}

bool identical(const PolygonMesh& a, const PolygonMesh& b)
{
    return a.positions == b.positions && a.face_offsets == b.face_offsets && a.corners == b.corners;
}

TEST(Repair, a_good_mesh_comes_back_as_it_is)
{
    const auto expect_untouched = [](const zoo::NamedMesh& named, SurfaceKind kind) {
        const RepairResult repaired = repair_surface(named.mesh, kind);
        EXPECT_TRUE(identical(repaired.mesh, named.mesh)) << named.name;
        EXPECT_TRUE(repaired.notes.empty()) << named.name;
        for (Index v = 0; v < named.mesh.vertex_count(); ++v) {
            ASSERT_EQ(repaired.vertex_map[v], v) << named.name;
        }
    };
    for (const auto& named : zoo::targets()) {
        expect_untouched(named, SurfaceKind::target);
    }
    for (const auto& named : zoo::layouts()) {
        expect_untouched(named, SurfaceKind::layout);
    }
}

TEST(Repair, mends_what_can_be_mended_and_leaves_the_rest_broken)
{
    for (const auto& broken : zoo::broken_meshes()) {
        SCOPED_TRACE(broken.name);
        const RepairResult repaired = repair_surface(broken.mesh, broken.kind);
        const Status status = check_surface(repaired.mesh, broken.kind, "the mesh");
        EXPECT_EQ(status.ok(), broken.mendable) << status.error().message;
        if (broken.mendable) {
            EXPECT_FALSE(repaired.notes.empty());
            EXPECT_NEAR(area(repaired.mesh), area(broken.mesh),
                        broken.code == ErrorCode::duplicateFace ? 10 : 1e-12);
            expect_map_keeps_positions(broken.mesh, repaired);
        }
    }
}

TEST(Repair, is_the_same_in_any_order_and_done_after_one_pass)
{
    for (const auto& broken : zoo::broken_meshes()) {
        if (broken.code == ErrorCode::indexOutOfRange || broken.code == ErrorCode::noFaces) {
            continue;
        }
        SCOPED_TRACE(broken.name);
        const PolygonMesh mesh = zoo::shuffled(broken.mesh, 3);
        const RepairResult repaired = repair_surface(mesh, broken.kind);
        EXPECT_EQ(check_surface(repaired.mesh, broken.kind, "the mesh").ok(), broken.mendable);
        const RepairResult again = repair_surface(repaired.mesh, broken.kind);
        if (broken.mendable) {
            EXPECT_TRUE(again.notes.empty());
        }
    }
}

TEST(Repair, a_soup_becomes_the_surface_it_was_made_of)
{
    for (const auto& [name, mesh] : zoo::targets()) {
        SCOPED_TRACE(name);
        const PolygonMesh soup = zoo::soup(mesh);
        const RepairResult repaired = repair_surface(soup, SurfaceKind::target);
        const Status status = check_surface(repaired.mesh, SurfaceKind::target, name);
        ASSERT_TRUE(status.ok()) << status.error().message;
        EXPECT_EQ(repaired.mesh.vertex_count(), mesh.vertex_count());
        EXPECT_EQ(repaired.mesh.face_count(), mesh.face_count());
        EXPECT_EQ(TriangleMesh(repaired.mesh).euler_characteristic(),
                  TriangleMesh(mesh).euler_characteristic());
        expect_map_keeps_positions(soup, repaired);
    }
}

TEST(Repair, cubes_that_touch_along_an_edge_or_in_a_corner_are_not_welded_there)
{
    const PolygonMesh cube = zoo::triangulated(zoo::cube());
    const double side = cube.positions[6].x() - cube.positions[0].x();
    for (const Vec3& offset : {Vec3(side, side, 0), Vec3(side, side, side)}) {
        PolygonMesh both = cube;
        for (Index f = 0; f < cube.face_count(); ++f) {
            const auto face = cube.face(f);
            both.add_face(std::array<Index, 3>{face[0] + 8, face[1] + 8, face[2] + 8});
        }
        for (const Vec3& p : cube.positions) {
            both.positions.push_back(p + offset);
        }
        const RepairResult repaired = repair_surface(zoo::soup(both), SurfaceKind::target);
        // Two closed cubes, still apart, or open along the shared edge: never a non-manifold edge.
        const Status status = check_surface(repaired.mesh, SurfaceKind::target, "the cubes");
        EXPECT_TRUE(status.error().code == ErrorCode::severalComponents ||
                    status.error().code == ErrorCode::coincidentVertices)
            << status.error().message;
    }
}

TEST(Repair, a_soup_with_needles_and_points_is_mended)
{
    PolygonMesh soup = zoo::soup(zoo::icosphere(1));
    // Triangles that are no more than an edge or a point, as exporters leave them behind.
    for (const std::array<Index, 3> face : {std::array<Index, 3>{0, 1, 1}, {4, 4, 4}}) {
        std::vector<Index> corners;
        for (const Index v : face) {
            corners.push_back(soup.vertex_count());
            soup.positions.push_back(soup.positions[v]);
        }
        soup.add_face(corners);
    }
    const RepairResult repaired = repair_surface(soup, SurfaceKind::target);
    const Status status = check_surface(repaired.mesh, SurfaceKind::target, "the soup");
    EXPECT_TRUE(status.ok()) << status.error().message;
    EXPECT_EQ(repaired.mesh.vertex_count(), 42U);
}

TEST(Repair, many_triangles_on_one_line_are_mended)
{
    // A square whose lower edge has ten vertices, with the triangles on that line on top of each
    // other: flips have to be done one after the other.
    PolygonMesh mesh;
    constexpr Index kCount = 10;
    for (Index i = 0; i <= kCount; ++i) {
        mesh.positions.emplace_back(static_cast<double>(i), 0, 0);
    }
    mesh.positions.emplace_back(5, 8, 0);
    mesh.positions.emplace_back(5, -8, 0);
    const Index apex = kCount + 1;
    const Index nadir = kCount + 2;
    for (Index i = 0; i < kCount; ++i) {
        mesh.add_face(std::array<Index, 3>{nadir, i + 1, i});
    }
    for (Index i = 1; i < kCount; ++i) {
        mesh.add_face(std::array<Index, 3>{0, i, i + 1});
    }
    mesh.add_face(std::array<Index, 3>{0, kCount, apex});
    const RepairResult repaired = repair_surface(mesh, SurfaceKind::target);
    const Status status = check_surface(repaired.mesh, SurfaceKind::target, "the mesh");
    EXPECT_TRUE(status.ok()) << status.error().message;
    EXPECT_EQ(repaired.mesh.vertex_count(), mesh.vertex_count());
    EXPECT_NEAR(area(repaired.mesh), 80, 1e-12);
}

}  // namespace
}  // namespace layout_embedding
