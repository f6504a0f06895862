#pragma once

#include <span>

#include "base/result.hh"
#include "embedding/normal_form.hh"
#include "layout/embedding_problem.hh"
#include "surface/path_graph.hh"
#include "surface/weak_embedding.hh"

namespace layout_embedding {

/// Brings a complete weak embedding in the barycentric path graph of the target into normal form on
/// the target (design, Sec. 4), without bigons and with the crossings of each edge spread evenly.
/// Strand e is the path of layout edge e. Every strand keeps its homotopy class, and its order
/// among the others.
///
/// Purely combinatorial: strands that run along a target edge are thought to run beside it, half of
/// them on either side, and pass each vertex on the side that crosses fewer edges.
///
/// Vertex elements are the two landmarks, and inner vertices at which a path comes or goes along a
/// whole edge of `edge_costs` below 1 (per target edge, as in PathMetric; empty for 1 everywhere):
/// there the strand runs on the edge itself. Of several such paths at a vertex it is one in the
/// middle.
///
/// The normal form refers to problem.target. Errors: realisationFailed for a path that is missing,
/// does not join its landmarks, or runs through another landmark, for lanes that do not fit
/// together, and for strands that cross at a vertex or edge midpoint. O(path lengths times vertex
/// degrees + crossings + #E).
Result<NormalForm> normal_form_of(const EmbeddingProblem& problem, const PathGraph& graph,
                                  const WeakEmbedding& embedding,
                                  std::span<const double> edge_costs = {});

}  // namespace layout_embedding
