#include <gtest/gtest.h>

#include "layout/layout.hh"
#include "mesh/triangle_mesh.hh"
#include "mesh/validation.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

TEST(CheckSurface, every_target_of_the_zoo_passes)
{
    for (const auto& [name, mesh] : zoo::targets()) {
        const Status status = check_surface(mesh, SurfaceKind::target, name);
        EXPECT_TRUE(status.ok()) << status.error().message;
    }
}

TEST(CheckSurface, every_layout_of_the_zoo_passes)
{
    for (const auto& [name, mesh] : zoo::layouts()) {
        const Status status = check_surface(mesh, SurfaceKind::layout, name);
        EXPECT_TRUE(status.ok()) << status.error().message;
    }
}

TEST(CheckSurface, every_broken_mesh_is_refused_with_its_code_and_its_place)
{
    for (const auto& broken : zoo::broken_meshes()) {
        const Status status = check_surface(broken.mesh, broken.kind, "the mesh");
        EXPECT_EQ(error_info(status.error().code).name, error_info(broken.code).name)
            << broken.name << ": " << status.error().message;
        const std::string& message = status.error().message;
        EXPECT_EQ(message.rfind("the mesh ", 0), 0U) << broken.name << ": " << message;
        EXPECT_NE(message.find(broken.where), std::string::npos) << broken.name << ": " << message;
        EXPECT_NE(message.find(std::string(error_info(broken.code).advice)), std::string::npos);
    }
}

TEST(CheckSurface, a_broken_mesh_stays_broken_in_any_order_of_vertices_and_faces)
{
    for (const auto& broken : zoo::broken_meshes()) {
        if (broken.code == ErrorCode::indexOutOfRange || broken.code == ErrorCode::noFaces) {
            continue;
        }
        const PolygonMesh mesh = zoo::shuffled(broken.mesh, 7);
        const Status status = check_surface(mesh, broken.kind, "the mesh");
        EXPECT_EQ(error_info(status.error().code).name, error_info(broken.code).name)
            << broken.name << ": " << status.error().message;
    }
}

TEST(CheckSurface, positions_of_a_layout_do_not_matter_as_long_as_they_are_numbers)
{
    PolygonMesh layout = zoo::cube();
    for (Vec3& p : layout.positions) {
        p.setConstant(1e300);
    }
    EXPECT_TRUE(check_surface(layout, SurfaceKind::layout, "the layout").ok());
}

TEST(CheckSurface, coincident_vertices_alone_are_no_error)
{
    // Two far vertices of a closed sphere moved onto each other: ugly, but a surface.
    PolygonMesh mesh = zoo::icosphere(2);
    mesh.positions[0] = mesh.positions[3];
    EXPECT_TRUE(check_surface(mesh, SurfaceKind::target, "the mesh").ok());
    // A boundary that touches itself in single points, with a hole that stays.
    mesh = zoo::grid_disk(4, 4);
    mesh.positions[0] = mesh.positions[4];
    EXPECT_TRUE(check_surface(mesh, SurfaceKind::target, "the mesh").ok());
}

TEST(CheckSurface, hubs_of_huge_degree_are_no_burden)
{
    // Quadratic work at the two hubs would take hours.
    const PolygonMesh mesh = zoo::bipyramid(200'000);
    EXPECT_TRUE(check_surface(mesh, SurfaceKind::target, "the mesh").ok());
    EXPECT_EQ(TriangleMesh(mesh).euler_characteristic(), 2);
    EXPECT_FALSE(check_surface(zoo::soup(mesh), SurfaceKind::target, "the mesh").ok());
}

TEST(TriangleMesh, counts_are_those_of_the_topology)
{
    const auto euler = [](const PolygonMesh& mesh) {
        return TriangleMesh(mesh).euler_characteristic();
    };
    const auto loops = [](const PolygonMesh& mesh) {
        return TriangleMesh(mesh).boundary_loop_count();
    };
    EXPECT_EQ(euler(zoo::icosphere(2)), 2);
    EXPECT_EQ(euler(zoo::torus(5, 4)), 0);
    EXPECT_EQ(euler(zoo::slab(2, 0)), -2);
    EXPECT_EQ(euler(zoo::slab(4, 1)), -6);
    EXPECT_EQ(euler(zoo::grid_disk(3, 4)), 1);
    EXPECT_EQ(loops(zoo::grid_disk(3, 4)), 1U);
    EXPECT_EQ(loops(zoo::hemisphere(2)), 1U);
    EXPECT_EQ(euler(zoo::annulus(7, 3)), 0);
    EXPECT_EQ(loops(zoo::annulus(7, 3)), 2U);
}

TEST(TriangleMesh, halfedges_agree_with_each_other)
{
    for (const auto& [name, polygons] : zoo::targets()) {
        SCOPED_TRACE(name);
        const TriangleMesh mesh(polygons);
        for (Index h = 0; h < mesh.halfedge_count(); ++h) {
            ASSERT_EQ(mesh.head(h), mesh.tail(TriangleMesh::next(h)));
            ASSERT_EQ(TriangleMesh::previous(TriangleMesh::next(h)), h);
            const Index twin = mesh.opposite(h);
            if (twin != kNone) {
                ASSERT_EQ(mesh.opposite(twin), h);
                ASSERT_EQ(mesh.tail(twin), mesh.head(h));
                ASSERT_EQ(mesh.head(twin), mesh.tail(h));
                ASSERT_EQ(mesh.edge(twin), mesh.edge(h));
                ASSERT_EQ(mesh.halfedge(mesh.edge(h)), std::min(h, twin));
            }
        }
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
            // Turning once around a vertex meets all its corners.
            Index met = 0;
            Index h = mesh.outgoing(v);
            do {
                ASSERT_EQ(mesh.tail(h), v);
                ++met;
                h = mesh.rotated_ccw(h);
            } while (h != kNone && h != mesh.outgoing(v));
            ASSERT_EQ(h == kNone, mesh.is_boundary_vertex(v));
            ASSERT_EQ(met, std::count(mesh.corners().begin(), mesh.corners().end(), v));
        }
    }
}

}  // namespace
}  // namespace layout_embedding
