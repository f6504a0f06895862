#include "search/path_oracle.hh"

#include <algorithm>

namespace layout_embedding {

PathOracle::PathOracle(PartialEmbedding& embedding, CutSurfaceSearch& search, bool remember)
    : embedding_(embedding),
      search_(search),
      remember_(remember),
      explanations_(embedding.strands().layout().edge_count())
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
        if (explanation.bound < best.bound || !applies(explanation)) {
            continue;
        }
        // Of equal bounds, the one that has a walk.
        if (explanation.bound > best.bound || best.walk == kNone) {
            best.bound = explanation.bound;
            best.walk = explanation.walk;
        }
    }
    if (best.bound == kInfiniteLength) {
        best.outcome = Outcome::blocked;
    } else if (best.bound >= limit) {
        best.outcome = Outcome::exceeded;
    } else if (best.walk != kNone && embedding_.traces(best.walk)) {
        best.outcome = Outcome::found;
    }
    return best;
}

Length PathOracle::known_bound(Index layout_edge) const
{
    Length bound = 0;
    for (const Explanation& explanation : explanations_[layout_edge]) {
        if (explanation.bound > bound && applies(explanation)) {
            bound = explanation.bound;
        }
    }
    return bound;
}

PathOracle::Answer PathOracle::find(Index layout_edge, Length limit, std::uint64_t& budget)
{
    if (searching_ == kNone) {
        if (remember_) {
            const Answer answer = recall(layout_edge, limit);
            if (answer.outcome != Outcome::running) {
                ++remembered_count_;
                return answer;
            }
        }
        searching_ = layout_edge;
        search_.begin(layout_edge, limit);
    }
    const std::uint64_t before = search_.expansion_count();
    const auto outcome = search_.run(budget);
    budget -= search_.expansion_count() - before;
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
    if (remember_ && answer.outcome != Outcome::tied) {
        std::vector<Index> blockers = search_.blockers();
        for (Index& blocker : blockers) {
            blocker = embedding_.walk(blocker);
        }
        explanations_[layout_edge].push_back({answer.bound, answer.walk, std::move(blockers)});
    }
    return answer;
}

}  // namespace layout_embedding
