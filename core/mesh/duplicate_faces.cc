#include "mesh/duplicate_faces.hh"

#include <algorithm>

namespace layout_embedding {
namespace {

/// Turns `face` to the lexicographically smallest of its rotations and those of its reverse.
void make_canonical(std::vector<Index>& face, std::vector<Index>& trial, std::vector<Index>& best)
{
    const Index smallest = *std::min_element(face.begin(), face.end());
    best.clear();
    for (int direction = 0; direction < 2; ++direction) {
        // Only rotations that begin with the smallest corner can win.
        for (std::size_t i = 0; i < face.size(); ++i) {
            if (face[i] == smallest) {
                trial.assign(face.begin() + static_cast<std::ptrdiff_t>(i), face.end());
                trial.insert(trial.end(), face.begin(),
                             face.begin() + static_cast<std::ptrdiff_t>(i));
                if (best.empty() || trial < best) {
                    best.swap(trial);
                }
            }
        }
        std::reverse(face.begin(), face.end());
    }
    face = best;
}

}  // namespace

std::vector<std::array<Index, 2>> duplicate_faces(const PolygonMesh& mesh)
{
    // The canonical faces, sorted inside the bucket of their smallest corner.
    PolygonMesh canonical;
    canonical.corners.reserve(mesh.corners.size());
    canonical.face_offsets.reserve(mesh.face_offsets.size());
    std::vector<Index> begin(mesh.positions.size() + 1, 0);
    std::vector<Index> face;
    std::vector<Index> trial;
    std::vector<Index> best;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        face.assign(mesh.face(f).begin(), mesh.face(f).end());
        if (!face.empty()) {
            make_canonical(face, trial, best);
            ++begin[face.front() + 1];
        }
        canonical.add_face(face);
    }
    for (std::size_t v = 1; v < begin.size(); ++v) {
        begin[v] += begin[v - 1];
    }
    std::vector<Index> order(begin.back());
    std::vector<Index> fill(begin.begin(), begin.end() - 1);
    for (Index f = 0; f < mesh.face_count(); ++f) {
        if (!canonical.face(f).empty()) {
            order[fill[canonical.face(f).front()]++] = f;
        }
    }
    const auto compare = [&](Index a, Index b) {
        const auto x = canonical.face(a);
        const auto y = canonical.face(b);
        const std::size_t common = std::min(x.size(), y.size());
        for (std::size_t i = 0; i < common; ++i) {
            if (x[i] != y[i]) {
                return x[i] < y[i] ? -1 : 1;
            }
        }
        return x.size() == y.size() ? 0 : (x.size() < y.size() ? -1 : 1);
    };
    std::vector<std::array<Index, 2>> duplicates;
    for (std::size_t v = 0; v + 1 < begin.size(); ++v) {
        std::sort(order.begin() + begin[v], order.begin() + begin[v + 1], [&](Index a, Index b) {
            const int c = compare(a, b);
            return c != 0 ? c < 0 : a < b;
        });
        Index first = begin[v];
        for (Index i = begin[v] + 1; i < begin[v + 1]; ++i) {
            if (compare(order[first], order[i]) == 0) {
                duplicates.push_back({order[first], order[i]});
            } else {
                first = i;
            }
        }
    }
    std::sort(duplicates.begin(), duplicates.end(),
              [](const auto& a, const auto& b) { return a[1] < b[1]; });
    return duplicates;
}

bool same_direction(std::span<const Index> a, std::span<const Index> b)
{
    const auto start = std::find(b.begin(), b.end(), a[0]) - b.begin();
    return b[(static_cast<std::size_t>(start) + 1) % b.size()] == a[1];
}

}  // namespace layout_embedding
