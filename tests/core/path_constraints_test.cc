#include "apps/path_constraints.hh"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "apps/embed_job.hh"
#include "embedding/check_input.hh"
#include "embedding_checks.hh"
#include "instances.hh"

namespace layout_embedding {
namespace {

EmbedJob solved(const EmbeddingProblem& problem, std::vector<PathConstraint> constraints = {})
{
    EmbedOptions options;
    options.gap = 0;
    options.look_for_doubts = false;
    options.constraints = std::move(constraints);
    EmbedJob job(problem, options);
    while (job.step()) {
    }
    return job;
}

std::vector<std::vector<WeakPoint>> routes(const EmbedJob& job)
{
    return weak_points(*job.problem().target, *job.graph(), job.result().weak);
}

void expect_optimal(const EmbedJob& job)
{
    ASSERT_EQ(job.result().status, EmbedStatus::optimal) << job.error().message;
    test::expect_valid(job.problem(), *job.graph(), job.result().weak, *job.result().refined);
}

TEST(PathConstraints, an_avoided_route_costs_more_and_kept_ones_cost_the_same)
{
    for (const auto& [name, problem] : test::random_instances(41, 3)) {
        SCOPED_TRACE(name);
        const EmbedJob best = solved(problem);
        expect_optimal(best);
        const auto found = routes(best);
        const EmbedJob other = solved(problem, {{0, false, found[0]}});
        expect_optimal(other);
        EXPECT_GT(other.result().exact_cost, best.result().exact_cost);
        EXPECT_NE(routes(other)[0], found[0]);

        std::vector<PathConstraint> all;
        for (Index e = 0; e < found.size(); ++e) {
            all.push_back({e, true, routes(other)[e]});
        }
        const EmbedJob kept = solved(problem, all);
        expect_optimal(kept);
        EXPECT_EQ(kept.result().exact_cost, other.result().exact_cost);
        all.push_back({0, false, routes(other)[0]});
        EXPECT_EQ(solved(problem, all).result().status, EmbedStatus::infeasible);
    }
}

TEST(ExcludedEmbeddings, the_next_best_is_found_and_damaged_ones_are_refused)
{
    EmbedOptions options;
    options.gap = 0;
    options.look_for_doubts = false;
    const auto solve = [&](const EmbeddingProblem& problem) {
        EmbedJob job(problem, options);
        while (job.step()) {
        }
        return job;
    };
    for (const auto& [name, problem] : test::random_instances(42, 3)) {
        SCOPED_TRACE(name);
        options.excluded.clear();
        Length cost = 0;
        std::vector<EmbeddingPaths> found;
        for (int i = 0; i < 3; ++i) {
            const EmbedJob job = solve(problem);
            expect_optimal(job);
            EXPECT_GT(job.result().exact_cost, cost);
            cost = job.result().exact_cost;
            EXPECT_EQ(std::count(found.begin(), found.end(), routes(job)), 0);
            found.push_back(routes(job));
            // Those of another seed are known as well: classes count.
            options.excluded.push_back(routes(job));
            options.seed = 1 + i % 2;
        }
        options.seed = 1;
        options.excluded = {{found[0].begin(), found[0].end() - 1}};
        EXPECT_EQ(solve(problem).error().code, ErrorCode::invalidPath);
        options.excluded = {found[0]};
        options.excluded[0][1].pop_back();
        EXPECT_EQ(solve(problem).error().code, ErrorCode::invalidPath);
        options.excluded = {found[0]};
        options.algorithm = Algorithm::branch_and_bound;
        EXPECT_EQ(solve(problem).error().code, ErrorCode::invalidOption);
        options.algorithm = Algorithm::exact;
    }
}

TEST(GivenEmbedding, is_taken_as_it_is_or_refused)
{
    EmbedOptions options;
    const auto solve = [&](const EmbeddingProblem& problem) {
        EmbedJob job(problem, options);
        while (job.step()) {
        }
        return job;
    };
    int mixed_embedded = 0;
    int mixed_refused = 0;
    for (const auto& [name, problem, graph, weak] : test::embedded_instances(44)) {
        SCOPED_TRACE(name);
        // Not a short one, and its graph has other lengths: what counts is where paths run.
        options.given = weak_points(*problem.target, graph, weak);
        const EmbedJob job = solve(problem);
        ASSERT_EQ(job.result().status, EmbedStatus::feasible) << job.error().message;
        ASSERT_TRUE(job.result().refined);
        EXPECT_EQ(routes(job), options.given);
        EXPECT_EQ(job.result().exact_lower_bound, 0U);
        EXPECT_EQ(job.result().exact_cost, test::total_length(*job.graph(), job.result().weak));
        test::expect_valid(problem, *job.graph(), job.result().weak, *job.result().refined);

        // Nothing is searched, so nothing can be kept or ruled out.
        const auto straight = options.given[0];
        options.constraints = {{0, true, straight}};
        EXPECT_EQ(solve(problem).error().code, ErrorCode::invalidOption);
        options.constraints.clear();
        options.excluded = {options.given};
        EXPECT_EQ(solve(problem).error().code, ErrorCode::invalidOption);
        options.excluded.clear();

        // A path that goes back and forth on its way is none.
        const auto middle = static_cast<std::ptrdiff_t>(straight.size() / 2);
        options.given[0].insert(options.given[0].begin() + middle + 1,
                                {straight[straight.size() / 2 - 1], straight[straight.size() / 2]});
        if (middle > 1) {
            EXPECT_EQ(solve(problem).result().status, EmbedStatus::none_found);
        }
        options.given[0] = straight;

        // Paths of two embeddings seldom go together.
        EmbedOptions greedy;
        greedy.algorithm = Algorithm::greedy;
        EmbedJob short_one(problem, greedy);
        while (short_one.step()) {
        }
        if (short_one.result().refined) {
            for (Index e = 0; e < options.given.size(); e += 2) {
                options.given[e] = routes(short_one)[e];
            }
            const EmbedJob mixed = solve(problem);
            if (mixed.result().refined) {
                test::expect_valid(problem, *mixed.graph(), mixed.result().weak,
                                   *mixed.result().refined);
                ++mixed_embedded;
            } else {
                EXPECT_EQ(mixed.result().status, EmbedStatus::none_found);
                ++mixed_refused;
            }
        }
        options.given.pop_back();
        EXPECT_EQ(solve(problem).error().code, ErrorCode::invalidPath);
    }
    EXPECT_GT(mixed_embedded, 5);
    EXPECT_GT(mixed_refused, 50);
}

TEST(EdgeWeights, cost_is_the_weighted_length_whatever_the_algorithm)
{
    const EmbeddingProblem problem = test::random_instances(43, 1)[0].problem;
    const Index edges = problem.layout->edge_count();
    EmbedOptions options;
    options.gap = 0;
    options.edge_weights.assign(edges, 1.0);
    options.edge_weights[0] = 0.001;
    options.edge_weights[1] = 0.25;
    options.edge_weights[2] = 1000;
    for (const Algorithm algorithm :
         {Algorithm::greedy, Algorithm::schreiner, Algorithm::branch_and_bound, Algorithm::exact}) {
        options.algorithm = algorithm;
        EmbedJob job(problem, options);
        while (job.step()) {
        }
        ASSERT_TRUE(job.result().refined) << job.error().message;
        test::expect_valid(problem, *job.graph(), job.result().weak, *job.result().refined);
        double sum = 0;
        for (Index e = 0; e < edges; ++e) {
            const double length = job.graph()->to_units(
                test::total_length(*job.graph(), {{job.result().weak.paths[e]}}));
            // Rounded to 1024ths of the largest, one at least.
            const double weight =
                std::max(1.0, std::round(options.edge_weights[e] * 1.024)) / 1.024;
            EXPECT_NEAR(job.result().edge_costs[e], weight * length, 1e-9 * weight * length);
            sum += job.result().edge_costs[e];
        }
        EXPECT_NEAR(job.result().cost, sum, 1e-9 * sum);
        EXPECT_LE(job.result().exact_lower_bound, job.result().exact_cost);
    }
    for (const std::vector<double>& wrong :
         {std::vector<double>(edges - 1, 1.0), std::vector<double>(edges, 0.0),
          std::vector<double>(edges, 1001.0),
          std::vector<double>(edges, std::numeric_limits<double>::quiet_NaN())}) {
        options.edge_weights = wrong;
        EmbedJob job(problem, options);
        while (job.step()) {
        }
        EXPECT_EQ(job.error().code, ErrorCode::invalidOption);
    }
}

TEST(PathConstraints, a_path_that_is_none_is_refused)
{
    const EmbeddingProblem problem = test::random_instances(41, 1)[0].problem;
    const EmbedJob job = solved(problem);
    const std::vector<WeakPoint> path = routes(job)[0];
    const auto expect_refused = [&](Index edge, std::vector<WeakPoint> given) {
        const auto result = class_constraints(problem, *job.graph(), {{edge, true, given}});
        ASSERT_FALSE(result.ok());
        EXPECT_EQ(result.error().code, ErrorCode::invalidPath);
    };
    ASSERT_TRUE(class_constraints(problem, *job.graph(), {{0, true, path}}).ok());
    expect_refused(problem.layout->edge_count(), path);
    expect_refused(1, path);
    expect_refused(0, {});
    expect_refused(0, {path.front(), path.back()});
    std::vector<WeakPoint> nowhere = path;
    nowhere[1] = {problem.target->vertex_count(), kNone, kNone};
    expect_refused(0, nowhere);
    nowhere[1] = {path[0][0], kNone, path[0][0]};
    expect_refused(0, nowhere);
    nowhere[1] = {path[0][0], path[0][0], path[0][0]};
    expect_refused(0, nowhere);
    std::vector<WeakPoint> there_and_back = path;
    there_and_back.insert(there_and_back.end(), path.rbegin() + 1, path.rend());
    there_and_back.insert(there_and_back.end(), path.begin() + 1, path.end());
    expect_refused(0, there_and_back);
}

}  // namespace
}  // namespace layout_embedding
