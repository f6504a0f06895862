#include "apps/candidate_paths.hh"

#include <gtest/gtest.h>
#include <numeric>

#include "apps/embed_job.hh"
#include "embedding_checks.hh"
#include "instances.hh"
#include "search_ground.hh"

namespace layout_embedding {
namespace {

TEST(CandidatePaths, are_an_embedding_if_and_only_if_nothing_conflicts)
{
    int with_conflicts = 0;
    int without = 0;
    auto instances = test::tiny_instances(21, 40);
    for (auto& instance : test::random_instances(22, 10)) {
        instances.push_back(std::move(instance));
    }
    for (const auto& [name, problem] : instances) {
        SCOPED_TRACE(name);
        // Insertion takes every edge's shortest path that is left: all candidates, or more.
        EmbedOptions options;
        options.algorithm = Algorithm::greedy;
        EmbedJob job(problem, options);
        while (job.step()) {
        }
        const EmbedResult& embedded = job.result();
        ASSERT_TRUE(embedded.refined.has_value());
        test::expect_valid(problem, *job.graph(), embedded.weak, *embedded.refined);

        const auto found = candidate_paths(problem, *job.graph());
        ASSERT_TRUE(found.ok()) << found.error().message;
        const Index edge_count = problem.layout->edge_count();
        ASSERT_EQ(found->lengths.size(), edge_count);
        ASSERT_EQ(found->paths.layout_edges.size(), edge_count);
        for (Index e = 0; e < edge_count; ++e) {
            EXPECT_LE(found->lengths[e], embedded.edge_costs[e] * (1 + 1e-12));
        }
        const double sum = std::accumulate(found->lengths.begin(), found->lengths.end(), 0.0);
        if (found->pairs.empty() && found->triples.empty()) {
            ++without;
            EXPECT_NEAR(embedded.cost, sum, 1e-9 * sum);
        } else {
            ++with_conflicts;
            EXPECT_GT(embedded.cost, sum * (1 + 1e-12));
        }
    }
    EXPECT_GT(with_conflicts, 5);
    EXPECT_GT(without, 5);
}

TEST(CandidatePaths, of_a_conflicting_pair_only_one_can_be_embedded)
{
    int pairs = 0;
    for (const auto& [name, problem] : test::random_instances(23, 10)) {
        SCOPED_TRACE(name);
        test::SearchGround ground(problem, 5);
        const auto found = candidate_paths(problem, ground.graph);
        ASSERT_TRUE(found.ok());
        std::vector<std::vector<Index>> walks;
        for (Index e = 0; e < problem.layout->edge_count(); ++e) {
            ground.search.begin(e);
            ASSERT_EQ(ground.search.run(), CutSurfaceSearch::Outcome::found);
            walks.push_back(ground.search.darts());
        }
        for (const auto& [a, b] : found->pairs) {
            EXPECT_LT(a, b);
            ASSERT_TRUE(ground.strands.insert(a, walks[a]));
            EXPECT_FALSE(ground.strands.trace(b, walks[b]).has_value());
            ground.strands.undo();
            ++pairs;
        }
    }
    EXPECT_GT(pairs, 5);
}

}  // namespace
}  // namespace layout_embedding
