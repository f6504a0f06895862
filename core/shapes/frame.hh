#pragma once

#include "base/types.hh"

namespace layout_embedding::shapes {

/// Sine and cosine of an angle in degrees from + - * alone, so that shapes are the same on every
/// platform (the standard library's differ in their last bits). Accurate to about 1e-15.
double sine(double degrees);
double cosine(double degrees);

/// A place and an orientation, for example of a bone. Axes are x, y, z, right-handed; figures stand
/// upright along y, look along z, and have their left side at positive x.
struct Frame {
    Vec3 origin = Vec3::Zero();
    /// Columns: the axes in space.
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();

    /// The point with these coordinates in the frame.
    Vec3 point(double x, double y, double z) const { return origin + axes * Vec3(x, y, z); }
    /// The vector with these coordinates in the frame.
    Vec3 direction(double x, double y, double z) const { return axes * Vec3(x, y, z); }
    Vec3 x() const { return axes.col(0); }
    Vec3 y() const { return axes.col(1); }
    Vec3 z() const { return axes.col(2); }

    /// Moved to the point with these coordinates in the frame.
    Frame moved(double x, double y, double z) const { return {point(x, y, z), axes}; }
    /// Turned about its own x, y or z axis, counter-clockwise as seen from the axis' tip.
    Frame turned_x(double degrees) const;
    Frame turned_y(double degrees) const;
    Frame turned_z(double degrees) const;
};

}  // namespace layout_embedding::shapes
