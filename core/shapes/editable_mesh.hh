#pragma once

#include <array>
#include <vector>

#include "base/types.hh"
#include "mesh/polygon_mesh.hh"

namespace layout_embedding::shapes {

/// A triangle mesh, oriented and manifold with or without boundary, that can be edited edge by
/// edge. Halfedges are numbered as in TriangleMesh (mesh/triangle_mesh.hh); removed faces and
/// vertices leave holes in the numbering until compact(). The topology never changes: collapses
/// and flips that would change it are refused.
class EditableMesh {
public:
    EditableMesh(std::vector<Vec3> positions, std::vector<Index> corners);

    Index vertex_count() const { return static_cast<Index>(positions.size()); }
    Index face_count() const { return static_cast<Index>(corners_.size() / 3); }
    Index halfedge_count() const { return static_cast<Index>(corners_.size()); }
    Index live_vertex_count() const { return live_vertices_; }
    bool has_vertex(Index v) const { return outgoing_[v] != kNone; }
    bool has_face(Index f) const { return corners_[3 * f] != kNone; }
    bool has_halfedge(Index h) const { return has_face(h / 3); }

    static Index next(Index h) { return h % 3 == 2 ? h - 2 : h + 1; }
    static Index previous(Index h) { return h % 3 == 0 ? h + 2 : h - 1; }
    Index tail(Index h) const { return corners_[h]; }
    Index head(Index h) const { return corners_[next(h)]; }
    Index apex(Index h) const { return corners_[previous(h)]; }
    Index opposite(Index h) const { return opposites_[h]; }
    std::array<Index, 3> face(Index f) const
    {
        return {corners_[3 * f], corners_[3 * f + 1], corners_[3 * f + 2]};
    }
    /// The first outgoing halfedge counter-clockwise (on a boundary the hole lies to its right).
    Index outgoing(Index v) const { return outgoing_[v]; }
    bool is_boundary(Index v) const { return opposites_[outgoing_[v]] == kNone; }
    /// Calls visit(h) for the outgoing halfedges of v, counter-clockwise.
    template <typename Visit>
    void for_outgoing(Index v, Visit visit) const
    {
        const Index first = outgoing_[v];
        Index h = first;
        do {
            visit(h);
            h = opposites_[previous(h)];
        } while (h != kNone && h != first);
    }
    /// Calls visit(w) for the neighbours of v.
    template <typename Visit>
    void for_neighbors(Index v, Visit visit) const
    {
        Index last = kNone;
        for_outgoing(v, [&](Index h) {
            visit(head(h));
            last = h;
        });
        if (opposites_[previous(last)] == kNone) {
            visit(apex(last));
        }
    }
    Index valence(Index v) const;

    /// A new vertex at `position` on the edge of h. Returns it; h then ends there.
    Index split_edge(Index h, const Vec3& position);
    /// A new vertex at `position` in face f.
    Index split_face(Index f, const Vec3& position);
    /// Whether the tail of h can become the head of h with the topology as it is (link condition),
    /// no vertex of fewer than three faces inside or one on the boundary, and boundary vertices
    /// going along the boundary only.
    bool can_collapse(Index h) const;
    /// Removes the tail of h, whose neighbours are then joined to the head; if can_collapse(h).
    void collapse(Index h);
    /// Whether the other diagonal of the two faces at h is no edge yet, and both ends keep at least
    /// three faces.
    bool can_flip(Index h) const;
    void flip(Index h);

    /// Renumbers what is left, in order; per old vertex its new id, kNone if removed.
    std::vector<Index> compact();
    PolygonMesh polygon_mesh() const;

    /// Per vertex. Freely changed from outside.
    std::vector<Vec3> positions;

private:
    void join(Index a, Index b);
    void anchor(Index v, Index h);
    bool adjacent(Index v, Index w) const;

    std::vector<Index> corners_;
    std::vector<Index> opposites_;
    std::vector<Index> outgoing_;
    Index live_vertices_ = 0;
};

}  // namespace layout_embedding::shapes
