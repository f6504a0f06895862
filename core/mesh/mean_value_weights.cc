#include "mesh/mean_value_weights.hh"

#include <algorithm>

namespace layout_embedding {

namespace {

// Corners whose sine is below this count as having this sine: tan stays below 2e9.
constexpr double kSmallestSine = 1e-9;
// Edges shorter than this share of their triangle's longest edge count as this long.
constexpr double kSmallestEdge = 1e-9;

}  // namespace

std::vector<std::array<double, 2>> mean_value_weights(const TriangleMesh& target)
{
    std::vector<std::array<double, 2>> weights(target.edge_count(), {0, 0});
    for (Index f = 0; f < target.face_count(); ++f) {
        std::array<double, 3> lengths;
        for (Index i = 0; i < 3; ++i) {
            const Index h = 3 * f + i;
            lengths[i] = (target.position(target.head(h)) - target.position(target.tail(h))).norm();
        }
        const double longest = std::max({lengths[0], lengths[1], lengths[2]});
        if (longest == 0) {
            lengths = {1, 1, 1};
        }
        for (double& length : lengths) {
            length = std::max(length, kSmallestEdge * longest);
        }
        for (Index i = 0; i < 3; ++i) {
            const Index h = 3 * f + i;
            const Index back = TriangleMesh::previous(h);
            const Vec3 u = target.position(target.head(h)) - target.position(target.tail(h));
            const Vec3 v = target.position(target.tail(back)) - target.position(target.tail(h));
            const double product = lengths[i] * lengths[(i + 2) % 3];
            // tan(a/2) = (1 - cos a) / sin a, without an arc function.
            const double sine = std::max(u.cross(v).norm(), kSmallestSine * product);
            const double tangent = std::max(product - u.dot(v), 0.0) / sine;
            const auto add = [&](Index halfedge, bool leaves, double length) {
                const Index e = target.edge(halfedge);
                const bool from_tail = (target.halfedge(e) == halfedge) == leaves;
                weights[e][from_tail ? 0 : 1] += tangent / length;
            };
            add(h, true, lengths[i]);
            add(back, false, lengths[(i + 2) % 3]);
        }
    }
    return weights;
}

}  // namespace layout_embedding
