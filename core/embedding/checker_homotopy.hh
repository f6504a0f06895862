#pragma once

#include <vector>

#include "embedding/checker_subdivision.hh"

namespace layout_embedding::checker {

/// Confirms that each chain of a sound subdivision `surface` is homotopic to its weak path among
/// arcs on the target punctured at its holes and landmarks, which may turn about their own end
/// points (not at landmarks on a boundary).
void check_homotopy(const CheckInput& input, const Surface& target, const Surface& surface,
                    const std::vector<Carrier>& carriers, Violations& violations);

}  // namespace layout_embedding::checker
