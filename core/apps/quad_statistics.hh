#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/types.hh"

namespace layout_embedding {

/// How a quad mesh is shaped.
struct QuadStatistics {
    /// Of all quads, the smallest scaled Jacobian at a corner: the sine of the angle there,
    /// negative where the quad is flipped or not convex.
    double least_jacobian = 0;
    double mean_jacobian = 0;
    /// Quads whose scaled Jacobian is not positive.
    Index flipped = 0;
    /// Degrees.
    double least_angle = 0;
    double largest_angle = 0;
    /// Root mean square of the differences to 90 degrees.
    double angle_deviation = 0;
    /// In the target's units.
    double least_edge = 0;
    double mean_edge = 0;
    double largest_edge = 0;
};

/// The normal from which the corners of a quad are seen, not of length 1: its own, which is normal
/// to both diagonals, or `up`, the surface's normal there, where the cosine between them is not
/// above `least_cosine`.
Vec3 quad_normal(const std::array<Vec3, 4>& corners, const Vec3& up, double least_cosine = 0);

/// The smallest scaled Jacobian of a quad as seen from quad_normal().
double scaled_jacobian(const std::array<Vec3, 4>& corners, const Vec3& up);

/// `ups`: per quad, the surface's normal there.
QuadStatistics quad_statistics(std::span<const Vec3> positions,
                               std::span<const std::array<Index, 4>> quads,
                               std::span<const Vec3> ups);

}  // namespace layout_embedding
