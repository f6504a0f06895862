#include "search/pairwise_bound.hh"

#include <algorithm>

namespace layout_embedding {

PairwiseBound::PairwiseBound(PartialEmbedding& embedding, PathOracle& oracle,
                             DistanceFields& fields)
    : embedding_(embedding),
      oracle_(oracle),
      cuts_(embedding.strands()),
      second_(cuts_, embedding.strands(), fields)
{}

void PairwiseBound::begin(std::span<const Index> root_walks)
{
    root_walks_.assign(root_walks.begin(), root_walks.end());
    // Of a wrong triple no two are in conflict.
    for (const auto& [a, b] : embedding_.conflicts(root_walks).pairs) {
        pairs_.push_back({a, b});
        edges_.push_back(a);
        edges_.push_back(b);
    }
    std::sort(edges_.begin(), edges_.end());
    edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
    for (const Index walk : root_walks_) {
        seconds_.push_back(embedding_.pool().cost(walk));
    }
}

PairwiseBound::Outcome PairwiseBound::run(WorkBudget& budget)
{
    if (next_edge_ < edges_.size() && !embedding_.move_strands()) {
        return Outcome::tied;
    }
    for (; next_edge_ < edges_.size(); ++next_edge_) {
        const Outcome outcome = find_second(edges_[next_edge_], budget);
        if (outcome != Outcome::finished) {
            return outcome;
        }
    }
    for (; next_side_ < 2 * pairs_.size(); ++next_side_) {
        Pair& pair = pairs_[next_side_ / 2];
        const bool b_yields = next_side_ % 2 == 0;
        const Index stays = b_yields ? pair.a : pair.b;
        if (embedding_.walk(stays) == kNone) {
            embedding_.go_to({});
            if (embedding_.insert(root_walks_[stays]) == PartialEmbedding::Insertion::torn) {
                return Outcome::tied;
            }
        }
        Length& cost = b_yields ? pair.b_beside_a : pair.a_beside_b;
        if (embedding_.walk(stays) == kNone) {
            cost = kInfiniteLength;  // refused: the class is in no embedding
            continue;
        }
        const auto answer = oracle_.find(b_yields ? pair.b : pair.a, kInfiniteLength, budget);
        if (answer.outcome == PathOracle::Outcome::running) {
            return Outcome::running;
        }
        if (answer.outcome == PathOracle::Outcome::tied) {
            return Outcome::tied;
        }
        cost = answer.bound;
    }
    embedding_.go_to({});
    combine();
    return Outcome::finished;
}

PairwiseBound::Outcome PairwiseBound::find_second(Index edge, WorkBudget& budget)
{
    switch (second_.run(edge, budget)) {
        case SecondClass::Outcome::running:
            return Outcome::running;
        case SecondClass::Outcome::tied:
            return Outcome::tied;
        case SecondClass::Outcome::found:
        case SecondClass::Outcome::bounded:
            break;
    }
    const EdgeWeights& weights = embedding_.strands().weights();
    seconds_[edge] = std::max(seconds_[edge], weights.cost(edge, second_.length()));
    return Outcome::finished;
}

void PairwiseBound::combine()
{
    const WalkPool& pool = embedding_.pool();
    const auto sum = [](Length x, Length y) {
        return x == kInfiniteLength || y == kInfiniteLength ? kInfiniteLength : x + y;
    };
    for (Pair& pair : pairs_) {
        const Length a = pool.cost(root_walks_[pair.a]);
        const Length b = pool.cost(root_walks_[pair.b]);
        const Length second_a = seconds_[pair.a];
        const Length second_b = seconds_[pair.b];
        pair.together =
            std::min({sum(a, std::max(pair.b_beside_a, second_b)),
                      sum(b, std::max(pair.a_beside_b, second_a)), sum(second_a, second_b)});
    }
}

Length PairwiseBound::surplus(std::span<const Length> costs)
{
    additions_.clear();
    for (Index i = 0; i < pairs_.size(); ++i) {
        const Pair& pair = pairs_[i];
        const Length apart = costs[pair.a] + costs[pair.b];
        if (pair.together == kInfiniteLength) {
            return kInfiniteLength;
        }
        if (pair.together > apart) {
            additions_.push_back({pair.together - apart, i});
        }
    }
    // A matching, the heaviest first: at least half of the best there is.
    std::sort(additions_.begin(), additions_.end());
    is_matched_.assign(costs.size(), 0);
    Length sum = 0;
    for (const Addition& addition : additions_) {
        const Pair& pair = pairs_[addition.pair];
        if (is_matched_[pair.a] == 0 && is_matched_[pair.b] == 0) {
            is_matched_[pair.a] = 1;
            is_matched_[pair.b] = 1;
            sum += addition.surplus;
        }
    }
    return sum;
}

}  // namespace layout_embedding
