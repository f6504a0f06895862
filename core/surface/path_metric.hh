#pragma once

#include <vector>

#include "base/types.hh"
#include "mesh/triangle_mesh.hh"

namespace layout_embedding {

/// What paths on the target cost. All that is known of shortest paths holds for any positive
/// lengths, and so do bounds and proofs.
struct PathMetric {
    /// Per target vertex, what a unit of length costs there, linear in between; empty for 1
    /// everywhere. Above kMinPathCost and at most kMaxPathCost.
    std::vector<double> vertex_costs;
    /// How much paths are drawn to sharp edges of the target: what a unit of length along one costs
    /// less than elsewhere, in [0, kMaxFeatureDiscount]. It is reached where faces meet at 60
    /// degrees from flat; up to 20 degrees an edge is not sharp at all.
    double feature_discount = 0;

    bool is_euclidean() const { return vertex_costs.empty() && feature_discount == 0; }
};

inline constexpr double kMinPathCost = 0.001;
inline constexpr double kMaxPathCost = 1000;
inline constexpr double kMaxFeatureDiscount = 0.95;

/// Per edge of the target, what a unit of length along it costs relative to its surroundings: 1,
/// and down to 1 - `discount` at sharp edges.
std::vector<double> feature_costs(const TriangleMesh& target, double discount);

}  // namespace layout_embedding
