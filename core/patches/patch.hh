#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/result.hh"
#include "base/types.hh"
#include "embedding/refined_mesh.hh"
#include "layout/layout.hh"

namespace layout_embedding {

/// The part of a refined mesh that belongs to one layout face, as a disk of its own: where the face
/// runs along both sides of a layout edge, the mesh is cut open there and the vertices of the chain
/// appear twice.
struct Patch {
    /// The layout face.
    Index face = kNone;
    /// Per vertex of the patch: its refined vertex. The boundary comes first, counter-clockwise,
    /// from the landmark of the tail of the face's first halfedge.
    std::vector<Index> vertices;
    /// Per side, in the order of Layout::face_halfedges(): the patch vertex where it begins; then
    /// the number of boundary vertices. Side i has the vertices sides[i] .. sides[i+1], the last
    /// one ends at vertex 0.
    std::vector<Index> sides;
    /// Per triangle: its refined triangle, increasing.
    std::vector<Index> triangles;
    /// Per triangle: three patch vertices, in the order of the refined triangle's corners.
    std::vector<std::array<Index, 3>> corners;

    Index side_count() const { return static_cast<Index>(sides.size() - 1); }
    Index boundary_size() const { return sides.back(); }
};

/// All patches of an embedding that check_embedding() accepts, by layout face. Errors:
/// realisationFailed where the chains do not bound the faces' triangles, which such an embedding
/// never has. O(#triangles log #triangles).
Result<std::vector<Patch>> patches_of(const Layout& layout, const RefinedMesh& refined);

}  // namespace layout_embedding
