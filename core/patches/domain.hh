#pragma once

#include <span>
#include <vector>

#include "base/types.hh"

namespace layout_embedding {

/// A point or vector in a plane domain.
using PlanePoint = Eigen::Vector2d;

/// Twice the signed area of the triangle between a and b.
inline double cross(const PlanePoint& a, const PlanePoint& b)
{
    return a.x() * b.y() - a.y() * b.x();
}

/// The corners of a convex polygon in the plane, counter-clockwise; side i runs from corner i to
/// the next one.
using Domain = std::vector<PlanePoint>;

/// The regular polygon with n >= 3 corners on the unit circle, the first one at (1, 0). Computed
/// with + - * / alone: the same bits on every platform.
Domain regular_polygon(Index n);

/// The rectangle with the corners (0, 0), (width, 0), (width, height), (0, height).
Domain rectangle(double width, double height);

/// A polygon with its corners on the unit circle, the first one at (1, 0), whose sides span angles
/// proportional to `lengths` (#sides >= 3 of them, none negative); none less than a tenth of the
/// mean. The same bits on every platform, too.
Domain inscribed_polygon(std::span<const double> lengths);

double area(const Domain& domain);

}  // namespace layout_embedding
