#pragma once

#include <vector>

#include "embedding/crossing_room.hh"
#include "embedding/funnel.hh"
#include "embedding/normal_form.hh"

namespace layout_embedding {

/// Pulls single strands of a normal form tight.
class StrandTightening {
public:
    /// Moves the crossings of a strand to where it is shortest while all other strands stay where
    /// they are and its own vertices are kept: the exact shortest path through the sleeve of faces
    /// between two vertices, unfolded into a plane, with the part of each edge as a portal that
    /// room_of() allows. `gaps` are prepared. O(elements of the strand).
    void tighten(NormalForm& form, Index strand, const CrossingGaps& gaps);

private:
    /// The edge of a portal, unfolded, from right to left as the strand sees it: from the tail to
    /// the head of the crossing's halfedge.
    struct UnfoldedEdge {
        Vec2 tail;
        Vec2 head;
        Index crossing;
        double low;   // as parameters from the tail
        double high;  // to the head
    };
    /// Unfolds the sleeve from a vertex element to the next one.
    void unfold(const NormalForm& form, Index from, Index to, const CrossingGaps& gaps);
    /// Moves the crossings between `bends` to the straight lines that join them.
    void place(NormalForm& form, std::span<const Bend> bends);

    Funnel funnel_;
    std::vector<UnfoldedEdge> edges_;
    std::vector<Portal> portals_;
    Vec2 end_;
};

}  // namespace layout_embedding
