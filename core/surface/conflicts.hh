#pragma once

#include <array>
#include <utility>
#include <vector>

#include "base/types.hh"
#include "surface/strands.hh"

namespace layout_embedding {

/// A candidate path of a layout edge that is not embedded: a walk that traces (paper, Sec. 4.3).
struct CandidateWalk {
    Index layout_edge;
    std::vector<Index> darts;
};

/// What keeps candidate paths from being embedded together (paper, Sec. 4.4.2 and Fig. 9).
/// Candidates without a conflict can be inserted in any order, all along the same walks.
struct Conflicts {
    /// Places (i, j), i < j, of candidates that truly cross (a shared stretch entered and left on
    /// opposite sides) or leave a common sector in the wrong order. Touching is no conflict.
    /// Sorted.
    std::vector<std::pair<Index, Index>> pairs;
    /// Places of three candidates around a landmark where nothing is embedded yet, in the wrong
    /// cyclic order; no two of them conflict there. Sorted.
    std::vector<std::array<Index, 3>> triples;
};

/// All conflicts between `candidates`, whose walks trace in `strands` and belong to different
/// edges. O(total length * log + pairs that share states + candidates per landmark cubed).
Conflicts find_conflicts(const Strands& strands, const std::vector<CandidateWalk>& candidates);

}  // namespace layout_embedding
