#include "apps/path_constraints.hh"

#include <algorithm>
#include <string>

namespace layout_embedding {

namespace {

/// The node at a point, kNone if the target has no such vertex, edge or face.
Index node_at(const TriangleMesh& target, const PathGraph& graph, const WeakPoint& point)
{
    const Index vertex = point[0];
    if (vertex >= target.vertex_count()) {
        return kNone;
    }
    if (point[1] == kNone) {
        return point[2] == kNone ? graph.node_of_vertex(vertex) : kNone;
    }
    Index h = target.outgoing(vertex);
    do {
        const Index next = target.head(h);
        const Index last = target.tail(TriangleMesh::previous(h));
        if (point[2] == kNone) {
            if (next == point[1]) {
                return graph.node_of_edge(target.edge(h));
            }
            if (last == point[1]) {
                return graph.node_of_edge(target.edge(TriangleMesh::previous(h)));
            }
        } else if ((next == point[1] && last == point[2]) ||
                   (next == point[2] && last == point[1])) {
            return graph.node_of_face(TriangleMesh::face_of(h));
        }
        h = target.rotated_ccw(h);
    } while (h != kNone && h != target.outgoing(vertex));
    return kNone;
}

/// The dart between two nodes, kNone if there is none.
Index dart_between(const PathGraph& graph, Index from, Index to)
{
    for (Index d = graph.first_dart(from); d < graph.first_dart(from + 1); ++d) {
        if (graph.head(d) == to) {
            return d;
        }
    }
    return kNone;
}

Error invalid_path(Index layout_edge, const std::string& what)
{
    return make_error(ErrorCode::invalidPath,
                      "the path given for layout edge " + std::to_string(layout_edge) + " " + what,
                      {{"edge", layout_edge}});
}

std::vector<Index> landmark_nodes(const EmbeddingProblem& problem, const PathGraph& graph)
{
    std::vector<Index> nodes;
    for (const Index vertex : problem.landmarks) {
        nodes.push_back(graph.node_of_vertex(vertex));
    }
    return nodes;
}

/// The darts along a path of a layout edge, from landmark to landmark.
Result<std::vector<Index>> darts_along(const EmbeddingProblem& problem, const PathGraph& graph,
                                       const std::vector<Index>& landmarks, Index layout_edge,
                                       const std::vector<WeakPoint>& path)
{
    const Layout& layout = *problem.layout;
    std::vector<Index> nodes;
    for (const WeakPoint& point : path) {
        nodes.push_back(node_at(*problem.target, graph, point));
        if (nodes.back() == kNone) {
            return invalid_path(layout_edge, "has a point " + std::to_string(nodes.size() - 1) +
                                                 " that is nowhere on the target");
        }
    }
    if (nodes.size() < 2 || nodes.front() != landmarks[layout.tail(2 * layout_edge)] ||
        nodes.back() != landmarks[layout.head(2 * layout_edge)]) {
        return invalid_path(layout_edge, "does not run between the landmarks of its ends");
    }
    std::vector<Index> darts;
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        if (i > 0 && std::find(landmarks.begin(), landmarks.end(), nodes[i]) != landmarks.end()) {
            return invalid_path(layout_edge, "runs through a landmark");
        }
        darts.push_back(dart_between(graph, nodes[i], nodes[i + 1]));
        if (darts.back() == kNone) {
            return invalid_path(layout_edge,
                                "has no way from its point " + std::to_string(i) + " to the next");
        }
    }
    return darts;
}

}  // namespace

Result<std::vector<ClassConstraint>> class_constraints(
    const EmbeddingProblem& problem, const PathGraph& graph,
    const std::vector<PathConstraint>& constraints)
{
    const std::vector<Index> landmarks = landmark_nodes(problem, graph);
    std::vector<ClassConstraint> result;
    for (const PathConstraint& constraint : constraints) {
        const Index e = constraint.layout_edge;
        if (e >= problem.layout->edge_count()) {
            return invalid_path(e, "is for an edge that the layout has not, of its " +
                                       std::to_string(problem.layout->edge_count()));
        }
        auto darts = darts_along(problem, graph, landmarks, e, constraint.path);
        if (!darts) {
            return darts.error();
        }
        result.push_back({e, constraint.is_kept, std::move(*darts)});
    }
    return result;
}

Result<std::vector<DartPaths>> embedding_darts(const EmbeddingProblem& problem,
                                               const PathGraph& graph,
                                               const std::vector<EmbeddingPaths>& embeddings)
{
    const std::vector<Index> landmarks = landmark_nodes(problem, graph);
    std::vector<DartPaths> result;
    for (const EmbeddingPaths& paths : embeddings) {
        if (paths.size() != problem.layout->edge_count()) {
            return make_error(ErrorCode::invalidPath,
                              "an embedding has " + std::to_string(paths.size()) +
                                  " paths for the " + std::to_string(problem.layout->edge_count()) +
                                  " edges of the layout");
        }
        result.emplace_back();
        for (Index e = 0; e < paths.size(); ++e) {
            auto darts = darts_along(problem, graph, landmarks, e, paths[e]);
            if (!darts) {
                return darts.error();
            }
            result.back().push_back(std::move(*darts));
        }
    }
    return result;
}

}  // namespace layout_embedding
