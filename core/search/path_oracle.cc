#include "search/path_oracle.hh"

#include <algorithm>
#include <cassert>

namespace layout_embedding {

namespace {

// Expansions that looking for a class that an edge may take goes on for, and as many times the
// nodes: beside strands there may be none at all, and no end to the search.
constexpr std::uint64_t kMaxEnumeration = 20'000;
constexpr std::uint64_t kMaxEnumerationPerNode = 4;

}  // namespace

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

void PathOracle::constrain(const ClassConstraints& constraints, CutSystems& cuts,
                           DistanceFields& fields)
{
    constraints_ = &constraints;
    cuts_ = &cuts;
    enumeration_ = std::make_unique<ClassEnumeration>(embedding_.strands(), fields);
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
            if (keeps(layout_edge) && answer.walk != kNone) {
                return {Outcome::blocked, kNone, kInfiniteLength};  // its only path does not fit
            }
        }
        if (!embedding_.move_strands()) {
            return {Outcome::tied, kNone, 0};
        }
        searching_ = layout_edge;
        limit_ = limit;
        if (keeps(layout_edge)) {
            begin_enumeration(layout_edge);
        } else {
            is_enumerating_ = false;
            search_.begin(layout_edge, weights().length(layout_edge, limit));
        }
    }
    assert(searching_ == layout_edge);
    Answer answer;
    if (!is_enumerating_) {
        answer = search(layout_edge, budget);
    }
    if (is_enumerating_) {
        answer = enumerate(layout_edge, budget);
    }
    if (answer.outcome == Outcome::running) {
        return answer;
    }
    searching_ = kNone;
    if (remembers_ && answer.outcome != Outcome::tied) {
        std::vector<Index> blockers =
            is_enumerating_ ? enumeration_->blockers() : search_.blockers();
        for (Index& blocker : blockers) {
            blocker = embedding_.walk(blocker);
        }
        remember({layout_edge, answer.bound, answer.walk, std::move(blockers)});
    }
    return answer;
}

/// The shortest path of all. Where its class is none that the edge may take, classes are to be
/// enumerated from now on.
PathOracle::Answer PathOracle::search(Index layout_edge, WorkBudget& budget)
{
    const std::uint64_t before = search_.expansion_count();
    const auto outcome = search_.run(budget.left());
    budget.charge(search_.expansion_count() - before);
    const Length bound = weights().cost(layout_edge, search_.lower_bound());
    switch (outcome) {
        case CutSurfaceSearch::Outcome::running:
            return {Outcome::running, kNone, bound};
        case CutSurfaceSearch::Outcome::tied:
            return {Outcome::tied, kNone, bound};
        case CutSurfaceSearch::Outcome::blocked:
            return {Outcome::blocked, kNone, bound};
        case CutSurfaceSearch::Outcome::exceeded:
            return {Outcome::exceeded, kNone, bound};
        case CutSurfaceSearch::Outcome::found:
            break;
    }
    if (constraints_ != nullptr && !constraints_->admit(layout_edge, search_.darts())) {
        begin_enumeration(layout_edge);
        return {Outcome::running, kNone, bound};
    }
    return {Outcome::found, embedding_.pool().add(layout_edge, search_.darts()), bound};
}

void PathOracle::begin_enumeration(Index layout_edge)
{
    is_enumerating_ = true;
    enumeration_left_ =
        keeps(layout_edge)
            ? UINT64_MAX
            : kMaxEnumeration + kMaxEnumerationPerNode * embedding_.strands().graph().node_count();
    enumeration_->begin(
        cuts_->of(layout_edge), layout_edge,
        std::min(weights().length(layout_edge, limit_), constraints_->limit(layout_edge)));
}

/// The shortest path of a class that the edge may take.
PathOracle::Answer PathOracle::enumerate(Index layout_edge, WorkBudget& budget)
{
    while (!budget.is_spent()) {
        const std::uint64_t before = enumeration_->expansion_count();
        const std::uint64_t work_before = enumeration_->work_count();
        const auto outcome = enumeration_->run(enumeration_left_, budget.left());
        const std::uint64_t expansions = enumeration_->expansion_count() - before;
        enumeration_left_ -= expansions;
        budget.charge(enumeration_->work_count() - work_before);
        const Length frontier = enumeration_->frontier();
        const Length bound = weights().cost(layout_edge, frontier);
        switch (outcome) {
            case ClassEnumeration::Outcome::running:
                if (enumeration_left_ == 0) {
                    return {Outcome::given_up, kNone, bound};
                }
                break;
            case ClassEnumeration::Outcome::tied:
                return {Outcome::tied, kNone, bound};
            case ClassEnumeration::Outcome::exceeded:
                return frontier < constraints_->limit(layout_edge)
                           ? Answer{Outcome::exceeded, kNone, bound}
                           : Answer{Outcome::blocked, kNone, kInfiniteLength};
            case ClassEnumeration::Outcome::found:
                if (constraints_->admit(layout_edge, enumeration_->darts())) {
                    const Index walk = embedding_.pool().add(layout_edge, enumeration_->darts());
                    return {Outcome::found, walk, embedding_.pool().cost(walk)};
                }
                break;
        }
    }
    return {Outcome::running, kNone, weights().cost(layout_edge, enumeration_->frontier())};
}

}  // namespace layout_embedding
