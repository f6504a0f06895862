#pragma once

#include "base/result.hh"
#include "embedding/normal_form.hh"
#include "embedding/refined_mesh.hh"
#include "layout/embedding_problem.hh"
#include "surface/path_graph.hh"
#include "surface/weak_embedding.hh"

namespace layout_embedding {

/// Cuts the target along strands in normal form (design, Sec. 4): faces are cut along their chords
/// and triangulated. Errors: realisationFailed where strands meet. O(#F + crossings).
Result<RefinedMesh> cut_along(const Layout& layout, const NormalForm& form);

/// Turns a complete weak embedding in the barycentric path graph of the target into a refined mesh
/// (paper, Sec. 3.3; design, Sec. 4): the strands in normal form as crossings with target edges,
/// bigons removed, crossings spread evenly along each edge (PathShape::even), then cut_along().
/// Every path keeps its homotopy class. Errors: realisationFailed.
Result<RefinedMesh> realise(const EmbeddingProblem& problem, const PathGraph& graph,
                            const WeakEmbedding& embedding);

}  // namespace layout_embedding
