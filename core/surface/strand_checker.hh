#pragma once

#include <string>
#include <vector>

#include "base/types.hh"
#include "layout/embedding_problem.hh"
#include "surface/path_graph.hh"
#include "surface/weak_embedding.hh"

namespace layout_embedding {

/// One reason why paths are no strands of an embedding.
struct StrandViolation {
    /// A stable camelCase name, for example "strandsCross".
    std::string code;
    /// One sentence with the ids concerned.
    std::string message;
};

/// Confirms from the definitions alone (design, Sec. 1) that the paths of `embedding` are strands
/// that do not cross. Independent by intent: it shares nothing with Strands and believes nothing.
/// Partial embeddings are welcome. Empty: all is well. Otherwise, the violations of the first of
/// these groups that has any:
/// - there is a path for each layout edge (pathCount); landmarks are different nodes of the graph
///   (landmarks);
/// - each path has one lane per dart (laneCount), its darts exist (dartOutOfRange), follow each
///   other (walkGap), lead from the landmark of its edge's tail to that of its head (walkEnds), and
///   meet no landmark in between (walkThroughLandmark);
/// - the lanes on each edge of the graph are 0 .. m-1, each of them once (lanes);
/// - around a node that is no landmark the strands that pass it are unlinked chords (strandsCross);
///   the strands at a landmark leave it in the layout's cyclic order, on the target's boundary in
///   its linear order (landmarkOrder).
///
/// O(n log n) for paths of n darts in total.
std::vector<StrandViolation> check_strands(const EmbeddingProblem& problem, const PathGraph& graph,
                                           const WeakEmbedding& embedding);

}  // namespace layout_embedding
