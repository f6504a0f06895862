// No lower bound of the exact method is above the cost of any embedding, whenever it is stopped.
#include <algorithm>
#include <gtest/gtest.h>
#include <set>

#include "base/random.hh"
#include "embedding_checks.hh"
#include "instances.hh"
#include "search/exact_solver.hh"
#include "search/sequence_solver.hh"
#include "search_ground.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

constexpr std::uint64_t kFieldBytes = std::uint64_t{1} << 30U;
// Not enough to prove the harder ones: bounds of all stages of a search are looked at.
constexpr std::uint64_t kMaxWork = 60'000;
constexpr std::uint64_t kSlice = 3000;
constexpr int kOrders = 3;

/// Prisms, cubes, and octahedra on a sphere, landmarks anywhere: among such are the instances that
/// no insertion sequence solves.
std::vector<test::Instance> instances_on_a_sphere(std::uint64_t seed, int count)
{
    const PolygonMesh sphere = zoo::icosphere(2);
    const std::pair<const char*, PolygonMesh> layouts[] = {
        {"prism", zoo::prism(3)}, {"cube", zoo::cube()}, {"octahedron", zoo::octahedron()}};
    Random random(seed);
    std::vector<test::Instance> instances;
    for (int i = 0; i < count; ++i) {
        const auto& [name, layout] = layouts[i % 3];
        const auto landmarks = zoo::random_landmarks(
            sphere, static_cast<Index>(layout.positions.size()), random.bits());
        instances.push_back({name + std::string(" #") + std::to_string(i),
                             test::problem_of(layout, sphere, landmarks)});
    }
    return instances;
}

/// Bounds compared with embeddings, instance by instance.
struct Comparison {
    int instances = 0;
    int proved = 0;
    std::set<Length> bounds;

    /// The bounds at every stop, none above `cost`, that of some embedding.
    void compare(const EmbeddingProblem& problem, const PathGraph& graph, Length cost)
    {
        ExactSolver solver(problem, graph, kFieldBytes, {});
        ++instances;
        for (std::uint64_t work = 0; work < kMaxWork; work += kSlice) {
            WorkBudget budget(kSlice);
            Solver::Outcome outcome = Solver::Outcome::improved;
            while (outcome != Solver::Outcome::running && outcome != Solver::Outcome::finished) {
                outcome = solver.run(budget);
                ASSERT_NE(outcome, Solver::Outcome::tied);
                bounds.insert(solver.lower_bound());
                if (outcome == Solver::Outcome::improved) {
                    cost = std::min(cost, solver.incumbent_cost());
                }
            }
            ASSERT_LE(solver.lower_bound(), cost);
            if (outcome == Solver::Outcome::finished) {
                ++proved;
                break;
            }
        }
        if (solver.incumbent_cost() != kInfiniteLength) {
            test::expect_strands(problem, graph, solver.incumbent());
        }
    }
};

/// The cheapest of a few embeddings made without the exact method.
Length cheapest(const EmbeddingProblem& problem, const PathGraph& graph, Random& random)
{
    Length cost = kInfiniteLength;
    for (int i = 0; i < kOrders; ++i) {
        if (const auto weak = test::insert_in_random_order(problem, graph, random)) {
            cost = std::min(cost, test::total_length(graph, *weak));
        }
    }
    SequenceSolver sequences(problem, graph, kFieldBytes, {});
    WorkBudget budget(kMaxWork);
    Solver::Outcome outcome = Solver::Outcome::improved;
    while (outcome != Solver::Outcome::running && outcome != Solver::Outcome::finished) {
        outcome = sequences.run(budget);
    }
    if (sequences.incumbent_cost() != kInfiniteLength) {
        test::expect_strands(problem, graph, sequences.incumbent());
    }
    return std::min(cost, sequences.incumbent_cost());
}

TEST(ExactBounds, none_is_above_any_embedding_of_two_thousand_random_instances)
{
    Random random(301);
    Comparison comparison;
    const auto compare = [&](const std::vector<test::Instance>& instances) {
        for (const auto& [name, problem] : instances) {
            SCOPED_TRACE(name);
            const PathGraph graph = PathGraph::barycentric(*problem.target, {random.bits(), 0});
            comparison.compare(problem, graph, cheapest(problem, graph, random));
        }
    };
    compare(test::tiny_instances(302, 1300));
    compare(test::random_instances(303, 400));
    compare(instances_on_a_sphere(304, 300));
    EXPECT_GE(comparison.instances, 2000);
    EXPECT_GT(comparison.proved, 1500);
    // Stopped on the way, too.
    EXPECT_GT(comparison.instances - comparison.proved, 20);
    EXPECT_GT(comparison.bounds.size(), 4000U);
}

TEST(ExactBounds, none_is_above_an_embedding_on_surfaces_of_any_topology)
{
    Comparison comparison;
    for (const auto& [name, problem, graph, weak] : test::embedded_instances(305)) {
        SCOPED_TRACE(name);
        comparison.compare(problem, graph, test::total_length(graph, weak));
    }
    EXPECT_GT(comparison.instances, 200);
    EXPECT_GT(comparison.proved, 50);
}

}  // namespace
}  // namespace layout_embedding
