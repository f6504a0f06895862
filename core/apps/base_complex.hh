#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "base/result.hh"
#include "base/types.hh"
#include "layout/layout.hh"

namespace layout_embedding {

/// The quads that a layout is divided into for quad meshing: its faces, where all of them have four
/// sides; else all faces after one midpoint subdivision, one quad per corner of a face.
///
/// Edges of the base complex: layout edges (edge e is that of the layout, from tail to head); with
/// a midpoint subdivision, edge h is the half of a layout edge from the tail of halfedge h to its
/// middle, and edge 2E + s runs from the middle of the s-th side of a face (faces in order, each in
/// the order of its halfedges) to the face's centre.
class BaseComplex {
public:
    explicit BaseComplex(const Layout& layout);

    bool is_subdivided() const { return is_subdivided_; }
    Index edge_count() const { return edge_count_; }

    /// A side of a quad: an edge, run through backwards or not.
    struct Side {
        Index edge;
        bool backwards;
    };
    struct Quad {
        /// The layout face it is or belongs to.
        Index face;
        /// Its corner of that face, 0 without a subdivision.
        Index corner;
        /// Counter-clockwise from that corner.
        std::array<Side, 4> sides;
    };
    const std::vector<Quad>& quads() const { return quads_; }

    /// Per edge its dual loop: edges on opposite sides of quads have as many segments. Loops are
    /// numbered by their first edge.
    const std::vector<Index>& loops() const { return loops_; }
    Index loop_count() const { return loop_count_; }
    /// The edges that a layout edge is divided into, from its tail; both with the same number
    /// without a subdivision.
    std::array<Index, 2> edges_of(Index layout_edge) const
    {
        return is_subdivided_ ? std::array<Index, 2>{2 * layout_edge, 2 * layout_edge + 1}
                              : std::array<Index, 2>{layout_edge, layout_edge};
    }

private:
    void add_quads(const Layout& layout);
    void find_loops();

    bool is_subdivided_;
    Index edge_count_ = 0;
    std::vector<Quad> quads_;
    std::vector<Index> loops_;
    Index loop_count_ = 0;
};

/// The number of segments of every edge of `base`, the same along each dual loop: the mean length
/// of the loop's layout edges over `edge_length`, rounded, at least 1. `lengths` are those of the
/// layout's edges. `prescribed` are pairs of a layout edge and its number of segments, which
/// overrule that along the edge's loops. Errors: invalidOption (an edge length that is not
/// positive, an edge that does not exist, a number of segments that is 0, beyond 4096 or, with a
/// midpoint subdivision, odd, and two numbers for one loop).
Result<std::vector<Index>> choose_segments(const BaseComplex& base, const Layout& layout,
                                           std::span<const double> lengths, double edge_length,
                                           std::span<const std::pair<Index, Index>> prescribed);

/// An edge length for which choose_segments() comes nearest to so many quads, in proportion; one
/// that gives every edge one segment where that is too many already. O(#loops + #quads).
double edge_length_for(const BaseComplex& base, const Layout& layout,
                       std::span<const double> lengths, double quads);

}  // namespace layout_embedding
