#pragma once

#include <vector>

#include "base/types.hh"
#include "surface/strands.hh"

namespace layout_embedding {

/// Keeps the holes of the target in the layout's outer faces.
///
/// On a target with boundary the cyclic orders alone do not force a hole into the layout face that
/// stands for it. The faces of the embedded part of the layout are unions of layout faces (and of
/// its boundary loops), merged across the edges that are not embedded yet; each of these unions has
/// to hold as many holes as boundary loops. Only unions that can be told from the holes' sides are
/// compared, that is once the embedded edges are connected.
class HoleGuard {
public:
    /// Keeps a reference.
    explicit HoleGuard(const Strands& strands);

    /// Whether the present strands leave every hole where the layout wants one. O(#states) at worst
    /// per hole that holds no landmark; nothing to do on closed targets.
    bool accepts() const { return edges_around_misplaced_hole().empty(); }
    /// Embedded edges around a face, or faces not yet parted, that holds more holes than it should;
    /// none where accepts(). In a complete embedding, their homotopy classes alone put the holes
    /// there (proof.md, Sec. 8). Ascending.
    std::vector<Index> edges_around_misplaced_hole() const;

private:
    /// A layout halfedge whose left side borders the component of the cut surface with the hole at
    /// `boundary_node`; kNone if no strand borders it.
    Index bordering_halfedge(Index boundary_node) const;

    const Strands& strands_;
    struct Hole {
        /// A node of the boundary loop that is no landmark.
        Index node;
        /// Where a landmark lies on the loop, the linear order there decides on the face: a number
        /// as in faces_. kNone otherwise.
        Index face;
    };
    /// One per boundary loop of the target.
    std::vector<Hole> holes_;
    /// Per layout halfedge: its face, or the face count plus its boundary loop.
    std::vector<Index> faces_;
    Index layout_loop_count_ = 0;
};

}  // namespace layout_embedding
