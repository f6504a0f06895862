#include "mesh/surface_point.hh"

#include <algorithm>

namespace layout_embedding {
namespace {

/// The barycentric coordinates of the point of a segment nearest to p, at its second end.
double nearest_on_segment(const Vec3& a, const Vec3& b, const Vec3& p)
{
    const Vec3 along = b - a;
    const double square = along.squaredNorm();
    return square > 0 ? std::clamp((p - a).dot(along) / square, 0.0, 1.0) : 0.0;
}

/// The point of a face nearest to `place`.
SurfacePoint nearest_in_face(const TriangleMesh& mesh, Index face, const Vec3& place)
{
    const auto corners = mesh.face(face);
    const Vec3& a = mesh.position(corners[0]);
    const Vec3& b = mesh.position(corners[1]);
    const Vec3& c = mesh.position(corners[2]);
    const Vec3 normal = (b - a).cross(c - a);
    const double square = normal.squaredNorm();
    if (square > 0) {
        const std::array<double, 3> inside{(c - b).cross(place - b).dot(normal) / square,
                                           (a - c).cross(place - c).dot(normal) / square,
                                           (b - a).cross(place - a).dot(normal) / square};
        if (inside[0] >= 0 && inside[1] >= 0 && inside[2] >= 0) {
            return {face, inside};
        }
    }
    // Outside of the face, or no area: the nearest point lies on a side.
    SurfacePoint best;
    double best_distance = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        const Vec3& from = mesh.position(corners[i]);
        const Vec3& to = mesh.position(corners[j]);
        const double t = nearest_on_segment(from, to, place);
        const double distance = ((1 - t) * from + t * to - place).squaredNorm();
        if (distance < best_distance) {
            best_distance = distance;
            best = {face, {0, 0, 0}};
            best.barycentrics[i] = 1 - t;
            best.barycentrics[j] = t;
        }
    }
    return best;
}

}  // namespace

Vec3 position_of(const TriangleMesh& mesh, const SurfacePoint& point)
{
    const auto corners = mesh.face(point.face);
    return point.barycentrics[0] * mesh.position(corners[0]) +
           point.barycentrics[1] * mesh.position(corners[1]) +
           point.barycentrics[2] * mesh.position(corners[2]);
}

std::array<double, 3> coordinates_in_face(const TriangleMesh& mesh, const SurfacePoint& point,
                                          Index face)
{
    std::array<double, 3> coordinates{0, 0, 0};
    const auto own = mesh.face(point.face);
    const auto corners = mesh.face(face);
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            if (corners[k] == own[i]) {
                coordinates[k] += point.barycentrics[i];
            }
        }
    }
    return coordinates;
}

Vec3 face_normal(const TriangleMesh& mesh, Index face)
{
    const auto corners = mesh.face(face);
    const Vec3& a = mesh.position(corners[0]);
    const Vec3 normal = (mesh.position(corners[1]) - a).cross(mesh.position(corners[2]) - a);
    const double length = normal.norm();
    return length > 0 ? Vec3(normal / length) : Vec3(0, 0, 0);
}

SurfacePoint walk_to_nearest(const TriangleMesh& mesh, const SurfacePoint& start, const Vec3& place)
{
    constexpr int kMaxSteps = 1000;
    SurfacePoint best = nearest_in_face(mesh, start.face, place);
    double best_distance = (position_of(mesh, best) - place).squaredNorm();
    for (int step = 0; step < kMaxSteps; ++step) {
        const Index face = best.face;
        // Faces around the corners that the point is not opposite to.
        for (Index i = 0; i < 3; ++i) {
            if (best.face == face && best.barycentrics[i] == 0) {
                continue;
            }
            const Index first = mesh.outgoing(mesh.tail(3 * face + i));
            for (Index h = first; h != kNone;) {
                const SurfacePoint other = nearest_in_face(mesh, TriangleMesh::face_of(h), place);
                const double distance = (position_of(mesh, other) - place).squaredNorm();
                if (distance < best_distance * (1 - 1e-12)) {
                    best = other;
                    best_distance = distance;
                }
                h = mesh.rotated_ccw(h);
                if (h == first) {
                    break;
                }
            }
        }
        if (best.face == face) {
            break;
        }
    }
    return best;
}

}  // namespace layout_embedding
