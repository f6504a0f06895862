#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/result.hh"
#include "base/types.hh"
#include "layout/edge_weights.hh"
#include "layout/layout.hh"
#include "mesh/triangle_mesh.hh"

namespace layout_embedding {

/// What is to be embedded where (paper, Sec. 3.2): a layout, a target, and one target vertex per
/// layout vertex. Immutable once made; meshes are shared, never copied.
struct EmbeddingProblem {
    std::shared_ptr<const Layout> layout;
    std::shared_ptr<const TriangleMesh> target;
    /// #V_layout target vertex ids, all different.
    std::vector<Index> landmarks;
    /// What is minimised is the sum of the paths' lengths times these.
    EdgeWeights weights = {};
};

/// Confirms that the landmarks are different vertices of the target: landmarkOutOfRange,
/// duplicateLandmark.
Status check_landmark_vertices(const TriangleMesh& target, std::span<const Index> landmarks);

/// Checks that the three fit together: one landmark per layout vertex (landmarkCount), each a
/// target vertex (landmarkOutOfRange), all different (duplicateLandmark); at least three
/// (tooFewLandmarks); layout and target of the same genus once their holes are filled, and holes in
/// the target only where the layout has boundary loops, one for each (topologyMismatch); an inner
/// layout vertex not on the target's boundary (landmarkOnBoundary).
Result<EmbeddingProblem> make_problem(std::shared_ptr<const Layout> layout,
                                      std::shared_ptr<const TriangleMesh> target,
                                      std::vector<Index> landmarks);

}  // namespace layout_embedding
