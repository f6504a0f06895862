#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/types.hh"

namespace layout_embedding {

/// The most corners of a face that files may have.
inline constexpr std::int64_t kMaxFaceCorners = 255;

/// Faces as loops of vertex ids, exactly as a file gives them: nothing is checked, welded or
/// reordered. Layouts and targets both start as one of these.
struct PolygonMesh {
    /// #V positions, in the units of the file.
    std::vector<Vec3> positions;
    /// #F+1 offsets into `corners`; face f has corners[face_offsets[f]] ..
    /// corners[face_offsets[f+1]-1].
    std::vector<Index> face_offsets{0};
    /// Vertex ids, counter-clockwise around each face.
    std::vector<Index> corners;

    Index vertex_count() const { return static_cast<Index>(positions.size()); }
    Index face_count() const { return static_cast<Index>(face_offsets.size() - 1); }

    std::span<const Index> face(Index f) const
    {
        return {corners.data() + face_offsets[f], corners.data() + face_offsets[f + 1]};
    }

    /// Appends a face with the given corners.
    void add_face(std::span<const Index> face_corners)
    {
        corners.insert(corners.end(), face_corners.begin(), face_corners.end());
        face_offsets.push_back(static_cast<Index>(corners.size()));
    }
};

}  // namespace layout_embedding
