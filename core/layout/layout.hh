#pragma once

#include <span>
#include <utility>
#include <vector>

#include "base/result.hh"
#include "base/types.hh"
#include "mesh/polygon_mesh.hh"

namespace layout_embedding {

/// A layout: a cell complex without geometry on an oriented surface (paper, Sec. 3), connected,
/// without loops and parallel edges.
///
/// Edge e has the halfedges 2e and 2e+1 in opposite directions. Every halfedge has a face on its
/// left, or kNone where the layout has a boundary. The cyclic order sigma_v of the paper is
/// outgoing(v): counter-clockwise as seen with the faces counter-clockwise; at a boundary vertex it
/// starts right after the boundary gap, so that it is a linear order there.
class Layout {
public:
    /// Reads `mesh` for its connectivity alone. `subject` names the layout in messages, for example
    /// "the layout cube.obj". Errors: those of check_surface() (mesh/validation.hh), layoutLoop.
    static Result<Layout> from_polygons(const PolygonMesh& mesh, std::string_view subject);

    Index vertex_count() const { return static_cast<Index>(outgoing_offsets_.size() - 1); }
    Index edge_count() const { return static_cast<Index>(tails_.size() / 2); }
    Index face_count() const { return static_cast<Index>(face_offsets_.size() - 1); }
    /// V - E + F.
    long euler_characteristic() const
    {
        return static_cast<long>(vertex_count()) - edge_count() + face_count();
    }

    static Index twin(Index h) { return h ^ 1U; }
    static Index edge(Index h) { return h / 2; }
    /// Edges are directed from tail(2e) to head(2e).
    Index tail(Index h) const { return tails_[h]; }
    Index head(Index h) const { return tails_[twin(h)]; }
    /// The face left of h, kNone at the boundary.
    Index face(Index h) const { return faces_[h]; }

    /// Halfedges that start at vertex v, counter-clockwise.
    std::span<const Index> outgoing(Index v) const
    {
        return {outgoing_.data() + outgoing_offsets_[v],
                outgoing_.data() + outgoing_offsets_[v + 1]};
    }
    /// The place of h in outgoing(tail(h)).
    Index rank(Index h) const { return ranks_[h]; }
    /// The halfedges of face f in counter-clockwise order, the face on their left.
    std::span<const Index> face_halfedges(Index f) const
    {
        return {face_halfedges_.data() + face_offsets_[f],
                face_halfedges_.data() + face_offsets_[f + 1]};
    }
    bool is_boundary_vertex(Index v) const;
    /// The boundary loops: cycles of halfedges without a face, each halfedge followed by the next
    /// one along the boundary (the hole on their left).
    std::vector<std::vector<Index>> boundary_loops() const;

private:
    std::vector<Index> tails_;             // per halfedge
    std::vector<Index> faces_;             // per halfedge
    std::vector<Index> outgoing_offsets_;  // #V+1
    std::vector<Index> outgoing_;
    std::vector<Index> ranks_;         // per halfedge
    std::vector<Index> face_offsets_;  // #F+1
    std::vector<Index> face_halfedges_;
};

}  // namespace layout_embedding
