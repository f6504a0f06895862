#include "search/starting_search.hh"

#include <array>

namespace layout_embedding {

namespace {

// One after the other, until one ends in an embedding. On closed surfaces of genus 0 the first
// does.
constexpr std::array<GreedyRule, 4> kRules{GreedyRule::plain(), GreedyRule::schreiner(),
                                           GreedyRule::kraevoy(), GreedyRule::praun()};

}  // namespace

StartingSearch::StartingSearch(const EmbeddingProblem& problem, SearchSpace& space,
                               std::uint64_t local_search, double gap)
    : problem_(problem),
      space_(space),
      first_local_search_(local_search),
      gap_(gap),
      stage_(space.constraints.empty() ? Stage::greedy : Stage::find_roots)
{
    if (stage_ == Stage::greedy) {
        greedy_ = std::make_unique<GreedySearch>(problem, space.strands, space.search, kRules[0]);
    }
}

double StartingSearch::progress() const
{
    return greedy_ ? greedy_->progress()
                   : static_cast<double>(next_root_) / space_.embedding.layout().edge_count();
}

Solver::Outcome StartingSearch::run(WorkBudget& budget)
{
    Solver::Outcome outcome = Solver::Outcome::finished;
    while (outcome == Solver::Outcome::finished && stage_ != Stage::finished) {
        switch (stage_) {
            case Stage::greedy:
                outcome = run_greedy(budget);
                break;
            case Stage::find_roots:
                outcome = find_roots(budget);
                break;
            case Stage::look_ahead:
                outcome = look_ahead(budget);
                break;
            case Stage::other_routes:
                outcome = try_other_routes(budget);
                break;
            case Stage::local_search:
                outcome = run_local_search(budget);
                break;
            case Stage::finished:
                break;
        }
    }
    return outcome;
}

void StartingSearch::empty_strands()
{
    while (!space_.strands.insertion_order().empty()) {
        space_.strands.undo();
    }
}

Solver::Outcome StartingSearch::run_greedy(WorkBudget& budget)
{
    const std::uint64_t before = space_.search.expansion_count();
    const auto outcome = greedy_->run(budget.left());
    budget.charge(space_.search.expansion_count() - before);
    switch (outcome) {
        case GreedySearch::Outcome::running:
            return Solver::Outcome::running;
        case GreedySearch::Outcome::bounded:
            if (rule_ > 0) {
                return Solver::Outcome::advanced;
            }
            root_bound_ = greedy_->lower_bound();
            if (root_bound_ != kInfiniteLength) {
                for (Index e = 0; e < space_.embedding.layout().edge_count(); ++e) {
                    root_walks_.push_back(space_.pool.add(e, greedy_->candidate(e)));
                    space_.oracle.learn_unconstrained(root_walks_.back());
                }
            }
            return Solver::Outcome::bounded;
        case GreedySearch::Outcome::inserted:
            return Solver::Outcome::advanced;
        case GreedySearch::Outcome::complete:
            return take_greedy_embedding();
        case GreedySearch::Outcome::failed:
            empty_strands();
            if (root_bound_ == kInfiniteLength) {
                stage_ = Stage::finished;
                return Solver::Outcome::finished;
            }
            return after_insertion();
        case GreedySearch::Outcome::tied:
            return Solver::Outcome::tied;
    }
    return Solver::Outcome::finished;
}

Solver::Outcome StartingSearch::take_greedy_embedding()
{
    std::vector<Index> walks;
    for (const Index e : space_.strands.insertion_order()) {
        walks.push_back(space_.pool.add(e, space_.strands.darts(e)));
    }
    empty_strands();
    space_.embedding.go_to(walks);
    const auto outcome = space_.incumbent.offer(space_.embedding);
    space_.embedding.go_to({});
    if (outcome == Incumbent::Outcome::tied) {
        return Solver::Outcome::tied;
    }
    const Solver::Outcome next = after_insertion();
    return outcome == Incumbent::Outcome::accepted && next != Solver::Outcome::tied
               ? Solver::Outcome::improved
               : next;
}

/// Decides what comes after an insertion, greedy or with a look ahead. Nothing is embedded.
Solver::Outcome StartingSearch::after_insertion()
{
    if (!space_.embedding.move_strands()) {
        return Solver::Outcome::tied;
    }
    if (space_.incumbent.exists() && (first_local_search_ == 0 || gap_is_reached())) {
        stage_ = Stage::finished;
    } else if (!has_looked_ahead_ && first_local_search_ > 0) {
        begin_lookahead();
    } else if (space_.incumbent.exists()) {
        begin_local_search(first_local_search_);
    } else if (!space_.excluded.empty()) {
        other_routes_ = std::make_unique<OtherRoutes>(space_, root_walks_);
        stage_ = Stage::other_routes;
    } else if (++rule_ < kRules.size() && space_.constraints.empty()) {
        greedy_ =
            std::make_unique<GreedySearch>(problem_, space_.strands, space_.search, kRules[rule_]);
        stage_ = Stage::greedy;
    } else {
        stage_ = Stage::finished;
    }
    return Solver::Outcome::advanced;
}

bool StartingSearch::gap_is_reached() const
{
    const Length cost = space_.incumbent.cost();
    return static_cast<double>(cost - root_bound_) <= gap_ * static_cast<double>(cost);
}

/// The unconstrained path of every edge, of the classes it may take.
Solver::Outcome StartingSearch::find_roots(WorkBudget& budget)
{
    for (; next_root_ < space_.embedding.layout().edge_count(); ++next_root_) {
        const auto answer = space_.oracle.find(next_root_, kInfiniteLength, budget);
        switch (answer.outcome) {
            case PathOracle::Outcome::running:
                return Solver::Outcome::running;
            case PathOracle::Outcome::tied:
                return Solver::Outcome::tied;
            case PathOracle::Outcome::found:
                break;
            default:
                root_bound_ = kInfiniteLength;
                stage_ = Stage::finished;
                return Solver::Outcome::bounded;
        }
        root_walks_.push_back(answer.walk);
    }
    for (const Index walk : root_walks_) {
        root_bound_ += space_.pool.cost(walk);
    }
    begin_lookahead();
    return Solver::Outcome::bounded;
}

void StartingSearch::begin_lookahead()
{
    // What is constrained comes first, while there is room for it.
    std::vector<Index> first;
    for (const bool kept : {true, false}) {
        for (Index e = 0; e < root_walks_.size(); ++e) {
            if (space_.constraints.constrains(e) && space_.constraints.keeps(e) == kept) {
                first.push_back(e);
            }
        }
    }
    lookahead_ = std::make_unique<LookaheadInsertion>(space_.embedding, space_.oracle, root_walks_,
                                                      std::move(first));
    stage_ = Stage::look_ahead;
    has_looked_ahead_ = true;
}

Solver::Outcome StartingSearch::look_ahead(WorkBudget& budget)
{
    Incumbent::Outcome offered = Incumbent::Outcome::rejected;
    switch (lookahead_->run(budget)) {
        case LookaheadInsertion::Outcome::running:
            return Solver::Outcome::running;
        case LookaheadInsertion::Outcome::tied:
            return Solver::Outcome::tied;
        case LookaheadInsertion::Outcome::failed:
            break;
        case LookaheadInsertion::Outcome::complete:
            offered = space_.incumbent.offer(space_.embedding);
            break;
    }
    if (offered == Incumbent::Outcome::tied) {
        return Solver::Outcome::tied;
    }
    space_.embedding.go_to({});
    lookahead_.reset();
    const Solver::Outcome outcome = after_insertion();
    return offered == Incumbent::Outcome::accepted && outcome != Solver::Outcome::tied
               ? Solver::Outcome::improved
               : outcome;
}

/// Up to the first embedding that is not excluded.
Solver::Outcome StartingSearch::try_other_routes(WorkBudget& budget)
{
    for (;;) {
        switch (other_routes_->run(budget)) {
            case OtherRoutes::Outcome::running:
                return Solver::Outcome::running;
            case OtherRoutes::Outcome::tied:
                return Solver::Outcome::tied;
            case OtherRoutes::Outcome::finished:
                other_routes_.reset();
                stage_ = Stage::finished;
                return Solver::Outcome::advanced;
            case OtherRoutes::Outcome::complete:
                break;
        }
        switch (space_.incumbent.offer(space_.embedding)) {
            case Incumbent::Outcome::tied:
                return Solver::Outcome::tied;
            case Incumbent::Outcome::rejected:
            case Incumbent::Outcome::excluded:
                break;
            case Incumbent::Outcome::accepted:
                other_routes_.reset();
                space_.embedding.go_to({});
                return after_insertion() == Solver::Outcome::tied ? Solver::Outcome::tied
                                                                  : Solver::Outcome::improved;
        }
    }
}

void StartingSearch::begin_local_search(std::uint64_t work)
{
    local_search_ = std::make_unique<LocalSearch>(space_.embedding, space_.oracle, space_.incumbent,
                                                  root_walks_);
    local_search_->allow(work);
    stage_ = Stage::local_search;
}

bool StartingSearch::resume(std::uint64_t local_search)
{
    if (!space_.incumbent.exists()) {
        return false;
    }
    if (!local_search_) {
        begin_local_search(local_search);
        return true;
    }
    local_search_->allow(local_search);
    stage_ = local_search_->is_exhausted() ? Stage::finished : Stage::local_search;
    return stage_ == Stage::local_search;
}

Solver::Outcome StartingSearch::run_local_search(WorkBudget& budget)
{
    const auto outcome =
        gap_is_reached() ? LocalSearch::Outcome::finished : local_search_->run(budget);
    switch (outcome) {
        case LocalSearch::Outcome::running:
            return Solver::Outcome::running;
        case LocalSearch::Outcome::improved:
            return Solver::Outcome::improved;
        case LocalSearch::Outcome::tied:
            return Solver::Outcome::tied;
        case LocalSearch::Outcome::finished:
            break;
    }
    space_.embedding.go_to({});
    stage_ = Stage::finished;
    return Solver::Outcome::finished;
}

}  // namespace layout_embedding
