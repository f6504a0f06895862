#pragma once

#include <vector>

#include "base/types.hh"
#include "mesh/triangle_mesh.hh"

namespace layout_embedding {

/// The connectivity of a triangle mesh that loses vertices by halfedge collapses and changes edges
/// by flips, and stays an oriented manifold without parallel edges whatever is done. Positions are
/// not its business.
///
/// Numbering and conventions are those of TriangleMesh: halfedge 3f+i runs from corner i of face f,
/// boundary edges have one halfedge, the outgoing halfedge of a boundary vertex is the first one
/// counter-clockwise. Ids stay what they are; removed elements leave gaps. Nothing is checked
/// unless it says so: ask can_collapse() and can_flip() first.
class EditableMesh {
public:
    explicit EditableMesh(const TriangleMesh& mesh);

    /// Vertex v stands for a hole, its faces are a cone over the hole's boundary loop: from now on
    /// nothing makes a vertex lie on two holes, neither on two of these nor on one and the
    /// boundary.
    void add_hole(Index v) { holes_.push_back(v); }

    /// Of the vertices that are left.
    Index vertex_count() const { return vertex_count_; }
    /// One more than the largest vertex id, left or removed.
    Index vertex_capacity() const { return static_cast<Index>(outgoing_.size()); }
    Index face_capacity() const { return static_cast<Index>(corners_.size() / 3); }
    bool has_vertex(Index v) const { return outgoing_[v] != kNone; }
    bool has_face(Index f) const { return corners_[3 * f] != kNone; }
    /// Number of edges at v.
    Index degree(Index v) const { return degrees_[v]; }

    static Index next(Index h) { return TriangleMesh::next(h); }
    static Index previous(Index h) { return TriangleMesh::previous(h); }
    Index tail(Index h) const { return corners_[h]; }
    Index head(Index h) const { return corners_[next(h)]; }
    Index opposite(Index h) const { return opposites_[h]; }
    Index outgoing(Index v) const { return outgoing_[v]; }
    bool is_boundary_vertex(Index v) const { return opposites_[outgoing_[v]] == kNone; }

    /// Calls `visit` with every outgoing halfedge of v, counter-clockwise from outgoing(v): one per
    /// face at v.
    template <typename Visit>
    void for_each_outgoing(Index v, Visit&& visit) const
    {
        const Index first = outgoing_[v];
        Index h = first;
        do {
            visit(h);
            h = opposites_[previous(h)];
        } while (h != kNone && h != first);
    }

    /// Calls `visit` with every neighbour of v, counter-clockwise; at a boundary vertex from one
    /// boundary neighbour to the other.
    template <typename Visit>
    void for_each_neighbour(Index v, Visit&& visit) const
    {
        const Index first = outgoing_[v];
        Index h = first;
        for (;;) {
            visit(head(h));
            const Index incoming = previous(h);
            h = opposites_[incoming];
            if (h == kNone) {
                visit(corners_[incoming]);
                return;
            }
            if (h == first) {
                return;
            }
        }
    }

    /// The halfedge from v to w; kNone where there is none. O(degree of v).
    Index find_halfedge(Index v, Index w) const;
    /// Whether an edge joins v and w. O(the smaller degree).
    bool adjacent(Index v, Index w) const;
    /// Whether an edge between v and w would be the only one, and would lead to no second hole.
    bool can_join(Index v, Index w) const;

    /// Whether moving v into its neighbour w keeps the surface what it is (the link condition,
    /// Dey et al. 1999): v and w have no common neighbours but the third corners of the one or two
    /// faces between them; a boundary vertex moves along the boundary only, and a loop keeps three
    /// vertices. A tetrahedron stays one.
    bool can_collapse(Index v, Index w) const;
    /// Moves v into w: v, their edge and its faces go, the other edges of v become edges of w.
    void collapse(Index v, Index w);

    /// Whether the inner edge of halfedge h can be replaced by the other diagonal of its two faces
    /// without making a parallel edge.
    bool can_flip(Index h) const;
    /// The new edge is that of previous(h); flipping that one brings the old edge back.
    void flip(Index h);

private:
    void glue(Index a, Index b);
    bool can_touch(Index v, Index hole) const;
    bool keeps_holes_apart(Index v, Index w) const;
    Index common_neighbours(Index v, Index w) const;

    Index vertex_count_;
    std::vector<Index> corners_;    // 3 #F, kNone where removed
    std::vector<Index> opposites_;  // per halfedge
    std::vector<Index> outgoing_;   // per vertex, kNone where removed
    std::vector<Index> degrees_;    // per vertex
    std::vector<Index> holes_;      // vertices that stand for one
    // common_neighbours() marks vertices with a number that it raises each time.
    mutable std::vector<Index> marks_;
    mutable Index mark_ = 0;
};

}  // namespace layout_embedding
