#pragma once

#include <cstdint>

#include "base/types.hh"
#include "surface/path_graph.hh"

namespace layout_embedding {

/// A metric of its own for one search: every node of the path graph has a weight in
/// [0, kFullWeight], and a dart is as long as its length times the mean weight of its ends.
using NodeWeight = std::uint32_t;
inline constexpr unsigned kWeightBits = 19;
inline constexpr NodeWeight kFullWeight = NodeWeight{1} << kWeightBits;

/// In integers: the low bits of the length, which are its perturbation, stay as they are, so that
/// the result is positive, as random as the length, and redrawn with it after a tie.
inline Length weighted_length(Length length, NodeWeight tail_weight, NodeWeight head_weight)
{
    constexpr unsigned kShift = kWeightBits + 1;
    constexpr Length kLow = (Length{1} << kShift) - 1;
    return (length >> kShift) * (tail_weight + head_weight) + (length & kLow) + 1;
}

}  // namespace layout_embedding
