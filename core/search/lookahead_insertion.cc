#include "search/lookahead_insertion.hh"

#include <algorithm>

namespace layout_embedding {

namespace {

// What inserting a path for a trial charges, in expansions.
constexpr std::uint64_t kTrialWork = 4;

}  // namespace

LookaheadInsertion::LookaheadInsertion(PartialEmbedding& embedding, PathOracle& oracle,
                                       std::vector<Index> candidates, std::vector<Index> first)
    : embedding_(embedding),
      oracle_(oracle),
      candidates_(std::move(candidates)),
      first_(std::move(first))
{}

LookaheadInsertion::Outcome LookaheadInsertion::run(WorkBudget& budget)
{
    Outcome outcome = Outcome::running;
    do {
        switch (stage_) {
            case Stage::first:
                outcome = insert_first(budget);
                break;
            case Stage::update:
                outcome = update(budget);
                break;
            case Stage::compare:
                outcome = compare(budget);
                break;
        }
    } while (outcome == Outcome::running && !budget.is_spent());
    return outcome;
}

/// Embeds the candidate of an edge; false, with the outcome, if that ends everything.
bool LookaheadInsertion::insert(Index layout_edge, Outcome& outcome)
{
    switch (embedding_.insert(candidates_[layout_edge])) {
        case PartialEmbedding::Insertion::done:
            return true;
        case PartialEmbedding::Insertion::refused:
            outcome = Outcome::failed;
            break;
        case PartialEmbedding::Insertion::torn:
            outcome = Outcome::tied;
            break;
    }
    return false;
}

/// Brings the candidate of an edge that is not embedded up to date: `complete` if it is.
LookaheadInsertion::Outcome LookaheadInsertion::find(Index layout_edge, WorkBudget& budget)
{
    if (embedding_.fits(candidates_[layout_edge])) {
        return Outcome::complete;
    }
    const auto answer = oracle_.find(layout_edge, kInfiniteLength, budget);
    switch (answer.outcome) {
        case PathOracle::Outcome::running:
            return Outcome::running;
        case PathOracle::Outcome::tied:
            return Outcome::tied;
        case PathOracle::Outcome::found:
            candidates_[layout_edge] = answer.walk;
            return Outcome::complete;
        default:
            return Outcome::failed;
    }
}

LookaheadInsertion::Outcome LookaheadInsertion::insert_first(WorkBudget& budget)
{
    for (; next_first_ < first_.size(); ++next_first_) {
        Outcome outcome = find(first_[next_first_], budget);
        if (outcome != Outcome::complete || !insert(first_[next_first_], outcome)) {
            return outcome;
        }
    }
    stage_ = Stage::update;
    return Outcome::running;
}

/// Brings the candidates up to date, and embeds those that are in nobody's way.
LookaheadInsertion::Outcome LookaheadInsertion::update(WorkBudget& budget)
{
    for (; next_ < candidates_.size(); ++next_) {
        if (embedding_.walk(next_) == kNone) {
            const Outcome outcome = find(next_, budget);
            if (outcome != Outcome::complete) {
                return outcome;
            }
        }
    }
    next_ = 0;
    contested_ = embedding_.conflicts(candidates_).edges();
    budget.charge(candidates_.size() / 4 + 1);
    Outcome outcome = Outcome::running;
    bool inserted = false;
    for (Index e = 0; e < candidates_.size(); ++e) {
        if (embedding_.walk(e) == kNone &&
            !std::binary_search(contested_.begin(), contested_.end(), e)) {
            if (!insert(e, outcome)) {
                return outcome;
            }
            inserted = true;
        }
    }
    if (embedding_.is_complete()) {
        return Outcome::complete;
    }
    if (!inserted) {
        stage_ = Stage::compare;
        next_contested_ = 0;
        least_damage_ = kInfiniteLength;
        best_ = kNone;
        others_ = embedding_.conflicting_with(contested_[0], candidates_);
        next_other_ = 0;
        damage_ = 0;
    }
    return outcome;
}

/// Looks for the contested candidate that does the least damage, and embeds it.
LookaheadInsertion::Outcome LookaheadInsertion::compare(WorkBudget& budget)
{
    for (;;) {
        const Index edge = contested_[next_contested_];
        while (next_other_ < others_.size() && damage_ < least_damage_) {
            const Index other = others_[next_other_];
            const Length before = embedding_.pool().cost(candidates_[other]);
            const std::pair key{candidates_[edge], candidates_[other]};
            auto known = damages_.find(key);
            if (known == damages_.end()) {
                if (!is_trying_) {
                    Outcome outcome = Outcome::running;
                    budget.charge(kTrialWork);
                    if (!insert(edge, outcome)) {
                        if (outcome == Outcome::tied) {
                            return outcome;
                        }
                        damage_ = kInfiniteLength;
                        break;
                    }
                    is_trying_ = true;
                }
                const auto answer = oracle_.find(other, kInfiniteLength, budget);
                if (answer.outcome == PathOracle::Outcome::running) {
                    return Outcome::running;
                }
                if (answer.outcome == PathOracle::Outcome::tied) {
                    return Outcome::tied;
                }
                known = damages_
                            .emplace(key, answer.outcome == PathOracle::Outcome::found
                                              ? answer.bound - before
                                              : kInfiniteLength)
                            .first;
            }
            damage_ = known->second == kInfiniteLength
                          ? kInfiniteLength
                          : damage_ + std::min(known->second, kInfiniteLength - damage_);
            ++next_other_;
        }
        if (is_trying_) {
            embedding_.undo();
            is_trying_ = false;
        }
        if (damage_ < least_damage_) {
            least_damage_ = damage_;
            best_ = edge;
        }
        if (++next_contested_ == contested_.size()) {
            break;
        }
        others_ = embedding_.conflicting_with(contested_[next_contested_], candidates_);
        next_other_ = 0;
        damage_ = 0;
        if (budget.is_spent()) {
            return Outcome::running;
        }
    }
    Outcome outcome = Outcome::failed;
    if (best_ != kNone && insert(best_, outcome)) {
        outcome = Outcome::running;
    }
    stage_ = Stage::update;
    return outcome;
}

}  // namespace layout_embedding
