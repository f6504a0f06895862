#pragma once

#include <vector>

#include "base/types.hh"
#include "search/partial_embedding.hh"
#include "surface/weak_embedding.hh"

namespace layout_embedding {

/// The best complete embedding that a search has found so far.
class Incumbent {
public:
    enum class Outcome { rejected, accepted, tied };

    bool exists() const { return cost_ != kInfiniteLength; }
    /// kInfiniteLength without one.
    Length cost() const { return cost_; }
    /// Walks in an order in which they can be inserted.
    const std::vector<Index>& walks() const { return walks_; }
    const WeakEmbedding& weak_embedding() const { return weak_; }

    /// Takes the present state of `embedding`, which is complete, if it is better. `tied`: its
    /// strands cannot be built (see PartialEmbedding::move_strands).
    Outcome offer(PartialEmbedding& embedding)
    {
        if (embedding.cost() >= cost_) {
            return Outcome::rejected;
        }
        if (!embedding.move_strands()) {
            return Outcome::tied;
        }
        cost_ = embedding.cost();
        walks_ = embedding.sequence();
        weak_ = embedding.strands().weak_embedding();
        return Outcome::accepted;
    }

private:
    std::vector<Index> walks_;
    Length cost_ = kInfiniteLength;
    WeakEmbedding weak_;
};

}  // namespace layout_embedding
