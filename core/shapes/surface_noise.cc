#include "shapes/surface_noise.hh"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/random.hh"
#include "base/types.hh"

namespace layout_embedding::shapes {

namespace {

/// A number in [-1, 1] for a lattice point.
double lattice_value(std::int64_t x, std::int64_t y, std::int64_t z, std::uint64_t seed)
{
    std::uint64_t hash = Random::mix(seed ^ static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15ULL);
    hash = Random::mix(hash ^ static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fULL);
    hash = Random::mix(hash ^ static_cast<std::uint64_t>(z) * 0x165667b19e3779f9ULL);
    return static_cast<double>(hash >> 11) * 0x1.0p-52 - 1.0;
}

/// Smooth noise in [-1, 1] with features of unit size.
double value_noise(const Vec3& p, std::uint64_t seed)
{
    const Vec3 base(std::floor(p.x()), std::floor(p.y()), std::floor(p.z()));
    Vec3 t = p - base;
    for (int i = 0; i < 3; ++i) {
        t[i] = t[i] * t[i] * (3.0 - 2.0 * t[i]);
    }
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        const int dx = corner & 1;
        const int dy = corner >> 1 & 1;
        const int dz = corner >> 2;
        const double weight = (dx != 0 ? t.x() : 1.0 - t.x()) * (dy != 0 ? t.y() : 1.0 - t.y()) *
                              (dz != 0 ? t.z() : 1.0 - t.z());
        sum += weight * lattice_value(static_cast<std::int64_t>(base.x()) + dx,
                                      static_cast<std::int64_t>(base.y()) + dy,
                                      static_cast<std::int64_t>(base.z()) + dz, seed);
    }
    return sum;
}

}  // namespace

void add_surface_noise(PolygonMesh& mesh, double amplitude, std::uint64_t seed)
{
    if (!(amplitude > 0.0)) {
        return;
    }
    const Index count = mesh.vertex_count();
    std::vector<Vec3> normals(count, Vec3::Zero());
    std::vector<double> shortest(count, std::numeric_limits<double>::infinity());
    double mean = 0.0;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const auto face = mesh.face(f);
        const Vec3& a = mesh.positions[face[0]];
        const Vec3 normal = (mesh.positions[face[1]] - a).cross(mesh.positions[face[2]] - a);
        for (Index i = 0; i < 3; ++i) {
            const Index v = face[i];
            const double length = (mesh.positions[face[(i + 1) % 3]] - mesh.positions[v]).norm();
            const Index w = face[(i + 1) % 3];
            normals[v] += normal;
            shortest[v] = std::min(shortest[v], length);
            shortest[w] = std::min(shortest[w], length);
            mean += length / mesh.corners.size();
        }
    }
    Random random(seed);
    const std::uint64_t smooth_seed = random.bits();
    for (Index v = 0; v < count; ++v) {
        const double chance = 2.0 * random.unit() - 1.0;
        const double norm = normals[v].norm();
        if (!(norm > 0.0)) {
            continue;
        }
        const double smooth = value_noise(mesh.positions[v] / (4.0 * mean), smooth_seed);
        const double offset = amplitude * (0.6 * smooth + 0.4 * chance) * shortest[v];
        mesh.positions[v] += offset / norm * normals[v];
    }
}

}  // namespace layout_embedding::shapes
