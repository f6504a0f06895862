#include "mesh/star_triangulation.hh"

#include <algorithm>
#include <cmath>
#include <limits>

namespace layout_embedding {
namespace {

constexpr double kSqrt12 = 3.4641016151377544;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// The penalty of a triangle that is turned over.
constexpr double kTurnedOver = 1e6;

}  // namespace

double triangle_quality(const Vec3& a, const Vec3& b, const Vec3& c)
{
    const Vec3 ab = b - a;
    const Vec3 ac = c - a;
    const Vec3 bc = c - b;
    const double squares = (ab.dot(ab) + ac.dot(ac)) + bc.dot(bc);
    if (!(squares > 0)) {
        return 0;
    }
    const Vec3 normal = ab.cross(ac);
    return kSqrt12 * std::sqrt(normal.dot(normal)) / squares;
}

double shape_penalty(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& up)
{
    const Vec3 ab = b - a;
    const Vec3 ac = c - a;
    const Vec3 bc = c - b;
    const double squares = (ab.dot(ab) + ac.dot(ac)) + bc.dot(bc);
    // Twice the area as seen from above.
    const double area = ab.cross(ac).dot(up);
    return area > 1e-6 * squares ? squares / (kSqrt12 * area) : kTurnedOver;
}

bool StarTriangulation::find(const EditableMesh& mesh, const std::vector<Vec3>& points, Index v,
                             bool any_shape)
{
    ring_.clear();
    mesh.for_each_neighbour(v, [&](Index u) { ring_.push_back(u); });
    boundary_ = mesh.is_boundary_vertex(v);
    const std::size_t n = ring_.size();
    if (n > kMaxDegree) {
        return false;
    }
    if (n == 2) {
        return mesh.can_collapse(v, ring_[0]);
    }
    // The normal of the star, and its worst face.
    Vec3 up = Vec3::Zero();
    double worst = 1;
    mesh.for_each_outgoing(v, [&](Index h) {
        const Vec3& a = points[v];
        const Vec3& b = points[mesh.head(h)];
        const Vec3& c = points[mesh.tail(EditableMesh::previous(h))];
        up += (b - a).cross(c - a);
        worst = std::min(worst, triangle_quality(a, b, c));
    });
    const double length = std::sqrt(up.dot(up));
    up = length > 0 ? Vec3(up / length) : Vec3(Vec3::Zero());
    const double least = std::min(kNeedle, worst);

    forbidden_.assign(n * n, 0);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = i + 2; j < n; ++j) {
            // On a boundary the last one closes the boundary loop, else it is an edge already.
            const bool outline = i == 0 && j == n - 1 && !boundary_;
            forbidden_[at(i, j)] = outline || mesh.can_join(ring_[i], ring_[j]) ? 0 : 1;
        }
    }
    penalties_.assign(n * n, 0);
    splits_.assign(n * n, 0);
    for (std::size_t span = 2; span < n; ++span) {
        for (std::size_t i = 0; i + span < n; ++i) {
            const std::size_t j = i + span;
            double best = kInfinity;
            for (std::size_t k = i + 1; k < j && forbidden_[at(i, j)] == 0; ++k) {
                const double inside = penalties_[at(i, k)] + penalties_[at(k, j)];
                if (!(inside < best)) {
                    continue;
                }
                const Vec3& a = points[ring_[i]];
                const Vec3& b = points[ring_[k]];
                const Vec3& c = points[ring_[j]];
                if (!any_shape) {
                    const Vec3 normal = (b - a).cross(c - a);
                    if (!(normal.dot(up) > kLeastCosine * std::sqrt(normal.dot(normal))) ||
                        triangle_quality(a, b, c) < least) {
                        continue;
                    }
                }
                const double penalty = inside + shape_penalty(a, b, c, up);
                if (penalty < best) {
                    best = penalty;
                    splits_[at(i, j)] = static_cast<std::uint8_t>(k);
                }
            }
            penalties_[at(i, j)] = best;
        }
    }
    // A tetrahedron has no smaller triangulation.
    return penalties_[at(0, n - 1)] < kInfinity &&
           (boundary_ || n > 3 || mesh.can_collapse(v, ring_[0]));
}

void StarTriangulation::apply(EditableMesh& mesh, Index v) const
{
    const std::size_t n = ring_.size();
    if (n > 2) {
        const std::size_t k = splits_[at(0, n - 1)];
        clip(mesh, v, 0, k);
        clip(mesh, v, k, n - 1);
        if (boundary_) {
            mesh.flip(mesh.find_halfedge(v, ring_[k]));
        }
    }
    mesh.collapse(v, ring_[0]);
}

void StarTriangulation::clip(EditableMesh& mesh, Index v, std::size_t i, std::size_t j) const
{
    if (j - i < 2) {
        return;
    }
    const std::size_t k = splits_[at(i, j)];
    clip(mesh, v, i, k);
    clip(mesh, v, k, j);
    mesh.flip(mesh.find_halfedge(v, ring_[k]));
}

}  // namespace layout_embedding
