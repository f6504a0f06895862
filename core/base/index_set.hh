#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "base/types.hh"

namespace layout_embedding {

/// A set of indices, kept as bits up to the largest.
class IndexSet {
public:
    bool contains(Index i) const
    {
        return i / 64 < words_.size() && ((words_[i / 64] >> (i % 64)) & 1U) != 0;
    }
    void insert(Index i)
    {
        const std::size_t word = i / 64;
        if (word >= words_.size()) {
            if (word >= words_.capacity()) {
                // Not twice as many: where there are many indices there are many sets.
                words_.reserve(word / kGrowth * kGrowth + kGrowth);
            }
            words_.resize(word + 1, 0);
        }
        words_[word] |= std::uint64_t{1} << (i % 64);
    }
    void erase(Index i)
    {
        if (i / 64 < words_.size()) {
            words_[i / 64] &= ~(std::uint64_t{1} << (i % 64));
        }
    }

    /// Calls `visit(i)` for the indices in ascending order until it returns false; whether it never
    /// did.
    template <typename Visit>
    bool all_of(Visit&& visit) const
    {
        for (std::size_t word = 0; word < words_.size(); ++word) {
            for (std::uint64_t left = words_[word]; left != 0; left &= left - 1) {
                if (!visit(static_cast<Index>(64 * word + std::countr_zero(left)))) {
                    return false;
                }
            }
        }
        return true;
    }
    /// all_of() for the indices that `left_out` does not hold at the time.
    template <typename Visit>
    bool all_of_but(const IndexSet& left_out, Visit&& visit) const
    {
        for (std::size_t word = 0; word < words_.size(); ++word) {
            const std::uint64_t kept =
                words_[word] & (word < left_out.words_.size() ? ~left_out.words_[word] : ~0ULL);
            for (std::uint64_t left = kept; left != 0; left &= left - 1) {
                if (!visit(static_cast<Index>(64 * word + std::countr_zero(left)))) {
                    return false;
                }
            }
        }
        return true;
    }
    /// Calls `visit(i)` for the indices that both sets hold, ascending.
    template <typename Visit>
    void for_each_common(const IndexSet& other, Visit&& visit) const
    {
        const std::size_t count = std::min(words_.size(), other.words_.size());
        for (std::size_t word = 0; word < count; ++word) {
            for (std::uint64_t left = words_[word] & other.words_[word]; left != 0;
                 left &= left - 1) {
                visit(static_cast<Index>(64 * word + std::countr_zero(left)));
            }
        }
    }
    /// About how long it takes to go through the set, in words.
    std::size_t word_count() const { return words_.size(); }

private:
    static constexpr std::size_t kGrowth = 16;

    std::vector<std::uint64_t> words_;
};

}  // namespace layout_embedding
