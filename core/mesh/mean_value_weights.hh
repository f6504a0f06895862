#pragma once

#include <array>
#include <vector>

#include "mesh/triangle_mesh.hh"

namespace layout_embedding {

/// Mean-value weights (Floater, "Mean value coordinates", 2003) on a surface: the weight of
/// neighbour j as seen from vertex i is (tan(a/2) + tan(b/2)) / |ij| with the angles a and b at i
/// on both sides of edge ij (one of them on the boundary). Positive, and not symmetric: per edge e
/// the weight of its head seen from its tail, then that of its tail seen from its head, with
/// tail and head as of target.halfedge(e).
///
/// Only + - * / and square roots in a fixed order: the same bits on every platform. Degenerate
/// corners count as nearly degenerate ones, so that all weights are finite. O(#F).
std::vector<std::array<double, 2>> mean_value_weights(const TriangleMesh& target);

}  // namespace layout_embedding
