#pragma once

#include <vector>

namespace layout_embedding {

/// Weighted isotonic regression with bounds: replaces `values` by the non-decreasing sequence in
/// [low, high] with the least weighted sum of squared differences (pool adjacent violators; Best
/// and Chakravarti 1990). `weights` are positive. Reuse one object to save allocations.
class IsotonicRegression {
public:
    /// O(#values).
    void fit(std::vector<double>& values, const std::vector<double>& weights, double low,
             double high);

private:
    struct Pool {
        double mean;
        double weight;
        std::size_t count;
    };
    std::vector<Pool> pools_;
};

}  // namespace layout_embedding
