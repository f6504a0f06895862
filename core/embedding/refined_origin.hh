#pragma once

#include <array>

#include "embedding/refined_mesh.hh"
#include "mesh/surface_point.hh"
#include "mesh/triangle_mesh.hh"

namespace layout_embedding {

/// The places of points of a refined mesh on its target. Both must outlive this.
class RefinedOrigin {
public:
    RefinedOrigin(const TriangleMesh& target, const RefinedMesh& refined)
        : target_(target), refined_(refined)
    {}

    /// A point of a refined triangle, given as weights of its corners.
    SurfacePoint in_triangle(Index triangle, const std::array<double, 3>& weights) const;

    /// The barycentric coordinates of a refined vertex in a target face that it lies in or on the
    /// rim of.
    std::array<double, 3> in_face(Index vertex, Index face) const;

private:
    const TriangleMesh& target_;
    const RefinedMesh& refined_;
};

}  // namespace layout_embedding
