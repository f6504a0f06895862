#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "base/types.hh"
#include "shapes/frame.hh"

namespace layout_embedding::shapes {

/// A point on the centre line of a sweep, with the radius there.
struct Knot {
    Vec3 position;
    double radius;
};

/// How the surface is rounded where a part joins the parts before it: `radius` is about the width
/// of the fillet. It fades out between `reach` and twice `reach` from `center`, so that a limb
/// blends into the body at its joint but stays apart from it elsewhere.
struct Blend {
    double radius = 0.0;
    Vec3 center = Vec3::Zero();
    double reach = std::numeric_limits<double>::infinity();
};

/// Radii are multiplied by `scale` (all positive) along the axes of the frame, whose origin does
/// not count: a flat wing is a tube in a plane, squashed along the normal of the plane.
struct Squash {
    Frame frame;
    Vec3 scale = Vec3::Ones();
};

/// A point of a profile in its plane.
using Point2 = std::array<double, 2>;

/// A closed profile through the given points, counter-clockwise, as a polygon.
using Profile = std::vector<Point2>;

/// A smooth open curve through the points (Catmull-Rom), `samples` segments per span.
Profile smooth_curve(const Profile& points, int samples);

/// A solid as the zero set of a function: parts with (nearly) exact signed distances, joined one
/// after the other by smooth unions or cut out by smooth differences (a cubic blend: two times
/// continuously differentiable where the parts are).
class Solid {
public:
    /// A round tube along a smooth curve through the knots, straight between two of them; a ball
    /// for one. Radii are stretched by `flat`, the knots stay where they are.
    void sweep(const std::vector<Knot>& knots, const Blend& blend, const Squash& flat = {},
               int samples = 4);
    /// The same along a closed curve.
    void closed_sweep(const std::vector<Knot>& knots, const Blend& blend, const Squash& flat,
                      int samples = 4);
    /// An ellipsoid at the frame's origin with `radii` along its axes.
    void ellipsoid(const Frame& frame, const Vec3& radii, const Blend& blend);
    /// The profile's x is the distance to the frame's y axis, its y runs along it; all x >= 0.
    /// Edges are rounded by `rounding`, by which everything grows.
    void revolution(const Frame& frame, Profile profile, double rounding, const Blend& blend);
    /// The profile in the frame's x-y plane, from -half_height to half_height along z.
    void extrusion(const Frame& frame, Profile profile, double half_height, double rounding,
                   const Blend& blend);
    /// The part added last is cut out instead of added.
    void cut_last();

    /// The value of the function at a point, and in which direction it grows.
    struct Value {
        /// Negative inside. Near the surface about the distance to it.
        double distance;
        /// A unit vector; near the surface about its outward normal.
        Vec3 normal;
    };
    Value value(const Vec3& point) const;
    double distance(const Vec3& point) const { return value(point).distance; }
    /// Where a ray from a point inside first leaves the solid; nothing if the point is not inside
    /// or the ray does not leave within `range`. `step` must be below the thinnest part.
    std::optional<Vec3> exit(const Vec3& inside, const Vec3& direction, double range,
                             double step) const;

    /// The corners of a box that contains everything that was added.
    Vec3 lower() const { return lower_; }
    Vec3 upper() const { return upper_; }
    double size() const { return (upper_ - lower_).norm(); }

private:
    enum class Kind { cones, revolution, extrusion };

    /// The hull of two balls.
    struct Cone {
        Vec3 a;
        Vec3 axis;  // unit
        double length;
        /// A ball around it, for a quick look.
        Vec3 center;
        double bound;
        double radius_a;
        double radius_b;
        /// Of the angle between the surface and the axis; no side surface if cosine is 0.
        double sine;
        double cosine;
    };

    struct Part {
        Kind kind = Kind::cones;
        bool cut = false;
        Vec3 origin = Vec3::Zero();
        /// From space, relative to origin, to the part's own coordinates.
        Eigen::Matrix3d to_part = Eigen::Matrix3d::Identity();
        bool rigid = true;
        double least_scale = 1.0;
        double largest_scale = 1.0;
        std::vector<Cone> cones;
        Profile profile;
        double half_height = 0.0;
        double rounding = 0.0;
        Blend blend;
        Vec3 center = Vec3::Zero();
        double bound = 0.0;
    };

    /// Of a part alone; anything not below `limit` if it is not below `limit`.
    static Value part_value(const Part& part, const Vec3& point, double limit);
    static Value cones_value(const Part& part, const Vec3& p, double limit);
    void add(Part part, const Vec3& lower, const Vec3& upper);
    void add_tube(const std::vector<Knot>& samples, const Blend& blend, const Squash& flat);

    std::vector<Part> parts_;
    Vec3 lower_ = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 upper_ = Vec3::Constant(-std::numeric_limits<double>::infinity());
};

}  // namespace layout_embedding::shapes
