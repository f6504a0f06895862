#pragma once

#include <vector>

#include "embedding/checker_surface.hh"

namespace layout_embedding::checker {

/// Confirms that there are as many landmarks as layout vertices, different and inside the target
/// where their layout vertex is no boundary vertex, and that the target has the layout's genus and
/// no hole or as many as the layout has boundary loops. True if the landmarks can be used.
bool check_landmarks(const Surface& layout, const Surface& target,
                     const std::vector<Index>& landmarks, Violations& violations);

/// Confirms that the chains embed the layout edges as disjoint paths in the refined mesh `surface`.
/// If so, fills for each of its halfedges the layout halfedge whose path runs along it, kNone
/// elsewhere.
bool check_chains(const Surface& layout, const std::vector<Index>& landmarks,
                  const std::vector<std::array<Index, 2>>& layout_edges, const RefinedMesh& refined,
                  const Surface& surface, Violations& violations,
                  std::vector<Index>& chain_halfedges);

/// Confirms that the chains at each landmark follow the layout's order.
void check_orders(const Surface& layout, const std::vector<Index>& landmarks,
                  const Surface& surface, const std::vector<Index>& chain_halfedges,
                  Violations& violations);

/// Confirms that the chains cut the refined mesh into the layout's faces and outside patches.
void check_patches(const Surface& layout, const std::vector<Index>& landmarks,
                   const RefinedMesh& refined, const Surface& surface,
                   const std::vector<Index>& chain_halfedges, Violations& violations);

}  // namespace layout_embedding::checker
