#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/types.hh"
#include "search/choice_relaxation.hh"
#include "search/selection_outcome.hh"
#include "search/work_budget.hh"

namespace layout_embedding {

/// The cheapest choice of one class per layout edge by branch and bound: nodes decide for or
/// against single classes, and are bounded by a linear relaxation (ChoiceRelaxation), which is far
/// stronger than contradictions found one by one where many edges are in each other's way.
///
/// What is known of a class is its cost; all unknown classes of an edge are its *rest*, which costs
/// at least what is known of it. Costs are those beyond the edges' bases. Knowledge may grow at any
/// time: what was decided stays, a class that becomes known was part of the rest.
class ChoiceTree {
public:
    using Outcome = SelectionOutcome;

    /// Only choices cheaper than `upper_bound`, which is finite, matter.
    ChoiceTree(Index edge_count, Length upper_bound);

    void lower_upper_bound(Length cost);
    /// To be called before something becomes known.
    void expect_news();
    /// A class becomes known, by its walk's id. Nothing to do if it is known, or too expensive.
    void add_class(Index edge, Index walk, Length cost);
    bool knows(Index walk) const { return walk < places_.size() && places_[walk].edge != kNone; }
    /// Two known classes cannot be chosen together.
    void exclude(Index walk_a, Index walk_b);
    /// Three edges around a triangle: which of their classes may be chosen together is up to
    /// add_tuple(), kNone for an edge's rest.
    Index add_triangle(const std::array<Index, 3>& edges);
    Index add_tuple(Index triangle, const std::array<Index, 3>& walks);
    void remove_tuple(Index triangle, Index tuple) { relaxation_.remove_tuple(triangle, tuple); }
    /// With the classes of `walks` chosen, an edge's rest costs at least `cost`; kInfiniteLength
    /// for never chosen.
    void add_bound(Index edge, std::span<const Index> walks, Length cost);
    /// Not all of these classes can be chosen together.
    void forbid(std::span<const Index> walks);

    /// Continues until something happens or the budget is spent. `wants_classes`: the relaxation
    /// takes the rest of some edges (wanted()); once for what is known.
    Outcome run(WorkBudget& budget);
    /// After `satisfied` or `optimal`: the walk of the class chosen, kNone for the rest.
    Index choice(Index edge) const { return choices_[edge]; }
    /// Every choice costs at least this, or at least the upper bound.
    Length lower_bound() const { return lower_bound_; }
    /// Classes that no choice that matters takes, as found since the last time, by their walks; an
    /// edge's rest goes to `rests`.
    void take_ruled_out(std::vector<Index>& walks, std::vector<Index>& rests);
    const std::vector<Index>& wanted() const { return wanted_; }
    std::uint64_t node_count() const { return node_count_; }
    /// About how many bytes exclusions and tuples take.
    std::uint64_t table_size() const { return relaxation_.table_size(); }

private:
    using Cost = ChoiceRelaxation::Cost;
    static constexpr Index kRest = 0;  // group; those of known classes follow

    struct Place {
        Index edge = kNone;
        Index label = kNone;
        Index group = kNone;
    };
    struct Label {
        Index walk;  // kNone for the rest
        Length cost;
    };
    /// With one class chosen, the rest costs so much.
    struct RestBound {
        Index walk;
        Length cost;
    };
    struct Edge {
        std::vector<Label> labels;
        std::vector<Index> walks;  // per group but the rest's
        Length rest = 0;           // costs at least, whatever the others do
        std::vector<RestBound> rest_bounds;
    };
    /// Not all of these classes together; or with all of them, the rest of an edge costs so much.
    struct Nogood {
        std::vector<Place> classes;
        Index rest_edge;  // kNone for none
        Length rest_cost;
    };
    /// Whether an edge takes a group.
    struct Decision {
        Index edge;
        Index group;
        Index group_count;  // of the edge, when this was decided
        bool is_taken;
    };
    struct Node {
        Cost bound;
        std::uint64_t id;
        std::vector<Decision> decisions;
        /// Where only one choice was left: when that was found, since what is known may have
        /// changed, and the choice.
        std::optional<std::uint64_t> leaf_version;
        std::vector<Index> choices;
    };
    static bool is_later(const Node& a, const Node& b)
    {
        return a.bound != b.bound ? a.bound > b.bound : a.id > b.id;
    }

    Cost scaled(Length cost) const { return static_cast<Cost>(cost >> shift_); }
    Index rest_label(Index edge, Length cost);
    void add_label(Index edge, Index group, Index walk, Length cost, Index like);
    bool is_decided(const Place& place) const;
    void apply(const std::vector<Decision>& decisions);
    void take(const Decision& decision);
    bool apply_nogoods();
    Outcome improve_node();
    bool is_leaf() const;
    Length take_choices();
    bool find_wanted();
    void branch();
    void open(Node node);
    Node take_best();
    void rule_out_for_good();
    void raise_lower_bound();

    ChoiceRelaxation relaxation_;
    unsigned shift_ = 0;
    std::vector<Edge> edges_;
    std::vector<Place> places_;  // per walk
    std::vector<Nogood> nogoods_;
    Length upper_bound_;
    Cost limit_ = 0;  // upper_bound_, scaled
    Length lower_bound_ = 0;
    std::uint64_t version_ = 0;

    std::vector<Node> open_;  // a heap, the smallest bound first
    std::optional<Node> current_;
    int rounds_ = 0;  // of sweeps for the present node
    std::uint64_t applied_version_ = 0;
    std::uint64_t next_id_ = 0;
    std::uint64_t node_count_ = 0;
    std::uint64_t root_version_ = 0;
    bool root_is_saved_ = false;
    std::vector<Index> wanted_;
    std::optional<std::uint64_t> wanted_version_;
    std::vector<Index> choices_;
    std::vector<Index> ruled_out_;
    std::vector<Index> ruled_out_rests_;
};

}  // namespace layout_embedding
