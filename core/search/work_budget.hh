#pragma once

#include <algorithm>
#include <cstdint>

namespace layout_embedding {

/// Work that a slice of a search may still do, counted in units that are the same on every machine:
/// expanded states of the cut surface, and what other operations charge on the scale of these.
///
/// An operation that cannot be interrupted begins when is_spent() is false and charges what it
/// likes, so that every search makes progress under every budget and stops at the same places
/// however it is sliced.
class WorkBudget {
public:
    explicit WorkBudget(std::uint64_t units = UINT64_MAX) : left_(units) {}

    bool is_spent() const { return left_ == 0; }
    std::uint64_t left() const { return left_; }
    /// All that was charged, perhaps more than there was.
    std::uint64_t spent() const { return spent_; }
    void charge(std::uint64_t units)
    {
        left_ -= std::min(left_, units);
        spent_ += units;
    }

private:
    std::uint64_t left_;
    std::uint64_t spent_ = 0;
};

}  // namespace layout_embedding
