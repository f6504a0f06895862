#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/index_set.hh"
#include "base/types.hh"
#include "search/work_budget.hh"

namespace layout_embedding {

/// Members of which certain pairs exclude each other, known from elsewhere.
class Exclusions {
public:
    virtual ~Exclusions() = default;
    /// The members that this one excludes; symmetric. Members may be added, but what is said of
    /// two members stays as it is.
    virtual const IndexSet& excluded(Index member) const = 0;
};

/// Boolean satisfiability by conflict-driven clause learning (Marques-Silva and Sakallah 1999; Een
/// and Soerensson 2003): two watched literals, first unique implication points, activities,
/// restarts. Clauses and variables may be added between calls; what was learned stays, since it
/// follows from the clauses alone. Solves under assumptions and says which of them contradict each
/// other. Stepped and deterministic.
class SatSolver {
public:
    /// A variable or its negation: 2 * variable, + 1 if negated.
    using Literal = Index;
    static Literal negate(Literal l) { return l ^ 1U; }

    enum class Outcome { running, satisfiable, unsatisfiable };

    SatSolver() = default;
    /// Keeps a reference: variables that stand for members obey the exclusions, as by a clause per
    /// pair.
    explicit SatSolver(const Exclusions& exclusions) : exclusions_(&exclusions) {}

    /// A new variable, as its positive literal. Until something else is learned it is tried with
    /// the value `preferred` first.
    Literal add_variable(bool preferred = false);
    /// A new variable that stands for a member of the exclusions.
    Literal add_member(Index member, bool preferred = false);
    Index variable_count() const { return static_cast<Index>(levels_.size()); }
    /// Of the literals, at least one holds. Not while a call is `running`.
    void add_clause(std::span<const Literal> literals);
    void add_clause(std::initializer_list<Literal> literals)
    {
        add_clause(std::span(literals.begin(), literals.size()));
    }

    /// Starts to look for an assignment in which all assumptions hold.
    void begin(std::span<const Literal> assumptions);
    /// Gives up after about this many more conflicts: `running` is returned, and stopped() holds.
    void limit_conflicts(std::uint64_t conflicts) { conflicts_left_ = conflicts; }
    /// Continues until the answer is known, the budget is spent, or the limit on conflicts is
    /// reached.
    Outcome run(WorkBudget& budget);
    bool stopped() const { return conflicts_left_ == 0; }

    /// After `satisfiable`: whether a literal holds.
    bool holds(Literal l) const { return model_[l] == Value::holds; }
    /// After `unsatisfiable`: assumptions that cannot hold together; empty if the clauses alone
    /// contradict each other.
    const std::vector<Literal>& core() const { return core_; }
    /// Whether the clauses alone say that a literal holds.
    bool is_fixed(Literal l) const { return is_true(l) && levels_[l / 2] == 0; }

    std::uint64_t conflict_count() const { return conflict_count_; }
    /// Clauses of three literals or more that were learned and are not forgotten.
    std::size_t learned_count() const { return learned_.size(); }

private:
    enum class Value : std::uint8_t { open, holds, fails };
    using Sign = std::uint8_t;  // of a literal: 1 if it is negated

    // A clause of three literals or more is a place in arena_: size, then block distance (0: not
    // learned), then literals. One of two is known by one of them, with the mark kBinary, where it
    // says why the other one holds.
    using Clause = Index;
    static constexpr std::uint64_t kFirstForgetting = 2000;  // learned clauses
    static constexpr Clause kBinary = Index{1} << 31U;
    struct Watch {
        Clause clause;
        Literal blocker;  // another literal of the clause
    };

    Index size(Clause c) const { return arena_[c]; }
    Index& distance(Clause c) { return arena_[c + 1]; }
    Literal* literals(Clause c) { return arena_.data() + c + 2; }
    std::span<const Literal> literals(Clause c, Literal other);

    bool is_true(Literal l) const { return values_[l] == Value::holds; }
    bool is_false(Literal l) const { return values_[l] == Value::fails; }
    Index level() const { return static_cast<Index>(level_starts_.size()); }

    Clause store(std::span<const Literal> literals, Index block_distance);
    void assign(Literal l, Clause reason);
    bool is_member(Index variable) const
    {
        return variable < members_.size() && members_[variable] != kNone;
    }
    Clause propagate();
    bool imply(Literal l, Literal falsified);
    void go_back(Index level);
    Index learn(Clause conflict);
    bool is_implied(Literal l);
    void explain(Literal failed);
    void raise_activity(Index variable);
    Index take_most_active();
    void sift_up(Index place);
    void sift_down(Index place);
    bool knows_much() const { return learned_.size() >= forget_at_; }
    void forget();

    const Exclusions* exclusions_ = nullptr;
    std::vector<Index> members_;           // per variable, as far as needed; kNone
    std::vector<Index> member_variables_;  // per member; kNone
    IndexSet excluded_members_;            // those whose variables do not hold

    std::vector<Index> arena_;
    std::vector<Clause> learned_;
    std::vector<std::vector<Literal>> implied_;  // per literal: those that hold if it does
    std::vector<std::vector<Watch>> watches_;  // per literal: clauses to look at when it gets false
    std::array<Literal, 2> pair_;              // a clause of two literals
    Literal violated_ = kNone;                 // one literal of the clause violated
    std::vector<Value> values_;                // per literal
    std::vector<Sign> phases_;                 // per variable: of the literal to try first
    std::vector<Sign> preferred_;
    std::vector<Index> levels_;
    std::vector<Clause> reasons_;
    std::vector<Literal> trail_;
    std::vector<Index> level_starts_;
    std::size_t propagated_ = 0;
    bool contradictory_ = false;

    std::vector<double> activities_;
    double activity_step_ = 1;
    std::vector<Index> heap_;         // variables, the most active first
    std::vector<Index> heap_places_;  // kNone: not in it

    std::vector<Literal> assumptions_;
    std::vector<Literal> core_;
    std::vector<Value> model_;
    std::vector<Literal> clause_;     // being learned
    std::vector<std::uint8_t> seen_;  // per variable
    std::vector<Literal> marked_;
    std::vector<Index> level_marks_;
    Index level_mark_ = 0;

    std::uint64_t conflicts_left_ = UINT64_MAX;
    std::uint64_t conflict_count_ = 0;
    std::uint64_t uncharged_ = 0;  // literals and clauses looked at
    std::uint64_t restart_conflicts_ = 0;
    std::uint64_t restarts_ = 0;
    std::uint64_t forget_at_ = kFirstForgetting;
};

}  // namespace layout_embedding
