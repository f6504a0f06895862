#include "search/greedy.hh"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

#include "embedding_checks.hh"
#include "instances.hh"
#include "naive_greedy.hh"
#include "search_ground.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

using test::SearchGround;
using Found = CutSurfaceSearch::Outcome;
using Outcome = GreedySearch::Outcome;

/// Problems on closed surfaces of genus 0, and on disks, rings and tori.
std::vector<test::Instance> all_problems()
{
    std::vector<test::Instance> problems = test::random_instances(61, 40);
    for (auto& instance : test::embedded_instances(62)) {
        problems.push_back({instance.name, std::move(instance.problem)});
    }
    return problems;
}

Outcome run_to_end(GreedySearch& greedy)
{
    for (;;) {
        const Outcome outcome = greedy.run();
        if (outcome != Outcome::bounded && outcome != Outcome::inserted) {
            return outcome;
        }
    }
}

TEST(Greedy, equals_the_search_that_computes_all_paths_anew_after_every_insertion)
{
    int complete = 0;
    int detours = 0;
    for (const test::Instance& instance : all_problems()) {
        SCOPED_TRACE(instance.name);
        SearchGround ground(instance.problem, 5);
        GreedySearch greedy(instance.problem, ground.strands, ground.search);
        const Outcome outcome = run_to_end(greedy);
        ASSERT_NE(outcome, Outcome::tied);

        SearchGround naive(instance.problem, 5);
        EXPECT_EQ(test::insert_naively(naive, test::Holes::guarded), outcome == Outcome::complete);
        EXPECT_EQ(ground.strands.insertion_order(), naive.strands.insertion_order());
        const WeakEmbedding weak = ground.strands.weak_embedding();
        const WeakEmbedding expected = naive.strands.weak_embedding();
        for (std::size_t e = 0; e < weak.paths.size(); ++e) {
            EXPECT_EQ(weak.paths[e].darts, expected.paths[e].darts);
            EXPECT_EQ(weak.paths[e].lanes, expected.paths[e].lanes);
        }
        EXPECT_EQ(greedy.embedded_cost(), test::total_length(ground.graph, weak));
        test::expect_strands(instance.problem, ground.graph, weak);
        if (outcome == Outcome::complete) {
            ++complete;
            EXPECT_LE(greedy.lower_bound(), greedy.embedded_cost());
            detours += greedy.lower_bound() < greedy.embedded_cost() ? 1 : 0;
        }
    }
    EXPECT_GT(complete, 70);
    EXPECT_GT(detours, 50);
}

TEST(Greedy, embeds_a_spanning_tree_first)
{
    for (const test::Instance& instance : all_problems()) {
        SCOPED_TRACE(instance.name);
        SearchGround ground(instance.problem, 6);
        GreedySearch greedy(instance.problem, ground.strands, ground.search);
        run_to_end(greedy);
        const Layout& layout = ground.strands.layout();
        auto tree = ground.strands.insertion_order();
        tree.resize(std::min<std::size_t>(tree.size(), layout.vertex_count() - 1));
        const auto numbers = test::components(layout, tree);
        const std::set<Index> different(numbers.begin(), numbers.end());
        EXPECT_EQ(different.size(), layout.vertex_count() - tree.size());
    }
}

TEST(Greedy, always_completes_on_closed_surfaces_of_genus_0)
{
    for (const test::Instance& instance : test::random_instances(63, 60)) {
        SCOPED_TRACE(instance.name);
        SearchGround ground(instance.problem, 7);
        GreedySearch greedy(instance.problem, ground.strands, ground.search);
        EXPECT_EQ(run_to_end(greedy), Outcome::complete);
    }
}

TEST(Greedy, the_lower_bound_is_never_above_the_best_of_many_orders)
{
    Random random(64);
    int orders = 0;
    for (const test::Instance& instance : test::random_instances(64, 25)) {
        SCOPED_TRACE(instance.name);
        SearchGround ground(instance.problem, 8);
        GreedySearch greedy(instance.problem, ground.strands, ground.search);
        ASSERT_EQ(run_to_end(greedy), Outcome::complete);
        const Layout& layout = ground.strands.layout();
        for (int round = 0; round < 20; ++round) {
            while (!ground.strands.insertion_order().empty()) {
                ground.strands.undo();
            }
            Length cost = 0;
            // Now and then without a tree first; such orders may get stuck.
            for (const Index e : round % 2 == 0 ? test::random_tree_first_order(layout, random)
                                                : test::random_order(layout.edge_count(), random)) {
                ground.search.begin(e);
                if (ground.search.run() != Found::found) {
                    break;
                }
                ASSERT_TRUE(ground.strands.insert(e, ground.search.darts()));
                cost += ground.search.cost();
            }
            if (ground.strands.insertion_order().size() == layout.edge_count()) {
                EXPECT_GE(cost, greedy.lower_bound());
                ++orders;
            }
        }
    }
    EXPECT_GT(orders, 250);
}

/// The cost of the best of all insertion orders that continue the present one.
Length best_of_all_orders(SearchGround& ground, Length cost, int& order_count)
{
    const Index edges = ground.strands.layout().edge_count();
    if (ground.strands.insertion_order().size() == edges) {
        ++order_count;
        return cost;
    }
    Length best = kInfiniteLength;
    for (Index e = 0; e < edges; ++e) {
        if (ground.strands.is_embedded(e)) {
            continue;
        }
        ground.search.begin(e);
        if (ground.search.run() != Found::found) {
            continue;
        }
        const Length extended = cost + ground.search.cost();
        EXPECT_TRUE(ground.strands.insert(e, ground.search.darts()));
        best = std::min(best, best_of_all_orders(ground, extended, order_count));
        ground.strands.undo();
    }
    return best;
}

TEST(Greedy, bound_and_cost_enclose_the_best_of_all_orders)
{
    Random random(65);
    int gaps = 0;
    int suboptimal = 0;
    for (int round = 0; round < 10; ++round) {
        // Six edges on closed targets.
        PolygonMesh target = zoo::subdivided(zoo::octahedron());
        for (Vec3& p : target.positions) {
            p *= 0.4 + random.unit();
        }
        const EmbeddingProblem problem = test::problem_of(
            zoo::tetrahedron(), target, zoo::random_landmarks(target, 4, random.bits()));
        SearchGround ground(problem, 9);
        int order_count = 0;
        const Length best = best_of_all_orders(ground, 0, order_count);
        EXPECT_GT(order_count, 6 * 2 * 24);  // the orders that begin with a tree, at the least
        GreedySearch greedy(problem, ground.strands, ground.search);
        ASSERT_EQ(run_to_end(greedy), Outcome::complete);
        EXPECT_LE(greedy.lower_bound(), best);
        EXPECT_GE(greedy.embedded_cost(), best);
        gaps += greedy.lower_bound() < best ? 1 : 0;
        suboptimal += greedy.embedded_cost() > best ? 1 : 0;
    }
    EXPECT_GT(gaps, 3);
    RecordProperty("suboptimal", suboptimal);
}

TEST(Greedy, slices_of_work_change_nothing)
{
    for (const test::Instance& instance : test::random_instances(66, 10)) {
        SCOPED_TRACE(instance.name);
        SearchGround whole(instance.problem, 10);
        GreedySearch greedy(instance.problem, whole.strands, whole.search);
        EXPECT_EQ(run_to_end(greedy), Outcome::complete);
        for (const std::uint64_t slice : {1U, 7U, 100U}) {
            SearchGround sliced(instance.problem, 10);
            GreedySearch stepped(instance.problem, sliced.strands, sliced.search);
            Outcome outcome = Outcome::running;
            while (outcome == Outcome::running || outcome == Outcome::bounded ||
                   outcome == Outcome::inserted) {
                const auto before = sliced.search.expansion_count();
                outcome = stepped.run(slice);
                EXPECT_LE(sliced.search.expansion_count() - before, slice);
            }
            EXPECT_EQ(outcome, Outcome::complete);
            EXPECT_EQ(stepped.embedded_cost(), greedy.embedded_cost());
            EXPECT_EQ(sliced.strands.insertion_order(), whole.strands.insertion_order());
            EXPECT_EQ(sliced.search.expansion_count(), whole.search.expansion_count());
        }
    }
}

}  // namespace
}  // namespace layout_embedding
