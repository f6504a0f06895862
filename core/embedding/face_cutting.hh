#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/types.hh"

namespace layout_embedding {

/// A point on the perimeter of a triangle, as face_cutting sees it: a corner or a crossing.
struct PerimeterPoint {
    /// The side the point lies on, 0 .. 2, side s from corner s to corner s + 1; corner s counts as
    /// the start of side s.
    Index side;
    /// The place on the side, 0 for a corner, below 1 for a crossing.
    double parameter;
    /// The place on the perimeter of the other end of the chord at a crossing; kNone for a corner,
    /// at which any number of chords may end.
    Index partner;
    Vec3 position;

    bool is_corner() const { return partner == kNone; }
};

/// Pieces of a triangle as polygons of places on its perimeter. Reuse one object for many faces to
/// save allocations.
struct FacePieces {
    /// Piece i has points[offsets[i]] .. points[offsets[i+1]-1], counter-clockwise. Two consecutive
    /// points that also follow each other on the perimeter are joined by a stretch of it, all
    /// others by a chord.
    std::vector<Index> offsets;
    std::vector<Index> points;
    /// Used by cut_face() alone.
    std::vector<Index> scratch;

    Index count() const { return static_cast<Index>(offsets.size() - 1); }
    std::span<const Index> piece(Index i) const
    {
        return {points.data() + offsets[i], points.data() + offsets[i + 1]};
    }
};

/// Cuts a triangle into convex pieces along chords between points of its perimeter, which are given
/// counter-clockwise from corner 0 on. False if two chords cross or meet at a crossing, or if one
/// has both ends on the same side; the test is combinatorial and thus exact. O(#points).
bool cut_face(std::span<const PerimeterPoint> perimeter, FacePieces& pieces);

/// Appends a triangulation of one piece to `triangles`, as places on the perimeter: the Delaunay
/// triangulation, which has the largest smallest angle. A piece has at most two points on each side
/// and thus six points, no three of them on a line.
void triangulate_piece(std::span<const PerimeterPoint> perimeter, std::span<const Index> piece,
                       std::vector<std::array<Index, 3>>& triangles);

}  // namespace layout_embedding
