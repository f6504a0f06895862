#pragma once

#include <string>
#include <vector>

#include "layout/embedding_problem.hh"
#include "surface/path_graph.hh"
#include "surface/weak_embedding.hh"

namespace layout_embedding {

/// One reason why strands are no weak embedding.
struct StrandViolation {
    /// A stable camelCase name.
    std::string code;
    /// One sentence with the ids concerned.
    std::string message;
};

/// Confirms directly from the definitions that `embedding`, complete or not (empty paths are left
/// out), is a set of strands that nowhere cross; a second opinion on what surface/strands.hh and
/// the search say, with which it shares nothing. Ids in it need not be sound. Codes:
/// - strandSize: not one path per layout edge, or not one lane per dart;
/// - strandBroken: a dart that does not exist or does not start where the one before ends;
/// - strandEnds: a path that does not run between the landmarks of its layout edge;
/// - strandThroughLandmark: a path with a landmark inside;
/// - strandLanes: the lanes on an edge are not 0 .. m-1;
/// - strandsCross: two passes of a node that cross;
/// - strandOrder: strands at a landmark against the layout's cyclic order, or on the target's
///   boundary against its linear order.
/// At most one violation per path, edge or node. O(n log n) in the number of darts in all paths.
std::vector<StrandViolation> check_strands(const EmbeddingProblem& problem, const PathGraph& graph,
                                           const WeakEmbedding& embedding);

}  // namespace layout_embedding
