#include "apps/boundary_paths.hh"

#include <algorithm>
#include <string>

#include "surface/strands.hh"

namespace layout_embedding {

namespace {

/// The dart between two neighbours in the path graph.
Index dart_to(const PathGraph& graph, Index from, Index to)
{
    Index dart = graph.first_dart(from);
    while (graph.head(dart) != to) {
        ++dart;
    }
    return dart;
}

Error cannot_follow(Index edge, const std::string& why)
{
    return make_error(
        ErrorCode::invalidOption,
        "layout edge " + std::to_string(edge) + " cannot run along the target's boundary: " + why,
        {{"edge", edge}});
}

}  // namespace

Result<std::vector<BoundaryPath>> boundary_paths(const EmbeddingProblem& problem,
                                                 const PathGraph& graph)
{
    const Layout& layout = *problem.layout;
    const TriangleMesh& target = *problem.target;
    std::vector<bool> is_landmark(target.vertex_count(), false);
    for (const Index vertex : problem.landmarks) {
        is_landmark[vertex] = true;
    }
    std::vector<BoundaryPath> paths;
    for (Index h = 0; h < 2 * layout.edge_count(); ++h) {
        if (layout.face(Layout::twin(h)) != kNone || layout.face(h) == kNone) {
            continue;
        }
        // The outside lies on the right of h, as the hole does along boundary halfedges.
        const Index from = problem.landmarks[layout.tail(h)];
        const Index to = problem.landmarks[layout.head(h)];
        if (!target.is_boundary_vertex(from) || !target.is_boundary_vertex(to)) {
            continue;
        }
        BoundaryPath path{Layout::edge(h), {from}, {}, 0};
        do {
            path.vertices.push_back(target.head(target.outgoing(path.vertices.back())));
        } while (!is_landmark[path.vertices.back()]);
        if (path.vertices.back() != to) {
            return cannot_follow(path.layout_edge,
                                 "the next landmark there is not the one at its other end, target "
                                 "vertex " +
                                     std::to_string(to) + ", but target vertex " +
                                     std::to_string(path.vertices.back()));
        }
        if (h % 2 == 1) {
            std::reverse(path.vertices.begin(), path.vertices.end());
        }
        for (std::size_t i = 0; i + 1 < path.vertices.size(); ++i) {
            const Index a = path.vertices[i];
            const Index b = path.vertices[i + 1];
            const Index edge = target.edge(target.outgoing(h % 2 == 0 ? a : b));
            const Index middle = graph.node_of_edge(edge);
            path.darts.push_back(dart_to(graph, graph.node_of_vertex(a), middle));
            path.darts.push_back(dart_to(graph, middle, graph.node_of_vertex(b)));
        }
        for (const Index dart : path.darts) {
            path.length += graph.dart(dart).length;
        }
        paths.push_back(std::move(path));
    }
    return paths;
}

std::optional<WeakEmbedding> with_boundary_paths(const EmbeddingProblem& problem,
                                                 const PathGraph& graph,
                                                 const WeakEmbedding& embedding,
                                                 const std::vector<BoundaryPath>& paths)
{
    Strands strands(problem, graph);
    std::vector<bool> inserted(embedding.paths.size(), false);
    for (const BoundaryPath& path : paths) {
        inserted[path.layout_edge] = true;
        if (!strands.insert(path.layout_edge, path.darts)) {
            return std::nullopt;
        }
    }
    for (Index edge = 0; edge < embedding.paths.size(); ++edge) {
        if (!inserted[edge] && !strands.insert(edge, embedding.paths[edge].darts)) {
            return std::nullopt;
        }
    }
    return strands.weak_embedding();
}

void run_along_boundary(NormalForm& form, const std::vector<BoundaryPath>& paths)
{
    for (const BoundaryPath& path : paths) {
        form.reroute(path.layout_edge,
                     std::span(path.vertices).subspan(1, path.vertices.size() - 2));
    }
    form.compact();
}

}  // namespace layout_embedding
