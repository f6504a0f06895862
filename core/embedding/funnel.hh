#pragma once

#include <span>
#include <vector>

#include "base/types.hh"

namespace layout_embedding {

/// A point or vector in a plane into which faces are unfolded.
struct Vec2 {
    double x = 0;
    double y = 0;

    friend Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
    friend Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
    friend Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
    friend double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
    friend double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
};

/// A segment that a path has to pass, seen along the path.
struct Portal {
    Vec2 left;
    Vec2 right;
};

/// A bend of a path: at one end of a portal.
struct Bend {
    Index portal;
    Vec2 point;
};

/// The shortest path from `start` through all portals, in order, to `end`, in a sleeve that may
/// overlap itself in the plane. Lee and Preparata, "Euclidean shortest paths in the presence of
/// rectilinear barriers" (Networks 14, 1984). Reuse one object to save allocations.
class Funnel {
public:
    /// The bends in their order, each at the last portal that has this end point; valid until the
    /// next call. O(#portals).
    std::span<const Bend> shortest_path(Vec2 start, std::span<const Portal> portals, Vec2 end);

private:
    /// One side of the funnel from the apex, which is not part of it, to its portal.
    struct Chain {
        std::vector<Bend> bends;
        std::size_t begin = 0;

        bool empty() const { return begin == bends.size(); }
        void clear()
        {
            bends.clear();
            begin = 0;
        }
    };
    /// Narrows or widens one side; `sign` is 1 for the left side, -1 for the right one.
    void extend(Chain& chain, Chain& other, Bend bend, double sign);

    Vec2 apex_;
    Chain left_;
    Chain right_;
    std::vector<Bend> path_;
};

}  // namespace layout_embedding
