#pragma once

#include <vector>

#include "base/types.hh"
#include "search/excluded_embeddings.hh"
#include "search/partial_embedding.hh"
#include "surface/weak_embedding.hh"

namespace layout_embedding {

/// The best complete embedding that a search has found so far.
class Incumbent {
public:
    enum class Outcome {
        /// Not better.
        rejected,
        /// Better, but not to be found.
        excluded,
        accepted,
        tied,
    };

    Incumbent() = default;
    /// Never becomes one of these. Keeps a reference.
    explicit Incumbent(ExcludedEmbeddings& excluded) : excluded_(&excluded) {}

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
        if (excluded_ != nullptr && excluded_->contain(embedding.sequence())) {
            return Outcome::excluded;
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
    ExcludedEmbeddings* excluded_ = nullptr;
    std::vector<Index> walks_;
    Length cost_ = kInfiniteLength;
    WeakEmbedding weak_;
};

}  // namespace layout_embedding
