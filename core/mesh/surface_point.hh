#pragma once

#include <array>

#include "base/types.hh"
#include "mesh/triangle_mesh.hh"

namespace layout_embedding {

/// A point of a triangle mesh: a face, and barycentric coordinates in the order of its corners.
struct SurfacePoint {
    Index face = kNone;
    std::array<double, 3> barycentrics{};
};

Vec3 position_of(const TriangleMesh& mesh, const SurfacePoint& point);

/// The barycentric coordinates in `face` of a point that is given in that face or in one beside it,
/// on its rim.
std::array<double, 3> coordinates_in_face(const TriangleMesh& mesh, const SurfacePoint& point,
                                          Index face);

/// The unit normal of a face; zero for one without area.
Vec3 face_normal(const TriangleMesh& mesh, Index face);

/// Walks from `start` to a point of the surface that is nearer to `place` than all others in the
/// faces around it: the nearest point of the same sheet as long as `place` is near to the surface.
/// Usually a few faces are looked at.
SurfacePoint walk_to_nearest(const TriangleMesh& mesh, const SurfacePoint& start,
                             const Vec3& place);

}  // namespace layout_embedding
