#include "apps/quad_statistics.hh"

#include <algorithm>
#include <cmath>
#include <limits>

namespace layout_embedding {

Vec3 quad_normal(const std::array<Vec3, 4>& corners, const Vec3& up, double least_cosine)
{
    const Vec3 own = (corners[2] - corners[0]).cross(corners[3] - corners[1]);
    const double least = least_cosine > 0 ? least_cosine * own.norm() * up.norm() : 0;
    return own.dot(up) <= least ? up : own;
}

double scaled_jacobian(const std::array<Vec3, 4>& corners, const Vec3& up)
{
    const Vec3 normal = quad_normal(corners, up);
    const double length = normal.norm();
    if (!(length > 0)) {
        return -1;
    }
    double least = 1;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 u = corners[(i + 1) % 4] - corners[i];
        const Vec3 v = corners[(i + 3) % 4] - corners[i];
        const double product = u.norm() * v.norm() * length;
        least = std::min(least, product > 0 ? u.cross(v).dot(normal) / product : -1.0);
    }
    return least;
}

QuadStatistics quad_statistics(std::span<const Vec3> positions,
                               std::span<const std::array<Index, 4>> quads,
                               std::span<const Vec3> ups)
{
    constexpr double kDegrees = 57.29577951308232;
    QuadStatistics statistics;
    statistics.least_jacobian = 1;
    statistics.least_angle = 180;
    statistics.least_edge = std::numeric_limits<double>::infinity();
    double jacobians = 0;
    double squares = 0;
    double lengths = 0;
    for (std::size_t q = 0; q < quads.size(); ++q) {
        std::array<Vec3, 4> corners;
        for (std::size_t i = 0; i < 4; ++i) {
            corners[i] = positions[quads[q][i]];
        }
        const double jacobian = scaled_jacobian(corners, ups[q]);
        statistics.least_jacobian = std::min(statistics.least_jacobian, jacobian);
        jacobians += jacobian;
        statistics.flipped += jacobian > 0 ? 0 : 1;
        for (std::size_t i = 0; i < 4; ++i) {
            const Vec3 u = corners[(i + 1) % 4] - corners[i];
            const Vec3 v = corners[(i + 3) % 4] - corners[i];
            const double angle = std::atan2(u.cross(v).norm(), u.dot(v)) * kDegrees;
            statistics.least_angle = std::min(statistics.least_angle, angle);
            statistics.largest_angle = std::max(statistics.largest_angle, angle);
            squares += (angle - 90) * (angle - 90);
            const double length = u.norm();
            statistics.least_edge = std::min(statistics.least_edge, length);
            statistics.largest_edge = std::max(statistics.largest_edge, length);
            lengths += length;
        }
    }
    const auto count = static_cast<double>(quads.size());
    statistics.mean_jacobian = jacobians / count;
    statistics.angle_deviation = std::sqrt(squares / (4 * count));
    statistics.mean_edge = lengths / (4 * count);
    return statistics;
}

}  // namespace layout_embedding
