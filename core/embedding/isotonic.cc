#include "embedding/isotonic.hh"

#include <algorithm>

namespace layout_embedding {

void IsotonicRegression::fit(std::vector<double>& values, const std::vector<double>& weights,
                             double low, double high)
{
    pools_.clear();
    for (std::size_t i = 0; i < values.size(); ++i) {
        Pool pool{values[i], weights[i], 1};
        while (!pools_.empty() && pools_.back().mean >= pool.mean) {
            const Pool& before = pools_.back();
            const double weight = before.weight + pool.weight;
            pool.mean = (before.weight * before.mean + pool.weight * pool.mean) / weight;
            pool.weight = weight;
            pool.count += before.count;
            pools_.pop_back();
        }
        pools_.push_back(pool);
    }
    // The bounded optimum is the unbounded one, cut off.
    auto place = values.begin();
    for (const Pool& pool : pools_) {
        place = std::fill_n(place, pool.count, std::clamp(pool.mean, low, high));
    }
}

}  // namespace layout_embedding
