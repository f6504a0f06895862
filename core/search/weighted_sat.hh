#pragma once

#include <set>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/types.hh"
#include "search/sat_solver.hh"
#include "search/selection_outcome.hh"
#include "search/work_budget.hh"

namespace layout_embedding {

/// The cheapest assignment of Boolean variables that satisfies clauses, where literals cost
/// something if they hold. Core-guided (Fu and Malik 2006; Morgado, Dodaro and Marques-Silva 2014,
/// OLL): every contradiction between "this literal does not hold" assumptions raises the lower
/// bound and is turned into cheaper literals, until the assumptions agree. The heaviest literals
/// come first (stratification), and those too heavy for the upper bound are forbidden.
///
/// Clauses, variables and costs may be added between steps; the bound stays.
class WeightedSat {
public:
    using Literal = SatSolver::Literal;
    static Literal negate(Literal l) { return SatSolver::negate(l); }

    using Outcome = SelectionOutcome;

    WeightedSat() = default;
    /// Keeps a reference.
    explicit WeightedSat(const Exclusions& exclusions) : solver_(exclusions) {}

    Literal add_variable(bool preferred = false) { return solver_.add_variable(preferred); }
    /// A variable that stands for a member of the exclusions.
    Literal add_member(Index member, bool preferred = false)
    {
        changed_ = true;
        return solver_.add_member(member, preferred);
    }
    /// At least one of the literals holds. Not while a step is `running`; likewise below.
    void add_clause(std::span<const Literal> literals);
    void add_clause(std::initializer_list<Literal> literals)
    {
        add_clause(std::span(literals.begin(), literals.size()));
    }
    /// `l` costs so much more if it holds.
    void add_cost(Literal l, Length weight);
    /// Every assignment costs so much more.
    void add_base(Length weight) { lower_bound_ += weight; }
    /// Assignments of this cost or more do not matter. Only ever lowered.
    void lower_upper_bound(Length cost);

    /// Continues until something happens; a choice is an assignment (holds()) here.
    Outcome run(WorkBudget& budget);
    /// Leaves a step that is `running`, so that something may be added; what was learned stays.
    void interrupt()
    {
        if (stage_ != Stage::satisfied) {
            stage_ = Stage::idle;
        }
    }

    /// Every assignment costs at least this, or at least the upper bound.
    Length lower_bound() const { return std::min(lower_bound_, upper_bound_); }
    Length upper_bound() const { return upper_bound_; }
    bool holds(Literal l) const { return solver_.holds(l); }
    /// What `l` costs beyond lower_bound().
    Length residual(Literal l) const { return l < residuals_.size() ? residuals_[l] : 0; }

    Index variable_count() const { return solver_.variable_count(); }
    std::uint64_t core_count() const { return core_count_; }
    std::uint64_t conflict_count() const { return solver_.conflict_count(); }

private:
    /// Which literals hold if at least 1, 2, ... of certain literals do: a node of a totalizer
    /// (Bailleux and Boufkhad 2003) that grows as far as it is asked for (Martins et al. 2014).
    struct Counter {
        Index left;  // counters; kNone for a single literal
        Index right;
        Index size;
        std::vector<Literal> at_least;
    };
    /// "At least so many of a counter's literals hold."
    struct Count {
        Index counter;
        Index number;
    };

    enum class Stage { idle, solving, shrinking, satisfied };

    void begin();
    void set_residual(Literal l, Length weight);
    bool begin_shrinking();
    bool next_to_shrink();
    Outcome take_core();
    void relax();
    Index add_counter(std::span<const Literal> literals);
    void count_up_to(Index counter, Index number);
    bool descend();
    void forbid();

    SatSolver solver_;
    std::vector<Length> residuals_;                  // per literal
    std::set<std::pair<Length, Literal>> weighted_;  // with a residual, by it
    Length lower_bound_ = 0;
    Length upper_bound_ = kInfiniteLength;
    Length stratum_ = kInfiniteLength;  // literals of this residual or more are assumed not to hold
    Stage stage_ = Stage::idle;
    bool changed_ = true;                      // since the last assignment was found
    std::vector<std::vector<Literal>> cores_;  // not relaxed yet, with what they cost
    std::vector<Length> core_weights_;
    std::vector<Counter> counters_;
    std::unordered_map<Literal, Count> counts_;  // of counters that take the place of cores
    std::vector<Literal> core_;
    std::vector<Literal> clause_;
    std::size_t shrink_next_ = 0;
    std::vector<Literal> assumptions_;
    std::uint64_t core_count_ = 0;
};

}  // namespace layout_embedding
