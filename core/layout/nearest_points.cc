#include "layout/nearest_points.hh"

#include <algorithm>
#include <utility>

namespace layout_embedding {

NearestPoints::NearestPoints(std::span<const Vec3> positions, std::vector<Index> ids)
    : positions_(positions), ids_(std::move(ids))
{
    build(0, ids_.size(), 0);
}

bool NearestPoints::before(Index a, Index b, int axis) const
{
    const double x = positions_[a][axis];
    const double y = positions_[b][axis];
    return x != y ? x < y : a < b;
}

void NearestPoints::build(std::size_t begin, std::size_t end, int axis)
{
    if (end - begin < 2) {
        return;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    const auto first = ids_.begin();
    std::nth_element(first + static_cast<std::ptrdiff_t>(begin),
                     first + static_cast<std::ptrdiff_t>(middle),
                     first + static_cast<std::ptrdiff_t>(end),
                     [&](Index a, Index b) { return before(a, b, axis); });
    build(begin, middle, (axis + 1) % 3);
    build(middle + 1, end, (axis + 1) % 3);
}

std::vector<NearestPoints::Neighbour> NearestPoints::nearest(const Vec3& query,
                                                             std::size_t count) const
{
    std::vector<Neighbour> heap;  // the farthest on top
    if (count > 0) {
        visit(0, ids_.size(), 0, query, count, heap);
    }
    std::sort_heap(heap.begin(), heap.end());
    return heap;
}

void NearestPoints::visit(std::size_t begin, std::size_t end, int axis, const Vec3& query,
                          std::size_t count, std::vector<Neighbour>& heap) const
{
    if (begin == end) {
        return;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    const Index root = ids_[middle];
    const double offset = query[axis] - positions_[root][axis];
    const int next = (axis + 1) % 3;
    const bool left = offset < 0;
    visit(left ? begin : middle + 1, left ? middle : end, next, query, count, heap);
    const Neighbour candidate{(positions_[root] - query).squaredNorm(), root};
    if (heap.size() < count) {
        heap.push_back(candidate);
        std::push_heap(heap.begin(), heap.end());
    } else if (candidate < heap.front()) {
        std::pop_heap(heap.begin(), heap.end());
        heap.back() = candidate;
        std::push_heap(heap.begin(), heap.end());
    }
    // Points beyond the splitting plane are no nearer than the plane; equally near ones can still
    // win by their id.
    if (heap.size() < count || offset * offset <= heap.front().squared_distance) {
        visit(left ? middle + 1 : begin, left ? end : middle, next, query, count, heap);
    }
}

}  // namespace layout_embedding
