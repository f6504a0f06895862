#include "patches/target_places.hh"

namespace layout_embedding {
namespace {

/// The edge of a mesh between two vertices, kNone if there is none.
Index edge_between(const TriangleMesh& mesh, Index a, Index b)
{
    const Index start = mesh.outgoing(a);
    Index h = start;
    do {
        if (mesh.head(h) == b) {
            return mesh.edge(h);
        }
        if (mesh.tail(TriangleMesh::previous(h)) == b) {
            return mesh.edge(TriangleMesh::previous(h));
        }
        h = mesh.rotated_ccw(h);
    } while (h != kNone && h != start);
    return kNone;
}

}  // namespace

Index TargetPlaces::common_edge(Index v, Index w) const
{
    const Spot a = spot_of(v);
    const Spot b = spot_of(w);
    if (a.edge != kNone || b.edge != kNone) {
        const Spot& on_edge = a.edge != kNone ? a : b;
        const Spot& other = a.edge != kNone ? b : a;
        const Index h = target_.halfedge(on_edge.edge);
        const bool common = other.edge == on_edge.edge ||
                            (other.vertex != kNone &&
                             (other.vertex == target_.tail(h) || other.vertex == target_.head(h)));
        return common ? on_edge.edge : kNone;
    }
    return a.vertex == kNone || b.vertex == kNone ? kNone
                                                  : edge_between(target_, a.vertex, b.vertex);
}

double TargetPlaces::parameter_on(Index edge, Index v) const
{
    const Spot spot = spot_of(v);
    if (spot.vertex != kNone) {
        return spot.vertex == target_.tail(target_.halfedge(edge)) ? 0 : 1;
    }
    return spot.parameter;
}

TargetPlaces::Spot TargetPlaces::spot_of(Index v) const
{
    if (v < patch_.vertices.size()) {
        return refined_spot(patch_.vertices[v]);
    }
    const auto& [a, b] = map_.splits[v - patch_.vertices.size()];
    Spot spot;
    spot.edge = common_edge(a, b);
    if (spot.edge != kNone) {
        spot.parameter = (parameter_on(spot.edge, a) + parameter_on(spot.edge, b)) / 2;
    }
    return spot;
}

TargetPlaces::Spot TargetPlaces::refined_spot(Index vertex) const
{
    if (vertex < target_.vertex_count()) {
        return {vertex, kNone, 0};
    }
    const EdgePlace place = edge_place(target_, refined_, vertex);
    return {kNone, place.edge, place.parameter};
}

EdgePlace edge_place(const TriangleMesh& target, const RefinedMesh& refined, Index vertex)
{
    const Index k = vertex - target.vertex_count();
    const auto& barycentrics = refined.vertex_barycentrics[k];
    // Vertices on edges lie on the halfedge that gives their edge its direction.
    for (Index i = 0; i < 3; ++i) {
        if (barycentrics[TriangleMesh::previous(i)] == 0) {
            return {target.edge(3 * refined.vertex_faces[k] + i),
                    barycentrics[TriangleMesh::next(i)]};
        }
    }
    return {kNone, 0};
}

}  // namespace layout_embedding
