#pragma once

#include <algorithm>
#include <cmath>

#include "patches/domain.hh"

namespace layout_embedding {

/// The step from (0, 0) towards the minimum of a function of the plane, by a quadratic model from
/// differences of width h; downhill in any case. `here` is its value at (0, 0).
template <typename Function>
PlanePoint newton_step(const Function& value, double here, double h)
{
    const double right = value(h, 0);
    const double left = value(-h, 0);
    const double above = value(0, h);
    const double below = value(0, -h);
    const double beyond = value(h, h);
    const PlanePoint gradient((right - left) / (2 * h), (above - below) / (2 * h));
    const double xx = (right + left - 2 * here) / (h * h);
    const double yy = (above + below - 2 * here) / (h * h);
    const double xy = (beyond - right - above + here) / (h * h);
    const double determinant = xx * yy - xy * xy;
    if (xx > 0 && determinant > 1e-6 * xx * yy) {
        const PlanePoint step(-(yy * gradient.x() - xy * gradient.y()) / determinant,
                              -(xx * gradient.y() - xy * gradient.x()) / determinant);
        if (step.dot(gradient) < 0) {
            return step;
        }
    }
    const double curvature = std::max({std::abs(xx), std::abs(yy), 1e-300});
    return -gradient / curvature;
}

}  // namespace layout_embedding
