#pragma once

#include <vector>

#include "base/types.hh"
#include "layout/embedding_problem.hh"
#include "surface/strands.hh"

namespace layout_embedding {

/// The test by which [KSG03, KS04] keep insertions from blocking later ones, as the paper's Sec. 5
/// uses it: a path that closes a cycle has to have, on either side, the landmarks of exactly those
/// layout vertices that lie on this side in the layout.
///
/// A side of the path is what a flood fill of the cut surface (the states of Strands) reaches from
/// it without crossing a strand; a side of the layout edge what a flood fill over layout faces
/// reaches without crossing an embedded edge. Both count the vertices on their border. A boundary
/// loop of the layout counts as one more face; where its vertices lie on the target's boundary it
/// is cut in pieces there, as the target is.
class SideTest {
public:
    /// Keeps a reference; strands are inserted and removed again.
    SideTest(const EmbeddingProblem& problem, Strands& strands);

    /// Whether a walk of a layout edge, which traces, separates the landmarks as the layout does.
    /// O(#states).
    bool accepts(Index layout_edge, const std::vector<Index>& darts);

private:
    /// Per layout vertex.
    using VertexSet = std::vector<bool>;

    VertexSet layout_side(Index layout_halfedge) const;
    VertexSet target_side(Index start_node, Index dart, Index slot);
    void reach(Index tail, Index dart, Index slot, VertexSet& landmarks);

    Strands& strands_;
    /// Per layout halfedge: the next and the previous one along the face or boundary loop on its
    /// left, kNone where that loop is cut.
    std::vector<Index> next_;
    std::vector<Index> previous_;
    std::vector<Index> layout_vertices_;  // by landmark node, sorted
    std::vector<bool> seen_;              // per state
    std::vector<Index> stack_;
};

}  // namespace layout_embedding
