#include "maps/exact_location.hh"

namespace layout_embedding {

ExactLocation::ExactLocation(const PlacedPatch& placed) : placed_(placed), location_(placed.map)
{
    for (const PlanePoint& point : placed.map.points) {
        points_.push_back(to_grid(point));
    }
}

bool ExactLocation::holds(Index triangle, const GridPoint& point) const
{
    for (Index h = 3 * triangle; h < 3 * triangle + 3; ++h) {
        if (orientation(points_[mesh().tail(h)], points_[mesh().head(h)], point) < 0) {
            return false;
        }
    }
    return true;
}

ExactPlace ExactLocation::find(const GridPoint& point) const
{
    // Rounding may have chosen a triangle beside the right one: walk towards the point.
    Index triangle = location_.find(to_plane(point)).triangle;
    const Index count = mesh().face_count();
    bool found = false;
    for (Index step = 0; step < 64 && !(found = holds(triangle, point)); ++step) {
        for (Index k = 0; k < 3; ++k) {
            const Index h = 3 * triangle + (k + step) % 3;
            const Index opposite = mesh().opposite(h);
            if (opposite != kNone &&
                orientation(points_[mesh().tail(h)], points_[mesh().head(h)], point) < 0) {
                triangle = TriangleMesh::face_of(opposite);
                break;
            }
        }
    }
    for (Index t = 0; !found && t < count; ++t) {
        found = holds(t, point);
        triangle = found ? t : triangle;
    }
    ExactPlace place;
    place.triangle = triangle;
    for (Index h = 3 * triangle; h < 3 * triangle + 3; ++h) {
        if (points_[mesh().tail(h)] == point) {
            place.vertex = mesh().tail(h);
            place.halfedge = kNone;
            return place;
        }
        if (orientation(points_[mesh().tail(h)], points_[mesh().head(h)], point) == 0) {
            place.halfedge = h;
        }
    }
    return place;
}

std::array<double, 3> ExactLocation::weights(Index triangle, const GridPoint& point) const
{
    const auto corners = mesh().face(triangle);
    const auto area = [&](Index a, Index b) {
        return static_cast<double>(orientation(points_[corners[a]], points_[corners[b]], point));
    };
    std::array<double, 3> weights{area(1, 2), area(2, 0), area(0, 1)};
    double sum = 0;
    for (double& weight : weights) {
        weight = std::max(weight, 0.0);
        sum += weight;
    }
    for (double& weight : weights) {
        weight /= sum;
    }
    return weights;
}

}  // namespace layout_embedding
