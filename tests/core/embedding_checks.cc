#include "embedding_checks.hh"

#include <gtest/gtest.h>

#include "embedding/check_input.hh"
#include "embedding/checker.hh"
#include "surface/strand_checker.hh"

namespace layout_embedding::test {

void expect_strands(const EmbeddingProblem& problem, const PathGraph& graph,
                    const WeakEmbedding& weak)
{
    for (const StrandViolation& violation : check_strands(problem, graph, weak)) {
        ADD_FAILURE() << violation.code << ": " << violation.message;
    }
}

void expect_valid(const EmbeddingProblem& problem, const PathGraph& graph,
                  const WeakEmbedding& weak, const RefinedMesh& refined)
{
    const PolygonMesh layout = to_polygons(*problem.layout);
    const PolygonMesh target = to_polygons(*problem.target);
    const auto edges = layout_edges(*problem.layout);
    const auto points = weak_points(*problem.target, graph, weak);
    const CheckReport report =
        check_embedding({layout, target, problem.landmarks, refined, edges, points});
    for (const Violation& violation : report.violations) {
        ADD_FAILURE() << violation.code << ": " << violation.message;
    }
}

Length total_length(const PathGraph& graph, const WeakEmbedding& weak)
{
    Length sum = 0;
    for (const WeakPath& path : weak.paths) {
        for (const Index dart : path.darts) {
            sum += graph.dart(dart).length;
        }
    }
    return sum;
}

Length total_cost(const EmbeddingProblem& problem, const PathGraph& graph,
                  const WeakEmbedding& weak)
{
    Length sum = 0;
    for (Index e = 0; e < weak.paths.size(); ++e) {
        sum += problem.weights.of(e) * total_length(graph, {{weak.paths[e]}});
    }
    return sum;
}

}  // namespace layout_embedding::test
