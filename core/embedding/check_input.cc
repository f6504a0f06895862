#include "embedding/check_input.hh"

namespace layout_embedding {

PolygonMesh to_polygons(const Layout& layout)
{
    PolygonMesh mesh;
    mesh.positions.assign(layout.vertex_count(), Vec3::Zero());
    for (Index f = 0; f < layout.face_count(); ++f) {
        std::vector<Index> corners;
        for (const Index h : layout.face_halfedges(f)) {
            corners.push_back(layout.tail(h));
        }
        mesh.add_face(corners);
    }
    return mesh;
}

PolygonMesh to_polygons(const TriangleMesh& target)
{
    PolygonMesh mesh;
    mesh.positions = target.positions();
    mesh.corners = target.corners();
    mesh.face_offsets.resize(target.face_count() + 1);
    for (Index f = 0; f <= target.face_count(); ++f) {
        mesh.face_offsets[f] = 3 * f;
    }
    return mesh;
}

std::vector<std::array<Index, 2>> layout_edges(const Layout& layout)
{
    std::vector<std::array<Index, 2>> edges(layout.edge_count());
    for (Index e = 0; e < layout.edge_count(); ++e) {
        edges[e] = {layout.tail(2 * e), layout.head(2 * e)};
    }
    return edges;
}

namespace {

WeakPoint weak_point(const TriangleMesh& target, const NodeElement& element)
{
    switch (element.kind) {
        case NodeKind::vertex:
            return {element.id, kNone, kNone};
        case NodeKind::edge_midpoint: {
            const Index h = target.halfedge(element.id);
            return {target.tail(h), target.head(h), kNone};
        }
        case NodeKind::face_centroid:
            break;
    }
    return target.face(element.id);
}

}  // namespace

std::vector<std::vector<WeakPoint>> weak_points(const TriangleMesh& target, const PathGraph& graph,
                                                const WeakEmbedding& embedding)
{
    std::vector<std::vector<WeakPoint>> points(embedding.paths.size());
    for (std::size_t e = 0; e < points.size(); ++e) {
        const auto& darts = embedding.paths[e].darts;
        if (darts.empty()) {
            continue;
        }
        points[e].push_back(weak_point(target, graph.element(graph.tail(darts[0]))));
        for (const Index dart : darts) {
            points[e].push_back(weak_point(target, graph.element(graph.head(dart))));
        }
    }
    return points;
}

}  // namespace layout_embedding
