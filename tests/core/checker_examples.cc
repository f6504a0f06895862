#include "checker_examples.hh"

#include <gtest/gtest.h>
#include <map>

#include "zoo.hh"

namespace layout_embedding {

std::vector<Example> examples()
{
    std::vector<Example> result;
    const auto add = [&](const std::string& name, const PolygonMesh& polygons, int subdivisions,
                         const std::set<Index>& dropped = {}) {
        result.push_back(
            {name + " as it is", embed_in_itself(polygons, subdivisions, false, 1, dropped)});
        result.push_back(
            {name + " refined", embed_in_itself(polygons, subdivisions, true, 2, dropped)});
        Example shaken = result.back();
        shaken.name = name + " shaken";
        shake(shaken.embedding, 5000, 3);
        result.push_back(shaken);
    };
    add("tetrahedron", zoo::tetrahedron(), 2);
    add("cube", zoo::cube(), 1);
    add("octahedron", zoo::octahedron(), 2);
    add("icosahedron", zoo::icosahedron(), 1);
    add("torus", grid_polygons(3, 4, true), 1);
    add("annulus", grid_polygons(4, 2, false), 1);
    add("annulus with all landmarks on the boundary", grid_polygons(5, 1, false), 2);
    add("disk",
        zoo::polygon_mesh({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}), 2);
    add("disk in a sphere", zoo::octahedron(), 2, {4});
    add("annulus in a sphere", zoo::cube(), 1, {0, 1});
    return result;
}

std::string describe(const CheckReport& report)
{
    std::string text;
    for (const Violation& violation : report.violations) {
        text += violation.code + ": " + violation.message + "\n";
    }
    return text;
}

std::vector<Index> shortest_walk(const std::vector<Index>& corners, Index from, Index to,
                                 const std::set<Index>& forbidden)
{
    std::map<Index, std::set<Index>> neighbors;
    for (std::size_t c = 0; c < corners.size(); ++c) {
        const Index next = corners[c % 3 == 2 ? c - 2 : c + 1];
        neighbors[corners[c]].insert(next);
        neighbors[next].insert(corners[c]);
    }
    std::map<Index, Index> parents{{to, to}};
    std::vector<Index> queue{to};
    for (std::size_t k = 0; k < queue.size() && parents.count(from) == 0; ++k) {
        for (const Index v : neighbors[queue[k]]) {
            if ((v == from || forbidden.count(v) == 0) && parents.emplace(v, queue[k]).second) {
                queue.push_back(v);
            }
        }
    }
    std::vector<Index> walk{from};
    while (walk.back() != to) {
        walk.push_back(parents.at(walk.back()));
    }
    return walk;
}

Index chain_of(const ClaimedEmbedding& embedding, Index a, Index b)
{
    for (Index c = 0; c < embedding.layout_edges.size(); ++c) {
        const auto [tail, head] = embedding.layout_edges[c];
        if ((tail == a && head == b) || (tail == b && head == a)) {
            return c;
        }
    }
    ADD_FAILURE() << "no chain for " << a << "-" << b;
    return 0;
}

}  // namespace layout_embedding
