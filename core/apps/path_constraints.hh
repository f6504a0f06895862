#pragma once

#include <vector>

#include "base/result.hh"
#include "base/types.hh"
#include "embedding/checker.hh"
#include "layout/embedding_problem.hh"
#include "search/class_constraints.hh"
#include "search/excluded_embeddings.hh"
#include "surface/path_graph.hh"

namespace layout_embedding {

/// What is asked of the path of one layout edge: to be homotopic to a given one, or not to be, on
/// the target punctured at its landmarks and holes.
struct PathConstraint {
    Index layout_edge = 0;
    /// Whether the path is to be kept, or to be avoided.
    bool is_kept = false;
    /// A path in the path graph from the landmark of tail(2e) to that of head(2e), through no other
    /// landmark; as a rule that of an earlier embedding (weak_points()). Its length does not
    /// matter.
    std::vector<WeakPoint> path;
};

/// An embedding by one path per layout edge, each as in PathConstraint.
using EmbeddingPaths = std::vector<std::vector<WeakPoint>>;

/// The same in terms of a path graph. Errors: invalidPath.
Result<std::vector<ClassConstraint>> class_constraints(
    const EmbeddingProblem& problem, const PathGraph& graph,
    const std::vector<PathConstraint>& constraints);

/// Embeddings as darts of a path graph. Errors: invalidPath where there is not one path per layout
/// edge, or a path is none.
Result<std::vector<DartPaths>> embedding_darts(const EmbeddingProblem& problem,
                                               const PathGraph& graph,
                                               const std::vector<EmbeddingPaths>& embeddings);

}  // namespace layout_embedding
