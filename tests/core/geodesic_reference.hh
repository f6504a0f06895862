#pragma once

#include <optional>
#include <vector>

#include "layout/embedding_problem.hh"
#include "surface/path_graph.hh"

namespace layout_embedding::test {

/// The length of the locally shortest path in the homotopy class of a walk in the path graph, on
/// the target punctured at all landmarks, however other paths run: by edge flips in an intrinsic
/// triangulation (Sharp and Crane, "You can find geodesic paths in triangle meshes by just flipping
/// edges", 2020), with a memory of the side on which the path passes a landmark that it touches.
/// Shares nothing with the realisation. Nothing where the path would meet itself on the way.
std::optional<double> geodesic_length(const EmbeddingProblem& problem, const PathGraph& graph,
                                      const std::vector<Index>& darts);

}  // namespace layout_embedding::test
