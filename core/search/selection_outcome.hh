#pragma once

namespace layout_embedding {

/// What comes of looking for the cheapest choice of one class per layout edge.
enum class SelectionOutcome {
    running,
    /// The lower bound has risen.
    raised,
    /// There is a choice, not known to be the cheapest.
    satisfied,
    /// There is a choice that costs as much as the lower bound: none is cheaper.
    optimal,
    /// Every choice costs at least the upper bound.
    exceeded,
    /// What is known is nearly used up: to know more classes of some edges would raise the bound.
    wants_classes,
};

}  // namespace layout_embedding
