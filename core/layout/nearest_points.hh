#pragma once

#include <span>
#include <vector>

#include "base/types.hh"

namespace layout_embedding {

/// A k-d tree over fixed points for nearest-neighbour queries.
class NearestPoints {
public:
    /// `ids` are the points of `positions` to take part, finite; `positions` must outlive the tree.
    /// O(n log n) time, n ids of memory.
    NearestPoints(std::span<const Vec3> positions, std::vector<Index> ids);

    struct Neighbour {
        double squared_distance;
        Index id;
        bool operator<(const Neighbour& other) const
        {
            return squared_distance != other.squared_distance
                       ? squared_distance < other.squared_distance
                       : id < other.id;
        }
    };

    /// The `count` points nearest to `query` (all if there are fewer), nearest first, equally far
    /// ones by id. About O(count log n) for points of a surface.
    std::vector<Neighbour> nearest(const Vec3& query, std::size_t count) const;

private:
    void build(std::size_t begin, std::size_t end, int axis);
    void visit(std::size_t begin, std::size_t end, int axis, const Vec3& query, std::size_t count,
               std::vector<Neighbour>& heap) const;
    bool before(Index a, Index b, int axis) const;

    std::span<const Vec3> positions_;
    // The root is in the middle, the points before it along the axis to its left, recursively.
    std::vector<Index> ids_;
};

}  // namespace layout_embedding
