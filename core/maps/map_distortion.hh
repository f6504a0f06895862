#pragma once

#include "maps/overlay.hh"
#include "maps/placed_target.hh"

namespace layout_embedding {

/// How far a map between two targets is from an isometry, once both are scaled to area 1. Means are
/// over the area of target a. Everything is computed from the linear maps of the overlay's pieces.
struct MapDistortion {
    /// Symmetric Dirichlet energy |J|^2 + |J^-1|^2 (Frobenius norms): 4 for an isometry, else more.
    double mean_energy = 0;
    double largest_energy = 0;
    /// Ratio of the larger to the smaller singular value: 1 where angles are kept.
    double mean_conformal = 0;
    /// Ratio of areas, the larger one over the smaller: 1 where areas are kept.
    double mean_area = 0;
};

MapDistortion map_distortion(const PlacedTarget& a, const PlacedTarget& b, const Overlay& overlay);

/// The integral over target a of the energy of the map of one layout face's patches; squared
/// lengths on b times `scale`. Infinite where the maps do not lie over each other.
double patch_energy(const PlacedPatch& a, const std::vector<Vec3>& positions_a,
                    const PlacedPatch& b, const std::vector<Vec3>& positions_b, double scale);

/// A 2 by 2 matrix.
using Matrix2 = Eigen::Matrix2d;

/// The linear map from a triangle in space, in a frame of its own, to a triangle of the domain.
/// `determinant` of it is positive. The frame's x axis is the first edge.
Matrix2 to_domain_map(const Vec3& a, const Vec3& b, const Vec3& c, const PlanePoint& u,
                      const PlanePoint& v, const PlanePoint& w);

}  // namespace layout_embedding
