#include "layout/edge_weights.hh"

#include <algorithm>
#include <cmath>

namespace layout_embedding {

EdgeWeights::EdgeWeights(std::span<const double> weights)
{
    if (weights.empty()) {
        return;
    }
    unit_ = *std::max_element(weights.begin(), weights.end()) / static_cast<double>(kParts);
    for (const double weight : weights) {
        weights_.push_back(static_cast<std::uint32_t>(std::max(1.0, std::round(weight / unit_))));
    }
}

}  // namespace layout_embedding
