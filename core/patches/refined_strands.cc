#include "patches/refined_strands.hh"

#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "patches/target_places.hh"

namespace layout_embedding {

namespace {

/// Whether a refined vertex lies on an edge of the target or at its end.
bool lies_on(const TriangleMesh& target, const RefinedMesh& refined, Index edge, Index vertex)
{
    const Index h = target.halfedge(edge);
    return vertex < target.vertex_count() ? target.tail(h) == vertex || target.head(h) == vertex
                                          : edge_place(target, refined, vertex).edge == edge;
}

/// Whether vertex i of a chain is where it crosses an edge of the target.
bool is_crossing(const TriangleMesh& target, const RefinedMesh& refined,
                 const std::vector<Index>& chain, std::size_t i)
{
    if (chain[i] < target.vertex_count()) {
        return false;
    }
    const Index edge = edge_place(target, refined, chain[i]).edge;
    return edge != kNone && !lies_on(target, refined, edge, chain[i - 1]);
}

}  // namespace

bool has_added_vertices(const TriangleMesh& target, const RefinedMesh& refined)
{
    std::size_t crossings = 0;
    for (const std::vector<Index>& chain : refined.chains) {
        for (std::size_t i = 0; i < chain.size(); ++i) {
            crossings += is_crossing(target, refined, chain, i) ? 1 : 0;
        }
    }
    return crossings < refined.vertex_faces.size();
}

NormalForm strands_of(const TriangleMesh& target, const RefinedMesh& refined)
{
    // The target face of each step of a chain.
    std::map<std::array<Index, 2>, Index> faces;
    for (const std::vector<Index>& chain : refined.chains) {
        for (std::size_t i = 1; i < chain.size(); ++i) {
            faces[{chain[i - 1], chain[i]}] = kNone;
        }
    }
    for (Index h = 0; h < refined.corners.size(); ++h) {
        const Index a = refined.corners[h];
        const Index b = refined.corners[TriangleMesh::next(h)];
        for (const std::array<Index, 2>& ends : {std::array{a, b}, std::array{b, a}}) {
            if (const auto found = faces.find(ends); found != faces.end()) {
                found->second = refined.triangle_faces[h / 3];
            }
        }
    }
    NormalForm form(target, static_cast<Index>(refined.chains.size()));
    struct Crossing {
        EdgePlace place;
        Index id;
    };
    std::vector<Crossing> crossings;
    for (Index e = 0; e < refined.chains.size(); ++e) {
        const std::vector<Index>& chain = refined.chains[e];
        for (std::size_t i = 0; i < chain.size(); ++i) {
            if (chain[i] < target.vertex_count()) {
                form.append_to_strand(e, form.add_vertex(chain[i]));
            } else if (is_crossing(target, refined, chain, i)) {
                const EdgePlace place = edge_place(target, refined, chain[i]);
                const Index face = faces.at({chain[i - 1], chain[i]});
                Index h = 3 * face;
                while (target.edge(h) != place.edge && h < 3 * face + 2) {
                    ++h;
                }
                const Index id = form.add_crossing(h);
                form.append_to_strand(e, id);
                form.set_parameter(id, place.parameter);
                crossings.push_back({place, id});
            }
        }
    }
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
        return a.place.edge != b.place.edge ? a.place.edge < b.place.edge
                                            : a.place.parameter < b.place.parameter;
    });
    for (const Crossing& crossing : crossings) {
        form.append_to_edge(crossing.id);
    }
    return form;
}

}  // namespace layout_embedding
