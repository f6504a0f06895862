#include "maps/map_optimisation.hh"

#include <algorithm>
#include <cmath>
#include <limits>

#include "maps/map_distortion.hh"
#include "patches/point_location.hh"

namespace layout_embedding {
namespace {

/// The points of a triangle at which the other target's metric is taken.
constexpr std::array<std::array<double, 3>, 4> kSamples{{{1.0 / 3, 1.0 / 3, 1.0 / 3},
                                                         {2.0 / 3, 1.0 / 6, 1.0 / 6},
                                                         {1.0 / 6, 2.0 / 3, 1.0 / 6},
                                                         {1.0 / 6, 1.0 / 6, 2.0 / 3}}};
constexpr int kMostHalvings = 8;

/// A metric on the domain: lengths are squared as x^T M x.
struct Metric {
    double xx = 0;
    double xy = 0;
    double yy = 0;
    double determinant = 0;
};

/// A patch with a map that is moved, over a map that is not.
class MovingPatch {
public:
    /// `moves_a`: the energy is the integral over the moving target; otherwise over the other one.
    MovingPatch(const PlacedTarget& moving, const PlacedTarget& fixed, Index face, double scale,
                bool moves_a)
        : placed_(moving.patches()[face]),
          points_(placed_.map.points),
          location_(fixed.patches()[face].map),
          moves_a_(moves_a)
    {
        const std::vector<Vec3> positions = moving.positions(face);
        for (const auto& c : placed_.map.corners) {
            const Vec3 first = positions[c[1]] - positions[c[0]];
            const Vec3 second = positions[c[2]] - positions[c[0]];
            // The map to the domain of the standard triangle instead: rows of the frame's inverse.
            const Matrix2 inverse =
                to_domain_map(positions[c[0]], positions[c[1]], positions[c[2]], PlanePoint(0, 0),
                              PlanePoint(1, 0), PlanePoint(0, 1));
            frames_.push_back(inverse);
            areas_.push_back(first.cross(second).norm() / 2);
        }
        const PlacedPatch& other = fixed.patches()[face];
        const std::vector<Vec3> others = fixed.positions(face);
        for (const auto& c : other.map.corners) {
            const Matrix2 map =
                to_domain_map(others[c[0]], others[c[1]], others[c[2]], other.map.points[c[0]],
                              other.map.points[c[1]], other.map.points[c[2]]);
            const Matrix2 back = map.inverse();
            const Matrix2 metric = scale * (back.transpose() * back);
            metrics_.push_back({metric(0, 0), metric(0, 1), metric(1, 1), metric.determinant()});
        }
    }

    const std::vector<PlanePoint>& points() const { return points_; }
    PlanePoint& point(Index v) { return points_[v]; }
    const PlacedPatch& placed() const { return placed_; }

    /// Whether the triangles around a vertex are positively oriented.
    bool is_positive_around(Index v) const
    {
        return for_star(v, [&](Index t) {
            const auto& c = placed_.map.corners[t];
            return orientation(to_grid(points_[c[0]]), to_grid(points_[c[1]]),
                               to_grid(points_[c[2]])) > 0;
        });
    }

    /// The energy around a vertex; metrics are taken at the places of the samples.
    double energy_around(Index v)
    {
        look_around(v);
        return energy_as_seen(v);
    }

    /// Takes the metrics for energy_as_seen().
    void look_around(Index v)
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

    /// The energy around a vertex with the metrics of the last look_around() at it.
    double energy_as_seen(Index v) const
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

    /// The mean height of the triangles around a vertex in the domain, to judge steps by.
    double size_around(Index v) const
    {
        double least = std::numeric_limits<double>::infinity();
        for_star(v, [&](Index t) {
            const auto& c = placed_.map.corners[t];
            for (std::size_t i = 0; i < 3; ++i) {
                const PlanePoint edge = points_[c[(i + 1) % 3]] - points_[c[i]];
                const double area =
                    cross(points_[c[1]] - points_[c[0]], points_[c[2]] - points_[c[0]]);
                least = std::min(least, area / edge.norm());
            }
            return true;
        });
        return least;
    }

private:
    /// Calls `action` for the triangles around a vertex until it returns false.
    template <typename Action>
    bool for_star(Index v, const Action& action) const
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

    const PlacedPatch& placed_;
    std::vector<PlanePoint> points_;
    PointLocation location_;
    bool moves_a_;
    std::vector<Matrix2> frames_;  // per triangle of the moving map
    std::vector<double> areas_;    // per triangle of the moving map
    std::vector<Metric> metrics_;  // per triangle of the fixed map
    std::vector<Metric> seen_;
};

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

void move_inner(MovingPatch& patch, Index v)
{
    const PlanePoint start = patch.point(v);
    const double before = patch.energy_around(v);
    const double h = 1e-3 * patch.size_around(v);
    if (!(h > 1e-13) || !std::isfinite(before)) {
        return;
    }
    std::array<double, 6> values{before};
    constexpr std::array<std::array<int, 2>, 6> kOffsets{
        {{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}}};
    for (std::size_t i = 1; i < 6; ++i) {
        patch.point(v) = start + h * PlanePoint(kOffsets[i][0], kOffsets[i][1]);
        values[i] = patch.energy_as_seen(v);
    }
    PlanePoint step = newton_step(values, h);
    for (int halving = 0; halving < kMostHalvings; ++halving, step /= 2) {
        patch.point(v) = to_plane(to_grid(start + step));
        if (patch.is_positive_around(v) && patch.energy_around(v) < before) {
            return;
        }
    }
    patch.point(v) = start;
}

}  // namespace

MapOptimisation::MapOptimisation(const Layout& layout, PlacedTarget& a, PlacedTarget& b)
    : layout_(layout), targets_{&a, &b}
{
    std::array<double, 2> areas{0, 0};
    for (std::size_t side = 0; side < 2; ++side) {
        for (Index face = 0; face < layout.face_count(); ++face) {
            const std::vector<Vec3> x = targets_[side]->positions(face);
            for (const auto& c : targets_[side]->patches()[face].map.corners) {
                areas[side] += (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).norm() / 2;
            }
        }
    }
    scale_ = areas[0] / areas[1];
}

void MapOptimisation::round()
{
    move_all(1);
    move_all(0);
}

void MapOptimisation::move_all(std::size_t side)
{
    PlacedTarget& moving = *targets_[side];
    const PlacedTarget& fixed = *targets_[1 - side];
    std::vector<MovingPatch> patches;
    patches.reserve(layout_.face_count());
    for (Index face = 0; face < layout_.face_count(); ++face) {
        patches.emplace_back(moving, fixed, face, side == 0 ? scale_ : 1 / scale_, side == 0);
        MovingPatch& patch = patches.back();
        const PlacedPatch& placed = patch.placed();
        for (Index v = placed.patch.boundary_size(); v < patch.points().size(); ++v) {
            move_inner(patch, v);
        }
    }
    // The boundary vertices of each chain in the patches beside it.
    struct Beside {
        Index face;
        Index begin;
        bool forward;
        std::array<std::int64_t, 2> from;
        std::array<std::int64_t, 2> step;
    };
    std::vector<std::vector<Beside>> beside(layout_.edge_count());
    for (Index face = 0; face < layout_.face_count(); ++face) {
        const Domain& domain = moving.domains()[face];
        const auto halfedges = layout_.face_halfedges(face);
        for (Index s = 0; s < halfedges.size(); ++s) {
            const auto corner = [&](std::size_t i) {
                const PlanePoint& p = domain[i % domain.size()];
                return std::array<std::int64_t, 2>{static_cast<std::int64_t>(p.x() * kCornerSteps),
                                                   static_cast<std::int64_t>(p.y() * kCornerSteps)};
            };
            const auto from = corner(s);
            const auto to = corner(s + 1);
            beside[Layout::edge(halfedges[s])].push_back({face,
                                                          patches[face].placed().patch.sides[s],
                                                          halfedges[s] % 2 == 0,
                                                          from,
                                                          {to[0] - from[0], to[1] - from[1]}});
        }
    }
    for (Index e = 0; e < layout_.edge_count(); ++e) {
        ChainShares shares = moving.shares()[e];
        const std::size_t last = shares.size() - 1;
        for (std::size_t i = 1; i < last; ++i) {
            const std::int64_t start = shares[i];
            const auto vertex = [&](const Beside& b) {
                return b.begin + static_cast<Index>(b.forward ? i : last - i);
            };
            const auto place = [&](std::int64_t share) {
                for (const Beside& b : beside[e]) {
                    const std::int64_t along = b.forward ? share : kWholeShare - share;
                    patches[b.face].point(vertex(b)) =
                        to_plane({b.from[0] * kWholeShare + along * b.step[0],
                                  b.from[1] * kWholeShare + along * b.step[1]});
                }
            };
            const auto energy = [&] {
                double sum = 0;
                for (const Beside& b : beside[e]) {
                    sum += patches[b.face].energy_around(vertex(b));
                }
                return sum;
            };
            const auto positive = [&] {
                return std::all_of(beside[e].begin(), beside[e].end(), [&](const Beside& b) {
                    return patches[b.face].is_positive_around(vertex(b));
                });
            };
            const double before = energy();
            const std::int64_t room =
                std::min(shares[i] - shares[i - 1], shares[i + 1] - shares[i]);
            const std::int64_t h = room / 64;
            if (h < 1 || !std::isfinite(before)) {
                continue;
            }
            const auto as_seen = [&](std::int64_t share) {
                place(share);
                double sum = 0;
                for (const Beside& b : beside[e]) {
                    sum += patches[b.face].energy_as_seen(vertex(b));
                }
                return sum;
            };
            place(start);
            for (const Beside& b : beside[e]) {
                patches[b.face].look_around(vertex(b));
            }
            const double above = as_seen(start + h);
            const double below = as_seen(start - h);
            const double slope = (above - below) / 2;
            const double curvature = above + below - 2 * before;
            if (!std::isfinite(slope) || slope == 0) {
                place(start);
                continue;
            }
            double step = curvature > 0 ? -slope / curvature * static_cast<double>(h)
                                        : (slope > 0 ? -1.0 : 1.0) * static_cast<double>(room) / 4;
            bool moved = false;
            for (int halving = 0; halving < kMostHalvings && !moved; ++halving, step /= 2) {
                const std::int64_t share =
                    start + static_cast<std::int64_t>(std::round(std::clamp(step, -1e18, 1e18)));
                if (share - shares[i - 1] < 64 || shares[i + 1] - share < 64) {
                    continue;
                }
                place(share);
                moved = positive() && energy() < before;
                if (moved) {
                    shares[i] = share;
                }
            }
            if (!moved) {
                place(start);
            }
        }
        moving.set_shares(e, std::move(shares));
    }
    for (Index face = 0; face < layout_.face_count(); ++face) {
        moving.set_points(face, patches[face].points());
    }
}

}  // namespace layout_embedding
