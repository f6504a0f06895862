#pragma once

#include "embedding/refined_mesh.hh"
#include "layout/embedding_problem.hh"
#include "surface/path_graph.hh"
#include "surface/weak_embedding.hh"

namespace layout_embedding::test {

/// Fails the test for every violation that the strand checker finds in a (partial) embedding.
void expect_strands(const EmbeddingProblem& problem, const PathGraph& graph,
                    const WeakEmbedding& weak);

/// Fails the test for every violation that the checker finds in a realised embedding.
void expect_valid(const EmbeddingProblem& problem, const PathGraph& graph,
                  const WeakEmbedding& weak, const RefinedMesh& refined);

/// The summed length of all paths.
Length total_length(const PathGraph& graph, const WeakEmbedding& weak);
/// With the problem's weights.
Length total_cost(const EmbeddingProblem& problem, const PathGraph& graph,
                  const WeakEmbedding& weak);

}  // namespace layout_embedding::test
