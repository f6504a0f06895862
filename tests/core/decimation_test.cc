#include "mesh/decimation.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/random.hh"
#include "layout/layout.hh"
#include "mesh/editable_mesh.hh"
#include "mesh/star_triangulation.hh"
#include "mesh/validation.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

/// The faces that are left, in the old ids.
std::vector<std::array<Index, 3>> faces_of(const EditableMesh& mesh)
{
    std::vector<std::array<Index, 3>> faces;
    for (Index f = 0; f < mesh.face_capacity(); ++f) {
        if (mesh.has_face(f)) {
            faces.push_back({mesh.tail(3 * f), mesh.tail(3 * f + 1), mesh.tail(3 * f + 2)});
        }
    }
    return faces;
}

/// The faces as a mesh of the vertices they use.
PolygonMesh compacted(const std::vector<std::array<Index, 3>>& faces, Index vertices)
{
    std::vector<Index> ids(vertices, kNone);
    PolygonMesh mesh;
    for (const auto& face : faces) {
        std::array<Index, 3> corners{};
        for (std::size_t i = 0; i < 3; ++i) {
            if (ids[face[i]] == kNone) {
                ids[face[i]] = mesh.vertex_count();
                mesh.positions.emplace_back(0, 0, 0);
            }
            corners[i] = ids[face[i]];
        }
        mesh.add_face(corners);
    }
    return mesh;
}

struct Topology {
    long euler_characteristic = 0;
    std::size_t loops = 0;
    bool operator==(const Topology&) const = default;
};

/// Of a surface without parallel edges in triangles with different corners; {-100, 0} if it is
/// none.
Topology topology_of(const PolygonMesh& mesh)
{
    const auto layout = Layout::from_polygons(mesh, "the mesh");
    if (!layout || mesh.face_count() < 1) {
        return {-100, 0};
    }
    return {layout->euler_characteristic(), layout->boundary_loops().size()};
}

/// Everything that the data structure promises.
void expect_consistent(const EditableMesh& mesh)
{
    Index vertices = 0;
    for (Index v = 0; v < mesh.vertex_capacity(); ++v) {
        if (!mesh.has_vertex(v)) {
            continue;
        }
        ++vertices;
        std::set<Index> around;
        Index neighbours = 0;
        mesh.for_each_neighbour(v, [&](Index u) {
            around.insert(u);
            ++neighbours;
            EXPECT_TRUE(mesh.adjacent(v, u));
        });
        EXPECT_EQ(mesh.degree(v), neighbours);
        EXPECT_EQ(around.size(), neighbours);
        EXPECT_EQ(around.count(v), 0U);
        Index gaps = 0;
        mesh.for_each_outgoing(v, [&](Index h) {
            EXPECT_EQ(mesh.tail(h), v);
            gaps += mesh.opposite(h) == kNone ? 1U : 0U;
        });
        EXPECT_EQ(gaps, mesh.is_boundary_vertex(v) ? 1U : 0U);
    }
    EXPECT_EQ(vertices, mesh.vertex_count());
    for (Index h = 0; h < 3 * mesh.face_capacity(); ++h) {
        if (mesh.has_face(h / 3) && mesh.opposite(h) != kNone) {
            EXPECT_EQ(mesh.opposite(mesh.opposite(h)), h);
            EXPECT_EQ(mesh.tail(mesh.opposite(h)), mesh.head(h));
            EXPECT_EQ(mesh.head(mesh.opposite(h)), mesh.tail(h));
        }
    }
}

/// The surface after v and w were made one vertex; faces that lose a corner go.
Topology topology_after_merging(const EditableMesh& mesh, Index v, Index w)
{
    std::vector<std::array<Index, 3>> faces;
    for (auto face : faces_of(mesh)) {
        std::replace(face.begin(), face.end(), v, w);
        if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0]) {
            faces.push_back(face);
        }
    }
    // Two triangles glued along their outlines are a layout, but no triangulation any more.
    return faces.size() == 2 && topology_of(compacted(faces, mesh.vertex_capacity())).loops == 0
               ? Topology{-100, 0}
               : topology_of(compacted(faces, mesh.vertex_capacity()));
}

/// Small surfaces of genus 0 to 2, with and without boundary.
std::vector<zoo::NamedMesh> small_surfaces()
{
    std::vector<zoo::NamedMesh> meshes{
        {"tetrahedron", zoo::tetrahedron()},
        {"icosahedron", zoo::icosahedron()},
        {"hull", zoo::hull(20, 5)},
        {"bipyramid", zoo::bipyramid(7)},
        {"sphere", zoo::bumpy_sphere(1, 3)},
        {"grid", zoo::grid_disk(4, 3)},
        {"hemisphere", zoo::hemisphere(1)},
        {"annulus", zoo::annulus(5, 2)},
        {"wheel", zoo::wheel(5)},
        {"torus", zoo::torus(5, 4)},
        {"genus 1", zoo::slab(1, 0)},
        {"genus 2", zoo::slab(2, 0)},
        {"triangle", zoo::polygon(3)},
    };
    return meshes;
}

/// A halfedge of the mesh at random.
Index random_halfedge(const EditableMesh& mesh, Random& random)
{
    for (;;) {
        const auto h = static_cast<Index>(random.below(3 * mesh.face_capacity()));
        if (mesh.has_face(h / 3)) {
            return h;
        }
    }
}

TEST(EditableMesh, collapses_are_possible_exactly_where_they_keep_the_surface)
{
    int possible = 0;
    int impossible = 0;
    for (const auto& [name, polygons] : small_surfaces()) {
        const TriangleMesh triangles(polygons);
        const Topology topology = topology_of(polygons);
        for (std::uint64_t seed = 0; seed < 2; ++seed) {
            SCOPED_TRACE(name + " seed " + std::to_string(seed));
            Random random(seed);
            EditableMesh mesh(triangles);
            for (int step = 0; step < 60; ++step) {
                for (Index h = 0; h < 3 * mesh.face_capacity(); ++h) {
                    if (!mesh.has_face(h / 3)) {
                        continue;
                    }
                    for (const auto& [v, w] : {std::pair{mesh.tail(h), mesh.head(h)},
                                               std::pair{mesh.head(h), mesh.tail(h)}}) {
                        const bool leaves_boundary =
                            mesh.is_boundary_vertex(v) && mesh.opposite(h) != kNone;
                        const bool keeps = topology_after_merging(mesh, v, w) == topology;
                        ASSERT_EQ(mesh.can_collapse(v, w), keeps && !leaves_boundary)
                            << "from " << v << " to " << w << " after " << step << " steps";
                        ++(keeps ? possible : impossible);
                    }
                }
                // Flips, too, so that all kinds of stars occur.
                const Index h = random_halfedge(mesh, random);
                if (step % 4 != 0 && mesh.can_flip(h)) {
                    mesh.flip(h);
                } else if (step % 4 == 0 && mesh.can_collapse(mesh.tail(h), mesh.head(h))) {
                    mesh.collapse(mesh.tail(h), mesh.head(h));
                }
                expect_consistent(mesh);
                ASSERT_EQ(topology_of(compacted(faces_of(mesh), mesh.vertex_capacity())), topology);
            }
        }
    }
    EXPECT_GT(possible, 1000);
    EXPECT_GT(impossible, 1000);
}

TEST(EditableMesh, a_flip_is_undone_by_flipping_the_new_edge)
{
    for (const auto& [name, polygons] : small_surfaces()) {
        SCOPED_TRACE(name);
        EditableMesh mesh{TriangleMesh(polygons)};
        const auto sorted_faces = [&] {
            auto faces = faces_of(mesh);
            for (auto& face : faces) {
                std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
            }
            std::sort(faces.begin(), faces.end());
            return faces;
        };
        const auto before = sorted_faces();
        for (Index h = 0; h < 3 * mesh.face_capacity(); ++h) {
            if (!mesh.can_flip(h)) {
                continue;
            }
            const Index a = mesh.tail(EditableMesh::previous(h));
            const Index v = mesh.tail(h);
            const Index w = mesh.head(h);
            mesh.flip(h);
            EXPECT_NE(sorted_faces(), before);
            EXPECT_FALSE(mesh.adjacent(v, w));
            const Index edge = EditableMesh::previous(h);
            EXPECT_EQ(mesh.tail(edge), a);
            ASSERT_TRUE(mesh.can_flip(edge));
            mesh.flip(edge);
            expect_consistent(mesh);
            EXPECT_EQ(sorted_faces(), before);
        }
    }
}

/// Whether the polygon between places i and j of the ring has a triangulation, by trying them all.
bool can_fill(const EditableMesh& mesh, const std::vector<Index>& ring, bool boundary,
              std::size_t i, std::size_t j)
{
    const bool outline = j == i + 1 || (i == 0 && j + 1 == ring.size() && !boundary);
    if (!outline && mesh.adjacent(ring[i], ring[j])) {
        return false;
    }
    bool found = j == i + 1;
    for (std::size_t k = i + 1; k < j && !found; ++k) {
        found = can_fill(mesh, ring, boundary, i, k) && can_fill(mesh, ring, boundary, k, j);
    }
    return found;
}

TEST(StarTriangulation, removes_a_vertex_wherever_its_neighbours_can_be_joined)
{
    int found = 0;
    int blocked = 0;
    for (const auto& [name, polygons] : small_surfaces()) {
        const TriangleMesh triangles(polygons);
        const Topology topology = topology_of(polygons);
        StarTriangulation star;
        for (std::uint64_t seed = 10; seed < 16; ++seed) {
            SCOPED_TRACE(name + " seed " + std::to_string(seed));
            Random random(seed);
            EditableMesh mesh(triangles);
            for (int step = 0; step < 80; ++step) {
                const Index h = random_halfedge(mesh, random);
                if (mesh.can_flip(h)) {
                    mesh.flip(h);
                }
                for (Index v = 0; v < mesh.vertex_capacity(); ++v) {
                    if (!mesh.has_vertex(v) || mesh.degree(v) > 9 || mesh.degree(v) < 3) {
                        continue;
                    }
                    const bool can = star.find(mesh, triangles.positions(), v, true);
                    const bool tetrahedron = topology == Topology{2, 0} && mesh.vertex_count() == 4;
                    EXPECT_EQ(
                        can, !tetrahedron && can_fill(mesh, star.ring(), mesh.is_boundary_vertex(v),
                                                      0, star.ring().size() - 1));
                    // A vertex of a triangle mesh that can be collapsed can be removed.
                    bool collapsible = false;
                    for (const Index w : star.ring()) {
                        collapsible = collapsible || mesh.can_collapse(v, w);
                    }
                    EXPECT_TRUE(can || !collapsible);
                    // Whatever passes with the test of shapes passes without.
                    EXPECT_TRUE(can || !star.find(mesh, triangles.positions(), v, false));
                    ++(can ? found : blocked);
                }
                const auto v = static_cast<Index>(random.below(mesh.vertex_capacity()));
                if (step % 8 == 7 && mesh.has_vertex(v) &&
                    star.find(mesh, triangles.positions(), v, true)) {
                    const auto ring = star.ring();
                    star.apply(mesh, v);
                    EXPECT_FALSE(mesh.has_vertex(v));
                    expect_consistent(mesh);
                    ASSERT_EQ(topology_of(compacted(faces_of(mesh), mesh.vertex_capacity())),
                              topology);
                }
            }
        }
    }
    EXPECT_GT(found, 1000);
    EXPECT_GT(blocked, 100);
}

TEST(StarTriangulation, prefers_the_short_diagonals_of_flat_stars)
{
    // An ellipse around vertex 0: of all triangulations the one of least penalty has short
    // diagonals across.
    PolygonMesh wheel = zoo::wheel(8);
    for (Vec3& p : wheel.positions) {
        p.y() *= 0.3;
    }
    const TriangleMesh triangles(wheel);
    EditableMesh mesh(triangles);
    StarTriangulation star;
    ASSERT_TRUE(star.find(mesh, triangles.positions(), 0, false));
    star.apply(mesh, 0);
    double longest = 0;
    double area = 0;
    for (const auto& face : faces_of(mesh)) {
        const Vec3 a = triangles.position(face[0]);
        const Vec3 b = triangles.position(face[1]);
        const Vec3 c = triangles.position(face[2]);
        longest = std::max({longest, (b - a).norm(), (c - b).norm(), (a - c).norm()});
        EXPECT_GT((b - a).cross(c - a).z(), 0);
        area += (b - a).cross(c - a).z() / 2;
    }
    EXPECT_LT(longest, 1.1);
    EXPECT_NEAR(area, 0.3 * 2 * std::sqrt(2.0), 1e-12);
}

TEST(Decimation, simplified_meshes_keep_their_topology_and_only_lose_vertices)
{
    for (const auto& [name, polygons] : zoo::targets()) {
        SCOPED_TRACE(name);
        const TriangleMesh triangles(polygons);
        const Topology topology = topology_of(polygons);
        const Index wanted = std::max<Index>(30, triangles.vertex_count() / 4);
        const SimplifiedMesh simple = simplified(triangles, wanted);
        EXPECT_EQ(topology_of(simple.mesh), topology);
        EXPECT_GE(simple.mesh.vertex_count(), std::min(wanted, triangles.vertex_count()));
        EXPECT_LE(simple.mesh.vertex_count(), std::max(wanted, 1 + triangles.vertex_count() / 2));
        ASSERT_EQ(simple.vertices.size(), simple.mesh.positions.size());
        EXPECT_TRUE(std::is_sorted(simple.vertices.begin(), simple.vertices.end()));
        for (Index v = 0; v < simple.vertices.size(); ++v) {
            EXPECT_EQ(simple.mesh.positions[v], triangles.position(simple.vertices[v]));
        }
        const SimplifiedMesh again = simplified(triangles, wanted);
        EXPECT_EQ(again.vertices, simple.vertices);
        EXPECT_EQ(again.mesh.corners, simple.mesh.corners);
    }
}

TEST(Decimation, kept_vertices_stay_and_more_runs_go_on_where_the_last_ended)
{
    const TriangleMesh triangles(zoo::bumpy_sphere(3, 7));
    std::vector<bool> kept(triangles.vertex_count(), false);
    for (Index v = 0; v < kept.size(); v += 40) {
        kept[v] = true;
    }
    const auto count = static_cast<Index>(std::count(kept.begin(), kept.end(), true));
    Decimation at_once(triangles, kept);
    at_once.run(count, DecimationEffort::any_shape);
    Decimation in_steps(triangles, kept);
    for (Index n = triangles.vertex_count(); n >= count; --n) {
        in_steps.run(n, DecimationEffort::any_shape);
        EXPECT_EQ(in_steps.mesh().vertex_count(), n);
    }
    for (Index v = 0; v < kept.size(); ++v) {
        EXPECT_EQ(at_once.mesh().has_vertex(v), kept[v]);
    }
    EXPECT_EQ(faces_of(at_once.mesh()), faces_of(in_steps.mesh()));
    const DecimationCounts& counts = at_once.counts();
    EXPECT_EQ(counts.collapses + counts.after_flips + counts.in_any_shape,
              triangles.vertex_count() - count);
}

TEST(Decimation, a_flat_disk_keeps_its_outline_and_area)
{
    const TriangleMesh triangles(zoo::grid_disk(12, 12));
    const SimplifiedMesh simple = simplified(triangles, 4);
    EXPECT_EQ(simple.mesh.vertex_count(), 4U);
    double area = 0;
    for (Index f = 0; f < simple.mesh.face_count(); ++f) {
        const auto face = simple.mesh.face(f);
        const Vec3& a = simple.mesh.positions[face[0]];
        area +=
            (simple.mesh.positions[face[1]] - a).cross(simple.mesh.positions[face[2]] - a).z() / 2;
    }
    EXPECT_NEAR(area, 1, 1e-12);
}

TEST(Decimation, a_simplified_sphere_stays_near_the_sphere)
{
    const TriangleMesh triangles(zoo::icosphere(4));
    const SimplifiedMesh simple = simplified(triangles, 200);
    ASSERT_EQ(simple.mesh.vertex_count(), 200U);
    double volume = 0;
    for (Index f = 0; f < simple.mesh.face_count(); ++f) {
        const auto face = simple.mesh.face(f);
        const Vec3& a = simple.mesh.positions[face[0]];
        const Vec3& b = simple.mesh.positions[face[1]];
        const Vec3& c = simple.mesh.positions[face[2]];
        // All faces look outwards.
        EXPECT_GT(a.dot(b.cross(c)), 0);
        EXPECT_GE(triangle_quality(a, b, c), kNeedle);
        volume += a.dot(b.cross(c)) / 6;
    }
    // A regular polyhedron of so many vertices has about 4.05.
    EXPECT_GT(volume, 3.85);
    EXPECT_LT(volume, 4.19);
}

TEST(Decimation, meshes_without_area_or_extent_do_no_harm)
{
    for (const Vec3& scale : {Vec3(1, 1, 0), Vec3(1, 0, 0), Vec3(0, 0, 0), Vec3(1, 1e-30, 1e-170),
                              Vec3(1e60, 1e-60, 1), Vec3(1e-60, 1e-60, 1e-60)}) {
        for (const PolygonMesh& shape :
             {zoo::bumpy_sphere(3, 1), zoo::torus(12, 8), zoo::annulus(9, 4)}) {
            PolygonMesh flat = shape;
            for (Vec3& p : flat.positions) {
                p = p.cwiseProduct(scale);
            }
            const TriangleMesh triangles(flat);
            Decimation decimation(triangles);
            decimation.run(12, DecimationEffort::any_shape);
            EXPECT_LE(decimation.mesh().vertex_count(), 14U);
            expect_consistent(decimation.mesh());
            EXPECT_EQ(topology_of(remaining_mesh(decimation, flat.positions).mesh),
                      topology_of(shape));
        }
    }
}

}  // namespace
}  // namespace layout_embedding
