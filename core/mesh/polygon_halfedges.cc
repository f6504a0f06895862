#include "mesh/polygon_halfedges.hh"

#include <algorithm>

namespace layout_embedding {

PolygonHalfedges::PolygonHalfedges(const PolygonMesh& mesh)
    : ends_(mesh.face_offsets),
      corners_(mesh.corners),
      faces_(mesh.corners.size()),
      opposites_(mesh.corners.size(), kNone)
{
    for (Index f = 0; f < mesh.face_count(); ++f) {
        std::fill(faces_.begin() + ends_[f], faces_.begin() + ends_[f + 1], f);
    }
    // The halfedges of each smaller vertex, sorted by the larger one.
    struct Entry {
        Index larger;
        Index halfedge;
    };
    std::vector<Index> begin(mesh.positions.size() + 1, 0);
    for (Index h = 0; h < count(); ++h) {
        ++begin[std::min(tail(h), head(h)) + 1];
    }
    for (std::size_t v = 1; v < begin.size(); ++v) {
        begin[v] += begin[v - 1];
    }
    std::vector<Entry> entries(count());
    std::vector<Index> fill(begin.begin(), begin.end() - 1);
    for (Index h = 0; h < count(); ++h) {
        entries[fill[std::min(tail(h), head(h))]++] = {std::max(tail(h), head(h)), h};
    }
    for (std::size_t v = 0; v + 1 < begin.size(); ++v) {
        std::sort(entries.begin() + begin[v], entries.begin() + begin[v + 1],
                  [](const Entry& a, const Entry& b) {
                      return a.larger != b.larger ? a.larger < b.larger : a.halfedge < b.halfedge;
                  });
        for (Index i = begin[v]; i < begin[v + 1];) {
            Index end = i + 1;
            while (end < begin[v + 1] && entries[end].larger == entries[i].larger) {
                ++end;
            }
            const Index first = entries[i].halfedge;
            if (end - i == 2) {
                const Index second = entries[i + 1].halfedge;
                if (tail(first) != tail(second)) {
                    opposites_[first] = second;
                    opposites_[second] = first;
                } else if (first < inconsistent_[0]) {
                    inconsistent_ = {first, second};
                }
            } else if (end - i > 2 && first < non_manifold_[0]) {
                non_manifold_ = {first, entries[i + 2].halfedge};
            }
            i = end;
        }
    }
}

Index PolygonHalfedges::unpaired_count() const
{
    return static_cast<Index>(std::count(opposites_.begin(), opposites_.end(), kNone));
}

std::vector<Index> PolygonHalfedges::components() const
{
    std::vector<Index> component(ends_.size() - 1, kNone);
    Index count = 0;
    std::vector<Index> stack;  // one halfedge per face reached
    for (Index start = 0; start < this->count(); ++start) {
        if (component[face(start)] != kNone) {
            continue;
        }
        component[face(start)] = count;
        stack.push_back(start);
        while (!stack.empty()) {
            const Index first = stack.back();
            stack.pop_back();
            Index h = first;
            do {
                const Index twin = opposite(h);
                if (twin != kNone && component[face(twin)] == kNone) {
                    component[face(twin)] = count;
                    stack.push_back(twin);
                }
                h = next(h);
            } while (h != first);
        }
        ++count;
    }
    return component;
}

}  // namespace layout_embedding
