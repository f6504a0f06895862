#pragma once

#include <vector>

#include "base/types.hh"

namespace layout_embedding {

/// The worst of a mesh's triangles.
struct TriangleQuality {
    /// The smallest angle, in degrees.
    double smallest_angle = 60;
    /// The smallest area, in square units of the mesh.
    double smallest_area = 0;
};

/// Of the triangles with the given corners, 3 vertex ids each. For reports: the last digits of the
/// angle may differ between platforms. O(#corners).
TriangleQuality triangle_quality(const std::vector<Vec3>& positions,
                                 const std::vector<Index>& corners);

}  // namespace layout_embedding
