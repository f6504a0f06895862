#include "search/path_oracle.hh"

#include <algorithm>

namespace layout_embedding {

PathOracle::PathOracle(PartialEmbedding& embedding, CutSurfaceSearch& search, bool remember)
    : embedding_(embedding),
      search_(search),
      remembers_(remember),
      explanations_(embedding.layout().edge_count())
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
    for (const Explanation& explanation : explanations_[layout_edge]) {
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
    for (const Explanation& explanation : explanations_[layout_edge]) {
        if (applies(explanation)) {
            return explanation.bound;
        }
    }
    return 0;
}

void PathOracle::learn_unconstrained(Index walk)
{
    const WalkPool& pool = embedding_.pool();
    explanations_[pool.layout_edge(walk)].push_back({pool.cost(walk), walk, {}});
}

void PathOracle::remember(Index layout_edge, const Answer& answer)
{
    std::vector<Index> blockers = search_.blockers();
    for (Index& blocker : blockers) {
        blocker = embedding_.walk(blocker);
    }
    auto& explanations = explanations_[layout_edge];
    const auto comes_before = [](const Explanation& a, const Explanation& b) {
        return a.bound != b.bound ? a.bound > b.bound : a.walk < b.walk;
    };
    Explanation explanation{answer.bound, answer.walk, std::move(blockers)};
    explanations.insert(
        std::upper_bound(explanations.begin(), explanations.end(), explanation, comes_before),
        std::move(explanation));
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
        remember(layout_edge, answer);
    }
    return answer;
}

}  // namespace layout_embedding
