#include "apps/quad_vertex_moves.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "patches/domain.hh"
#include "patches/newton_step.hh"

namespace layout_embedding {
namespace {

/// Two directions of length 1 that span a plane with the normal.
struct Tangents {
    Vec3 across;
    Vec3 along;
};

Tangents tangents_of(const Vec3& normal)
{
    int axis = 0;
    normal.cwiseAbs().minCoeff(&axis);
    const Vec3 across = normal.cross(Vec3::Unit(axis)).normalized();
    return {across, normal.cross(across)};
}

}  // namespace

double move_to_mean(MovableQuads& quads, Index v)
{
    constexpr double kGood = 0.5;
    const Vec3 mean = quads.mean_around(v);
    double length = 0;
    Index count = 0;
    for (const Index q : quads.quads_at(v)) {
        const auto& quad = quads.quad(q);
        const auto at = std::find(quad.begin(), quad.end(), v) - quad.begin();
        for (const auto step : {1, 3}) {
            const Vec3& neighbour = quads.position(quad[static_cast<std::size_t>((at + step) % 4)]);
            length += (neighbour - quads.position(v)).norm();
            ++count;
        }
    }
    length /= count;
    const MovableQuads::Place old = quads.place(v);
    const double before = quads.quality(v);
    for (const double step : {1.0, 0.5, 0.2}) {
        quads.walk(v, old.point, (1 - step) * old.position + step * mean);
        const double after = quads.quality(v);
        if (after > before || after >= kGood) {
            return length > 0 ? (quads.position(v) - old.position).norm() / length : 0;
        }
    }
    quads.put(v, old);
    return 0;
}

double lower_distortion(MovableQuads& quads, Index v, const StepRule& rule)
{
    constexpr int kHalvings = 6;
    const MovableQuads::Place old = quads.place(v);
    double length = std::numeric_limits<double>::infinity();
    double longest = 0;
    for (const Index q : quads.quads_at(v)) {
        for (const Index corner : quads.quad(q)) {
            if (corner != v) {
                const double distance = (quads.position(corner) - old.position).norm();
                length = std::min(length, distance);
                longest = std::max(longest, distance);
            }
        }
    }
    const auto [across, along] = tangents_of(quads.normal(v));
    const auto flat_around = [&] { return rule.flat > 0 ? quads.flipped_around(v, rule.flat) : 0; };
    const auto quality = [&] {
        return rule.floor > 0 ? std::min(quads.quality(v), rule.floor) : 0;
    };
    const double worst = quality();
    const double before = quads.distortion(v, rule.least_cosine);
    const Index flipped = quads.flipped_around(v);
    const Index flat = flat_around();
    const double h = 1e-3 * std::max(length, 1e-3 * longest);
    PlanePoint step = newton_step(
        [&, &across = across, &along = along](double x, double y) {
            quads.hold(v, old.position + x * across + y * along);
            return quads.distortion(v, rule.least_cosine);
        },
        before, h);
    const double size = step.norm();
    if (!std::isfinite(size)) {
        quads.put(v, old);  // all around v lies in one place
        return 0;
    }
    if (size > longest) {
        step *= longest / size;
    }
    for (int halving = 0; halving < kHalvings; ++halving, step /= 2) {
        quads.walk(v, old.point, old.position + step.x() * across + step.y() * along);
        const double after = quads.distortion(v, rule.least_cosine);
        if (after < before && (rule.may_flip || (quads.flipped_around(v) <= flipped &&
                                                 flat_around() <= flat && quality() >= worst))) {
            return 1 - after / before;
        }
    }
    quads.put(v, old);
    return 0;
}

bool look_around(MovableQuads& quads, Index v)
{
    const Domain directions = regular_polygon(8);
    const MovableQuads::Place old = quads.place(v);
    double length = 0;
    for (const Index q : quads.quads_at(v)) {
        for (const Index corner : quads.quad(q)) {
            length = std::max(length, (quads.position(corner) - old.position).norm());
        }
    }
    const auto [across, along] = tangents_of(quads.normal(v));
    const double before = quads.quality(v);
    const Index flipped = quads.flipped_around(v);
    double best = before;
    MovableQuads::Place best_place = old;
    for (const double step : {0.4, 0.15, 0.05, 0.015}) {
        for (const PlanePoint& direction : directions) {
            quads.walk(
                v, old.point,
                old.position + step * length * (direction.x() * across + direction.y() * along));
            if (const double here = quads.quality(v);
                here > best && quads.flipped_around(v) <= flipped) {
                best = here;
                best_place = quads.place(v);
            }
        }
    }
    quads.put(v, best_place);
    return best > before + 1e-3;
}

}  // namespace layout_embedding
