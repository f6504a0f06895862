#include "surface/path_metric.hh"

#include <algorithm>

namespace layout_embedding {

namespace {

// Cosines of the angles between the normals of two faces, 20 and 60 degrees, at which an edge
// begins to be sharp and is as sharp as it counts. Not the angles: their functions differ between
// machines.
constexpr double kSharp = 0.9396926207859084;
constexpr double kSharpest = 0.5;

Vec3 area_vector(const TriangleMesh& mesh, Index face)
{
    const auto [a, b, c] = mesh.face(face);
    return (mesh.position(b) - mesh.position(a)).cross(mesh.position(c) - mesh.position(a));
}

}  // namespace

std::vector<double> feature_costs(const TriangleMesh& target, double discount)
{
    std::vector<double> costs(target.edge_count(), 1.0);
    for (Index e = 0; e < target.edge_count(); ++e) {
        const Index h = target.halfedge(e);
        const Index twin = target.opposite(h);
        if (h == kNone || twin == kNone) {
            continue;
        }
        const Vec3 u = area_vector(target, TriangleMesh::face_of(h));
        const Vec3 v = area_vector(target, TriangleMesh::face_of(twin));
        const double product = u.norm() * v.norm();
        const double cosine = product > 0 ? u.dot(v) / product : 1.0;
        const double sharpness = std::clamp((kSharp - cosine) / (kSharp - kSharpest), 0.0, 1.0);
        costs[e] = 1 - discount * sharpness;
    }
    return costs;
}

}  // namespace layout_embedding
