#pragma once

#include <cstdint>
#include <vector>

#include "layout/embedding_problem.hh"
#include "surface/path_graph.hh"
#include "surface/weighted_length.hh"

namespace layout_embedding {

/// The vertex-repulsive guide of [PSS01]: a path between the landmarks i and j is searched in the
/// path graph weighted with the field 1 - w_i - w_j, w the harmonic functions of the landmarks. The
/// field is small where the path's own landmarks dominate, so that the path keeps away from all
/// others. Midpoints and centroids have the mean of their corners.
///
/// The functions are rounded to 15 bits, which is all that is kept of them: 2 bytes per vertex and
/// landmark. Together with HarmonicFunctions' fixed order of operations this makes guided paths the
/// same on every platform.
class RepulsiveGuide {
public:
    /// Computes all functions; see SparseLu for time and memory. Keeps references.
    RepulsiveGuide(const EmbeddingProblem& problem, const PathGraph& graph);

    /// Per node of the path graph: the weight for a path between the landmarks of layout vertices i
    /// and j. O(#nodes); valid until the next call.
    const std::vector<NodeWeight>& node_weights(Index i, Index j);

    /// Bytes taken while constructing, roughly.
    static std::uint64_t estimate_bytes(Index target_vertices, Index landmarks);

private:
    const TriangleMesh& target_;
    const PathGraph& graph_;
    std::vector<std::vector<std::uint16_t>> functions_;  // per landmark, per vertex
    std::vector<NodeWeight> weights_;
};

}  // namespace layout_embedding
