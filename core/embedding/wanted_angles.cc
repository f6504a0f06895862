#include "embedding/wanted_angles.hh"

#include <algorithm>
#include <limits>

namespace layout_embedding {

namespace {

/// The tangent of 3 degrees.
constexpr double kThinTangent = 0.0524077792830412;

/// The tangent of a third of the angle of tangent t, by Newton's method.
double third_tangent(double t)
{
    double x = t / 3;
    for (int i = 0; i < 6; ++i) {
        x -= (3 * x - x * x * x - t * (1 - 3 * x * x)) / (3 - 3 * x * x + 6 * t * x);
    }
    return x;
}

double least_tangent(const TriangleMesh& mesh, Index face)
{
    const auto [a, b, c] = mesh.face(face);
    const Vec3 u = mesh.position(b) - mesh.position(a);
    const Vec3 v = mesh.position(c) - mesh.position(b);
    const Vec3 w = mesh.position(a) - mesh.position(c);
    return std::min({tangent_between(u, -w), tangent_between(v, -u), tangent_between(w, -v)});
}

}  // namespace

WantedAngles::WantedAngles(const TriangleMesh& target) : target_(target)
{
    double least = std::numeric_limits<double>::infinity();
    for (Index face = 0; face < target.face_count(); ++face) {
        least = std::min(least, least_tangent(target, face));
    }
    everywhere_ = third_tangent(least);
}

double WantedAngles::tangent_in(Index face) const
{
    if (everywhere_ >= kThinTangent) {
        return everywhere_;
    }
    return std::max(everywhere_,
                    std::min(kThinTangent, third_tangent(least_tangent(target_, face))));
}

double tangent_between(const Vec3& u, const Vec3& v)
{
    const double dot = u.dot(v);
    return dot > 0 ? u.cross(v).norm() / dot : std::numeric_limits<double>::infinity();
}

}  // namespace layout_embedding
