#include "embedding/refined_origin.hh"

namespace layout_embedding {

SurfacePoint RefinedOrigin::in_triangle(Index triangle, const std::array<double, 3>& weights) const
{
    SurfacePoint point{refined_.triangle_faces[triangle], {0, 0, 0}};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto coordinates =
            in_face(refined_.corners[3 * std::size_t{triangle} + i], point.face);
        for (std::size_t k = 0; k < 3; ++k) {
            point.barycentrics[k] += weights[i] * coordinates[k];
        }
    }
    double sum = 0;
    for (const double coordinate : point.barycentrics) {
        sum += coordinate;
    }
    for (double& coordinate : point.barycentrics) {
        coordinate /= sum;
    }
    return point;
}

std::array<double, 3> RefinedOrigin::in_face(Index vertex, Index face) const
{
    if (vertex >= target_.vertex_count()) {
        const Index k = vertex - target_.vertex_count();
        return coordinates_in_face(
            target_, {refined_.vertex_faces[k], refined_.vertex_barycentrics[k]}, face);
    }
    std::array<double, 3> coordinates{0, 0, 0};
    const auto corners = target_.face(face);
    for (std::size_t i = 0; i < 3; ++i) {
        if (corners[i] == vertex) {
            coordinates[i] = 1;
        }
    }
    return coordinates;
}

}  // namespace layout_embedding
