#pragma once

#include <vector>

#include "maps/placed_target.hh"
#include "maps/plane_grid.hh"
#include "patches/point_location.hh"

namespace layout_embedding {

/// Where a point lies in a triangulation of the plane: at a vertex, on an edge, or inside of a
/// triangle. Exactly one of the first two is given, or none.
struct ExactPlace {
    Index vertex = kNone;
    /// A halfedge of the edge.
    Index halfedge = kNone;
    /// A triangle that holds the point.
    Index triangle = kNone;
};

/// Finds the places of grid points in a patch's map, without rounding.
class ExactLocation {
public:
    /// `placed` must outlive this and stay as it is.
    explicit ExactLocation(const PlacedPatch& placed);

    /// The place of a point of the domain. As fast as PointLocation.
    ExactPlace find(const GridPoint& point) const;
    /// The weights of the corners of `triangle` for a point in it.
    std::array<double, 3> weights(Index triangle, const GridPoint& point) const;

    const GridPoint& point(Index vertex) const { return points_[vertex]; }
    const TriangleMesh& mesh() const { return placed_.mesh; }

private:
    bool holds(Index triangle, const GridPoint& point) const;

    const PlacedPatch& placed_;
    std::vector<GridPoint> points_;
    PointLocation location_;
};

}  // namespace layout_embedding
