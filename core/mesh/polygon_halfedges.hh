#pragma once

#include <array>
#include <vector>

#include "base/types.hh"
#include "mesh/polygon_mesh.hh"

namespace layout_embedding {

/// The halfedges of a polygon mesh of any quality, paired where that can be done: halfedge h runs
/// from corner h of `mesh.corners` to the next corner of the same face.
///
/// Refers to `mesh`, which must outlive it and stay as it is. The corners must be vertices of the
/// mesh; nothing else is assumed. O(#H log #H), whatever the degrees.
class PolygonHalfedges {
public:
    explicit PolygonHalfedges(const PolygonMesh& mesh);

    Index count() const { return static_cast<Index>(faces_.size()); }
    Index face(Index h) const { return faces_[h]; }
    Index next(Index h) const { return h + 1 == ends_[faces_[h] + 1] ? ends_[faces_[h]] : h + 1; }
    Index previous(Index h) const
    {
        return h == ends_[faces_[h]] ? ends_[faces_[h] + 1] - 1 : h - 1;
    }
    Index tail(Index h) const { return corners_[h]; }
    Index head(Index h) const { return corners_[next(h)]; }
    /// The halfedge in the opposite direction where an edge has exactly these two; kNone on a
    /// boundary and where the edge is not that of a consistently oriented manifold.
    Index opposite(Index h) const { return opposites_[h]; }

    /// Halfedges h and g of the first edge (that of smallest h) with more than two faces, kNone if
    /// there is none.
    std::array<Index, 2> non_manifold() const { return non_manifold_; }
    /// The first two halfedges of an edge that run in the same direction, kNone if there are none.
    std::array<Index, 2> inconsistent() const { return inconsistent_; }

    /// Number of halfedges without an opposite.
    Index unpaired_count() const;
    /// Numbers the components of faces that paired halfedges join, in the order of their first
    /// faces: per face its component. O(#H).
    std::vector<Index> components() const;

private:
    const std::vector<Index>& ends_;
    const std::vector<Index>& corners_;
    std::vector<Index> faces_;
    std::vector<Index> opposites_;
    std::array<Index, 2> non_manifold_{kNone, kNone};
    std::array<Index, 2> inconsistent_{kNone, kNone};
};

}  // namespace layout_embedding
