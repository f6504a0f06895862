#include "patches/point_location.hh"

#include <algorithm>
#include <cmath>

namespace layout_embedding {

PointLocation::PointLocation(const Parametrisation& map) : map_(map), low_(map.points[0])
{
    PlanePoint high = low_;
    for (const PlanePoint& point : map.points) {
        low_ = low_.cwiseMin(point);
        high = high.cwiseMax(point);
    }
    const PlanePoint size = high - low_;
    cell_size_ = std::sqrt(size.x() * size.y() / static_cast<double>(map.corners.size()));
    for (int axis = 0; axis < 2; ++axis) {
        const double count = std::floor(size[axis] / cell_size_) + 1;
        cells_[static_cast<std::size_t>(axis)] =
            static_cast<Index>(std::min(count, 4.0 * static_cast<double>(map.corners.size()) + 1));
    }
    offsets_.assign(std::size_t{cells_[0]} * cells_[1] + 1, 0);
    const auto for_each_cell = [&](auto&& action) {
        for (Index t = 0; t < map.corners.size(); ++t) {
            PlanePoint least = map.points[map.corners[t][0]];
            PlanePoint most = least;
            for (const Index corner : map.corners[t]) {
                least = least.cwiseMin(map.points[corner]);
                most = most.cwiseMax(map.points[corner]);
            }
            const auto from = cell_of(least);
            const auto to = cell_of(most);
            for (Index y = from[1]; y <= to[1]; ++y) {
                for (Index x = from[0]; x <= to[0]; ++x) {
                    action(std::size_t{y} * cells_[0] + x, t);
                }
            }
        }
    };
    for_each_cell([&](std::size_t cell, Index) { ++offsets_[cell + 1]; });
    for (std::size_t cell = 1; cell < offsets_.size(); ++cell) {
        offsets_[cell] += offsets_[cell - 1];
    }
    triangles_.resize(offsets_.back());
    std::vector<Index> ends(offsets_.begin(), offsets_.end() - 1);
    for_each_cell([&](std::size_t cell, Index t) { triangles_[ends[cell]++] = t; });
}

std::array<Index, 2> PointLocation::cell_of(const PlanePoint& point) const
{
    std::array<Index, 2> cell{};
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const int a = static_cast<int>(axis);
        const double place = std::floor((point[a] - low_[a]) / cell_size_);
        cell[axis] =
            static_cast<Index>(std::clamp(place, 0.0, static_cast<double>(cells_[axis]) - 1));
    }
    return cell;
}

PointLocation::Place PointLocation::find(const PlanePoint& point) const
{
    const auto [x, y] = cell_of(point);
    const std::size_t cell = std::size_t{y} * cells_[0] + x;
    Place best{kNone, {}};
    double best_least = -std::numeric_limits<double>::infinity();
    const auto look_at = [&](Index t) {
        const auto& c = map_.corners[t];
        const PlanePoint a = map_.points[c[0]] - point;
        const PlanePoint b = map_.points[c[1]] - point;
        const PlanePoint d = map_.points[c[2]] - point;
        const std::array<double, 3> areas{cross(b, d), cross(d, a), cross(a, b)};
        const double sum = areas[0] + areas[1] + areas[2];
        if (!(sum > 0)) {
            return;
        }
        const double least = std::min({areas[0], areas[1], areas[2]}) / sum;
        if (least > best_least) {
            best_least = least;
            best = {t, {areas[0] / sum, areas[1] / sum, areas[2] / sum}};
        }
    };
    for (Index place = offsets_[cell]; place < offsets_[cell + 1]; ++place) {
        look_at(triangles_[place]);
    }
    // A cell at the rim may be empty.
    for (Index t = 0; best_least < -1e-3 && t < map_.corners.size(); ++t) {
        look_at(t);
    }
    double sum = 0;
    for (double& coordinate : best.barycentrics) {
        coordinate = std::max(coordinate, 0.0);
        sum += coordinate;
    }
    for (double& coordinate : best.barycentrics) {
        coordinate /= sum;
    }
    return best;
}

}  // namespace layout_embedding
