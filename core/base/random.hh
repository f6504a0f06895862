#pragma once

#include <cstdint>

namespace layout_embedding {

/// SplitMix64 (Steele, Lea, Flood 2014): a seeded generator whose numbers are the same on every
/// platform. Also a good mixing function for hashing 64-bit values.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    /// 64 uniformly distributed bits.
    std::uint64_t bits()
    {
        state_ += 0x9e3779b97f4a7c15ULL;
        return mix(state_);
    }

    /// A uniform integer in [0, bound), bound > 0, without modulo bias.
    std::uint64_t below(std::uint64_t bound)
    {
        const std::uint64_t limit = UINT64_MAX - UINT64_MAX % bound;
        std::uint64_t x = bits();
        while (x >= limit) {
            x = bits();
        }
        return x % bound;
    }

    /// A uniform double in [0, 1) with 53 random bits.
    double unit() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }

    static std::uint64_t mix(std::uint64_t x)
    {
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
        x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
        return x ^ (x >> 31);
    }

private:
    std::uint64_t state_;
};

}  // namespace layout_embedding
