#include "shapes/solid.hh"

#include <algorithm>
#include <cmath>

namespace layout_embedding::shapes {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Smooth minimum with a cubic blend (Quilez, "Smooth minimum"): the minimum where the two differ
/// by k or more. Returns it with the share of b in its gradient.
std::array<double, 2> smooth_min(double a, double b, double k)
{
    const double difference = std::abs(a - b);
    if (difference >= k) {
        return a < b ? std::array{a, 0.0} : std::array{b, 1.0};
    }
    const double h = (k - difference) / k;
    const double share = 0.5 * h * h;
    const double value = (a < b ? a : b) - h * h * h * k * (1.0 / 6.0);
    return {value, a < b ? share : 1.0 - share};
}

double blend_radius(const Blend& blend, const Vec3& point)
{
    if (blend.reach == kInfinity) {
        return blend.radius;
    }
    const double x = 2.0 - (point - blend.center).norm() / blend.reach;
    if (x >= 1.0) {
        return blend.radius;
    }
    return x <= 0.0 ? 0.0 : blend.radius * x * x * (3.0 - 2.0 * x);
}

/// Signed distance to a simple polygon and its gradient.
std::array<double, 3> polygon_value(const Profile& polygon, double x, double y)
{
    double best = kInfinity;
    double best_x = 0.0;
    double best_y = 0.0;
    bool inside = false;
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
        const double ex = polygon[j][0] - polygon[i][0];
        const double ey = polygon[j][1] - polygon[i][1];
        const double wx = x - polygon[i][0];
        const double wy = y - polygon[i][1];
        const double t = std::clamp((wx * ex + wy * ey) / (ex * ex + ey * ey), 0.0, 1.0);
        const double bx = wx - t * ex;
        const double by = wy - t * ey;
        if (bx * bx + by * by < best) {
            best = bx * bx + by * by;
            best_x = bx;
            best_y = by;
        }
        if ((polygon[i][1] > y) != (polygon[j][1] > y) && wx < ex * wy / ey) {
            inside = !inside;
        }
    }
    const double distance = std::sqrt(best);
    const double sign = inside ? -1.0 : 1.0;
    const double scale = distance > 0.0 ? sign / distance : 0.0;
    return {sign * distance, scale * best_x, scale * best_y};
}

template <typename T>
T spline(const T& p0, const T& p1, const T& p2, const T& p3, double t)
{
    return T(p1 + 0.5 * t *
                      ((p2 - p0) + t * ((2.0 * p0 - 5.0 * p1 + 4.0 * p2 - p3) +
                                        t * (3.0 * (p1 - p2) + p3 - p0))));
}

/// Position and radius in one vector.
using Vec4 = Eigen::Vector4d;

Vec4 packed(const Knot& knot)
{
    return {knot.position.x(), knot.position.y(), knot.position.z(), knot.radius};
}

std::vector<Knot> sampled(const std::vector<Knot>& knots, int samples, bool closed)
{
    const int count = static_cast<int>(knots.size());
    const auto knot = [&](int i) {
        return packed(knots[closed ? (i + count) % count : std::clamp(i, 0, count - 1)]);
    };
    std::vector<Knot> result;
    for (int i = 0; i + (closed ? 0 : 1) < count; ++i) {
        for (int s = 0; s < samples; ++s) {
            const Vec4 p = spline<Vec4>(knot(i - 1), knot(i), knot(i + 1), knot(i + 2),
                                        static_cast<double>(s) / samples);
            // A spline through a small radius between large ones may undershoot.
            const double least = 0.5 * std::min(knot(i)[3], knot(i + 1)[3]);
            result.push_back({{p[0], p[1], p[2]}, std::max(p[3], least)});
        }
    }
    result.push_back(closed ? result.front() : knots.back());
    return result;
}

}  // namespace

Profile smooth_curve(const Profile& points, int samples)
{
    std::vector<Knot> knots;
    for (const auto& [x, y] : points) {
        knots.push_back({{x, y, 0.0}, 0.0});
    }
    Profile result;
    for (const Knot& knot : sampled(knots, samples, false)) {
        result.push_back({knot.position.x(), knot.position.y()});
    }
    return result;
}

void Solid::sweep(const std::vector<Knot>& knots, const Blend& blend, const Squash& flat,
                  int samples)
{
    if (knots.size() == 1) {
        add_tube({knots[0], knots[0]}, blend, flat);
    } else {
        add_tube(sampled(knots, knots.size() == 2 ? 1 : samples, false), blend, flat);
    }
}

void Solid::closed_sweep(const std::vector<Knot>& knots, const Blend& blend, const Squash& flat,
                         int samples)
{
    add_tube(sampled(knots, samples, true), blend, flat);
}

void Solid::ellipsoid(const Frame& frame, const Vec3& radii, const Blend& blend)
{
    add_tube({{frame.origin, 1.0}, {frame.origin, 1.0}}, blend, {frame, radii});
}

void Solid::add_tube(const std::vector<Knot>& samples, const Blend& blend, const Squash& flat)
{
    Part part;
    part.kind = Kind::cones;
    part.blend = blend;
    part.origin = samples.front().position;
    part.to_part = flat.scale.cwiseInverse().asDiagonal() * flat.frame.axes.transpose();
    part.rigid = flat.scale == Vec3::Ones();
    part.least_scale = flat.scale.minCoeff();
    part.largest_scale = flat.scale.maxCoeff();
    Vec3 lower = Vec3::Constant(kInfinity);
    Vec3 upper = -lower;
    const double widest = flat.scale.maxCoeff();
    for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
        Cone cone;
        cone.a = part.to_part * (samples[i].position - part.origin);
        const Vec3 b = part.to_part * (samples[i + 1].position - part.origin);
        cone.radius_a = samples[i].radius;
        cone.radius_b = samples[i + 1].radius;
        cone.length = (b - cone.a).norm();
        cone.center = 0.5 * (cone.a + b);
        cone.bound = 0.5 * cone.length + std::max(cone.radius_a, cone.radius_b);
        cone.axis = cone.length > 0.0 ? Vec3((b - cone.a) / cone.length) : Vec3::UnitX();
        const double slope = cone.radius_a - cone.radius_b;
        if (cone.length > std::abs(slope)) {
            cone.sine = slope / cone.length;
            cone.cosine = std::sqrt(1.0 - cone.sine * cone.sine);
        } else {
            // One ball lies in the other.
            if (cone.radius_b > cone.radius_a) {
                cone.a = b;
                cone.radius_a = cone.radius_b;
            }
            cone.length = 0.0;
            cone.sine = 0.0;
            cone.cosine = 0.0;
        }
        part.cones.push_back(cone);
    }
    for (const Knot& knot : samples) {
        lower = lower.cwiseMin((knot.position.array() - widest * knot.radius).matrix());
        upper = upper.cwiseMax((knot.position.array() + widest * knot.radius).matrix());
    }
    add(std::move(part), lower, upper);
}

void Solid::revolution(const Frame& frame, Profile profile, double rounding, const Blend& blend)
{
    double low = kInfinity;
    double high = -kInfinity;
    double radius = 0.0;
    for (const auto& [x, y] : profile) {
        low = std::min(low, y);
        high = std::max(high, y);
        radius = std::max(radius, x);
    }
    // Where it touches the axis it is mirrored there, so that the axis is no edge of it.
    const auto on_axis = [](const Point2& p) { return p[0] == 0.0; };
    if (std::any_of(profile.begin(), profile.end(), on_axis)) {
        for (std::size_t i = profile.size(); i-- > 0;) {
            if (!on_axis(profile[i])) {
                profile.push_back({-profile[i][0], profile[i][1]});
            }
        }
    }
    Part part;
    part.kind = Kind::revolution;
    part.blend = blend;
    part.origin = frame.origin;
    part.to_part = frame.axes.transpose();
    part.rigid = true;
    part.profile = std::move(profile);
    part.rounding = rounding;
    const Vec3 middle = frame.point(0, 0.5 * (low + high), 0);
    const double half = 0.5 * (high - low) + rounding;
    const Vec3 extent = frame.axes.cwiseAbs() * Vec3(radius + rounding, half, radius + rounding);
    add(std::move(part), middle - extent, middle + extent);
}

void Solid::extrusion(const Frame& frame, Profile profile, double half_height, double rounding,
                      const Blend& blend)
{
    Vec3 lower = Vec3::Constant(kInfinity);
    Vec3 upper = -lower;
    for (const auto& [x, y] : profile) {
        for (const double z : {-half_height, half_height}) {
            const Vec3 corner = frame.point(x, y, z);
            lower = lower.cwiseMin((corner.array() - rounding).matrix());
            upper = upper.cwiseMax((corner.array() + rounding).matrix());
        }
    }
    Part part;
    part.kind = Kind::extrusion;
    part.blend = blend;
    part.origin = frame.origin;
    part.to_part = frame.axes.transpose();
    part.rigid = true;
    part.profile = std::move(profile);
    part.half_height = half_height;
    part.rounding = rounding;
    add(std::move(part), lower, upper);
}

void Solid::add(Part part, const Vec3& lower, const Vec3& upper)
{
    part.center = 0.5 * (lower + upper);
    part.bound = 0.5 * (upper - lower).norm();
    lower_ = lower_.cwiseMin(lower);
    upper_ = upper_.cwiseMax(upper);
    parts_.push_back(std::move(part));
}

void Solid::cut_last()
{
    parts_.back().cut = true;
}

Solid::Value Solid::cones_value(const Part& part, const Vec3& p, double limit)
{
    // Before it is scaled back.
    double best = limit / (limit > 0.0 ? part.least_scale : part.largest_scale);
    const Cone* best_cone = nullptr;
    Vec3 best_normal = Vec3::UnitX();
    for (const Cone& cone : part.cones) {
        const double reach = best + cone.bound;
        if (best < kInfinity && (reach <= 0.0 || (p - cone.center).squaredNorm() > reach * reach)) {
            continue;
        }
        const Vec3 from_a = p - cone.a;
        const double along = from_a.dot(cone.axis);
        const Vec3 across = from_a - along * cone.axis;
        const double radial = across.norm();
        const double foot = cone.cosine > 0.0 ? along - radial * cone.sine / cone.cosine : 0.0;
        double distance;
        Vec3 normal;
        if (foot <= 0.0 || cone.length == 0.0) {
            normal = from_a;
            distance = from_a.norm() - cone.radius_a;
        } else if (foot >= cone.length) {
            normal = from_a - cone.length * cone.axis;
            distance = normal.norm() - cone.radius_b;
        } else {
            normal = radial > 0.0 ? Vec3(cone.sine * cone.axis + cone.cosine / radial * across)
                                  : cone.axis;
            distance = radial * cone.cosine + along * cone.sine - cone.radius_a;
        }
        if (distance < best) {
            best = distance;
            best_cone = &cone;
            best_normal = normal;
        }
    }
    if (best_cone == nullptr) {
        return {limit, Vec3::UnitX()};
    }
    const double length = best_normal.norm();
    if (!(length > 0.0)) {
        return {best * part.least_scale, Vec3::UnitX()};
    }
    best_normal /= length;
    if (part.rigid) {
        return {best, part.to_part.transpose() * best_normal};
    }
    // To first order the distance in space, as the gradient there is to_part' times the normal.
    const Vec3 gradient = part.to_part.transpose() * best_normal;
    const double slope = gradient.norm();
    return {best / slope, gradient / slope};
}

Solid::Value Solid::part_value(const Part& part, const Vec3& point, double limit)
{
    const Vec3 p = part.to_part * (point - part.origin);
    if (part.kind == Kind::cones) {
        return cones_value(part, p, limit);
    }
    if (part.kind == Kind::revolution) {
        const double radius = std::sqrt(p.x() * p.x() + p.z() * p.z());
        const auto [distance, across, along] = polygon_value(part.profile, radius, p.y());
        const Vec3 out = radius > 0.0 ? Vec3(p.x() / radius, 0, p.z() / radius) : Vec3::UnitX();
        const Vec3 normal = across * out + Vec3(0, along, 0);
        return {distance - part.rounding, part.to_part.transpose() * normal};
    }
    const auto [side, x, y] = polygon_value(part.profile, p.x(), p.y());
    const double cap = std::abs(p.z()) - part.half_height;
    const Vec3 side_normal(x, y, 0);
    const Vec3 cap_normal(0, 0, p.z() < 0.0 ? -1.0 : 1.0);
    if (side <= 0.0 || cap <= 0.0) {
        const bool sideways = side > cap;
        return {std::max(side, cap) - part.rounding,
                part.to_part.transpose() * (sideways ? side_normal : cap_normal)};
    }
    const double distance = std::sqrt(side * side + cap * cap);
    return {distance - part.rounding,
            part.to_part.transpose() * ((side * side_normal + cap * cap_normal) / distance)};
}

Solid::Value Solid::value(const Vec3& point) const
{
    double distance = kInfinity;
    Vec3 gradient = Vec3::UnitX();
    for (const Part& part : parts_) {
        const double sign = part.cut ? -1.0 : 1.0;
        const double reach = sign * distance + part.blend.radius + part.bound;
        if (reach <= 0.0 || (point - part.center).squaredNorm() > reach * reach) {
            continue;
        }
        const Value other = part_value(part, point, sign * distance + part.blend.radius);
        if (distance == kInfinity) {
            distance = other.distance;
            gradient = other.normal;
            continue;
        }
        const bool near = std::abs(other.distance - sign * distance) < part.blend.radius;
        const double k = near ? blend_radius(part.blend, point) : 0.0;
        const auto [blended, share] = smooth_min(sign * distance, other.distance, k);
        distance = sign * blended;
        gradient = (1.0 - share) * gradient + sign * share * other.normal;
    }
    const double slope = gradient.norm();
    return {distance, slope > 0.0 ? Vec3(gradient / slope) : Vec3::UnitY()};
}

std::optional<Vec3> Solid::exit(const Vec3& inside, const Vec3& direction, double range,
                                double step) const
{
    const Vec3 unit = direction.normalized();
    if (!(distance(inside) < 0.0)) {
        return std::nullopt;
    }
    double low = 0.0;
    double high = 0.0;
    while (distance(inside + high * unit) < 0.0) {
        low = high;
        high += step;
        if (high > range) {
            return std::nullopt;
        }
    }
    for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (low + high);
        (distance(inside + middle * unit) < 0.0 ? low : high) = middle;
    }
    return inside + 0.5 * (low + high) * unit;
}

}  // namespace layout_embedding::shapes
