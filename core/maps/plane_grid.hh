#pragma once

#include <cmath>
#include <cstdint>

#include "patches/domain.hh"

namespace layout_embedding {

/// A point of the plane in whole steps of 2^-52, no coordinate beyond 1 in size: such points are
/// exactly the same as doubles and as integers, and orientations of them are computed without
/// rounding.
struct GridPoint {
    std::int64_t x = 0;
    std::int64_t y = 0;

    friend bool operator==(const GridPoint&, const GridPoint&) = default;
};

__extension__ using WideInteger = __int128;

/// The steps of the plane grid, of the corners of domains, and of the shares along their sides: a
/// corner plus a share of the way to the next corner is a point of the grid, without rounding.
inline constexpr double kGridSteps = 4503599627370496.0;  // 2^52
inline constexpr double kCornerSteps = 1048576.0;         // 2^20
inline constexpr std::int64_t kWholeShare = std::int64_t{1} << std::int64_t{32};

/// The grid point next to `point`.
inline GridPoint to_grid(const PlanePoint& point)
{
    return {static_cast<std::int64_t>(std::round(point.x() * kGridSteps)),
            static_cast<std::int64_t>(std::round(point.y() * kGridSteps))};
}

inline PlanePoint to_plane(const GridPoint& point)
{
    return {static_cast<double>(point.x) / kGridSteps, static_cast<double>(point.y) / kGridSteps};
}

/// Twice the signed area of a, b, c in squared steps, exactly: positive if counter-clockwise.
inline WideInteger orientation(const GridPoint& a, const GridPoint& b, const GridPoint& c)
{
    return static_cast<WideInteger>(b.x - a.x) * (c.y - a.y) -
           static_cast<WideInteger>(b.y - a.y) * (c.x - a.x);
}

/// The inner product of b - a and d - c, exactly.
inline WideInteger inner(const GridPoint& a, const GridPoint& b, const GridPoint& c,
                         const GridPoint& d)
{
    return static_cast<WideInteger>(b.x - a.x) * (d.x - c.x) +
           static_cast<WideInteger>(b.y - a.y) * (d.y - c.y);
}

}  // namespace layout_embedding
