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

Error invalid_path(const PathConstraint& constraint, const std::string& what)
{
    return make_error(
        ErrorCode::invalidPath,
        "the path given for layout edge " + std::to_string(constraint.layout_edge) + " " + what,
        {{"edge", constraint.layout_edge}});
}

}  // namespace

Result<std::vector<ClassConstraint>> class_constraints(
    const EmbeddingProblem& problem, const PathGraph& graph,
    const std::vector<PathConstraint>& constraints)
{
    const Layout& layout = *problem.layout;
    std::vector<Index> landmark_nodes;
    for (const Index vertex : problem.landmarks) {
        landmark_nodes.push_back(graph.node_of_vertex(vertex));
    }
    std::vector<ClassConstraint> result;
    for (const PathConstraint& constraint : constraints) {
        const Index e = constraint.layout_edge;
        if (e >= layout.edge_count()) {
            return invalid_path(constraint, "is for an edge that the layout has not, of its " +
                                                std::to_string(layout.edge_count()));
        }
        std::vector<Index> nodes;
        for (const WeakPoint& point : constraint.path) {
            nodes.push_back(node_at(*problem.target, graph, point));
            if (nodes.back() == kNone) {
                return invalid_path(constraint, "has a point " + std::to_string(nodes.size() - 1) +
                                                    " that is nowhere on the target");
            }
        }
        if (nodes.size() < 2 || nodes.front() != landmark_nodes[layout.tail(2 * e)] ||
            nodes.back() != landmark_nodes[layout.head(2 * e)]) {
            return invalid_path(constraint, "does not run between the landmarks of its ends");
        }
        ClassConstraint in_graph{e, constraint.is_kept, {}};
        for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
            if (i > 0 && std::find(landmark_nodes.begin(), landmark_nodes.end(), nodes[i]) !=
                             landmark_nodes.end()) {
                return invalid_path(constraint, "runs through a landmark");
            }
            in_graph.darts.push_back(dart_between(graph, nodes[i], nodes[i + 1]));
            if (in_graph.darts.back() == kNone) {
                return invalid_path(
                    constraint, "has no way from its point " + std::to_string(i) + " to the next");
            }
        }
        result.push_back(std::move(in_graph));
    }
    return result;
}

}  // namespace layout_embedding
