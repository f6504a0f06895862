#pragma once

#include "base/result.hh"
#include "embedding/normal_form.hh"
#include "layout/embedding_problem.hh"
#include "surface/path_graph.hh"
#include "surface/weak_embedding.hh"

namespace layout_embedding {

/// Brings a complete weak embedding in the barycentric path graph of the target into normal form on
/// the target (design, Sec. 4), without bigons and with the crossings of each edge spread evenly.
/// Strand e is the path of layout edge e; the only vertex elements are its two landmarks. Every
/// strand keeps its homotopy class, and its order among the others.
///
/// Purely combinatorial: strands that run along a target edge are thought to run beside it, half of
/// them on either side, and pass each vertex on the side that crosses fewer edges.
///
/// The normal form refers to problem.target. Errors: realisationFailed for a path that is missing,
/// does not join its landmarks, or runs through another landmark, for lanes that do not fit
/// together, and for strands that cross at a vertex or edge midpoint. O(path lengths times vertex
/// degrees + crossings + #E).
Result<NormalForm> normal_form_of(const EmbeddingProblem& problem, const PathGraph& graph,
                                  const WeakEmbedding& embedding);

}  // namespace layout_embedding
