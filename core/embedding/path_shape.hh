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
    /// Shortened, then traced anew as straight lines in parametrisations of the patches beside them
    /// where that makes thin patches rounder (patches/fairing.hh).
    fair,
};

}  // namespace layout_embedding
