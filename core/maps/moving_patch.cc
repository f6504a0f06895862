#include "maps/moving_patch.hh"

#include <algorithm>
#include <cmath>
#include <limits>

#include "patches/newton_step.hh"

namespace layout_embedding {
namespace {

/// The points of a triangle at which the other target's metric is taken.
constexpr std::array<std::array<double, 3>, 4> kSamples{{{1.0 / 3, 1.0 / 3, 1.0 / 3},
                                                         {2.0 / 3, 1.0 / 6, 1.0 / 6},
                                                         {1.0 / 6, 2.0 / 3, 1.0 / 6},
                                                         {1.0 / 6, 1.0 / 6, 2.0 / 3}}};
constexpr int kStepHalvings = 8;
/// The least determinant of a triangle's metric, as a share of its size.
constexpr double kLeastShare = 1e-24;

}  // namespace

MovingPatch::MovingPatch(const PlacedPatch& moving, const std::vector<Vec3>& moving_positions,
                         const PlacedPatch& fixed, const std::vector<Vec3>& fixed_positions,
                         double scale, bool moves_a, MapEnergy judged_by)
    : placed_(moving),
      points_(moving.map.points),
      location_(fixed.map),
      moves_a_(moves_a),
      judged_by_(judged_by),
      fixed_(fixed),
      fixed_positions_(fixed_positions),
      scale_(scale)
{
    for (const auto& c : moving.map.corners) {
        // To the standard triangle, for any place of the corners in the domain.
        frames_.push_back(to_domain_map(moving_positions[c[0]], moving_positions[c[1]],
                                        moving_positions[c[2]], PlanePoint(0, 0), PlanePoint(1, 0),
                                        PlanePoint(0, 1)));
        const Vec3 u = moving_positions[c[1]] - moving_positions[c[0]];
        const Vec3 w = moving_positions[c[2]] - moving_positions[c[0]];
        const double area = u.cross(w).norm() / 2;
        const double size = std::max({u.squaredNorm(), w.squaredNorm(), 1e-300});
        const double determinant = std::max(4 * area * area, kLeastShare * size * size);
        shapes_.push_back(
            {area, w.dot(w) / determinant, -u.dot(w) / determinant, u.dot(u) / determinant});
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

/// |J|^2 + |J^-1|^2 times the area of target a per area of the target that moves.
double MovingPatch::energy(double squares, double ratio) const
{
    return squares * (moves_a_ ? 1 + 1 / (ratio * ratio) : ratio + 1 / ratio);
}

/// The place on the target that stays of a point of the domain.
Vec3 MovingPatch::lifted(const PlanePoint& point) const
{
    const PointLocation::Place place = location_.find(point);
    const auto& c = fixed_.map.corners[place.triangle];
    return place.barycentrics[0] * fixed_positions_[c[0]] +
           place.barycentrics[1] * fixed_positions_[c[1]] +
           place.barycentrics[2] * fixed_positions_[c[2]];
}

void MovingPatch::look_around(Index v)
{
    seen_.clear();
    for_star(v, [&](Index t) {
        const auto& c = placed_.map.corners[t];
        const auto corner = static_cast<std::size_t>(std::find(c.begin(), c.end(), v) - c.begin());
        const PlanePoint& next = points_[c[(corner + 1) % 3]];
        const PlanePoint& last = points_[c[(corner + 2) % 3]];
        Opposite opposite{t, corner, {lifted(next), lifted(last), lifted((next + last) / 2)}, {}};
        for (std::size_t i = 0; judged_by_ != MapEnergy::places && i < kSamples.size(); ++i) {
            const PlanePoint p = kSamples[i][0] * points_[c[0]] + kSamples[i][1] * points_[c[1]] +
                                 kSamples[i][2] * points_[c[2]];
            opposite.metrics[i] = metrics_[location_.find(p).triangle];
        }
        seen_.push_back(opposite);
        return true;
    });
}

double MovingPatch::sampled_energy(const Opposite& opposite) const
{
    const auto& c = placed_.map.corners[opposite.triangle];
    const PlanePoint p = points_[c[1]] - points_[c[0]];
    const PlanePoint q = points_[c[2]] - points_[c[0]];
    const Matrix2& frame = frames_[opposite.triangle];
    // The map from the triangle's plane to the domain.
    const double a = p.x() * frame(0, 0) + q.x() * frame(1, 0);
    const double b = p.x() * frame(0, 1) + q.x() * frame(1, 1);
    const double d = p.y() * frame(0, 0) + q.y() * frame(1, 0);
    const double e = p.y() * frame(0, 1) + q.y() * frame(1, 1);
    const double determinant = a * e - b * d;
    double sum = 0;
    for (const Metric& m : opposite.metrics) {
        const double squares =
            m.xx * (a * a + b * b) + 2 * m.xy * (a * d + b * e) + m.yy * (d * d + e * e);
        const double ratio = std::sqrt(determinant * determinant * m.determinant);
        sum += energy(squares, ratio);
    }
    return shapes_[opposite.triangle].area / kSamples.size() * sum;
}

double MovingPatch::energy_as_seen(Index v) const
{
    const PlanePoint& point = points_[v];
    const Vec3 place = lifted(point);
    double sum = 0;
    for (const Opposite& opposite : seen_) {
        const auto& corners = placed_.map.corners[opposite.triangle];
        const PlanePoint& next = points_[corners[(opposite.corner + 1) % 3]];
        const PlanePoint& last = points_[corners[(opposite.corner + 2) % 3]];
        if (!(cross(next - point, last - point) > 0)) {
            return std::numeric_limits<double>::infinity();
        }
        if (judged_by_ == MapEnergy::samples) {
            sum += sampled_energy(opposite);
            continue;
        }
        // Corners, and the middles of the sides that begin at them.
        std::array<Vec3, 3> c;
        std::array<Vec3, 3> m;
        c[opposite.corner] = place;
        c[(opposite.corner + 1) % 3] = opposite.places[0];
        c[(opposite.corner + 2) % 3] = opposite.places[1];
        m[opposite.corner] = lifted((point + next) / 2);
        m[(opposite.corner + 1) % 3] = opposite.places[2];
        m[(opposite.corner + 2) % 3] = lifted((last + point) / 2);
        const Shape& shape = shapes_[opposite.triangle];
        const auto add = [&](const Vec3& p, const Vec3& q) {
            const double squares =
                4 * scale_ * (shape.xx * p.dot(p) + 2 * shape.xy * p.dot(q) + shape.yy * q.dot(q));
            const double ratio =
                std::max(2 * scale_ * p.cross(q).norm() / std::max(shape.area, 1e-300), 1e-100);
            // |J|^2 + |J^-1|^2, per area of target a.
            sum +=
                shape.area / 4 * squares * (moves_a_ ? 1 + 1 / (ratio * ratio) : ratio + 1 / ratio);
        };
        add(m[0] - c[0], m[2] - c[0]);
        add(c[1] - m[0], m[1] - m[0]);
        add(m[1] - m[2], c[2] - m[2]);
        add(m[1] - m[2], m[1] - m[0]);
        if (judged_by_ != MapEnergy::places) {
            sum += sampled_energy(opposite);
        }
    }
    return sum;
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
    PlanePoint step = newton_step(
        [&](double x, double y) {
            points_[v] = start + PlanePoint(x, y);
            return energy_as_seen(v);
        },
        before, h);
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
