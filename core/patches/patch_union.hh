#pragma once

#include "patches/patch.hh"

namespace layout_embedding {

/// Two patches on both sides of a chain as one, a disk without that chain; all others it has in
/// common stay cut open. `left` has the chain as its side `left_side`, and lies to its left;
/// `right` has it backwards as its side `right_side`. The sides of the union are those of `left`
/// that follow the chain, then those of `right`: it begins where the chain ends, and where `right`
/// begins, at side left.side_count() - 1, the chain begins. Triangles are those of `left`, then
/// those of `right`; its face is kNone. O(#triangles).
Patch united(const Patch& left, Index left_side, const Patch& right, Index right_side);

}  // namespace layout_embedding
