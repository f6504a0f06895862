#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/types.hh"
#include "layout/layout.hh"
#include "search/class_branching.hh"
#include "search/class_clauses.hh"
#include "search/face_loops.hh"
#include "search/known_classes.hh"
#include "search/selection_outcome.hh"
#include "search/work_budget.hh"
#include "surface/walk_pool.hh"

namespace layout_embedding {

/// The cheapest choice of one homotopy class per layout edge so that all can be embedded together,
/// as far as classes are known (design, Sec. 3; proof.md, Theorem 1). A class is known by its
/// shortest walk; all that are not known are one choice more, the *rest*, which fits everything and
/// costs at least what is known of it. The cost of the cheapest choice bounds every embedding from
/// below; if no rest is in it, it is an embedding, and the best of all.
///
/// Two engines take turns on what is known (KnownClasses): clauses and costs (ClassClauses), and
/// branch and bound (ClassBranching) where these tell nothing for a while.
class ClassSelection {
public:
    using Outcome = SelectionOutcome;

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
    const std::vector<Index>& wanted() const { return branching_->wanted(); }
    Length lower_bound() const
    {
        return branching_ ? std::max(clauses_.lower_bound(), branching_->lower_bound())
                          : clauses_.lower_bound();
    }
    /// Known classes.
    Index class_count() const { return static_cast<Index>(known_.walks().size()); }

private:
    bool is_branchings_turn();
    Outcome run_engine(WorkBudget& budget);
    Outcome run_branching(WorkBudget& budget);
    void read_choices();

    KnownClasses known_;
    ClassClauses clauses_;
    std::unique_ptr<ClassBranching> branching_;  // once the clauses have turned out to be hard
    std::uint64_t patience_;
    std::vector<Index> choices_;

    std::uint64_t clause_work_ = 0;  // since something became known
    std::uint64_t branching_work_ = 0;
    std::uint64_t all_clause_work_ = 0;
    std::size_t knowledge_ = 0;
    std::uint64_t turn_left_ = 0;
    bool is_branchings_turn_ = false;
    bool choice_is_branchings_ = false;
};

}  // namespace layout_embedding
