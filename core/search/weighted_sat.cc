#include "search/weighted_sat.hh"

#include <algorithm>

namespace layout_embedding {

namespace {

// Conflicts that leaving a literal out of a core may take.
constexpr std::uint64_t kShrinkConflicts = 60;
// Larger cores are taken as they are.
constexpr std::size_t kMaxShrunkCore = 80;

}  // namespace

void WeightedSat::add_clause(std::span<const Literal> literals)
{
    solver_.add_clause(literals);
    changed_ = true;
}

void WeightedSat::set_residual(Literal l, Length weight)
{
    if (residuals_.size() <= l) {
        residuals_.resize(l + 1, 0);
    }
    weighted_.erase({residuals_[l], l});
    residuals_[l] = weight;
    if (weight > 0) {
        weighted_.insert({weight, l});
    }
}

void WeightedSat::add_cost(Literal l, Length weight)
{
    set_residual(l, residual(l) + weight);
    changed_ = true;
}

void WeightedSat::lower_upper_bound(Length cost)
{
    upper_bound_ = std::min(upper_bound_, cost);
    changed_ = true;
}

/// Forbids what cannot hold in any assignment that matters.
void WeightedSat::forbid()
{
    while (!weighted_.empty() && upper_bound_ != kInfiniteLength) {
        const auto [weight, literal] = *weighted_.rbegin();
        if (lower_bound_ + weight < upper_bound_) {
            break;
        }
        solver_.add_clause({negate(literal)});
        set_residual(literal, 0);
    }
}

void WeightedSat::begin()
{
    forbid();
    if (stratum_ == kInfiniteLength && !weighted_.empty()) {
        stratum_ = weighted_.rbegin()->first;
    }
    assumptions_.clear();
    for (auto it = weighted_.rbegin(); it != weighted_.rend() && it->first >= stratum_; ++it) {
        assumptions_.push_back(negate(it->second));
    }
    solver_.begin(assumptions_);
    stage_ = Stage::solving;
    changed_ = false;
}

WeightedSat::Outcome WeightedSat::run(WorkBudget& budget)
{
    for (;;) {
        if (lower_bound_ >= upper_bound_) {
            return Outcome::exceeded;
        }
        switch (stage_) {
            case Stage::idle:
                begin();
                break;
            case Stage::solving:
                switch (solver_.run(budget)) {
                    case SatSolver::Outcome::running:
                        return Outcome::running;
                    case SatSolver::Outcome::satisfiable: {
                        budget.charge(1);
                        stage_ = Stage::satisfied;
                        const bool all_assumed =
                            weighted_.empty() || weighted_.begin()->first >= stratum_;
                        return all_assumed && cores_.empty() ? Outcome::optimal
                                                             : Outcome::satisfied;
                    }
                    case SatSolver::Outcome::unsatisfiable:
                        budget.charge(1);
                        break;
                }
                if (solver_.core().empty()) {
                    lower_bound_ = upper_bound_;
                    return Outcome::exceeded;
                }
                if (!begin_shrinking()) {
                    return take_core();
                }
                break;
            case Stage::shrinking: {
                const auto outcome = solver_.run(budget);
                if (outcome == SatSolver::Outcome::running && !solver_.stopped()) {
                    return Outcome::running;
                }
                budget.charge(1);
                if (outcome == SatSolver::Outcome::unsatisfiable) {
                    // Those left out stay out; what was found necessary stays in front.
                    std::vector<Literal> smaller;
                    std::size_t kept = 0;
                    for (std::size_t i = 0; i < core_.size(); ++i) {
                        const auto& core = solver_.core();
                        if (std::find(core.begin(), core.end(), core_[i]) != core.end()) {
                            smaller.push_back(core_[i]);
                            kept += i < shrink_next_ ? 1 : 0;
                        }
                    }
                    core_ = std::move(smaller);
                    shrink_next_ = kept;
                    if (core_.empty()) {
                        lower_bound_ = upper_bound_;
                        return Outcome::exceeded;
                    }
                } else {
                    ++shrink_next_;
                }
                if (!next_to_shrink()) {
                    return take_core();
                }
                break;
            }
            case Stage::satisfied:
                if (!changed_) {
                    if (!cores_.empty()) {
                        relax();
                    } else if (!descend()) {
                        return Outcome::optimal;
                    }
                }
                stage_ = Stage::idle;
                break;
        }
    }
}

/// Begins to look for a smaller core; false if there is no point.
bool WeightedSat::begin_shrinking()
{
    core_ = solver_.core();
    // The lightest are what it would be best to lose.
    std::sort(core_.begin(), core_.end(), [&](Literal a, Literal b) {
        const Length weight_a = residual(negate(a));
        const Length weight_b = residual(negate(b));
        return weight_a != weight_b ? weight_a < weight_b : a < b;
    });
    shrink_next_ = core_.size() <= kMaxShrunkCore ? 0 : core_.size();
    stage_ = Stage::shrinking;
    return next_to_shrink();
}

/// Begins to look for a core without the next literal; false if there is none.
bool WeightedSat::next_to_shrink()
{
    if (core_.size() <= 1 || shrink_next_ >= core_.size()) {
        return false;
    }
    assumptions_.clear();
    for (std::size_t i = 0; i < core_.size(); ++i) {
        if (i != shrink_next_) {
            assumptions_.push_back(core_[i]);
        }
    }
    solver_.begin(assumptions_);
    solver_.limit_conflicts(kShrinkConflicts);
    return true;
}

/// The literals of a core cannot all be false: the least of their costs has to be paid.
WeightedSat::Outcome WeightedSat::take_core()
{
    ++core_count_;
    Length weight = kInfiniteLength;
    for (Literal& l : core_) {
        l = negate(l);
        weight = std::min(weight, residual(l));
    }
    for (const Literal l : core_) {
        set_residual(l, residual(l) - weight);
        const auto found = counts_.find(l);
        if (found != counts_.end() &&
            found->second.number < counters_[found->second.counter].size) {
            // The next one that holds costs as much again.
            const Count more{found->second.counter, found->second.number + 1};
            count_up_to(more.counter, more.number);
            const Literal next = counters_[more.counter].at_least[more.number - 1];
            counts_.emplace(next, more);
            set_residual(next, residual(next) + weight);
        }
    }
    lower_bound_ += weight;
    solver_.add_clause(core_);
    cores_.push_back(core_);
    core_weights_.push_back(weight);
    stage_ = Stage::idle;
    return Outcome::raised;
}

/// One literal of each core is paid for. The second that holds costs as much again, and so on: the
/// literal "at least two hold" takes the place of the core.
void WeightedSat::relax()
{
    for (std::size_t c = 0; c < cores_.size(); ++c) {
        if (cores_[c].size() > 1) {
            const Index counter = add_counter(cores_[c]);
            count_up_to(counter, 2);
            const Literal two = counters_[counter].at_least[1];
            counts_.emplace(two, Count{counter, 2});
            set_residual(two, residual(two) + core_weights_[c]);
        }
    }
    cores_.clear();
    core_weights_.clear();
}

Index WeightedSat::add_counter(std::span<const Literal> literals)
{
    Counter counter{kNone, kNone, static_cast<Index>(literals.size()), {}};
    if (literals.size() == 1) {
        counter.at_least.push_back(literals[0]);
    } else {
        counter.left = add_counter(literals.first(literals.size() / 2));
        counter.right = add_counter(literals.subspan(literals.size() / 2));
    }
    counters_.push_back(std::move(counter));
    return static_cast<Index>(counters_.size() - 1);
}

/// Makes the literals "at least 1, 2, ..., `number` hold".
void WeightedSat::count_up_to(Index counter, Index number)
{
    number = std::min(number, counters_[counter].size);
    if (counters_[counter].at_least.size() >= number) {
        return;
    }
    count_up_to(counters_[counter].left, number);
    count_up_to(counters_[counter].right, number);
    const auto& left = counters_[counters_[counter].left].at_least;
    const auto& right = counters_[counters_[counter].right].at_least;
    auto& here = counters_[counter].at_least;
    while (here.size() < number) {
        here.push_back(solver_.add_variable());
        const std::size_t sum = here.size();
        for (std::size_t i = 0; i <= std::min(sum, left.size()); ++i) {
            const std::size_t j = sum - i;
            if (j > right.size()) {
                continue;
            }
            clause_.assign(1, here.back());
            if (i > 0) {
                clause_.push_back(negate(left[i - 1]));
            }
            if (j > 0) {
                clause_.push_back(negate(right[j - 1]));
            }
            solver_.add_clause(clause_);
        }
    }
}

/// Goes on to lighter literals; false if all are assumed not to hold already.
bool WeightedSat::descend()
{
    const auto below = weighted_.lower_bound({stratum_, 0});
    if (below == weighted_.begin()) {
        return false;
    }
    stratum_ = std::prev(below)->first / 4;
    return true;
}

}  // namespace layout_embedding
