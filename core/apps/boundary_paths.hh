#pragma once

#include <optional>
#include <vector>

#include "base/result.hh"
#include "embedding/normal_form.hh"
#include "layout/embedding_problem.hh"
#include "surface/path_graph.hh"
#include "surface/weak_embedding.hh"

namespace layout_embedding {

/// A layout boundary edge that is to run along the target's boundary.
struct BoundaryPath {
    Index layout_edge;
    /// The target's boundary vertices from the landmark of tail(2e) to that of head(2e).
    std::vector<Index> vertices;
    /// The darts of the path graph along them, and their length.
    std::vector<Index> darts;
    Length length;
};

/// One per layout boundary edge with both landmarks on the target's boundary: the part of it from
/// one to the other that has the hole where the layout has its outside. No other path is ever in
/// the way of such a path, since it has nothing but the hole beyond it. Errors: invalidOption where
/// the two landmarks lie on different boundary loops, or others between them. O(#F + lengths).
Result<std::vector<BoundaryPath>> boundary_paths(const EmbeddingProblem& problem,
                                                 const PathGraph& graph);

/// The embedding with these paths along the boundary, all others as they are. `embedding` is
/// complete and has each of these edges in the homotopy class of its boundary path. Nothing if the
/// paths meet all the same.
std::optional<WeakEmbedding> with_boundary_paths(const EmbeddingProblem& problem,
                                                 const PathGraph& graph,
                                                 const WeakEmbedding& embedding,
                                                 const std::vector<BoundaryPath>& paths);

/// Puts the strands of these edges on the boundary vertices; in `form` they are the ones nearest to
/// the boundary.
void run_along_boundary(NormalForm& form, const std::vector<BoundaryPath>& paths);

}  // namespace layout_embedding
