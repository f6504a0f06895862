#pragma once

#include <array>
#include <utility>
#include <vector>

#include "base/result.hh"
#include "base/types.hh"
#include "layout/embedding_problem.hh"
#include "surface/path_graph.hh"
#include "surface/polylines.hh"

namespace layout_embedding {

/// The path that each layout edge would take if it were alone, and what keeps these candidate
/// paths from being embedded together (paper, Sec. 4.1 and Fig. 9): the root of every search. No
/// embedding is shorter than all of them together, and without a conflict they are one.
struct CandidatePaths {
    /// One per layout edge that has a path past the other landmarks.
    Polylines paths;
    /// Per layout edge: the length in target units and the path-graph metric, infinity without a
    /// path.
    std::vector<double> lengths;
    /// Layout edges (a, b), a < b, whose candidates cross or leave a landmark on the boundary in
    /// the wrong order. Sorted.
    std::vector<std::pair<Index, Index>> pairs;
    /// Three layout edges at a landmark, ascending, whose candidates are in the wrong cyclic order
    /// there; no two of them conflict at it. Sorted.
    std::vector<std::array<Index, 3>> triples;
};

/// Finds them in the path graph of a job for the same problem. One search per layout edge. Error:
/// unresolvedTie, which cannot happen in the graph of a job that has found an embedding.
Result<CandidatePaths> candidate_paths(const EmbeddingProblem& problem, const PathGraph& graph);

}  // namespace layout_embedding
