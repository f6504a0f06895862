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
        const auto more = more_.find(l);
        if (more != more_.end()) {
            set_residual(more->second, residual(more->second) + weight);
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
/// literal "at least so many hold" takes the place of each one paid for.
void WeightedSat::relax()
{
    for (std::size_t c = 0; c < cores_.size(); ++c) {
        const std::vector<Literal> counts = count(cores_[c]);
        for (std::size_t k = 1; k + 1 < counts.size(); ++k) {
            more_.emplace(counts[k], counts[k + 1]);
        }
        if (counts.size() > 1) {
            set_residual(counts[1], residual(counts[1]) + core_weights_[c]);
        }
    }
    cores_.clear();
    core_weights_.clear();
}

/// Literals that hold if at least 1, 2, ... of the given ones do: a totalizer (Bailleux and
/// Boufkhad 2003), in one direction only.
std::vector<WeightedSat::Literal> WeightedSat::count(std::span<const Literal> literals)
{
    if (literals.size() == 1) {
        return {literals[0]};
    }
    const std::size_t half = literals.size() / 2;
    const std::vector<Literal> left = count(literals.first(half));
    const std::vector<Literal> right = count(literals.subspan(half));
    std::vector<Literal> both;
    for (std::size_t k = 0; k < literals.size(); ++k) {
        both.push_back(solver_.add_variable());
    }
    for (std::size_t i = 0; i <= left.size(); ++i) {
        for (std::size_t j = i == 0 ? 1 : 0; j <= right.size(); ++j) {
            if (i == 0) {
                solver_.add_clause({negate(right[j - 1]), both[j - 1]});
            } else if (j == 0) {
                solver_.add_clause({negate(left[i - 1]), both[i - 1]});
            } else {
                solver_.add_clause({negate(left[i - 1]), negate(right[j - 1]), both[i + j - 1]});
            }
        }
    }
    return both;
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
