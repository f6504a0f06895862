#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>

namespace layout_embedding {

/// All element ids (vertices, edges, faces, halfedges, nodes, darts) are 0-based 32-bit integers.
using Index = std::uint32_t;

/// No element; for example the opposite of a boundary halfedge.
inline constexpr Index kNone = std::numeric_limits<Index>::max();

/// A point or vector in space, in the units of the target.
using Vec3 = Eigen::Vector3d;

/// A length in the path-graph metric, an exact integer; PathGraph::unit() converts it to the
/// target's units.
using Length = std::uint64_t;

/// Longer than every path: no path exists.
inline constexpr Length kInfiniteLength = std::numeric_limits<Length>::max();

}  // namespace layout_embedding
