#include "search/sat_solver.hh"

#include <algorithm>

namespace layout_embedding {

namespace {

constexpr Index kNoReason = kNone;
constexpr double kActivityDecay = 0.95;
constexpr double kMaxActivity = 1e100;
constexpr std::uint64_t kRestartUnit = 64;
constexpr Index kGoodDistance = 3;  // learned clauses of few blocks are kept
// After forgetting learned clauses, the next time is when there are so many more than this time.
constexpr std::uint64_t kForgetLater = 200;
// Clauses looked at per unit of work: an expanded node of a path search takes about as long.
constexpr std::uint64_t kClausesPerWork = 12;
// Words of a set of exclusions gone through in the time of looking at a clause.
constexpr std::uint64_t kWordsPerLook = 8;
// Storing a clause takes as long as looking at so many.
constexpr std::uint64_t kLooksPerStored = 4;

/// 1 1 2 1 1 2 4 ...: how long the i-th run between restarts is (Luby, Sinclair, Zuckerman 1993).
std::uint64_t luby(std::uint64_t i)
{
    std::uint64_t size = 1;
    std::uint64_t exponent = 0;
    while (size < i + 1) {
        size = 2 * size + 1;
        ++exponent;
    }
    while (size - 1 != i) {
        size = (size - 1) / 2;
        --exponent;
        i %= size;
    }
    return std::uint64_t{1} << exponent;
}

}  // namespace

SatSolver::Literal SatSolver::add_variable(bool preferred)
{
    const Index variable = variable_count();
    const Sign phase = preferred ? 0 : 1;
    phases_.push_back(phase);
    preferred_.push_back(phase);
    levels_.push_back(0);
    reasons_.push_back(kNoReason);
    activities_.push_back(0);
    heap_places_.push_back(kNone);
    seen_.push_back(0);
    values_.resize(values_.size() + 2, Value::open);
    model_.push_back(preferred ? Value::holds : Value::fails);
    model_.push_back(preferred ? Value::fails : Value::holds);
    watches_.resize(watches_.size() + 2);
    implied_.resize(implied_.size() + 2);
    heap_places_[variable] = static_cast<Index>(heap_.size());
    heap_.push_back(variable);
    sift_up(heap_places_[variable]);
    return 2 * variable;
}

SatSolver::Literal SatSolver::add_member(Index member, bool preferred)
{
    const Literal l = add_variable(preferred);
    members_.resize(l / 2 + 1, kNone);
    members_[l / 2] = member;
    if (member >= member_variables_.size()) {
        member_variables_.resize(member + 1, kNone);
    }
    member_variables_[member] = l / 2;
    go_back(0);
    const bool may_hold = exclusions_->excluded(member).all_of([&](Index other) {
        return other >= member_variables_.size() || member_variables_[other] == kNone ||
               !is_true(2 * member_variables_[other]);
    });
    if (!may_hold) {
        add_clause({negate(l)});
    }
    return l;
}

/// The literals of a clause, one of which is `other`; of one with two, until the next call.
std::span<const SatSolver::Literal> SatSolver::literals(Clause c, Literal other)
{
    if ((c & kBinary) != 0) {
        pair_ = {c ^ kBinary, other};
        return pair_;
    }
    return {literals(c), size(c)};
}

/// Takes note of a clause. What it is known by says why the first literal holds.
SatSolver::Clause SatSolver::store(std::span<const Literal> literals, Index block_distance)
{
    uncharged_ += kLooksPerStored;
    if (literals.size() == 2) {
        implied_[negate(literals[0])].push_back(literals[1]);
        implied_[negate(literals[1])].push_back(literals[0]);
        return literals[1] | kBinary;
    }
    const auto clause = static_cast<Clause>(arena_.size());
    arena_.push_back(static_cast<Index>(literals.size()));
    arena_.push_back(block_distance);
    arena_.insert(arena_.end(), literals.begin(), literals.end());
    watches_[literals[0]].push_back({clause, literals[1]});
    watches_[literals[1]].push_back({clause, literals[0]});
    if (block_distance > 0) {
        learned_.push_back(clause);
    }
    return clause;
}

void SatSolver::add_clause(std::span<const Literal> literals)
{
    if (contradictory_) {
        return;
    }
    go_back(0);
    clause_.assign(literals.begin(), literals.end());
    std::sort(clause_.begin(), clause_.end());
    std::size_t kept = 0;
    Literal previous = kNone;
    for (const Literal l : clause_) {
        if (is_true(l) || (previous != kNone && l == negate(previous))) {
            return;
        }
        if (!is_false(l) && l != previous) {
            clause_[kept++] = l;
            previous = l;
        }
    }
    clause_.resize(kept);
    if (clause_.empty()) {
        contradictory_ = true;
    } else if (clause_.size() == 1) {
        assign(clause_[0], kNoReason);
        contradictory_ = propagate() != kNone;
    } else {
        store(clause_, 0);
    }
}

void SatSolver::assign(Literal l, Clause reason)
{
    const Index variable = l / 2;
    values_[l] = Value::holds;
    values_[negate(l)] = Value::fails;
    levels_[variable] = level();
    reasons_[variable] = reason;
    trail_.push_back(l);
    if ((l & 1U) != 0 && is_member(variable)) {
        excluded_members_.insert(members_[variable]);
    }
}

/// Draws all conclusions; the clause that is violated, one literal of which is violated_, kNone if
/// none is.
SatSolver::Clause SatSolver::propagate()
{
    while (propagated_ < trail_.size()) {
        const Literal holding = trail_[propagated_++];
        const Literal falsified = negate(holding);
        ++uncharged_;
        for (const Literal l : implied_[holding]) {
            if (!imply(l, falsified)) {
                return falsified | kBinary;
            }
        }
        const Index variable = holding / 2;
        if ((holding & 1U) == 0 && is_member(variable)) {
            const IndexSet& excluded = exclusions_->excluded(members_[variable]);
            uncharged_ += excluded.word_count() / kWordsPerLook;
            const bool agrees = excluded.all_of_but(excluded_members_, [&](Index other) {
                return other >= member_variables_.size() || member_variables_[other] == kNone ||
                       imply(negate(2 * member_variables_[other]), falsified);
            });
            if (!agrees) {
                return falsified | kBinary;
            }
        }
        auto& watches = watches_[falsified];
        std::size_t kept = 0;
        for (std::size_t i = 0; i < watches.size(); ++i) {
            const Watch watch = watches[i];
            if (is_true(watch.blocker)) {
                watches[kept++] = watch;
                continue;
            }
            ++uncharged_;
            Literal* of_clause = literals(watch.clause);
            if (of_clause[0] == falsified) {
                std::swap(of_clause[0], of_clause[1]);
            }
            const Literal first = of_clause[0];
            if (first != watch.blocker && is_true(first)) {
                watches[kept++] = {watch.clause, first};
                continue;
            }
            const Index count = size(watch.clause);
            Index k = 2;
            while (k < count && is_false(of_clause[k])) {
                ++k;
            }
            if (k < count) {
                std::swap(of_clause[1], of_clause[k]);
                watches_[of_clause[1]].push_back({watch.clause, first});
                continue;
            }
            watches[kept++] = {watch.clause, first};
            if (is_false(first)) {
                while (++i < watches.size()) {
                    watches[kept++] = watches[i];
                }
                watches.resize(kept);
                propagated_ = trail_.size();
                violated_ = first;
                return watch.clause;
            }
            assign(first, watch.clause);
        }
        watches.resize(kept);
    }
    return kNone;
}

/// Concludes that `l` holds, in a clause with `falsified` alone; false, with violated_, where it
/// does not.
bool SatSolver::imply(Literal l, Literal falsified)
{
    if (is_true(l)) {
        return true;
    }
    ++uncharged_;
    if (is_false(l)) {
        propagated_ = trail_.size();
        violated_ = l;
        return false;
    }
    assign(l, falsified | kBinary);
    return true;
}

void SatSolver::go_back(Index to)
{
    if (level() <= to) {
        return;
    }
    const Index start = level_starts_[to];
    for (std::size_t i = trail_.size(); i-- > start;) {
        const Literal l = trail_[i];
        const Index variable = l / 2;
        const Sign sign = l & 1U;
        phases_[variable] = sign;
        values_[l] = Value::open;
        values_[negate(l)] = Value::open;
        if (sign != 0 && is_member(variable)) {
            excluded_members_.erase(members_[variable]);
        }
        if (heap_places_[variable] == kNone) {
            heap_places_[variable] = static_cast<Index>(heap_.size());
            heap_.push_back(variable);
            sift_up(heap_places_[variable]);
        }
    }
    trail_.resize(start);
    level_starts_.resize(to);
    propagated_ = start;
}

/// Whether a literal of the clause being learned follows from the others.
bool SatSolver::is_implied(Literal l)
{
    const Clause reason = reasons_[l / 2];
    if (reason == kNoReason) {
        return false;
    }
    const auto of_reason = literals(reason, negate(l));
    return std::all_of(of_reason.begin(), of_reason.end(), [&](Literal other) {
        return other / 2 == l / 2 || seen_[other / 2] != 0 || levels_[other / 2] == 0;
    });
}

/// Puts the first unique implication point of a conflict into clause_; the level to go back to.
Index SatSolver::learn(Clause conflict)
{
    clause_.assign(1, kNone);
    marked_.clear();
    Index open = 0;
    std::size_t place = trail_.size();
    Literal current = kNone;
    do {
        ++uncharged_;
        for (const Literal l : literals(conflict, current == kNone ? violated_ : current)) {
            const Index variable = l / 2;
            if (l == current || seen_[variable] != 0 || levels_[variable] == 0) {
                continue;
            }
            seen_[variable] = 1;
            marked_.push_back(l);
            raise_activity(variable);
            if (levels_[variable] == level()) {
                ++open;
            } else {
                clause_.push_back(l);
            }
        }
        do {
            current = trail_[--place];
        } while (seen_[current / 2] == 0);
        conflict = reasons_[current / 2];
        seen_[current / 2] = 0;
        --open;
    } while (open > 0);
    clause_[0] = negate(current);
    clause_.erase(std::remove_if(clause_.begin() + 1, clause_.end(),
                                 [&](Literal l) { return is_implied(l); }),
                  clause_.end());
    for (const Literal l : marked_) {
        seen_[l / 2] = 0;
    }
    Index back = 0;
    for (std::size_t k = 1; k < clause_.size(); ++k) {
        if (levels_[clause_[k] / 2] > back) {
            back = levels_[clause_[k] / 2];
            std::swap(clause_[1], clause_[k]);
        }
    }
    return back;
}

/// The assumptions because of which `failed`, one of them, cannot hold.
void SatSolver::explain(Literal failed)
{
    core_.assign(1, failed);
    if (level() == 0) {
        return;
    }
    seen_[failed / 2] = 1;
    for (std::size_t i = trail_.size(); i-- > level_starts_[0];) {
        const Literal l = trail_[i];
        if (seen_[l / 2] == 0) {
            continue;
        }
        const Clause reason = reasons_[l / 2];
        if (reason == kNoReason) {
            if (l != failed) {
                core_.push_back(l);
            }
        } else {
            for (const Literal other : literals(reason, l)) {
                if (levels_[other / 2] > 0) {
                    seen_[other / 2] = 1;
                }
            }
        }
        seen_[l / 2] = 0;
    }
    seen_[failed / 2] = 0;
}

void SatSolver::raise_activity(Index variable)
{
    activities_[variable] += activity_step_;
    if (activities_[variable] > kMaxActivity) {
        for (double& activity : activities_) {
            activity /= kMaxActivity;
        }
        activity_step_ /= kMaxActivity;
    }
    if (heap_places_[variable] != kNone) {
        sift_up(heap_places_[variable]);
    }
}

void SatSolver::sift_up(Index place)
{
    const Index variable = heap_[place];
    while (place > 0) {
        const Index parent = (place - 1) / 2;
        if (activities_[heap_[parent]] >= activities_[variable]) {
            break;
        }
        heap_[place] = heap_[parent];
        heap_places_[heap_[place]] = place;
        place = parent;
    }
    heap_[place] = variable;
    heap_places_[variable] = place;
}

void SatSolver::sift_down(Index place)
{
    const Index variable = heap_[place];
    for (;;) {
        Index child = 2 * place + 1;
        if (child >= heap_.size()) {
            break;
        }
        if (child + 1 < heap_.size() && activities_[heap_[child + 1]] > activities_[heap_[child]]) {
            ++child;
        }
        if (activities_[heap_[child]] <= activities_[variable]) {
            break;
        }
        heap_[place] = heap_[child];
        heap_places_[heap_[place]] = place;
        place = child;
    }
    heap_[place] = variable;
    heap_places_[variable] = place;
}

Index SatSolver::take_most_active()
{
    const Index variable = heap_.front();
    heap_places_[variable] = kNone;
    heap_.front() = heap_.back();
    heap_.pop_back();
    if (!heap_.empty()) {
        heap_places_[heap_.front()] = 0;
        sift_down(0);
    }
    return variable;
}

/// Drops the worse half of the learned clauses; at level 0, when all conclusions are drawn.
void SatSolver::forget()
{
    forget_at_ += kForgetLater;
    std::vector<Clause> by_quality = learned_;
    std::stable_sort(by_quality.begin(), by_quality.end(), [&](Clause a, Clause b) {
        return distance(a) != distance(b) ? distance(a) < distance(b) : size(a) < size(b);
    });
    std::vector<Index> old = std::move(arena_);
    std::vector<std::uint8_t> dropped(old.size(), 0);
    for (std::size_t i = by_quality.size() / 2; i < by_quality.size(); ++i) {
        if (old[by_quality[i] + 1] > kGoodDistance) {
            dropped[by_quality[i]] = 1;
        }
    }
    arena_.clear();
    learned_.clear();
    for (auto& watches : watches_) {
        watches.clear();
    }
    for (Literal l = 0; l < implied_.size(); ++l) {
        auto& implied = implied_[l];
        if (is_true(l) || is_false(l)) {
            implied.clear();
        } else {
            implied.erase(std::remove_if(implied.begin(), implied.end(),
                                         [&](Literal other) { return is_true(other); }),
                          implied.end());
        }
    }
    for (std::size_t c = 0; c < old.size(); c += old[c] + 2) {
        std::span<Literal> of_clause(old.data() + c + 2, old[c]);
        // Clauses that hold anyway go as well; false literals would spoil the watches.
        const bool holds =
            std::any_of(of_clause.begin(), of_clause.end(), [&](Literal l) { return is_true(l); });
        if (dropped[c] == 0 && !holds) {
            clause_.clear();
            std::copy_if(of_clause.begin(), of_clause.end(), std::back_inserter(clause_),
                         [&](Literal l) { return !is_false(l); });
            store(clause_, old[c + 1]);
        }
    }
    // Nothing at level 0 is ever explained.
    for (const Literal l : trail_) {
        reasons_[l / 2] = kNoReason;
    }
}

void SatSolver::begin(std::span<const Literal> assumptions)
{
    Index kept = 0;
    if (knows_much()) {
        go_back(0);
        if (!contradictory_) {
            forget();
        }
    } else {
        // What follows from the assumptions in front that are the same as last time stays.
        const std::size_t common =
            std::min({assumptions.size(), assumptions_.size(), level_starts_.size()});
        while (kept < common && assumptions[kept] == assumptions_[kept]) {
            ++kept;
        }
        go_back(kept);
    }
    phases_ = preferred_;
    assumptions_.assign(assumptions.begin(), assumptions.end());
    core_.clear();
    conflicts_left_ = UINT64_MAX;
    restart_conflicts_ = 0;
    restarts_ = 0;
}

SatSolver::Outcome SatSolver::run(WorkBudget& budget)
{
    if (contradictory_) {
        core_.clear();
        return Outcome::unsatisfiable;
    }
    for (;;) {
        const Clause conflict = propagate();
        budget.charge(uncharged_ / kClausesPerWork);
        uncharged_ %= kClausesPerWork;
        if (conflict != kNone) {
            ++conflict_count_;
            ++restart_conflicts_;
            if (level() == 0) {
                contradictory_ = true;
                core_.clear();
                return Outcome::unsatisfiable;
            }
            const Index back = learn(conflict);
            ++level_mark_;
            level_marks_.resize(levels_.size() + 1, 0);
            Index blocks = 0;
            for (const Literal l : clause_) {
                Index& mark = level_marks_[levels_[l / 2]];
                blocks += mark != level_mark_ ? 1 : 0;
                mark = level_mark_;
            }
            go_back(back);
            if (clause_.size() == 1) {
                assign(clause_[0], kNoReason);
            } else {
                const Literal asserted = clause_[0];
                assign(asserted, store(clause_, blocks));
            }
            activity_step_ /= kActivityDecay;
            if (conflicts_left_ > 0 && conflicts_left_ != UINT64_MAX) {
                --conflicts_left_;
            }
            continue;
        }
        if (budget.is_spent() || stopped()) {
            return Outcome::running;
        }
        if (restart_conflicts_ >= kRestartUnit * luby(restarts_)) {
            ++restarts_;
            restart_conflicts_ = 0;
            if (knows_much()) {
                go_back(0);
                forget();
            } else {
                go_back(std::min(level(), static_cast<Index>(assumptions_.size())));
            }
            continue;
        }
        Literal next = kNone;
        while (level() < assumptions_.size()) {
            const Literal assumption = assumptions_[level()];
            if (is_true(assumption)) {
                level_starts_.push_back(static_cast<Index>(trail_.size()));
            } else if (is_false(assumption)) {
                explain(assumption);
                return Outcome::unsatisfiable;
            } else {
                next = assumption;
                break;
            }
        }
        const bool is_complete = trail_.size() == variable_count();
        while (next == kNone && !is_complete && !heap_.empty()) {
            const Index variable = take_most_active();
            if (values_[2 * variable] == Value::open) {
                next = 2 * variable + phases_[variable];
            }
        }
        if (next == kNone) {
            model_ = values_;
            return Outcome::satisfiable;
        }
        level_starts_.push_back(static_cast<Index>(trail_.size()));
        assign(next, kNoReason);
    }
}

}  // namespace layout_embedding
