#include "apps/boundary_paths.hh"

#include <algorithm>
#include <gtest/gtest.h>

#include "apps/embed_job.hh"
#include "base/random.hh"
#include "embedding_checks.hh"
#include "instances.hh"
#include "patches/patch_shape.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

/// The boundary vertices of a target with one loop, with the hole on the right.
std::vector<Index> boundary_of(const TriangleMesh& target)
{
    Index start = 0;
    while (!target.is_boundary_vertex(start)) {
        ++start;
    }
    std::vector<Index> loop{start};
    while (target.head(target.outgoing(loop.back())) != start) {
        loop.push_back(target.head(target.outgoing(loop.back())));
    }
    return loop;
}

/// The layout's boundary vertices in the order of its loop, with the outside on the right.
std::vector<Index> boundary_of(const Layout& layout)
{
    Index h = 0;
    while (layout.face(h) == kNone || layout.face(Layout::twin(h)) != kNone) {
        ++h;
    }
    std::vector<Index> loop;
    const Index start = h;
    do {
        loop.push_back(layout.tail(h));
        for (Index next = 0; next < 2 * layout.edge_count(); ++next) {
            if (layout.tail(next) == layout.head(h) && layout.face(next) != kNone &&
                layout.face(Layout::twin(next)) == kNone) {
                h = next;
                break;
            }
        }
    } while (h != start);
    return loop;
}

EmbeddingProblem problem_with(const PolygonMesh& layout_mesh, const PolygonMesh& target_mesh,
                              std::size_t on_boundary, std::uint64_t seed)
{
    const Layout layout = Layout::from_polygons(layout_mesh, "the layout").value();
    const TriangleMesh target(target_mesh);
    const std::vector<Index> layout_loop = boundary_of(layout);
    const std::vector<Index> target_loop = boundary_of(target);
    Random random(seed);
    std::vector<Index> landmarks(layout.vertex_count(), kNone);
    std::vector<bool> used(target.vertex_count(), false);
    const std::size_t shift = random.below(target_loop.size());
    for (std::size_t i = 0; i < std::min(on_boundary, layout_loop.size()); ++i) {
        const std::size_t place =
            (shift + i * target_loop.size() / layout_loop.size()) % target_loop.size();
        landmarks[layout_loop[i]] = target_loop[place];
        used[target_loop[place]] = true;
    }
    for (Index& landmark : landmarks) {
        while (landmark == kNone) {
            const Index v = static_cast<Index>(random.below(target.vertex_count()));
            if (!used[v] && !target.is_boundary_vertex(v)) {
                landmark = v;
                used[v] = true;
            }
        }
    }
    return test::problem_of(layout_mesh, target_mesh, landmarks);
}

EmbedResult embed(EmbedJob& job)
{
    while (job.step()) {
    }
    EXPECT_EQ(job.error().message, "");
    return job.result();
}

TEST(BoundaryPaths, edges_run_on_the_boundary_and_all_others_stay_optimal)
{
    int followed = 0;
    int longer = 0;
    for (const PolygonMesh& target :
         {zoo::grid_disk(6, 6), zoo::hemisphere(3), zoo::grid_disk(9, 4)}) {
        for (const PolygonMesh& layout :
             {zoo::polygon(4), zoo::wheel(4), zoo::wheel(5), zoo::quad_grid(2, 1)}) {
            for (std::uint64_t seed = 1; seed <= 3; ++seed) {
                for (const std::size_t on_boundary : {std::size_t{3}, std::size_t{100}}) {
                    SCOPED_TRACE(seed);
                    const EmbeddingProblem problem =
                        problem_with(layout, target, on_boundary, seed);
                    EmbedOptions options;
                    options.gap = 0;
                    options.boundary_is_followed = true;
                    EmbedJob job(problem, options);
                    const EmbedResult result = embed(job);
                    if (result.status == EmbedStatus::infeasible ||
                        result.status == EmbedStatus::none_found) {
                        continue;
                    }
                    ASSERT_TRUE(result.refined.has_value());
                    EXPECT_EQ(result.status, EmbedStatus::optimal);
                    const auto paths = boundary_paths(problem, *job.graph());
                    ASSERT_TRUE(paths.ok());
                    EXPECT_GE(paths->size(), 2U);
                    // What is left to the search are the other edges in their best classes: none
                    // of them is in the way of a path along the boundary.
                    options.boundary_is_followed = false;
                    EmbedJob free_job(problem, options);
                    const EmbedResult unbound = embed(free_job);
                    ASSERT_TRUE(unbound.refined.has_value());
                    EXPECT_EQ(unbound.status, EmbedStatus::optimal);
                    EXPECT_GE(result.exact_cost, unbound.exact_cost);
                    longer += result.exact_cost > unbound.exact_cost ? 1 : 0;
                    for (const PathShape shape :
                         {PathShape::even, PathShape::shortened, PathShape::fair}) {
                        ASSERT_TRUE(job.reshape(shape));
                        embed(job);
                        ASSERT_TRUE(job.result().refined.has_value());
                        test::expect_strands(problem, *job.graph(), job.result().weak);
                        test::expect_valid(problem, *job.graph(), job.result().weak,
                                           *job.result().refined);
                        EXPECT_EQ(test::total_length(*job.graph(), job.result().weak),
                                  result.exact_cost);
                        for (const BoundaryPath& path : *paths) {
                            std::vector<Index> chain =
                                job.result().refined->chains[path.layout_edge];
                            EXPECT_TRUE(std::includes(
                                chain.begin(), chain.end(), path.vertices.begin(),
                                path.vertices.end(), [&](Index a, Index b) {
                                    const auto place = [&](Index v) {
                                        return std::find(chain.begin(), chain.end(), v);
                                    };
                                    return place(a) < place(b);
                                }));
                            double length = 0;
                            for (std::size_t i = 1; i < path.vertices.size(); ++i) {
                                length += (problem.target->position(path.vertices[i]) -
                                           problem.target->position(path.vertices[i - 1]))
                                              .norm();
                            }
                            EXPECT_NEAR(chain_length(*job.result().refined, chain), length,
                                        1e-12 * length);
                            ++followed;
                        }
                    }
                }
            }
        }
    }
    EXPECT_GT(followed, 300);
    EXPECT_GT(longer, 10);
}

TEST(BoundaryPaths, landmarks_in_the_way_are_refused)
{
    const PolygonMesh target = zoo::grid_disk(6, 6);
    const std::vector<Index> loop = boundary_of(TriangleMesh(target));
    const PolygonMesh layout_mesh = zoo::polygon(4);
    const Layout layout = Layout::from_polygons(layout_mesh, "the layout").value();
    const std::vector<Index> layout_loop = boundary_of(layout);
    std::vector<Index> landmarks(4);
    for (std::size_t i = 0; i < 4; ++i) {
        landmarks[layout_loop[i]] = loop[3 * (i == 1 ? 2 : i == 2 ? 1 : i)];
    }
    EmbedOptions options;
    options.boundary_is_followed = true;
    EmbedJob job(test::problem_of(layout_mesh, target, landmarks), options);
    while (job.step()) {
    }
    EXPECT_EQ(job.result().status, EmbedStatus::failed);
    EXPECT_EQ(job.error().code, ErrorCode::invalidOption);
    EXPECT_FALSE(job.error().details.empty());
}

TEST(BoundaryPaths, only_the_exact_method_follows_the_boundary)
{
    EmbedOptions options;
    options.boundary_is_followed = true;
    options.algorithm = Algorithm::branch_and_bound;
    EmbedJob job(problem_with(zoo::wheel(4), zoo::grid_disk(6, 6), 100, 1), options);
    while (job.step()) {
    }
    EXPECT_EQ(job.error().code, ErrorCode::invalidOption);
}

}  // namespace
}  // namespace layout_embedding
