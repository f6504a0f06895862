#include "layout/layout.hh"

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>

#include "layout/embedding_problem.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

Layout make_layout(const PolygonMesh& mesh)
{
    Result<Layout> layout = Layout::from_polygons(mesh, "the layout");
    EXPECT_TRUE(layout.ok()) << layout.error().message;
    return std::move(layout.value());
}

Result<EmbeddingProblem> problem(const PolygonMesh& layout, const PolygonMesh& target,
                                 std::vector<Index> landmarks)
{
    return make_problem(std::make_shared<Layout>(make_layout(layout)),
                        std::make_shared<TriangleMesh>(target), std::move(landmarks));
}

void expect_error(const Result<EmbeddingProblem>& result, ErrorCode code, const std::string& words)
{
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(error_info(result.error().code).name, error_info(code).name);
    EXPECT_NE(result.error().message.find(words), std::string::npos) << result.error().message;
}

TEST(Layout, every_halfedge_is_in_one_face_or_boundary_loop)
{
    for (const auto& [name, mesh] : zoo::layouts()) {
        SCOPED_TRACE(name);
        const Layout layout = make_layout(mesh);
        ASSERT_EQ(layout.face_count(), mesh.face_count());
        std::vector<int> met(2 * layout.edge_count(), 0);
        for (Index f = 0; f < layout.face_count(); ++f) {
            const auto halfedges = layout.face_halfedges(f);
            ASSERT_EQ(halfedges.size(), mesh.face(f).size());
            for (std::size_t i = 0; i < halfedges.size(); ++i) {
                // The face's vertices in the order of the file.
                EXPECT_EQ(layout.tail(halfedges[i]), mesh.face(f)[i]);
                EXPECT_EQ(layout.head(halfedges[i]), mesh.face(f)[(i + 1) % halfedges.size()]);
                EXPECT_EQ(layout.face(halfedges[i]), f);
                ++met[halfedges[i]];
            }
        }
        for (const auto& loop : layout.boundary_loops()) {
            for (std::size_t i = 0; i < loop.size(); ++i) {
                EXPECT_EQ(layout.face(loop[i]), kNone);
                EXPECT_EQ(layout.head(loop[i]), layout.tail(loop[(i + 1) % loop.size()]));
                ++met[loop[i]];
            }
        }
        EXPECT_EQ(std::count(met.begin(), met.end(), 1), static_cast<long>(met.size()));
    }
}

TEST(Layout, cyclic_orders_turn_counter_clockwise_through_the_faces)
{
    for (const auto& [name, mesh] : zoo::layouts()) {
        SCOPED_TRACE(name);
        const Layout layout = make_layout(mesh);
        Index halfedges = 0;
        for (Index v = 0; v < layout.vertex_count(); ++v) {
            const auto outgoing = layout.outgoing(v);
            halfedges += static_cast<Index>(outgoing.size());
            for (Index i = 0; i < outgoing.size(); ++i) {
                const Index h = outgoing[i];
                const Index following = outgoing[(i + 1) % outgoing.size()];
                ASSERT_EQ(layout.tail(h), v);
                ASSERT_EQ(layout.rank(h), i);
                // The face between two neighbours lies left of the first, right of the second.
                ASSERT_EQ(layout.face(h), layout.face(Layout::twin(following)));
                if (layout.face(h) != kNone) {
                    // In that face, the second's twin is followed by the first.
                    const auto face = layout.face_halfedges(layout.face(h));
                    const auto place = std::find(face.begin(), face.end(), Layout::twin(following));
                    ASSERT_NE(place, face.end());
                    ASSERT_EQ(place + 1 == face.end() ? face.front() : *(place + 1), h);
                }
                // Only behind the last one may be the gap.
                ASSERT_TRUE(layout.face(h) != kNone || i + 1 == outgoing.size());
            }
            EXPECT_EQ(layout.is_boundary_vertex(v), layout.face(outgoing.back()) == kNone);
        }
        EXPECT_EQ(halfedges, 2 * layout.edge_count());
    }
}

TEST(Layout, counts_are_those_of_the_topology)
{
    const auto euler = [](const PolygonMesh& mesh) {
        return make_layout(mesh).euler_characteristic();
    };
    const auto loops = [](const PolygonMesh& mesh) {
        return make_layout(mesh).boundary_loops().size();
    };
    EXPECT_EQ(euler(zoo::cube()), 2);
    EXPECT_EQ(make_layout(zoo::cube()).edge_count(), 12U);
    EXPECT_EQ(euler(zoo::polygon_hull(20, 9)), 2);
    EXPECT_EQ(euler(zoo::quad_torus(3, 3)), 0);
    EXPECT_EQ(euler(zoo::slab(2, 0)), -2);
    EXPECT_EQ(euler(zoo::polygon(7)), 1);
    EXPECT_EQ(loops(zoo::polygon(7)), 1U);
    EXPECT_EQ(euler(zoo::quad_ring(5)), 0);
    EXPECT_EQ(loops(zoo::quad_ring(5)), 2U);
}

TEST(Layout, broken_ones_are_refused_in_the_words_of_the_validation)
{
    for (const auto& broken : zoo::broken_meshes()) {
        if (broken.kind == SurfaceKind::layout) {
            const Result<Layout> layout = Layout::from_polygons(broken.mesh, "the layout");
            ASSERT_FALSE(layout.ok()) << broken.name;
            EXPECT_EQ(layout.error().code, broken.code);
            EXPECT_EQ(layout.error().message.rfind("the layout ", 0), 0U);
        }
    }
}

TEST(EmbeddingProblem, landmarks_must_be_different_target_vertices_one_per_layout_vertex)
{
    const PolygonMesh target = zoo::icosphere(1);
    EXPECT_TRUE(problem(zoo::tetrahedron(), target, {5, 0, 41, 7}).ok());
    expect_error(problem(zoo::tetrahedron(), target, {5, 0, 41}), ErrorCode::landmarkCount,
                 "3 landmarks for a layout of 4 vertices");
    expect_error(problem(zoo::tetrahedron(), target, {5, 0, 42, 7}), ErrorCode::landmarkOutOfRange,
                 "landmark 2 is vertex 42 but the target has only vertices 0 to 41");
    expect_error(problem(zoo::tetrahedron(), target, {5, 7, 41, 7}), ErrorCode::duplicateLandmark,
                 "landmarks 1 and 3 are both target vertex 7");
}

TEST(EmbeddingProblem, surfaces_of_different_type_are_refused_with_both_characteristics)
{
    const auto landmarks = [](const PolygonMesh& layout, const PolygonMesh& target) {
        return zoo::random_landmarks(target, layout.vertex_count(), 1);
    };
    const auto check = [&](const PolygonMesh& layout, const PolygonMesh& target) {
        return problem(layout, target, landmarks(layout, target));
    };
    expect_error(check(zoo::cube(), zoo::torus(8, 6)), ErrorCode::topologyMismatch,
                 "the layout has Euler characteristic 2 (genus 0, no boundary) but the target has "
                 "Euler characteristic 0 (genus 1, no boundary)");
    expect_error(check(zoo::cube(), zoo::grid_disk(8, 8)), ErrorCode::topologyMismatch,
                 "but the target has Euler characteristic 1 (genus 0, 1 boundary loop)");
    expect_error(check(zoo::wheel(5), zoo::annulus(12, 4)), ErrorCode::topologyMismatch,
                 "2 boundary loops");
    expect_error(check(zoo::quad_ring(4), zoo::grid_disk(8, 8)), ErrorCode::topologyMismatch,
                 "the layout has Euler characteristic 0 (genus 0, 2 boundary loops)");
    // A layout with boundary fits a closed target of its genus, and one with the same holes.
    EXPECT_TRUE(check(zoo::wheel(5), zoo::icosphere(2)).ok());
    EXPECT_TRUE(check(zoo::wheel(5), zoo::grid_disk(8, 8)).ok());
    EXPECT_TRUE(check(zoo::quad_ring(4), zoo::annulus(12, 4)).ok());
    EXPECT_TRUE(check(zoo::quad_torus(3, 3), zoo::torus(8, 6)).ok());
    EXPECT_TRUE(check(zoo::slab(2, 0), zoo::slab(2, 1)).ok());
    expect_error(check(zoo::quad_torus(3, 3), zoo::slab(2, 1)), ErrorCode::topologyMismatch,
                 "genus 2");
}

TEST(EmbeddingProblem, inner_layout_vertices_stay_off_the_boundary_of_the_target)
{
    const PolygonMesh target = zoo::grid_disk(4, 4);  // vertex 5 i + j at (i, j)
    expect_error(problem(zoo::wheel(3), target, {2, 6, 7, 11}), ErrorCode::landmarkOnBoundary,
                 "landmark 0 is target vertex 2");
    EXPECT_TRUE(problem(zoo::wheel(3), target, {12, 0, 20, 23}).ok());
}

}  // namespace
}  // namespace layout_embedding
