#include "embedding/triangle_quality.hh"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace layout_embedding {

TriangleQuality triangle_quality(const std::vector<Vec3>& positions,
                                 const std::vector<Index>& corners)
{
    if (corners.empty()) {
        return {};
    }
    // The smallest angle of a triangle lies opposite to its shortest side: the smallest tangent of
    // all is enough to find it.
    double least_sine = 1;
    double least_cosine = 0;
    double least_area = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < corners.size(); i += 3) {
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3& a = positions[corners[i + k]];
            const Vec3 u = positions[corners[i + (k + 1) % 3]] - a;
            const Vec3 v = positions[corners[i + (k + 2) % 3]] - a;
            const double sine = u.cross(v).norm();
            const double cosine = u.dot(v);
            least_area = std::min(least_area, 0.5 * sine);
            if (cosine > 0 && sine * least_cosine < least_sine * cosine) {
                least_sine = sine;
                least_cosine = cosine;
            } else if (!(sine > 0)) {
                least_sine = 0;
                least_cosine = 1;
            }
        }
    }
    return {std::atan2(least_sine, least_cosine) * 180 / std::numbers::pi, least_area};
}

}  // namespace layout_embedding
