#pragma once

#include <cstdint>

namespace layout_embedding {

/// How paths run within their homotopy classes (design, Sec. 4). The numbers stay as they are;
/// interfaces count on them.
enum class PathShape : std::uint32_t {
    /// Crossings spread evenly along each edge: jagged, with the most even triangles.
    even,
    /// As short as the gaps between neighbours allow.
    shortened,
    /// Shortened, then re-traced in harmonic parametrisations of the patches beside them.
    fair,
};

}  // namespace layout_embedding
