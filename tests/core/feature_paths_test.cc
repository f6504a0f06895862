#include <cmath>
#include <gtest/gtest.h>
#include <string>

#include "apps/embed_job.hh"
#include "apps/landmark_drag.hh"
#include "base/random.hh"
#include "embedding/realisation.hh"
#include "embedding/weak_to_normal_form.hh"
#include "embedding_checks.hh"
#include "instances.hh"
#include "patches/patch_shape.hh"
#include "surface/path_metric.hh"
#include "zoo.hh"

// Paths that follow sharp edges of the target, in every shape.

namespace layout_embedding {
namespace {

constexpr double kRounding = 1e-9;

/// The cube with corners at (+-1, +-1, +-1), in quads.
PolygonMesh wide_cube()
{
    PolygonMesh mesh = zoo::cube();
    for (Vec3& p : mesh.positions) {
        p *= std::sqrt(3.0);
    }
    return mesh;
}

/// Whether a straight segment lies on an edge of that cube.
bool on_edge_of_cube(const Vec3& a, const Vec3& b)
{
    int sides = 0;
    for (int k = 0; k < 3; ++k) {
        sides += std::abs(a[k]) > 1 - kRounding && std::abs(a[k] - b[k]) < kRounding ? 1 : 0;
    }
    return sides >= 2;
}

struct OnEdges {
    double length = 0;
    double all = 0;
    double share() const { return length / all; }
    void add(const Vec3& a, const Vec3& b)
    {
        all += (b - a).norm();
        length += on_edge_of_cube(a, b) ? (b - a).norm() : 0;
    }
};

EmbedJob embedded(const EmbeddingProblem& problem, double discount)
{
    EmbedOptions options;
    options.metric.feature_discount = discount;
    options.shape = PathShape::even;
    options.look_for_doubts = false;
    EmbedJob job(problem, options);
    while (job.step()) {
    }
    EXPECT_TRUE(job.result().refined.has_value()) << job.error().message;
    return job;
}

const RefinedMesh& reshaped(EmbedJob& job, PathShape shape)
{
    EXPECT_TRUE(job.reshape(shape));
    while (job.step()) {
    }
    EXPECT_TRUE(job.result().refined.has_value()) << job.error().message;
    test::expect_valid(job.problem(), *job.graph(), job.result().weak, *job.result().refined);
    return *job.result().refined;
}

OnEdges chains_on_edges(const RefinedMesh& refined)
{
    OnEdges sum;
    for (const std::vector<Index>& chain : refined.chains) {
        for (std::size_t i = 1; i < chain.size(); ++i) {
            sum.add(refined.positions[chain[i - 1]], refined.positions[chain[i]]);
        }
    }
    return sum;
}

OnEdges weak_paths_on_edges(const EmbedJob& job)
{
    OnEdges sum;
    const PathGraph& graph = *job.graph();
    for (const WeakPath& path : job.result().weak.paths) {
        for (const Index dart : path.darts) {
            sum.add(graph.position(graph.tail(dart)), graph.position(graph.head(dart)));
        }
    }
    return sum;
}

TEST(FeaturePaths, stay_on_sharp_edges_where_the_optimum_ran_along_them)
{
    PolygonMesh target = zoo::triangulated(wide_cube());
    for (int i = 0; i < 4; ++i) {
        target = zoo::subdivided(target);
    }
    OnEdges without;
    OnEdges weak;
    OnEdges of_shapes[3];
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        SCOPED_TRACE(seed);
        const PolygonMesh layout = seed % 3 == 0 ? zoo::octahedron() : wide_cube();
        const EmbeddingProblem problem =
            test::problem_of(layout, target, zoo::displaced_landmarks(layout, target, 0.2, seed));
        EmbedJob job = embedded(problem, 0.5);
        const OnEdges of_weak = weak_paths_on_edges(job);
        weak.length += of_weak.length;
        weak.all += of_weak.all;
        double even_length = 0;
        for (const PathShape shape : {PathShape::even, PathShape::shortened, PathShape::fair}) {
            const OnEdges of_chains = chains_on_edges(reshaped(job, shape));
            OnEdges& sum = of_shapes[static_cast<std::size_t>(shape)];
            sum.length += of_chains.length;
            sum.all += of_chains.all;
            if (shape == PathShape::even) {
                even_length = of_chains.all;
            } else if (shape == PathShape::shortened) {
                EXPECT_LE(of_chains.all, even_length);
            }
        }
        EmbedJob plain = embedded(problem, 0);
        without.length += chains_on_edges(reshaped(plain, PathShape::shortened)).length;
        without.all += chains_on_edges(*plain.result().refined).all;
    }
    EXPECT_GT(weak.share(), 0.3);
    EXPECT_LT(without.share(), 0.5 * weak.share());
    for (const OnEdges& chains : of_shapes) {
        EXPECT_GT(chains.length, 0.93 * weak.length);
    }
}

TEST(FeaturePaths, stay_on_curved_ones_that_a_shorter_way_leaves)
{
    // A cylinder: the layout's edges around its ends follow the rims, which nearly halves what they
    // cost, though the way across the flat ends is shorter.
    constexpr Index kSides = 32;
    PolygonMesh target = zoo::triangulated(zoo::prism(kSides));
    for (int i = 0; i < 2; ++i) {
        target = zoo::subdivided(target);
    }
    std::vector<Index> landmarks;
    for (Index i = 0; i < 8; ++i) {
        landmarks.push_back(i < 4 ? i * kSides / 4 : kSides + (i - 4) * kSides / 4);
    }
    EmbedJob job = embedded(test::problem_of(zoo::prism(4), target, landmarks), 0.5);
    const Layout& layout = *job.problem().layout;
    const double arc = (target.positions[0] - target.positions[1]).norm() * kSides / 4;
    for (const PathShape shape : {PathShape::even, PathShape::shortened, PathShape::fair}) {
        SCOPED_TRACE(static_cast<int>(shape));
        const RefinedMesh& refined = reshaped(job, shape);
        for (Index e = 0; e < layout.edge_count(); ++e) {
            if ((layout.tail(2 * e) < 4) == (layout.head(2 * e) < 4)) {
                EXPECT_NEAR(chain_length(refined, refined.chains[e]), arc, 1e-9);
            }
        }
    }
    EmbedJob plain = embedded(job.problem(), 0);
    const RefinedMesh& refined = reshaped(plain, PathShape::shortened);
    for (Index e = 0; e < layout.edge_count(); ++e) {
        if ((layout.tail(2 * e) < 4) == (layout.head(2 * e) < 4)) {
            EXPECT_LT(chain_length(refined, refined.chains[e]), 0.98 * arc);
        }
    }
}

OnEdges lines_on_edges(const Polylines& lines)
{
    OnEdges sum;
    for (std::size_t line = 1; line < lines.offsets.size(); ++line) {
        for (Index i = lines.offsets[line - 1] + 1; i < lines.offsets[line]; ++i) {
            sum.add(lines.points[i - 1], lines.points[i]);
        }
    }
    return sum;
}

TEST(FeaturePaths, stay_on_sharp_edges_while_a_landmark_is_dragged)
{
    PolygonMesh target = zoo::triangulated(wide_cube());
    for (int i = 0; i < 4; ++i) {
        target = zoo::subdivided(target);
    }
    const PolygonMesh layout = wide_cube();
    const EmbeddingProblem problem =
        test::problem_of(layout, target, zoo::displaced_landmarks(layout, target, 0.2, 2));
    const EmbedJob job = embedded(problem, 0.5);
    const EmbedJob plain = embedded(problem, 0);
    LandmarkDrag drag(problem, *job.graph(), job.edge_costs(), job.result().weak, 3);
    LandmarkDrag plain_drag(problem, *plain.graph(), plain.edge_costs(), plain.result().weak, 3);
    Random random(8);
    OnEdges of_drag;
    OnEdges of_plain_drag;
    OnEdges of_jobs;
    int moves = 0;
    for (Index place = problem.landmarks[3]; moves < 6;) {
        // To a neighbour, as a hand leads it.
        Index halfedge = problem.target->outgoing(place);
        for (std::uint64_t turns = random.below(4); turns > 0; --turns) {
            halfedge = problem.target->rotated_ccw(halfedge);
        }
        place = problem.target->head(halfedge);
        if (!drag.move_to(place) || !plain_drag.move_to(place)) {
            continue;
        }
        ++moves;
        const auto form =
            normal_form_of(drag.problem(), *job.graph(), drag.embedding(), job.edge_costs());
        ASSERT_TRUE(form.ok()) << form.error().message;
        const auto refined = cut_along(*problem.layout, *form);
        ASSERT_TRUE(refined.ok()) << refined.error().message;
        test::expect_valid(drag.problem(), *job.graph(), drag.embedding(), *refined);

        EmbedJob anew = embedded(drag.problem(), 0.5);
        EXPECT_GE(drag.cost(), anew.result().lower_bound * (1 - 1e-12));
        EXPECT_LE(drag.cost(), 1.05 * anew.result().cost);
        const auto add = [](OnEdges& sum, const OnEdges& one) {
            sum.length += one.length;
            sum.all += one.all;
        };
        add(of_drag, lines_on_edges(drag.paths()));
        add(of_plain_drag, lines_on_edges(plain_drag.paths()));
        add(of_jobs, chains_on_edges(reshaped(anew, PathShape::shortened)));
    }
    EXPECT_GT(of_jobs.share(), 0.3);
    EXPECT_GT(of_drag.length, 0.95 * of_jobs.length);
    EXPECT_LT(of_plain_drag.share(), 0.5 * of_drag.share());
}

TEST(FeaturePaths, every_embedding_in_such_a_metric_is_valid_in_every_shape)
{
    // Rough targets, on which many edges are sharp and paths share them.
    int on_edges = 0;
    for (const auto& [name, problem] : test::random_instances(71, 24)) {
        SCOPED_TRACE(name);
        EmbedOptions options;
        options.metric.feature_discount = 0.9;
        options.work_limit = 50'000;
        options.algorithm = Algorithm::schreiner;
        EmbedJob job(problem, options);
        while (job.step()) {
        }
        if (!job.result().refined) {
            continue;  // a heuristic in a dead end
        }
        const std::vector<double> costs = feature_costs(*problem.target, 0.9);
        for (const PathShape shape : {PathShape::even, PathShape::shortened, PathShape::fair}) {
            const RefinedMesh& refined = reshaped(job, shape);
            for (const std::vector<Index>& chain : refined.chains) {
                for (std::size_t i = 1; i < chain.size(); ++i) {
                    const Index a = chain[i - 1];
                    const Index b = chain[i];
                    const Index vertices = problem.target->vertex_count();
                    const Index edge =
                        a < vertices && b < vertices ? problem.target->edge_between(a, b) : kNone;
                    on_edges += edge != kNone && costs[edge] < 1 ? 1 : 0;
                }
            }
        }
    }
    EXPECT_GT(on_edges, 500);
}

}  // namespace
}  // namespace layout_embedding
