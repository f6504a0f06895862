#pragma once

#include "base/types.hh"

namespace layout_embedding {

/// A sum of weighted squared distances to planes and points (Garland and Heckbert 1997), as the
/// quadratic form x'Ax - 2 b'x + c.
class Quadric {
public:
    /// Adds the squared distance to the plane through `point` with unit normal `normal`.
    void add_plane(const Vec3& normal, const Vec3& point, double weight)
    {
        const double offset = normal.dot(point);
        xx_ += weight * (normal.x() * normal.x());
        xy_ += weight * (normal.x() * normal.y());
        xz_ += weight * (normal.x() * normal.z());
        yy_ += weight * (normal.y() * normal.y());
        yz_ += weight * (normal.y() * normal.z());
        zz_ += weight * (normal.z() * normal.z());
        b_ += (weight * offset) * normal;
        c_ += weight * (offset * offset);
    }

    /// Adds the squared distance to `point`.
    void add_point(const Vec3& point, double weight)
    {
        xx_ += weight;
        yy_ += weight;
        zz_ += weight;
        b_ += weight * point;
        c_ += weight * point.dot(point);
    }

    Quadric& operator+=(const Quadric& other)
    {
        xx_ += other.xx_;
        xy_ += other.xy_;
        xz_ += other.xz_;
        yy_ += other.yy_;
        yz_ += other.yz_;
        zz_ += other.zz_;
        b_ += other.b_;
        c_ += other.c_;
        return *this;
    }

    /// The sum at x; rounding can make it slightly negative.
    double operator()(const Vec3& x) const
    {
        const double squares =
            xx_ * (x.x() * x.x()) + yy_ * (x.y() * x.y()) + zz_ * (x.z() * x.z());
        const double products =
            xy_ * (x.x() * x.y()) + xz_ * (x.x() * x.z()) + yz_ * (x.y() * x.z());
        return ((squares + 2 * products) - 2 * b_.dot(x)) + c_;
    }

private:
    double xx_ = 0;
    double xy_ = 0;
    double xz_ = 0;
    double yy_ = 0;
    double yz_ = 0;
    double zz_ = 0;
    Vec3 b_ = Vec3::Zero();
    double c_ = 0;
};

}  // namespace layout_embedding
