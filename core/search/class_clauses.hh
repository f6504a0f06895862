#pragma once

#include <array>
#include <map>
#include <set>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "search/known_classes.hh"
#include "search/selection_outcome.hh"
#include "search/weighted_sat.hh"
#include "search/work_budget.hh"

namespace layout_embedding {

/// The cheapest choice of one class per layout edge, as clauses and costs of a WeightedSat that
/// grows as classes and bounds become known. Cyclic orders around landmarks and what faces demand
/// are added where a choice violates them.
class ClassClauses {
public:
    using Outcome = SelectionOutcome;

    /// Keeps a reference, and adds to it what choices turn out to violate.
    explicit ClassClauses(KnownClasses& known);

    /// An edge's base is known. Once per edge, before anything else.
    void add_base(Length bound) { sat_.add_base(bound); }
    /// A class has become known.
    void add_class(Index walk);
    /// A bound has become known, and all its walks are.
    void add_bound(const KnownClasses::Bound& bound);
    /// Not all of these known classes can be chosen together.
    void forbid(std::span<const Index> walks);
    /// No choice that matters takes this class; or the edge's rest.
    void rule_out(Index walk) { sat_.add_clause({WeightedSat::negate(literals_[walk])}); }
    void rule_out_rest(Index layout_edge);
    void lower_upper_bound(Length cost) { sat_.lower_upper_bound(cost); }

    /// Continues until something happens. Choices may violate orders and faces.
    Outcome run(WorkBudget& budget) { return sat_.run(budget); }
    /// Leaves a step that is `running`, so that something may be added.
    void interrupt() { sat_.interrupt(); }
    /// After `satisfied` or `optimal`: the class chosen, kNone for the rest.
    Index choice(Index layout_edge) const;
    Length lower_bound() const { return sat_.lower_bound(); }

    /// Forbids wrong orders that are in a choice (per edge), and those that differ from one in a
    /// single class; false if there is none.
    bool add_violated_orders(std::span<const Index> choices);
    /// Adds what faces demand that a choice does not comply with, and more of the kind; false if it
    /// complies with all. `is_own`: whether the choice is that of the assignment found last.
    bool add_violated_faces(std::span<const Index> choices, bool is_own);
    /// Whether note_classes() has been called, by a choice's faces or otherwise.
    bool has_noted_classes() const { return !rows_.empty(); }
    /// Tells the faces of the classes that are new to them. Cuts for faces are not made before.
    void note_classes();

    /// Work that no budget was charged with yet.
    std::uint64_t take_uncharged() { return std::exchange(uncharged_, 0); }

private:
    using Literal = WeightedSat::Literal;
    static constexpr Literal kTrue = kNone;

    struct Edge {
        Literal rest = kTrue;
        /// "This edge costs at least so much beyond its base", ascending.
        std::map<Length, Literal> levels;
    };
    /// A walk at one place of a triangle whose completions are clauses, beside every walk known at
    /// another place.
    struct Row {
        std::size_t place;
        Index walk;
        bool operator<(const Row& other) const
        {
            return place != other.place ? place < other.place : walk < other.walk;
        }
    };

    Literal level(Index layout_edge, Length excess);
    void forbid_order(const std::array<Index, 3>& walks);
    void add_row(Index face, std::size_t place, Index walk);
    void add_to_rows(Index walk);
    bool add_completion(Index face, std::vector<Index>& walks, std::size_t place);

    /// Walks that cross.
    struct Crossings : Exclusions {
        explicit Crossings(const WalkPool& walks) : pool(walks) {}
        const IndexSet& excluded(Index walk) const override { return pool.crossing(walk); }
        const WalkPool& pool;
    };

    KnownClasses& known_;
    Crossings crossings_;
    WeightedSat sat_;
    std::vector<Edge> edges_;
    std::vector<Literal> literals_;  // per walk; kNone if it is not known
    std::set<std::array<Index, 3>> forbidden_orders_;
    std::vector<std::set<Row>> rows_;  // per face
    std::size_t noted_ = 0;            // classes that the faces know of
    /// Per side of a face that is not known yet: pairs of walks that it would complete.
    std::unordered_map<Index, std::vector<std::array<Index, 2>>> waiting_;  // never iterated
    std::uint64_t uncharged_ = 0;
};

}  // namespace layout_embedding
