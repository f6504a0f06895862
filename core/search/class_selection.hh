#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/types.hh"
#include "layout/layout.hh"
#include "search/choice_tree.hh"
#include "search/face_loops.hh"
#include "search/weighted_sat.hh"
#include "search/work_budget.hh"
#include "surface/walk_pool.hh"

namespace layout_embedding {

/// The cheapest choice of one homotopy class per layout edge so that all can be embedded together,
/// as far as classes are known (design, Sec. 3; proof.md, Theorem 1). A class is known by its
/// shortest walk; all that are not known are one choice more, the *rest*, which fits everything and
/// costs at least what is known of it. The cost of the cheapest choice bounds every embedding from
/// below; if no rest is in it, it is an embedding, and the best of all.
///
/// Kept as clauses and costs in a WeightedSat that grows as classes and bounds become known; cyclic
/// orders around landmarks and what faces demand are added where a choice violates them.
class ClassSelection {
public:
    enum class Outcome {
        running,
        /// lower_bound() has risen.
        raised,
        /// There is a choice (choice()), not known to be the cheapest.
        satisfied,
        /// The choice costs lower_bound(): there is none cheaper.
        optimal,
        /// Every choice costs at least the upper bound.
        exceeded,
        /// To know more classes of some edges (wanted()) would raise the bound.
        wants_classes,
    };

    /// Keeps references. `is_linear`: per layout vertex, whether the orders of the edges there are
    /// linear, as they are at landmarks on the target's boundary. `faces` may be missing.
    /// `patience`: units of work that clauses get for what is known before branch and bound begins;
    /// 0 for branch and bound alone, once there is an upper bound.
    ClassSelection(const Layout& layout, const WalkPool& pool, std::optional<FaceLoops> faces,
                   std::vector<bool> is_linear, std::uint64_t patience);

    /// Every class of the edge costs at least this. Once per edge, before anything else.
    void set_base(Index layout_edge, Length bound);
    /// One more known class. Nothing to do if it is known already.
    void add_class(Index walk);
    /// All classes of the edge that cost less than `bound` and could be embedded together with the
    /// walks `blockers` of other edges are known.
    void add_bound(Index layout_edge, std::span<const Index> blockers, Length bound);
    /// Only choices cheaper than this matter. Only ever lowered.
    void lower_upper_bound(Length cost);
    /// Not all of these classes can be chosen together.
    void forbid(std::span<const Index> walks);

    /// Continues until something happens; where `satisfied` or `optimal`, there is a choice, in
    /// which all classes can be embedded together.
    Outcome run(WorkBudget& budget);

    /// After `satisfied` or `optimal`: the class chosen, kNone for the rest.
    Index choice(Index layout_edge) const { return choices_[layout_edge]; }
    /// After `wants_classes`: the edges.
    const std::vector<Index>& wanted() const { return tree_->wanted(); }
    Length lower_bound() const
    {
        return tree_ ? std::max(sat_.lower_bound(), base_ + tree_->lower_bound())
                     : sat_.lower_bound();
    }
    /// Known classes.
    Index class_count() const { return class_count_; }
    const WeightedSat& sat() const { return sat_; }

private:
    using Literal = WeightedSat::Literal;
    static constexpr Literal kTrue = kNone;

    struct Edge {
        Length base = 0;
        Literal rest = kTrue;
        std::vector<Index> walks;
        /// "This edge costs at least so much", ascending.
        std::map<Length, Literal> levels;
    };

    Literal literal(Index walk) const { return walk < literals_.size() ? literals_[walk] : kNone; }
    Literal level(Index layout_edge, Length cost);
    void read_choices();
    bool add_violated_orders();
    bool is_wrong(const std::array<Index, 3>& halfedges, const std::array<Index, 3>& walks) const;
    void forbid_order(const std::array<Index, 3>& walks);
    bool add_violated_faces();
    void add_row(Index face, std::size_t place, Index walk);
    void add_to_rows(Index walk);
    bool add_completion(Index face, std::vector<Index>& walks, std::size_t place);
    bool can_go_together(Index a, Index b) const;
    void note_walks();
    bool is_trees_turn();
    Outcome run_engine(WorkBudget& budget);
    Outcome run_tree(WorkBudget& budget);
    Outcome run_sat(WorkBudget& budget);
    void tell_tree();
    void tell_tree_of(Index walk);
    void tell_tree_of_triangles(Index walk);
    template <typename Visit>
    void for_each_in_wrong_order(Index walk, const Visit& visit) const;

    /// Walks that cross.
    struct Crossings : Exclusions {
        explicit Crossings(const WalkPool& walks) : pool(walks) {}
        const IndexSet& excluded(Index walk) const override { return pool.crossing(walk); }
        const WalkPool& pool;
    };

    const Layout& layout_;
    const WalkPool& pool_;
    std::optional<FaceLoops> faces_;
    std::vector<bool> is_linear_;
    std::uint64_t patience_;
    Crossings crossings_;
    WeightedSat sat_;
    std::vector<Edge> edges_;
    std::vector<Literal> literals_;  // per walk; kNone if it is not known here
    std::vector<Index> choices_;
    Length base_ = 0;  // of all edges
    std::set<std::array<Index, 3>> forbidden_orders_;
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
    std::vector<std::set<Row>> rows_;  // per face; empty before the first choice
    std::vector<Index> unnoted_;       // walks that the faces do not know of yet
    /// Per side of a face that is not known yet: pairs of walks that it would complete.
    std::unordered_map<Index, std::vector<std::array<Index, 2>>> waiting_;  // never iterated
    std::uint64_t uncharged_ = 0;
    Index class_count_ = 0;

    // Branch and bound, once the clauses have turned out to be hard, and what it is told: known
    // classes, what an edge's rest costs beside some of them, and which cannot be chosen together.
    struct Told {
        Index layout_edge;  // kNone where classes cannot be chosen together
        std::vector<Index> walks;
        Length cost;
    };
    std::unique_ptr<ChoiceTree> tree_;
    std::vector<Index> known_;  // classes, in the order in which they became known
    std::vector<Told> bounds_;
    std::vector<Told> nogoods_;
    std::size_t told_classes_ = 0;
    std::size_t told_bounds_ = 0;
    std::size_t told_nogoods_ = 0;
    std::vector<Index> triangles_;  // per face; kNone
    /// Per side of a face that no class known to the tree is on: tuples with an edge's rest that
    /// would complete it.
    std::unordered_map<Index, std::vector<Index>> tuples_;  // never iterated
    std::uint64_t sat_work_ = 0;                            // since something became known
    std::uint64_t tree_work_ = 0;
    std::uint64_t all_sat_work_ = 0;
    std::size_t knowledge_ = 0;
    std::uint64_t turn_left_ = 0;
    bool is_trees_turn_ = false;
    bool choice_is_trees_ = false;
};

}  // namespace layout_embedding
