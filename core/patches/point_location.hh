#pragma once

#include <array>
#include <vector>

#include "base/types.hh"
#include "patches/parametrisation.hh"

namespace layout_embedding {

/// Finds the triangles of a parametrisation that hold given points of its domain, by a grid of
/// about as many cells as there are triangles.
class PointLocation {
public:
    /// `map` must outlive this. O(#triangles) for well-shaped ones.
    explicit PointLocation(const Parametrisation& map);

    struct Place {
        /// Of Parametrisation::corners.
        Index triangle;
        /// In the order of its corners, none negative, adding up to 1.
        std::array<double, 3> barycentrics;
    };
    /// Where `point` lies; for a point outside of the domain by rounding, a triangle beside it.
    Place find(const PlanePoint& point) const;

private:
    std::array<Index, 2> cell_of(const PlanePoint& point) const;

    const Parametrisation& map_;
    PlanePoint low_;
    double cell_size_ = 1;
    std::array<Index, 2> cells_{1, 1};
    std::vector<Index> offsets_;
    std::vector<Index> triangles_;
};

}  // namespace layout_embedding
