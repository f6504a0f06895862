#include "search/class_selection.hh"

#include <utility>

namespace layout_embedding {

namespace {

// Once clauses have had so many units of work, the instance is hard: before, branch and bound waits
// so many times as long, and from then on it gets so many times as much work as clauses.
constexpr std::uint64_t kHard = 8'000'000;
constexpr std::uint64_t kWaitBeforeHard = 8;
constexpr std::uint64_t kBranchingShare = 3;
// Units of work that clauses or branch and bound get at a time.
constexpr std::uint64_t kTurn = 50'000;
// No branch and bound on larger tables.
constexpr std::uint64_t kMostEntries = 32'000'000;

}  // namespace

ClassSelection::ClassSelection(const Layout& layout, const WalkPool& pool,
                               std::optional<FaceLoops> faces, std::vector<bool> is_linear,
                               std::uint64_t patience)
    : known_(layout, pool, std::move(faces), std::move(is_linear)),
      clauses_(known_),
      patience_(patience),
      choices_(layout.edge_count(), kNone)
{}

void ClassSelection::set_base(Index layout_edge, Length bound)
{
    known_.set_base(layout_edge, bound);
    clauses_.add_base(bound);
}

void ClassSelection::add_class(Index walk)
{
    if (known_.add(walk)) {
        clauses_.add_class(walk);
    }
}

void ClassSelection::add_bound(Index layout_edge, std::span<const Index> blockers, Length bound)
{
    const Length base = known_.base(layout_edge);
    if (bound <= base) {
        return;
    }
    for (const Index walk : blockers) {
        add_class(walk);
    }
    known_.add_bound({layout_edge,
                      {blockers.begin(), blockers.end()},
                      bound == kInfiniteLength ? bound : bound - base});
    clauses_.add_bound(known_.bounds().back());
}

void ClassSelection::forbid(std::span<const Index> walks)
{
    for (const Index walk : walks) {
        add_class(walk);
    }
    known_.forbid(walks);
    clauses_.forbid(walks);
}

void ClassSelection::lower_upper_bound(Length cost)
{
    known_.lower_upper_bound(cost);
    clauses_.lower_upper_bound(cost);
    if (branching_) {
        branching_->lower_upper_bound(cost);
    }
}

ClassSelection::Outcome ClassSelection::run(WorkBudget& budget)
{
    if (clauses_.has_noted_classes()) {
        clauses_.note_classes();
    }
    for (;;) {
        budget.charge(clauses_.take_uncharged());
        const Outcome outcome = run_engine(budget);
        if (outcome == Outcome::running && !budget.is_spent()) {
            continue;  // the other one's turn
        }
        if (outcome != Outcome::satisfied && outcome != Outcome::optimal) {
            return outcome;
        }
        read_choices();
        const bool has_wrong_orders = clauses_.add_violated_orders(choices_);
        const bool has_wrong_faces = clauses_.add_violated_faces(choices_, !choice_is_branchings_);
        if (!has_wrong_orders && !has_wrong_faces) {
            return outcome;
        }
    }
}

/// Clauses and branch and bound take turns.
ClassSelection::Outcome ClassSelection::run_engine(WorkBudget& budget)
{
    if (turn_left_ == 0) {
        is_branchings_turn_ = is_branchings_turn();
        turn_left_ = kTurn;
    }
    WorkBudget turn(std::min(budget.left(), turn_left_));
    const Outcome outcome = is_branchings_turn_ ? run_branching(turn) : clauses_.run(turn);
    budget.charge(turn.spent());
    turn_left_ -= std::min(turn_left_, turn.spent());
    (is_branchings_turn_ ? branching_work_ : clause_work_) += turn.spent();
    all_clause_work_ += is_branchings_turn_ ? 0 : turn.spent();
    choice_is_branchings_ = is_branchings_turn_;
    if (outcome != Outcome::running && is_branchings_turn_) {
        clauses_.interrupt();  // something may be added to them
    }
    return outcome;
}

/// Branch and bound is up where clauses have not told anything for a while.
bool ClassSelection::is_branchings_turn()
{
    const std::size_t knowledge = known_.walks().size() + known_.bounds().size();
    if (std::exchange(knowledge_, knowledge) != knowledge) {
        clause_work_ = 0;
        branching_work_ = 0;
    }
    const std::uint64_t wait = all_clause_work_ < kHard ? kWaitBeforeHard * patience_ : patience_;
    return known_.upper_bound() != kInfiniteLength && clause_work_ >= wait &&
           (patience_ == 0 || branching_work_ < kBranchingShare * (clause_work_ - wait)) &&
           (!branching_ || branching_->table_size() < kMostEntries);
}

ClassSelection::Outcome ClassSelection::run_branching(WorkBudget& budget)
{
    if (known_.faces() != nullptr) {
        clauses_.note_classes();
        budget.charge(clauses_.take_uncharged());
    }
    if (!branching_) {
        branching_ = std::make_unique<ClassBranching>(known_);
    }
    branching_->tell();
    const Outcome outcome = branching_->run(budget);
    std::vector<Index> walks;
    std::vector<Index> rests;
    branching_->take_ruled_out(walks, rests);
    if (!walks.empty() || !rests.empty()) {
        clauses_.interrupt();
    }
    for (const Index walk : walks) {
        clauses_.rule_out(walk);
    }
    for (const Index e : rests) {
        clauses_.rule_out_rest(e);
    }
    return outcome;
}

void ClassSelection::read_choices()
{
    for (Index e = 0; e < choices_.size(); ++e) {
        choices_[e] = choice_is_branchings_ ? branching_->choice(e) : clauses_.choice(e);
    }
}

}  // namespace layout_embedding
