#include "mesh/weld.hh"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "mesh/polygon_halfedges.hh"

namespace layout_embedding {
namespace {

bool lexicographically_less(const Vec3& a, const Vec3& b)
{
    for (int i = 0; i < 3; ++i) {
        if (a[i] != b[i]) {
            return a[i] < b[i];
        }
    }
    return false;
}

/// Per vertex a number that two vertices share iff their positions are equal.
std::vector<Index> position_ids(const PolygonMesh& mesh)
{
    std::vector<Index> order(mesh.vertex_count());
    std::iota(order.begin(), order.end(), 0);
    const auto& positions = mesh.positions;
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
        if (lexicographically_less(positions[a], positions[b])) {
            return true;
        }
        return !lexicographically_less(positions[b], positions[a]) && a < b;
    });
    std::vector<Index> ids(mesh.vertex_count(), 0);
    for (std::size_t i = 1; i < order.size(); ++i) {
        ids[order[i]] = ids[order[i - 1]];
        if (lexicographically_less(positions[order[i - 1]], positions[order[i]])) {
            ++ids[order[i]];
        }
    }
    return ids;
}

/// The faces whose corners are all at different places. The others are no more than edges, and
/// vanish where their corners become one.
PolygonMesh without_needles(const PolygonMesh& mesh, const std::vector<Index>& ids)
{
    PolygonMesh result;
    result.positions = mesh.positions;
    std::vector<Index> places;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        places.clear();
        for (const Index corner : mesh.face(f)) {
            places.push_back(ids[corner]);
        }
        std::sort(places.begin(), places.end());
        if (std::adjacent_find(places.begin(), places.end()) == places.end()) {
            result.add_face(mesh.face(f));
        }
    }
    return result;
}

/// Boundary halfedges, in pairs that lie on each other in opposite directions, no third with them.
std::vector<std::array<Index, 2>> coincident_pairs(const std::vector<Index>& ids,
                                                   const PolygonHalfedges& halfedges)
{
    struct Entry {
        Index smaller;
        Index larger;
        Index halfedge;
    };
    std::vector<Entry> entries;
    for (Index h = 0; h < halfedges.count(); ++h) {
        const Index tail = ids[halfedges.tail(h)];
        const Index head = ids[halfedges.head(h)];
        if (halfedges.opposite(h) == kNone && tail != head) {
            entries.push_back({std::min(tail, head), std::max(tail, head), h});
        }
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
        if (a.smaller != b.smaller) {
            return a.smaller < b.smaller;
        }
        return a.larger != b.larger ? a.larger < b.larger : a.halfedge < b.halfedge;
    });
    std::vector<std::array<Index, 2>> pairs;
    for (std::size_t i = 0; i < entries.size();) {
        std::size_t end = i + 1;
        while (end < entries.size() && entries[end].smaller == entries[i].smaller &&
               entries[end].larger == entries[i].larger) {
            ++end;
        }
        const Index h = entries[i].halfedge;
        const Index g = end - i == 2 ? entries[i + 1].halfedge : kNone;
        if (g != kNone && ids[halfedges.tail(h)] == ids[halfedges.head(g)]) {
            pairs.push_back({h, g});
        }
        i = end;
    }
    return pairs;
}

/// Disjoint sets whose representative is their smallest element.
class Classes {
public:
    explicit Classes(Index count) : parents_(count)
    {
        std::iota(parents_.begin(), parents_.end(), 0);
    }

    Index find(Index v)
    {
        while (parents_[v] != v) {
            parents_[v] = parents_[parents_[v]];
            v = parents_[v];
        }
        return v;
    }

    void join(Index a, Index b)
    {
        a = find(a);
        b = find(b);
        parents_[std::max(a, b)] = std::min(a, b);
    }

private:
    std::vector<Index> parents_;
};

}  // namespace

std::vector<Index> weld_classes(const PolygonMesh& given)
{
    const std::vector<Index> ids = position_ids(given);
    const PolygonMesh mesh = without_needles(given, ids);
    const PolygonHalfedges halfedges(mesh);
    std::vector<std::array<Index, 2>> pairs = coincident_pairs(ids, halfedges);
    constexpr int kMaxRounds = 8;
    for (int round = 1;; ++round) {
        Classes classes(mesh.vertex_count());
        for (const auto& [h, g] : pairs) {
            classes.join(halfedges.tail(h), halfedges.head(g));
            classes.join(halfedges.head(h), halfedges.tail(g));
        }
        std::vector<Index> result(mesh.vertex_count());
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
            result[v] = classes.find(v);
        }
        if (pairs.empty()) {
            return result;
        }
        // An edge that was fine before and is not any more has joined with others through classes
        // that other pairs made. Give up the pairs at its ends.
        const PolygonMesh trial = welded(mesh, result);
        const PolygonHalfedges joined(trial);
        std::vector<bool> bad(mesh.vertex_count(), false);
        bool any = false;
        for (const auto& [h, g] : pairs) {
            if (joined.opposite(h) != g) {
                bad[trial.corners[h]] = bad[joined.head(h)] = any = true;
            }
        }
        for (Index h = 0; h < halfedges.count(); ++h) {
            if (halfedges.opposite(h) != joined.opposite(h) && halfedges.opposite(h) != kNone) {
                bad[trial.corners[h]] = bad[joined.head(h)] = any = true;
            }
        }
        if (!any) {
            return result;
        }
        const std::size_t before = pairs.size();
        pairs.erase(std::remove_if(pairs.begin(), pairs.end(),
                                   [&](const std::array<Index, 2>& pair) {
                                       return bad[trial.corners[pair[0]]] ||
                                              bad[joined.head(pair[0])];
                                   }),
                    pairs.end());
        if (pairs.size() == before || round == kMaxRounds) {
            pairs.clear();
        }
    }
}

PolygonMesh welded(const PolygonMesh& mesh, const std::vector<Index>& classes)
{
    PolygonMesh result = mesh;
    for (Index& corner : result.corners) {
        corner = classes[corner];
    }
    return result;
}

bool welding_helps(const PolygonMesh& mesh, const std::vector<Index>& classes)
{
    const auto component_count = [](const PolygonHalfedges& halfedges) {
        const std::vector<Index> components = halfedges.components();
        return *std::max_element(components.begin(), components.end()) + 1;
    };
    const PolygonHalfedges before(mesh);
    // Faces that would be no more than an edge do not count afterwards.
    PolygonMesh joined;
    joined.positions = mesh.positions;
    const PolygonMesh trial = welded(mesh, classes);
    for (Index f = 0; f < trial.face_count(); ++f) {
        const auto face = trial.face(f);
        if (face.size() != 3 || (face[0] != face[1] && face[1] != face[2] && face[2] != face[0])) {
            joined.add_face(face);
        }
    }
    if (joined.face_count() == 0) {
        return false;
    }
    const PolygonHalfedges after(joined);
    return component_count(after) < component_count(before) ||
           (before.unpaired_count() > 0 && after.unpaired_count() == 0);
}

}  // namespace layout_embedding
