#pragma once

#include "embedding/checker.hh"
#include "maps/placed_target.hh"

namespace layout_embedding {

/// Confirms that two targets which are placed on the same domains have a one-to-one map between
/// their patches. Independent by intent: exact arithmetic and connectivity are its own, and nothing
/// is taken from where the maps were made but plain arrays. Violations by code:
///
/// - Domains are the same on both sides and strictly convex (domainsDiffer, domainNotConvex).
/// - In both maps of every layout face: vertices and triangles are those of the patch's refined
///   triangles, each one covered once by its parts (mapIncomplete); every triangle is positively
///   oriented, exactly (triangleFlipped); the boundary follows the sides of the domain, exactly and
///   strictly forwards (boundaryOffSide); the areas of the triangles add up to that of the domain,
///   exactly (areaMismatch). With these a map is one-to-one onto its domain.
/// - Every vertex of a chain has the same share in both patches beside it (sidesDisagree), so the
///   maps of neighbouring patches fit together.
/// - Landmarks go to the corners of the domain in the order of the layout face (landmarkMisplaced).
CheckReport check_maps(const Layout& layout, const std::vector<Index>& landmarks_a,
                       const PlacedTarget& a, const std::vector<Index>& landmarks_b,
                       const PlacedTarget& b);

}  // namespace layout_embedding
