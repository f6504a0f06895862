#pragma once

#include <vector>

#include "base/types.hh"
#include "shapes/solid.hh"

namespace layout_embedding::shapes {

/// Triangles as they come out of a grid: of very uneven shape, but connected like the surface.
struct RawSurface {
    std::vector<Vec3> positions;
    /// Three vertex ids per triangle, counter-clockwise from outside.
    std::vector<Index> corners;
};

/// The component of the surface of `solid` that passes near `seed`, by marching tetrahedra (each
/// cell of a grid with cells of size `cell` in six), which are followed from cell to cell along the
/// surface: the time depends on the surface alone. Always a closed manifold; details thinner than a
/// cell are lost. Empty if no surface passes within a cell of `seed`.
RawSurface extract_surface(const Solid& solid, const Vec3& seed, double cell);

/// The part of `surface` with (p - origin) . normal < 0, with vertices exactly on the plane; the
/// largest component of it.
RawSurface clip_surface(const RawSurface& surface, const Vec3& origin, const Vec3& normal,
                        double cell);

}  // namespace layout_embedding::shapes
