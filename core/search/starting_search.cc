#include "search/starting_search.hh"

#include <array>

namespace layout_embedding {

namespace {

// Where local search goes on for long, bounds are what is missing.
constexpr std::uint64_t kMaxLocalSearchWork = 6'000'000;

// One after the other, until one ends in an embedding. On closed surfaces of genus 0 the first
// does.
constexpr std::array<GreedyRule, 4> kRules{GreedyRule::plain(), GreedyRule::schreiner(),
                                           GreedyRule::kraevoy(), GreedyRule::praun()};

}  // namespace

StartingSearch::StartingSearch(const EmbeddingProblem& problem, SearchSpace& space,
                               bool local_search, double gap)
    : problem_(problem),
      space_(space),
      wants_local_search_(local_search),
      gap_(gap),
      greedy_(std::make_unique<GreedySearch>(problem, space.strands, space.search, kRules[0]))
{}

Solver::Outcome StartingSearch::run(WorkBudget& budget)
{
    Solver::Outcome outcome = Solver::Outcome::finished;
    while (outcome == Solver::Outcome::finished && stage_ != Stage::finished) {
        outcome = stage_ == Stage::greedy ? run_greedy(budget) : run_local_search(budget);
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
            if (root_bound_ == kInfiniteLength || ++rule_ == kRules.size()) {
                stage_ = Stage::finished;
                return Solver::Outcome::finished;
            }
            greedy_ = std::make_unique<GreedySearch>(problem_, space_.strands, space_.search,
                                                     kRules[rule_]);
            return Solver::Outcome::advanced;
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
    if (space_.incumbent.offer(space_.embedding) == Incumbent::Outcome::tied) {
        return Solver::Outcome::tied;
    }
    stage_ = wants_local_search_ ? Stage::local_search : Stage::finished;
    if (wants_local_search_) {
        local_search_ = std::make_unique<LocalSearch>(
            space_.embedding, space_.oracle, space_.incumbent, root_walks_, kMaxLocalSearchWork);
    } else {
        space_.embedding.go_to({});
    }
    return Solver::Outcome::improved;
}

Solver::Outcome StartingSearch::run_local_search(WorkBudget& budget)
{
    const Length cost = space_.incumbent.cost();
    const double gap = static_cast<double>(cost - root_bound_) / static_cast<double>(cost);
    const auto outcome = gap > gap_ ? local_search_->run(budget) : LocalSearch::Outcome::finished;
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
    local_search_.reset();
    stage_ = Stage::finished;
    return Solver::Outcome::finished;
}

}  // namespace layout_embedding
