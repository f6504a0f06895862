#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/types.hh"

namespace layout_embedding {

inline constexpr double kMinEdgeWeight = 0.001;
inline constexpr double kMaxEdgeWeight = 1000;

/// How much the length of each layout edge's path counts: its cost is its length times an integer
/// weight, so that sums stay exact. All weights are 1 unless others are given.
///
/// A positive factor changes neither which walk of a class is the shortest nor which classes can be
/// embedded together: all that holds for lengths holds for costs.
class EdgeWeights {
public:
    EdgeWeights() = default;
    /// One number per layout edge from kMinEdgeWeight to kMaxEdgeWeight, rounded to 1024ths of the
    /// largest of them, at least one such part. None for 1 everywhere.
    explicit EdgeWeights(std::span<const double> weights);

    /// Whether all weights are 1.
    bool empty() const { return weights_.empty(); }
    Length of(Index layout_edge) const { return empty() ? 1 : weights_[layout_edge]; }
    /// The largest integer weight.
    Length largest() const { return empty() ? 1 : kParts; }
    /// What the integer weight 1 stands for among the numbers given.
    double unit() const { return unit_; }

    /// What a path of this length costs; kInfiniteLength stays.
    Length cost(Index layout_edge, Length length) const
    {
        return length == kInfiniteLength ? length : length * of(layout_edge);
    }
    /// Paths of this length or more cost `cost` or more, shorter ones less; kInfiniteLength stays.
    Length length(Index layout_edge, Length cost) const
    {
        const Length weight = of(layout_edge);
        return cost == kInfiniteLength ? cost : cost / weight + (cost % weight != 0 ? 1 : 0);
    }

private:
    static constexpr Length kParts = 1024;

    std::vector<std::uint32_t> weights_;
    double unit_ = 1;
};

}  // namespace layout_embedding
