#pragma once

#include <span>
#include <vector>

#include "embedding/funnel.hh"
#include "embedding/normal_form.hh"

namespace layout_embedding {

/// Moves of single strands over free vertices: inner vertices of the mesh that are no landmarks.
/// With these and with StrandTightening, a strand reaches every place in its homotopy class. A move
/// is made only if it makes the strand shorter by more than a share kLeastGain of the elements
/// around, so no sequence of moves comes back to where it was.
///
/// Segments along target edges that cost less than 1 are that much shorter for it: strands that run
/// along such edges leave them only where the way beside them costs less.
class VertexMoves {
public:
    static constexpr double kLeastGain = 1e-10;

    /// Keeps references. `edge_costs`: what a unit of length along each target edge costs, at most
    /// 1; empty for 1. O(#F + elements).
    VertexMoves(NormalForm& form, const std::vector<Index>& landmarks,
                std::span<const double> edge_costs = {});

    /// Whether a strand may be put on the vertex.
    bool is_free(Index vertex) const { return carried_[vertex] == kNone; }
    /// The element on a vertex that carries a strand and is no landmark, else kNone.
    Index carried(Index vertex) const
    {
        return carried_[vertex] < kNone - 1 ? carried_[vertex] : kNone;
    }

    /// If the crossing is the first of a run around a free vertex, with nothing between it and the
    /// vertex, and the way over the vertex is shorter than the run: puts the strand on the vertex.
    /// Returns the vertex element, or kNone. O(length of the run).
    Index snap(Index crossing);

    /// If nothing lies between the crossing and a free vertex: puts the strand on the vertex, even
    /// if it gets longer. Returns the vertex element, or kNone. O(length of the run).
    Index snap_to(Index crossing, Index vertex);

    /// Moves the strand at a vertex element off the vertex to its left or right, even if it gets
    /// longer, half of the way to what is there; false if there is no edge to cross, or if it runs
    /// along one that costs less. O(vertex degree).
    bool push_off(Index element, bool left);

    /// If the strand at a vertex element makes an angle below pi on one of its sides there, moves
    /// it off the vertex to this side, to the straight line between the elements before and after
    /// or as near to it as neighbouring crossings allow, but only if it keeps the gaps of `spacing`
    /// from the vertex there. Returns the last element of the strand before the place of the move,
    /// or kNone if nothing was done. O(vertex degree).
    Index pop(Index element, double spacing);

    /// The vertex as seen from a crossing towards the tail (or head) of its edge, if there is no
    /// crossing in between; else kNone.
    Index vertex_beside(Index crossing, bool towards_tail) const;

private:
    bool is_beside(Index element, Index vertex) const;
    /// Of a crossing that is the first of a run around a free vertex.
    Index snap_run(Index crossing, Index vertex, bool only_if_shorter);
    /// Lists the outgoing halfedges counter-clockwise around the vertex strictly between the
    /// directions to `from` and `to`: the elements after and before it on its strand for the left
    /// side, the other way round for the right side.
    void gather_fan(Index vertex, Index from, Index to, bool left);
    /// Unfolds `from`, the fan and `to` with the vertex as origin; false if the angle is not below
    /// pi.
    bool unfold_fan(Index vertex, Index from, Index to);
    bool pop_to_side(Index element, bool left, double spacing);
    /// Puts crossings on the edges of the fan, distances_ from the vertex.
    void leave_vertex(Index element, bool left);
    /// What a unit of length costs between two neighbours on a strand: less than 1 along some
    /// edges.
    double cost_between(Index a, Index b) const;
    /// The part of an edge at the vertex up to its nearest crossing.
    double reach_from(Index vertex, Index edge) const;
    Index outgoing_in_face(Index vertex, Index face) const;
    Index halfedge_between(Index tail, Index head) const;

    NormalForm& form_;
    std::span<const double> edge_costs_;
    /// Per vertex: the element on it; kNone - 1 if it must not carry a strand.
    std::vector<Index> carried_;

    // Scratch.
    std::vector<Index> fan_;  // outgoing halfedges
    std::vector<Vec2> rays_;  // the direction of each, unit vectors
    Vec2 from_;
    Vec2 to_;
    std::vector<double> distances_;  // per edge of the fan, from the vertex
    std::vector<double> least_;
    std::vector<Index> halfedges_;
};

}  // namespace layout_embedding
