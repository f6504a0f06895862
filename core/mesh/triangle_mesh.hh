#pragma once

#include <array>
#include <vector>

#include "base/types.hh"
#include "mesh/polygon_mesh.hh"

namespace layout_embedding {

/// An oriented manifold triangle mesh, with or without boundary, in flat arrays.
///
/// Halfedge 3f+i runs from corner i to corner i+1 of face f, counter-clockwise; boundary edges have
/// one halfedge. Around a vertex, "counter-clockwise" is as seen from outside (face normals towards
/// the viewer).
class TriangleMesh {
public:
    TriangleMesh() = default;

    /// Builds the connectivity of `mesh`, which must satisfy check_surface() with triangles only
    /// (mesh/validation.hh); nothing is checked here. O(#F log #F).
    explicit TriangleMesh(const PolygonMesh& mesh);

    Index vertex_count() const { return static_cast<Index>(positions_.size()); }
    Index edge_count() const { return static_cast<Index>(edge_halfedges_.size()); }
    Index face_count() const { return static_cast<Index>(corners_.size() / 3); }
    Index halfedge_count() const { return static_cast<Index>(corners_.size()); }
    /// V - E + F.
    long euler_characteristic() const
    {
        return static_cast<long>(vertex_count()) - edge_count() + face_count();
    }

    const std::vector<Vec3>& positions() const { return positions_; }
    const Vec3& position(Index vertex) const { return positions_[vertex]; }
    /// 3 #F vertex ids, counter-clockwise per face.
    const std::vector<Index>& corners() const { return corners_; }
    std::array<Index, 3> face(Index f) const
    {
        return {corners_[3 * f], corners_[3 * f + 1], corners_[3 * f + 2]};
    }

    Index tail(Index h) const { return corners_[h]; }
    Index head(Index h) const { return corners_[next(h)]; }
    static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
    static Index previous(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }
    static Index face_of(Index h) { return h / 3; }
    /// The other halfedge of the edge, kNone on the boundary.
    Index opposite(Index h) const { return opposites_[h]; }
    Index edge(Index h) const { return edges_[h]; }
    /// The smaller-numbered halfedge of an edge; it gives the edge its direction.
    Index halfedge(Index edge) const { return edge_halfedges_[edge]; }
    bool is_boundary_edge(Index edge) const { return opposite(halfedge(edge)) == kNone; }

    /// An outgoing halfedge of the vertex; at a boundary vertex the first one counter-clockwise
    /// (the hole lies to its right).
    Index outgoing(Index vertex) const { return vertex_halfedges_[vertex]; }
    /// The next outgoing halfedge counter-clockwise around the tail of h; kNone at the boundary.
    Index rotated_ccw(Index h) const { return opposites_[previous(h)]; }
    bool is_boundary_vertex(Index vertex) const { return opposite(outgoing(vertex)) == kNone; }
    /// The edge that joins two vertices, kNone if there is none. O(degree of `a`).
    Index edge_between(Index a, Index b) const;

    /// Number of boundary loops.
    Index boundary_loop_count() const;

private:
    std::vector<Vec3> positions_;
    std::vector<Index> corners_;           // 3 #F
    std::vector<Index> opposites_;         // per halfedge
    std::vector<Index> edges_;             // per halfedge
    std::vector<Index> edge_halfedges_;    // per edge
    std::vector<Index> vertex_halfedges_;  // per vertex
};

}  // namespace layout_embedding
