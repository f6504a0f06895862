#include "search/path_oracle.hh"

#include <algorithm>
#include <cassert>

namespace layout_embedding {

PathOracle::PathOracle(PartialEmbedding& embedding, CutSurfaceSearch& search, bool remember)
    : embedding_(embedding),
      search_(search),
      remembers_(remember),
      by_bound_(embedding.layout().edge_count())
{}

bool PathOracle::applies(const Explanation& explanation) const
{
    return std::all_of(explanation.blockers.begin(), explanation.blockers.end(), [&](Index walk) {
        return embedding_.walk(embedding_.pool().layout_edge(walk)) == walk;
    });
}

PathOracle::Answer PathOracle::recall(Index layout_edge, Length limit) const
{
    Answer best;
    for (const Index i : by_bound_[layout_edge]) {
        const Explanation& explanation = explanations_[i];
        if (applies(explanation)) {
            best.bound = explanation.bound;
            best.walk = explanation.walk;
            break;
        }
    }
    if (best.bound == kInfiniteLength) {
        best.outcome = Outcome::blocked;
    } else if (best.bound >= limit) {
        best.outcome = Outcome::exceeded;
    } else if (best.walk != kNone && embedding_.fits(best.walk)) {
        best.outcome = Outcome::found;
    }
    return best;
}

Length PathOracle::known_bound(Index layout_edge) const
{
    for (const Index i : by_bound_[layout_edge]) {
        if (applies(explanations_[i])) {
            return explanations_[i].bound;
        }
    }
    return 0;
}

void PathOracle::learn_unconstrained(Index walk)
{
    const WalkPool& pool = embedding_.pool();
    remember({pool.layout_edge(walk), pool.cost(walk), walk, {}});
}

void PathOracle::remember(Explanation explanation)
{
    auto& by_bound = by_bound_[explanation.layout_edge];
    const auto comes_before = [&](const Explanation& a, Index other) {
        const Explanation& b = explanations_[other];
        return a.bound != b.bound ? a.bound > b.bound : a.walk < b.walk;
    };
    const auto place =
        std::upper_bound(by_bound.begin(), by_bound.end(), explanation, comes_before);
    by_bound.insert(place, static_cast<Index>(explanations_.size()));
    explanations_.push_back(std::move(explanation));
}

PathOracle::Answer PathOracle::find(Index layout_edge, Length limit, WorkBudget& budget)
{
    if (searching_ == kNone) {
        if (remembers_) {
            const Answer answer = recall(layout_edge, limit);
            if (answer.outcome != Outcome::running) {
                ++remembered_count_;
                return answer;
            }
        }
        if (!embedding_.move_strands()) {
            return {Outcome::tied, kNone, 0};
        }
        searching_ = layout_edge;
        search_.begin(layout_edge, limit);
    }
    assert(searching_ == layout_edge);
    const std::uint64_t before = search_.expansion_count();
    const auto outcome = search_.run(budget.left());
    budget.charge(search_.expansion_count() - before);
    Answer answer;
    answer.bound = search_.lower_bound();
    switch (outcome) {
        case CutSurfaceSearch::Outcome::running:
            return answer;
        case CutSurfaceSearch::Outcome::tied:
            answer.outcome = Outcome::tied;
            break;
        case CutSurfaceSearch::Outcome::blocked:
            answer.outcome = Outcome::blocked;
            break;
        case CutSurfaceSearch::Outcome::exceeded:
            answer.outcome = Outcome::exceeded;
            break;
        case CutSurfaceSearch::Outcome::found:
            answer.outcome = Outcome::found;
            answer.walk = embedding_.pool().add(layout_edge, search_.darts());
            break;
    }
    searching_ = kNone;
    if (remembers_ && answer.outcome != Outcome::tied) {
        std::vector<Index> blockers = search_.blockers();
        for (Index& blocker : blockers) {
            blocker = embedding_.walk(blocker);
        }
        remember({layout_edge, answer.bound, answer.walk, std::move(blockers)});
    }
    return answer;
}

}  // namespace layout_embedding
