#include "mesh/triangle_mesh.hh"

#include <algorithm>

namespace layout_embedding {

TriangleMesh::TriangleMesh(const PolygonMesh& mesh)
    : positions_(mesh.positions),
      corners_(mesh.corners),
      opposites_(mesh.corners.size(), kNone),
      edges_(mesh.corners.size(), kNone),
      vertex_halfedges_(mesh.positions.size(), kNone)
{
    // Pair the halfedges of each edge: bucket them by their smaller vertex. Edges are numbered by
    // their smaller halfedge.
    const Index halfedges = halfedge_count();
    std::vector<Index> bucket_begin(vertex_count() + 1, 0);
    for (Index h = 0; h < halfedges; ++h) {
        ++bucket_begin[std::min(tail(h), head(h)) + 1];
    }
    for (Index v = 0; v < vertex_count(); ++v) {
        bucket_begin[v + 1] += bucket_begin[v];
    }
    std::vector<Index> bucket(halfedges);
    std::vector<Index> fill(bucket_begin.begin(), bucket_begin.end() - 1);
    for (Index h = 0; h < halfedges; ++h) {
        bucket[fill[std::min(tail(h), head(h))]++] = h;
    }
    // Inside a bucket, the halfedges of one edge become neighbours when sorted by the larger
    // vertex.
    const auto larger = [&](Index h) { return std::max(tail(h), head(h)); };
    for (Index v = 0; v < vertex_count(); ++v) {
        std::sort(bucket.begin() + bucket_begin[v], bucket.begin() + bucket_begin[v + 1],
                  [&](Index a, Index b) {
                      return larger(a) != larger(b) ? larger(a) < larger(b) : a < b;
                  });
    }
    for (Index i = 1; i < halfedges; ++i) {
        const Index a = bucket[i - 1];
        const Index b = bucket[i];
        if (tail(a) == head(b) && head(a) == tail(b)) {
            opposites_[a] = b;
            opposites_[b] = a;
        }
    }
    for (Index h = 0; h < halfedges; ++h) {
        const Index twin = opposites_[h];
        if (twin == kNone || h < twin) {
            edges_[h] = edge_count();
            if (twin != kNone) {
                edges_[twin] = edge_count();
            }
            edge_halfedges_.push_back(h);
        }
        // Any outgoing halfedge of an inner vertex, the boundary one of a boundary vertex.
        Index& first = vertex_halfedges_[tail(h)];
        if (first == kNone || twin == kNone) {
            first = h;
        }
    }
}

Index TriangleMesh::edge_between(Index a, Index b) const
{
    const Index start = outgoing(a);
    Index h = start;
    do {
        if (head(h) == b) {
            return edge(h);
        }
        // The last edge around a boundary vertex has no outgoing halfedge, only this incoming one.
        const Index incoming = previous(h);
        if (tail(incoming) == b) {
            return edge(incoming);
        }
        h = rotated_ccw(h);
    } while (h != kNone && h != start);
    return kNone;
}

Index TriangleMesh::boundary_loop_count() const
{
    std::vector<bool> seen(halfedge_count(), false);
    Index loops = 0;
    for (Index start = 0; start < halfedge_count(); ++start) {
        if (opposite(start) != kNone || seen[start]) {
            continue;
        }
        ++loops;
        // The boundary continues at the head with that vertex's first outgoing halfedge.
        for (Index h = start; !seen[h]; h = outgoing(head(h))) {
            seen[h] = true;
        }
    }
    return loops;
}

}  // namespace layout_embedding
