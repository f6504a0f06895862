#include "apps/path_constraints.hh"

#include <gtest/gtest.h>

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
