#include "apps/landmark_drag.hh"

#include <gtest/gtest.h>

#include "apps/embed_job.hh"
#include "base/random.hh"
#include "embedding/realisation.hh"
#include "embedding/weak_to_normal_form.hh"
#include "embedding_checks.hh"
#include "instances.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

EmbedJob solved(const EmbeddingProblem& problem, Algorithm algorithm = Algorithm::exact)
{
    EmbedOptions options;
    options.algorithm = algorithm;
    options.look_for_doubts = false;
    EmbedJob job(problem, options);
    while (job.step()) {
    }
    return job;
}

/// Vertices of the target from one to the next along edges, as a hand leads a landmark.
std::vector<Index> stroll(const TriangleMesh& target, Index from, int steps, Random& random)
{
    std::vector<Index> places;
    for (int i = 0; i < steps; ++i) {
        std::vector<Index> next;
        for (Index h = 0; h < 3 * target.face_count(); ++h) {
            if (target.tail(h) == from) {
                next.push_back(target.head(h));
            }
        }
        from = next[random.below(next.size())];
        places.push_back(from);
    }
    return places;
}

TEST(LandmarkDrag, gives_a_valid_embedding_at_every_place)
{
    Random random(31);
    int moves = 0;
    int refused = 0;
    for (const auto& [name, problem] : test::random_instances(32, 12)) {
        SCOPED_TRACE(name);
        const EmbedJob job = solved(problem, Algorithm::greedy);
        ASSERT_TRUE(job.result().refined.has_value());
        const Index vertex = static_cast<Index>(random.below(problem.landmarks.size()));
        LandmarkDrag drag(problem, *job.graph(), job.edge_costs(), job.result().weak, vertex);
        for (const Index place : stroll(*problem.target, problem.landmarks[vertex], 8, random)) {
            const std::vector<Index> before = drag.problem().landmarks;
            if (!drag.move_to(place)) {
                EXPECT_EQ(drag.problem().landmarks, before);
                ++refused;
                continue;
            }
            ++moves;
            EXPECT_EQ(drag.problem().landmarks[vertex], place);
            test::expect_strands(drag.problem(), *job.graph(), drag.embedding());
            const auto form = normal_form_of(drag.problem(), *job.graph(), drag.embedding());
            ASSERT_TRUE(form.ok()) << form.error().message;
            const auto refined = cut_along(*problem.layout, *form);
            ASSERT_TRUE(refined.ok()) << refined.error().message;
            test::expect_valid(drag.problem(), *job.graph(), drag.embedding(), *refined);
            const Polylines paths = drag.paths();
            ASSERT_EQ(paths.layout_edges.size(), problem.layout->edge_count());
            for (Index e = 0; e < paths.layout_edges.size(); ++e) {
                const Layout& layout = *problem.layout;
                const auto at = [&](Index v) {
                    return drag.problem().target->position(drag.problem().landmarks[v]);
                };
                EXPECT_EQ(paths.points[paths.offsets[e]], at(layout.tail(2 * e)));
                EXPECT_EQ(paths.points[paths.offsets[e + 1] - 1], at(layout.head(2 * e)));
            }
        }
    }
    EXPECT_GT(moves, 40);
    EXPECT_LT(refused, moves);
}

TEST(LandmarkDrag, stays_near_the_best_embedding_on_a_smooth_target)
{
    const PolygonMesh target = zoo::bumpy_sphere(3, 4);
    const PolygonMesh layout = zoo::cube();
    const auto problem =
        test::problem_of(layout, target, zoo::displaced_landmarks(layout, target, 0, 5));
    const EmbedJob job = solved(problem);
    LandmarkDrag drag(problem, *job.graph(), job.edge_costs(), job.result().weak, 0);
    Random random(6);
    int moves = 0;
    for (const Index place : stroll(*problem.target, problem.landmarks[0], 12, random)) {
        if (drag.move_to(place)) {
            ++moves;
            const EmbedJob anew = solved(drag.problem());
            EXPECT_GE(drag.cost(), anew.result().lower_bound * (1 - 1e-12));
            EXPECT_LE(drag.cost(), 1.05 * anew.result().cost);
        }
    }
    EXPECT_GT(moves, 8);
    // Back where it began, the embedding is the one that was left, or one as good.
    ASSERT_TRUE(drag.move_to(problem.landmarks[0]));
    EXPECT_LE(drag.cost(), 1.02 * job.result().cost);
}

TEST(LandmarkDrag, stays_where_it_is_rather_than_on_another_landmark_or_off_the_rim)
{
    const PolygonMesh disk = zoo::grid_disk(9, 8);
    const PolygonMesh layout = zoo::quad_grid(2, 2);
    const auto problem =
        test::problem_of(layout, disk, zoo::displaced_landmarks(layout, disk, 0, 7));
    const EmbedJob job = solved(problem);
    ASSERT_TRUE(job.result().refined.has_value());
    for (Index v = 0; v < problem.landmarks.size(); ++v) {
        LandmarkDrag drag(problem, *job.graph(), job.edge_costs(), job.result().weak, v);
        const double cost = drag.cost();
        const bool on_rim = problem.target->is_boundary_vertex(problem.landmarks[v]);
        int refused = 0;
        for (Index place = 0; place < problem.target->vertex_count(); ++place) {
            if (problem.target->is_boundary_vertex(place) != on_rim) {
                EXPECT_FALSE(drag.move_to(place));
                ++refused;
            }
        }
        EXPECT_FALSE(drag.move_to(problem.landmarks[(v + 1) % problem.landmarks.size()]));
        EXPECT_FALSE(drag.move_to(problem.target->vertex_count()));
        EXPECT_GT(refused, 0);
        EXPECT_EQ(drag.cost(), cost);
        EXPECT_EQ(drag.problem().landmarks, problem.landmarks);
    }
}

}  // namespace
}  // namespace layout_embedding
