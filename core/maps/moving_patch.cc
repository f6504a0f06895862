#include "maps/moving_patch.hh"

#include <algorithm>
#include <cmath>
#include <limits>

namespace layout_embedding {
namespace {

/// The points of a triangle at which the other target's metric is taken.
constexpr std::array<std::array<double, 3>, 4> kSamples{{{1.0 / 3, 1.0 / 3, 1.0 / 3},
                                                         {2.0 / 3, 1.0 / 6, 1.0 / 6},
                                                         {1.0 / 6, 2.0 / 3, 1.0 / 6},
                                                         {1.0 / 6, 1.0 / 6, 2.0 / 3}}};
constexpr int kStepHalvings = 8;

/// The step towards the minimum of a quadratic model from values at (0,0), (h,0), (-h,0), (0,h),
/// (0,-h), (h,h); downhill in any case.
PlanePoint newton_step(const std::array<double, 6>& f, double h)
{
    const PlanePoint gradient((f[1] - f[2]) / (2 * h), (f[3] - f[4]) / (2 * h));
    const double xx = (f[1] + f[2] - 2 * f[0]) / (h * h);
    const double yy = (f[3] + f[4] - 2 * f[0]) / (h * h);
    const double xy = (f[5] - f[1] - f[3] + f[0]) / (h * h);
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

}  // namespace

MovingPatch::MovingPatch(const PlacedPatch& moving, const std::vector<Vec3>& moving_positions,
                         const PlacedPatch& fixed, const std::vector<Vec3>& fixed_positions,
                         double scale, bool moves_a)
    : placed_(moving), points_(moving.map.points), location_(fixed.map), moves_a_(moves_a)
{
    for (const auto& c : moving.map.corners) {
        const Vec3& a = moving_positions[c[0]];
        const Vec3& b = moving_positions[c[1]];
        const Vec3& d = moving_positions[c[2]];
        // To the standard triangle, for any place of the corners in the domain.
        frames_.push_back(
            to_domain_map(a, b, d, PlanePoint(0, 0), PlanePoint(1, 0), PlanePoint(0, 1)));
        areas_.push_back((b - a).cross(d - a).norm() / 2);
    }
    for (const auto& c : fixed.map.corners) {
        const Matrix2 back =
            to_domain_map(fixed_positions[c[0]], fixed_positions[c[1]], fixed_positions[c[2]],
                          fixed.map.points[c[0]], fixed.map.points[c[1]], fixed.map.points[c[2]])
                .inverse();
        const Matrix2 metric = scale * (back.transpose() * back);
        metrics_.push_back({metric(0, 0), metric(0, 1), metric(1, 1), metric.determinant()});
    }
}

/// Calls `action` for the triangles around a vertex until it returns false.
template <typename Action>
bool MovingPatch::for_star(Index v, const Action& action) const
{
    const TriangleMesh& mesh = placed_.mesh;
    const Index first = mesh.outgoing(v);
    for (Index h = first; h != kNone;) {
        if (!action(TriangleMesh::face_of(h))) {
            return false;
        }
        h = mesh.rotated_ccw(h);
        if (h == first) {
            break;
        }
    }
    return true;
}

bool MovingPatch::is_positive_around(Index v) const
{
    return for_star(v, [&](Index t) {
        const auto& c = placed_.map.corners[t];
        return orientation(to_grid(points_[c[0]]), to_grid(points_[c[1]]), to_grid(points_[c[2]])) >
               0;
    });
}

double MovingPatch::energy_around(Index v)
{
    look_around(v);
    return energy_as_seen(v);
}

void MovingPatch::look_around(Index v)
{
    seen_.clear();
    for_star(v, [&](Index t) {
        const auto& c = placed_.map.corners[t];
        for (const auto& weights : kSamples) {
            const PlanePoint p = weights[0] * points_[c[0]] + weights[1] * points_[c[1]] +
                                 weights[2] * points_[c[2]];
            seen_.push_back(metrics_[location_.find(p).triangle]);
        }
        return true;
    });
}

double MovingPatch::energy_as_seen(Index v) const
{
    double sum = 0;
    std::size_t sample = 0;
    const bool positive = for_star(v, [&](Index t) {
        const auto& c = placed_.map.corners[t];
        const PlanePoint p = points_[c[1]] - points_[c[0]];
        const PlanePoint q = points_[c[2]] - points_[c[0]];
        const Matrix2& frame = frames_[t];
        // The map from the triangle's plane to the domain.
        const double a = p.x() * frame(0, 0) + q.x() * frame(1, 0);
        const double b = p.x() * frame(0, 1) + q.x() * frame(1, 1);
        const double d = p.y() * frame(0, 0) + q.y() * frame(1, 0);
        const double e = p.y() * frame(0, 1) + q.y() * frame(1, 1);
        const double determinant = a * e - b * d;
        if (!(determinant > 0)) {
            return false;
        }
        double of_triangle = 0;
        for (std::size_t i = 0; i < kSamples.size(); ++i, ++sample) {
            const Metric& m = seen_[sample];
            const double squares =
                m.xx * (a * a + b * b) + 2 * m.xy * (a * d + b * e) + m.yy * (d * d + e * e);
            const double ratio = determinant * determinant * m.determinant;
            // |J|^2 + |J^-1|^2, per area of target a.
            of_triangle += moves_a_ ? squares * (1 + 1 / ratio)
                                    : squares * (std::sqrt(ratio) + 1 / std::sqrt(ratio));
        }
        sum += areas_[t] * of_triangle / kSamples.size();
        return true;
    });
    return positive ? sum : std::numeric_limits<double>::infinity();
}

double MovingPatch::least_height_around(Index v) const
{
    double least = std::numeric_limits<double>::infinity();
    for_star(v, [&](Index t) {
        const auto& c = placed_.map.corners[t];
        for (std::size_t i = 0; i < 3; ++i) {
            const PlanePoint edge = points_[c[(i + 1) % 3]] - points_[c[i]];
            const double area = cross(points_[c[1]] - points_[c[0]], points_[c[2]] - points_[c[0]]);
            least = std::min(least, area / edge.norm());
        }
        return true;
    });
    return least;
}

void MovingPatch::improve(Index v)
{
    const PlanePoint start = points_[v];
    const double before = energy_around(v);
    const double h = 1e-3 * least_height_around(v);
    if (!(h > 1e-13) || !std::isfinite(before)) {
        return;
    }
    std::array<double, 6> values{before};
    constexpr std::array<std::array<int, 2>, 6> kOffsets{
        {{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}}};
    for (std::size_t i = 1; i < 6; ++i) {
        points_[v] = start + h * PlanePoint(kOffsets[i][0], kOffsets[i][1]);
        values[i] = energy_as_seen(v);
    }
    PlanePoint step = newton_step(values, h);
    for (int halving = 0; halving < kStepHalvings; ++halving, step /= 2) {
        points_[v] = to_plane(to_grid(start + step));
        if (is_positive_around(v) && energy_around(v) < before) {
            return;
        }
    }
    points_[v] = start;
}

void MovingPatch::improve_all()
{
    for (Index v = placed_.patch.boundary_size(); v < points_.size(); ++v) {
        improve(v);
    }
}

}  // namespace layout_embedding
