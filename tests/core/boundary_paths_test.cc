#include "apps/boundary_paths.hh"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>

#include "all_selections.hh"
#include "apps/embed_job.hh"
#include "base/random.hh"
#include "embedding_checks.hh"
#include "instances.hh"
#include "patches/patch_shape.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

/// Cycles of vertices along halfedges that have no face on their right, as `next` leads from one
/// vertex to another; kNone for a vertex that is not on the boundary.
std::vector<std::vector<Index>> cycles(const std::vector<Index>& next)
{
    std::vector<std::vector<Index>> loops;
    std::vector<bool> seen(next.size(), false);
    for (Index start = 0; start < next.size(); ++start) {
        if (next[start] == kNone || seen[start]) {
            continue;
        }
        loops.emplace_back();
        for (Index v = start; !seen[v]; v = next[v]) {
            seen[v] = true;
            loops.back().push_back(v);
        }
    }
    return loops;
}

std::vector<std::vector<Index>> boundary_loops(const Layout& layout)
{
    std::vector<Index> next(layout.vertex_count(), kNone);
    for (Index h = 0; h < 2 * layout.edge_count(); ++h) {
        if (layout.face(h) != kNone && layout.face(Layout::twin(h)) == kNone) {
            next[layout.tail(h)] = layout.head(h);
        }
    }
    return cycles(next);
}

std::vector<std::vector<Index>> boundary_loops(const TriangleMesh& target)
{
    std::vector<Index> next(target.vertex_count(), kNone);
    for (Index v = 0; v < target.vertex_count(); ++v) {
        if (target.is_boundary_vertex(v)) {
            next[v] = target.head(target.outgoing(v));
        }
    }
    return cycles(next);
}

EmbeddingProblem problem_with(const PolygonMesh& layout_mesh, const PolygonMesh& target_mesh,
                              std::size_t on_boundary, std::uint64_t seed)
{
    const Layout layout = Layout::from_polygons(layout_mesh, "the layout").value();
    const TriangleMesh target(target_mesh);
    const std::vector<Index> layout_loop = boundary_loops(layout)[0];
    const std::vector<Index> target_loop = boundary_loops(target)[0];
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

/// Landmarks at random: of each layout boundary loop all, or all but one, in order on a boundary
/// loop of the target, all others inside.
std::vector<Index> random_landmarks(const PolygonMesh& layout_mesh, const PolygonMesh& target_mesh,
                                    Random& random)
{
    const auto layout = Layout::from_polygons(layout_mesh, "the layout").value();
    const TriangleMesh target(target_mesh);
    std::vector<Index> landmarks(layout.vertex_count(), kNone);
    const auto layout_loops = boundary_loops(layout);
    const auto target_loops = boundary_loops(target);
    for (std::size_t i = 0; i < layout_loops.size(); ++i) {
        const std::vector<Index>& loop = target_loops[i];
        const std::size_t count = layout_loops[i].size() - random.below(2);
        const std::size_t turn = random.below(loop.size());
        std::vector<bool> taken(loop.size(), false);
        for (std::size_t left = count; left > 0;) {
            const std::size_t place = random.below(loop.size());
            left -= taken[place] ? 0 : 1;
            taken[place] = true;
        }
        std::size_t next = 0;
        for (std::size_t k = 0; k < loop.size(); ++k) {
            const std::size_t place = (turn + k) % loop.size();
            if (taken[place]) {
                landmarks[layout_loops[i][next++]] = loop[place];
            }
        }
    }
    const std::vector<Index> inside =
        zoo::random_landmarks(target_mesh, layout.vertex_count(), random.bits());
    std::size_t next = 0;
    for (Index& landmark : landmarks) {
        landmark = landmark == kNone ? inside.at(next++) : landmark;
    }
    return landmarks;
}

TEST(BoundaryPaths, with_them_the_exact_method_finds_the_best_of_all_selections)
{
    struct Ground {
        std::string name;
        PolygonMesh layout;
        PolygonMesh target;
        int count;
    };
    Random random(31);
    int compared = 0;
    int longer = 0;
    int above_root = 0;
    for (const auto& [name, layout, target, count] :
         {Ground{"wheel on a disk", zoo::wheel(4), zoo::grid_disk(5, 5), 12},
          Ground{"two squares on a disk", zoo::quad_grid(2, 1), zoo::grid_disk(6, 4), 12},
          Ground{"wheel on a hemisphere", zoo::wheel(3), zoo::hemisphere(2), 12},
          Ground{"ring on an annulus", zoo::quad_ring(3), zoo::annulus(9, 3), 16}}) {
        for (int i = 0; i < count; ++i) {
            SCOPED_TRACE(name + " #" + std::to_string(i));
            const EmbeddingProblem problem =
                test::problem_of(layout, target, random_landmarks(layout, target, random));
            EmbedOptions options;
            options.gap = 0;
            options.boundary_is_followed = true;
            options.look_for_doubts = false;
            options.work_limit = 2'000'000;
            EmbedJob job(problem, options);
            const EmbedResult result = embed(job);
            if (result.status != EmbedStatus::optimal) {
                continue;  // no first embedding within the limit
            }
            test::expect_valid(problem, *job.graph(), result.weak, *result.refined);
            const auto paths = boundary_paths(problem, *job.graph());
            ASSERT_TRUE(paths.ok());
            test::SelectionRules rules;
            Length alone = 0;
            for (const BoundaryPath& path : *paths) {
                rules.walks[path.layout_edge] = path.darts;
                alone += path.length;
            }
            const test::AllSelections all(problem, result.exact_cost + 1, rules);
            EXPECT_EQ(all.best(), result.exact_cost);
            ++compared;
            EXPECT_GT(result.exact_cost, alone);
            options.boundary_is_followed = false;
            EmbedJob free_job(problem, options);
            longer += embed(free_job).exact_cost < result.exact_cost ? 1 : 0;
            above_root += result.counters.states_created > 0 ? 1 : 0;
        }
    }
    EXPECT_GT(compared, 35);
    EXPECT_GT(longer, 15);
    EXPECT_GT(above_root, 5);
}

TEST(BoundaryPaths, landmarks_in_the_way_are_refused)
{
    const PolygonMesh target = zoo::grid_disk(6, 6);
    const std::vector<Index> loop = boundary_loops(TriangleMesh(target))[0];
    const PolygonMesh layout_mesh = zoo::polygon(4);
    const Layout layout = Layout::from_polygons(layout_mesh, "the layout").value();
    const std::vector<Index> layout_loop = boundary_loops(layout)[0];
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
