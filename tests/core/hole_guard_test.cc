#include "surface/hole_guard.hh"

#include <gtest/gtest.h>

#include "embedding/check_input.hh"
#include "embedding/checker.hh"
#include "embedding/realisation.hh"
#include "embedding_checks.hh"
#include "embedding_instances.hh"
#include "naive_greedy.hh"
#include "random_instances.hh"
#include "search/greedy.hh"
#include "zoo.hh"

// Surfaces with boundary and of higher genus: whatever greedy insertion completes has to pass both
// checkers.

namespace layout_embedding {
namespace {

using instances::problem;
using instances::random_landmarks;

/// Runs the greedy search; whether it embedded everything, which then is checked in full.
bool embeds_validly(const EmbeddingProblem& problem, std::uint64_t seed)
{
    test::SearchGround ground(problem, seed);
    GreedySearch greedy(ground.strands, ground.search);
    for (;;) {
        const auto outcome = greedy.run();
        const WeakEmbedding weak = ground.strands.weak_embedding();
        EXPECT_NE(outcome, GreedySearch::Outcome::tied);
        test::expect_strands(problem, ground.graph, weak);
        if (outcome == GreedySearch::Outcome::bounded ||
            outcome == GreedySearch::Outcome::inserted) {
            continue;
        }
        if (outcome != GreedySearch::Outcome::complete) {
            return false;
        }
        const auto refined = realise(problem, ground.graph, weak);
        EXPECT_TRUE(refined.ok()) << refined.error().message;
        if (refined.ok()) {
            test::expect_valid(problem, ground.graph, weak, *refined);
        }
        return true;
    }
}

/// Whether the checker finds a hole of the target inside a layout face.
bool has_hole_in_patch(const EmbeddingProblem& problem, const test::SearchGround& ground)
{
    const WeakEmbedding weak = ground.strands.weak_embedding();
    const auto refined = realise(problem, ground.graph, weak);
    if (!refined.ok()) {
        return false;
    }
    const PolygonMesh layout = to_polygons(*problem.layout);
    const PolygonMesh target = to_polygons(*problem.target);
    const auto edges = layout_edges(*problem.layout);
    const auto points = weak_points(*problem.target, ground.graph, weak);
    for (const Violation& violation :
         check_embedding({layout, target, problem.landmarks, *refined, edges, points}).violations) {
        if (violation.code == "holeInPatch" || violation.code == "patchNotDisk") {
            return true;
        }
    }
    return false;
}

PolygonMesh wheel_layout(Index spokes)
{
    PolygonMesh mesh;
    mesh.positions.assign(spokes + 1, Vec3::Zero());
    for (Index i = 0; i < spokes; ++i) {
        mesh.add_face(std::vector<Index>{0, 1 + i, 1 + (i + 1) % spokes});
    }
    return mesh;
}

TEST(HoleGuard, without_it_holes_end_up_in_faces_and_with_it_they_do_not)
{
    Random random(71);
    int wrong_without = 0;
    int mended = 0;
    int complete = 0;
    for (int round = 0; round < 60; ++round) {
        const PolygonMesh target =
            instances::scrambled(instances::triangulated(instances::disk(6), random), random);
        const PolygonMesh layout = round % 2 == 0 ? wheel_layout(3) : instances::disk(1);
        const EmbeddingProblem p =
            problem(layout, target,
                    random_landmarks(static_cast<Index>(layout.positions.size()), target, random));
        test::SearchGround unguarded(p, 1);
        const bool wrong = test::insert_naively(unguarded, test::Holes::ignored) &&
                           has_hole_in_patch(p, unguarded);
        wrong_without += wrong ? 1 : 0;
        if (embeds_validly(p, 1)) {
            ++complete;
            mended += wrong ? 1 : 0;
        }
    }
    EXPECT_GT(wrong_without, 5);
    EXPECT_GT(mended, 0);
    EXPECT_GT(complete, 20);
    RecordProperty("wrong_without", wrong_without);
    RecordProperty("mended", mended);
    RecordProperty("complete", complete);
}

TEST(HoleGuard, disks_in_disks_with_inner_landmarks)
{
    Random random(72);
    int complete = 0;
    for (int round = 0; round < 20; ++round) {
        const PolygonMesh target =
            instances::scrambled(instances::triangulated(instances::disk(7), random), random);
        for (const PolygonMesh& layout :
             {instances::disk(2), zoo::wheel(5), zoo::polygon(3), zoo::quad_grid(1, 3)}) {
            complete +=
                embeds_validly(problem(layout, target,
                                       random_landmarks(static_cast<Index>(layout.positions.size()),
                                                        target, random)),
                               random.bits())
                    ? 1
                    : 0;
        }
    }
    EXPECT_GT(complete, 15);
    RecordProperty("complete", complete);
}

TEST(HoleGuard, a_disk_in_a_closed_sphere_always_completes)
{
    Random random(73);
    for (int round = 0; round < 20; ++round) {
        const PolygonMesh target = zoo::bumpy_sphere(2, random.bits());
        const PolygonMesh layout = instances::disk(2);
        EXPECT_TRUE(
            embeds_validly(problem(layout, target, random_landmarks(9, target, random)), 3));
    }
}

TEST(HoleGuard, rings_in_rings)
{
    Random random(74);
    int complete = 0;
    for (int round = 0; round < 30; ++round) {
        const PolygonMesh target = instances::triangulated(instances::annulus(10, 5), random);
        const PolygonMesh layout = instances::annulus(4, 1);
        // Near their places; or anywhere.
        std::vector<Index> landmarks;
        for (Index i = 0; i < 4; ++i) {
            for (Index j = 0; j < 2; ++j) {
                const auto around = static_cast<Index>((5 * i) / 2 + random.below(2));
                landmarks.push_back((around % 10) * 6 + 1 + 2 * j +
                                    static_cast<Index>(random.below(2)));
            }
        }
        if (round % 3 == 2) {
            landmarks = random_landmarks(8, target, random);
        }
        complete += embeds_validly(problem(layout, target, landmarks), random.bits()) ? 1 : 0;
    }
    EXPECT_GT(complete, 10);
    RecordProperty("complete", complete);
}

TEST(HoleGuard, landmarks_on_the_boundary_keep_the_linear_order)
{
    Random random(75);
    int complete = 0;
    int rounds = 0;
    for (int round = 0; round < 10; ++round) {
        const PolygonMesh target =
            instances::scrambled(instances::triangulated(instances::disk(6), random), random);
        // A square grid by its corners and sides, all outer vertices on the boundary; only the
        // corners; only one.
        const std::vector<std::vector<Index>> choices{
            {0, 3, 6, 21, 24, 27, 42, 45, 48},
            {0, 10, 6, 22, 24, 26, 42, 38, 48},
            {0, 10, 12, 22, 24, 26, 36, 38, 40},
        };
        for (const auto& landmarks : choices) {
            ++rounds;
            complete +=
                embeds_validly(problem(instances::disk(2), target, landmarks), random.bits()) ? 1
                                                                                              : 0;
        }
    }
    EXPECT_GT(complete, rounds / 2);
    RecordProperty("complete", complete);
}

TEST(HoleGuard, tori_in_tori)
{
    Random random(76);
    int complete = 0;
    for (int round = 0; round < 10; ++round) {
        const PolygonMesh target = instances::triangulated(instances::torus(8, 12), random);
        std::vector<Index> landmarks;
        for (Index i = 0; i < 4; ++i) {
            for (Index j = 0; j < 4; ++j) {
                landmarks.push_back((3 * i + static_cast<Index>(random.below(2))) * 8 + 2 * j +
                                    static_cast<Index>(random.below(2)));
            }
        }
        complete +=
            embeds_validly(problem(instances::torus(4, 4), target, landmarks), random.bits()) ? 1
                                                                                              : 0;
    }
    EXPECT_GT(complete, 3);
    RecordProperty("complete", complete);
}

TEST(HoleGuard, a_surface_of_genus_two_on_itself)
{
    const PolygonMesh layout = zoo::slab(2, 0);
    const PolygonMesh target = zoo::subdivided(layout);
    std::vector<Index> landmarks;
    for (Index v = 0; v < layout.positions.size(); ++v) {
        landmarks.push_back(v);
    }
    EXPECT_TRUE(embeds_validly(problem(layout, target, landmarks), 4));
}

}  // namespace
}  // namespace layout_embedding
