#include "search/exact_solver.hh"

#include <algorithm>

namespace layout_embedding {

namespace {

// The first exploration of an edge expands a share of the nodes, each further one twice as many.
constexpr std::uint64_t kFirstExplorationShare = 4;
constexpr std::uint64_t kMaxFirstExploration = 60'000;
constexpr unsigned kMaxExplorations = 4;
// Where the selection wants classes, edges are explored as long as that had less than this share of
// all work.
constexpr std::uint64_t kExplorationShare = 2;
// Nothing is explored any more once so many classes are known: which of them cross takes memory for
// all pairs.
constexpr Index kMaxExploredClasses = 8192;
// How far the first exploration of an edge goes beyond its shortest path: what the incumbent costs
// more than the root bound, divided among the open edges, so many times; as power of two. Each
// further one goes twice as far.
constexpr unsigned kFirstShares = 1;
// Expansions after which an enumeration beside other walks is over as soon as it has raised its
// bound, and how many more it gets at a time if it has not.
constexpr std::uint64_t kEnumeration = 20'000;
constexpr std::uint64_t kMoreEnumeration = 1000;
// Units of work that local search gets at a time, at first and then as long as it had less than
// this share of all.
constexpr std::uint64_t kLocalSearch = 100'000;
constexpr std::uint64_t kLocalSearchShare = 10;
// Where bound and incumbent are this close, as a share of the cost, it gets less: what it comes
// across are more classes for the selection to choose from.
constexpr double kCloseGap = 0.05;
constexpr std::uint64_t kLocalSearchShareIfClose = 40;

std::vector<bool> linear_vertices(const Strands& strands)
{
    std::vector<bool> linear;
    for (Index v = 0; v < strands.layout().vertex_count(); ++v) {
        linear.push_back(strands.graph().is_boundary(strands.landmark_node(v)));
    }
    return linear;
}

}  // namespace

ExactSolver::ExactSolver(const EmbeddingProblem& problem, const PathGraph& graph,
                         std::uint64_t field_bytes, const ExactSolverOptions& options)
    : options_(options),
      graph_(graph),
      space_(problem, graph, field_bytes, true, options.constraints, options.excluded),
      start_(problem, space_, options.local_search ? kLocalSearch : 0, options.gap),
      selection_(*problem.layout, space_.pool,
                 options.faces
                     ? std::optional(FaceLoops(*problem.layout, graph, space_.pool, space_.cuts))
                     : std::nullopt,
                 linear_vertices(space_.strands), options.patience),
      enumeration_(space_.strands, space_.fields),
      rest_bounds_(problem.layout->edge_count()),
      explorations_(problem.layout->edge_count())
{
    for (Index node = 0; node < graph.node_count() && !has_holes_; ++node) {
        has_holes_ = graph.is_boundary(node);
    }
}

Length ExactSolver::lower_bound() const
{
    return std::max(start_.root_bound(),
                    std::min(selection_.lower_bound(), space_.incumbent.cost()));
}

bool ExactSolver::gap_is_at_most(double gap) const
{
    const Length cost = space_.incumbent.cost();
    return space_.incumbent.exists() &&
           static_cast<double>(cost - lower_bound()) <= gap * static_cast<double>(cost);
}

/// Local search goes on as long as it had less than its share of all work.
bool ExactSolver::is_local_search_up() const
{
    return options_.local_search && is_between_ &&
           start_.local_search_work() *
                   (gap_is_at_most(kCloseGap) ? kLocalSearchShareIfClose : kLocalSearchShare) <
               work_;
}

bool ExactSolver::bound_has_risen()
{
    const Length bound = lower_bound();
    if (bound < told_bound_ + told_bound_ / 1000 + 1) {
        return false;
    }
    told_bound_ = bound;
    return true;
}

Length ExactSolver::base(Index layout_edge) const
{
    return space_.pool.cost(start_.root_walks()[layout_edge]);
}

/// All classes that cost less are known of the edge whose classes are enumerated.
Length ExactSolver::frontier() const
{
    return space_.strands.weights().cost(open_[next_open_].edge, enumeration_.frontier());
}

Solver::Outcome ExactSolver::run(WorkBudget& budget)
{
    while (stage_ != Stage::finished) {
        const std::uint64_t before = budget.spent();
        const bool explores = stage_ == Stage::enumerate && is_exploration_;
        const Outcome outcome = step(budget);
        work_ += budget.spent() - before;
        exploration_work_ += explores ? budget.spent() - before : 0;
        is_between_ = outcome != Outcome::running;
        if (outcome != Outcome::finished) {
            return outcome;
        }
    }
    return Outcome::finished;
}

/// Continues the present stage; `finished` if another one is up.
Solver::Outcome ExactSolver::step(WorkBudget& budget)
{
    switch (stage_) {
        case Stage::start:
            return begin(budget);
        case Stage::select:
            return select(budget);
        case Stage::explore:
            return explore();
        case Stage::examine:
            return examine(budget);
        case Stage::enumerate:
            return enumerate(budget);
        case Stage::complete:
            return complete(budget);
        case Stage::improve:
            return improve(budget);
        case Stage::finished:
            break;
    }
    return Outcome::finished;
}

Solver::Outcome ExactSolver::begin(WorkBudget& budget)
{
    const Outcome outcome = start_.run(budget);
    if (outcome != Outcome::finished) {
        return outcome;
    }
    if (start_.root_bound() == kInfiniteLength) {
        stage_ = Stage::finished;
        return Outcome::finished;
    }
    for (Index e = 0; e < rest_bounds_.size(); ++e) {
        selection_.set_base(e, base(e));
    }
    told_bound_ = start_.root_bound();
    selection_.lower_upper_bound(space_.incumbent.cost());
    learn();
    for (Index e = 0; e < rest_bounds_.size(); ++e) {
        if (space_.constraints.keeps(e)) {
            add_rest_bound(e, {}, kInfiniteLength);  // no other class counts
        }
    }
    stage_ = Stage::select;
    return Outcome::finished;
}

/// Tells the selection what searches have found since the last time.
void ExactSolver::learn()
{
    for (; learned_walks_ < space_.pool.size(); ++learned_walks_) {
        selection_.add_class(learned_walks_);
    }
    const auto& explanations = space_.oracle.explanations();
    for (; learned_explanations_ < explanations.size(); ++learned_explanations_) {
        const auto& explanation = explanations[learned_explanations_];
        selection_.add_bound(explanation.layout_edge, explanation.blockers, explanation.bound);
    }
    space_.excluded.for_each_new([&](std::span<const Index> walks) { selection_.forbid(walks); });
}

Solver::Outcome ExactSolver::select(WorkBudget& budget)
{
    if (gap_is_at_most(options_.gap)) {
        stage_ = Stage::finished;
        return Outcome::finished;
    }
    if (is_local_search_up() && start_.resume(kLocalSearch)) {
        stage_ = Stage::improve;
        return Outcome::finished;
    }
    const auto outcome = selection_.run(budget);
    switch (outcome) {
        case ClassSelection::Outcome::running:
            return Outcome::running;
        case ClassSelection::Outcome::raised:
            return bound_has_risen() ? Outcome::bounded : Outcome::finished;
        case ClassSelection::Outcome::wants_classes:
            explore_wanted();
            break;
        case ClassSelection::Outcome::exceeded:
            stage_ = Stage::finished;
            break;
        case ClassSelection::Outcome::satisfied:
        case ClassSelection::Outcome::optimal:
            ++counters_.states_created;
            look_into(outcome == ClassSelection::Outcome::optimal);
            break;
    }
    return Outcome::finished;
}

/// Explores edges of which the selection would gain from knowing more.
void ExactSolver::explore_wanted()
{
    if (!options_.exploration || exploration_work_ * kExplorationShare >= work_) {
        return;
    }
    open_.clear();
    next_open_ = 0;
    for (const Index e : selection_.wanted()) {
        open_.push_back({e, 0});
    }
    is_wanted_ = true;
    stage_ = Stage::explore;
}

/// Goes to the selection's known classes, and decides what to do about it.
void ExactSolver::look_into(bool is_optimal)
{
    std::vector<Index> walks;
    open_.clear();
    next_open_ = 0;
    for (Index e = 0; e < rest_bounds_.size(); ++e) {
        const Index walk = selection_.choice(e);
        if (walk == kNone) {
            open_.push_back({e, 0});
        } else {
            walks.push_back(walk);
        }
    }
    space_.embedding.go_to(walks);
    cost_ = space_.embedding.cost();
    for (OpenEdge& open : open_) {
        open.bound = rest_bound(open.edge);
        cost_ = open.bound == kInfiniteLength
                    ? kInfiniteLength
                    : cost_ + std::min(open.bound, kInfiniteLength - cost_);
    }
    const Length incumbent = space_.incumbent.cost();
    if (cost_ >= incumbent) {
        return;  // of no interest, whatever its unknown classes turn out to be
    }
    if (open_.empty()) {
        stage_ = Stage::complete;
        return;
    }
    // Far from the cheapest, what is open is so by accident.
    const Length bound = selection_.lower_bound();
    if (is_optimal || (space_.incumbent.exists() && cost_ - bound <= (incumbent - bound) / 2)) {
        ++counters_.states_expanded;
        has_explored_ = false;
        is_wanted_ = false;
        // Without an incumbent nothing says how far to explore: first of all, an embedding. Where
        // holes are in the way it takes classes that lead around them.
        stage_ = (options_.exploration && space_.incumbent.exists()) || has_holes_ ? Stage::explore
                                                                                   : Stage::examine;
    }
}

/// What an edge costs at least beside the embedded walks if it takes no known class.
Length ExactSolver::rest_bound(Index layout_edge) const
{
    Length bound = std::max(base(layout_edge), space_.oracle.known_bound(layout_edge));
    for (const RestBound& rest : rest_bounds_[layout_edge]) {
        if (rest.bound <= bound) {
            break;
        }
        if (std::all_of(rest.blockers.begin(), rest.blockers.end(), [&](Index walk) {
                return space_.embedding.walk(space_.pool.layout_edge(walk)) == walk;
            })) {
            bound = rest.bound;
        }
    }
    return bound;
}

void ExactSolver::add_rest_bound(Index layout_edge, std::vector<Index> blockers, Length bound)
{
    selection_.add_bound(layout_edge, blockers, bound);
    auto& bounds = rest_bounds_[layout_edge];
    const auto place = std::find_if(bounds.begin(), bounds.end(),
                                    [&](const RestBound& other) { return other.bound < bound; });
    bounds.insert(place, {bound, std::move(blockers)});
}

/// Takes note of what the open edge that is up costs at least.
void ExactSolver::raise_open_bound(Length bound)
{
    Length& known = open_[next_open_].bound;
    if (bound > known) {
        cost_ = bound == kInfiniteLength ? kInfiniteLength : cost_ + (bound - known);
        known = bound;
    }
}

/// From this length on, a path of the open edge that is up makes the selection too expensive.
Length ExactSolver::open_limit() const
{
    return space_.incumbent.exists() ? open_[next_open_].bound + (space_.incumbent.cost() - cost_)
                                     : kInfiniteLength;
}

/// Enumerates classes of the open edges whatever the others do, as long as not much has gone into
/// that. What comes of it holds in all selections.
Solver::Outcome ExactSolver::explore()
{
    const std::uint64_t first = std::min<std::uint64_t>(
        kMaxFirstExploration, 1 + graph_.node_count() / kFirstExplorationShare);
    const Length slack = space_.incumbent.cost() - start_.root_bound();
    for (; next_open_ < open_.size(); ++next_open_) {
        const Index edge = open_[next_open_].edge;
        Exploration& exploration = explorations_[edge];
        if (exploration.rounds >= kMaxExplorations ||
            selection_.class_count() >= kMaxExploredClasses ||
            (space_.incumbent.exists() && exploration.frontier >= base(edge) + slack)) {
            continue;
        }
        Length limit = kInfiniteLength;
        const unsigned rounds = exploration.rounds++;
        if (space_.incumbent.exists()) {
            const Length share = slack / open_.size() + 1;
            const unsigned doublings = kFirstShares + rounds;
            limit = base(edge) + (share < (slack >> doublings) ? share << doublings : slack);
            limit = limit > exploration.frontier ? limit : base(edge) + slack;
        }
        is_exploration_ = true;
        has_explored_ = true;
        space_.embedding.go_to({});
        return begin_enumeration(edge, limit, first << rounds) ? Outcome::finished : Outcome::tied;
    }
    next_open_ = 0;
    stage_ = has_explored_ || is_wanted_ ? Stage::select : Stage::examine;
    return Outcome::finished;
}

/// Looks for the open edges' shortest paths beside the selected walks.
Solver::Outcome ExactSolver::examine(WorkBudget& budget)
{
    for (; next_open_ < open_.size() && cost_ < space_.incumbent.cost(); ++next_open_) {
        const Index edge = open_[next_open_].edge;
        const auto answer = space_.oracle.find(edge, open_limit(), budget);
        if (answer.outcome == PathOracle::Outcome::running) {
            return Outcome::running;
        }
        if (answer.outcome == PathOracle::Outcome::tied) {
            return Outcome::tied;
        }
        const bool is_known =
            answer.outcome == PathOracle::Outcome::found && answer.walk < learned_walks_;
        learn();
        raise_open_bound(answer.bound);
        if (is_known || answer.outcome == PathOracle::Outcome::given_up) {
            // The shortest class is known, and was not taken: another one is meant.
            is_exploration_ = false;
            return begin_enumeration(edge, open_limit(), kEnumeration) ? Outcome::finished
                                                                       : Outcome::tied;
        }
    }
    stage_ = cost_ < space_.incumbent.cost() ? Stage::complete : Stage::select;
    return Outcome::finished;
}

/// Begins to enumerate classes beside the embedded walks; false if these cannot be embedded, which
/// only a tie that went unnoticed could cause.
bool ExactSolver::begin_enumeration(Index edge, Length limit, std::uint64_t expansions)
{
    if (!space_.embedding.move_strands()) {
        return false;
    }
    enumeration_.begin(space_.cuts.of(edge), edge, space_.strands.weights().length(edge, limit));
    expansions_ = 0;
    max_expansions_ = expansions;
    stage_ = Stage::enumerate;
    return true;
}

Solver::Outcome ExactSolver::enumerate(WorkBudget& budget)
{
    const OpenEdge& open = open_[next_open_];
    for (;;) {
        if (expansions_ >= max_expansions_) {
            if (is_exploration_ || frontier() > open.bound) {
                end_enumeration();
                return Outcome::finished;
            }
            max_expansions_ += kMoreEnumeration;
        }
        if (budget.is_spent()) {
            return Outcome::running;
        }
        const std::uint64_t before = enumeration_.expansion_count();
        const std::uint64_t work_before = enumeration_.work_count();
        const auto outcome = enumeration_.run(max_expansions_ - expansions_, budget.left());
        const std::uint64_t expansions = enumeration_.expansion_count() - before;
        expansions_ += expansions;
        counters_.expansions += expansions;
        budget.charge(enumeration_.work_count() - work_before);
        switch (outcome) {
            case ClassEnumeration::Outcome::running:
                break;
            case ClassEnumeration::Outcome::tied:
                return Outcome::tied;
            case ClassEnumeration::Outcome::exceeded:
                end_enumeration();
                return Outcome::finished;
            case ClassEnumeration::Outcome::found:
                if (space_.constraints.admit(open.edge, enumeration_.darts())) {
                    space_.pool.add(open.edge, enumeration_.darts());
                    learn();
                }
                break;
        }
    }
}

/// Takes note of how far the enumeration has come.
void ExactSolver::end_enumeration()
{
    const Index edge = open_[next_open_].edge;
    const Length frontier = this->frontier();
    std::vector<Index> blockers = enumeration_.blockers();
    for (Index& blocker : blockers) {
        blocker = space_.embedding.walk(blocker);
    }
    add_rest_bound(edge, std::move(blockers), frontier);
    if (is_exploration_) {
        explorations_[edge].frontier = frontier;
        stage_ = Stage::explore;
    } else {
        raise_open_bound(frontier);
        stage_ = Stage::examine;
    }
    ++next_open_;
}

/// Makes an embedding of the selection, its open edges along the shortest paths that are left.
Solver::Outcome ExactSolver::complete(WorkBudget& budget)
{
    stage_ = Stage::select;
    for (const OpenEdge& open : open_) {
        if (space_.embedding.walk(open.edge) != kNone) {
            continue;
        }
        const Length incumbent = space_.incumbent.cost();
        if (space_.embedding.cost() >= incumbent) {
            return Outcome::finished;
        }
        const auto answer = space_.oracle.find(
            open.edge,
            space_.incumbent.exists() ? incumbent - space_.embedding.cost() : kInfiniteLength,
            budget);
        if (answer.outcome == PathOracle::Outcome::running) {
            stage_ = Stage::complete;
            return Outcome::running;
        }
        if (answer.outcome == PathOracle::Outcome::tied) {
            return Outcome::tied;
        }
        learn();
        if (answer.outcome != PathOracle::Outcome::found) {
            return Outcome::finished;
        }
        switch (space_.embedding.insert(answer.walk)) {
            case PartialEmbedding::Insertion::done:
                break;
            case PartialEmbedding::Insertion::refused:
                return Outcome::finished;
            case PartialEmbedding::Insertion::torn:
                return Outcome::tied;
        }
    }
    return offer();
}

Solver::Outcome ExactSolver::offer()
{
    if (has_holes_) {
        if (!space_.embedding.move_strands()) {
            return Outcome::tied;
        }
        const std::vector<Index> misplaced = space_.embedding.walks_around_misplaced_hole();
        if (!misplaced.empty()) {
            selection_.forbid(misplaced);
            return Outcome::finished;
        }
    }
    switch (space_.incumbent.offer(space_.embedding)) {
        case Incumbent::Outcome::tied:
            return Outcome::tied;
        case Incumbent::Outcome::rejected:
        case Incumbent::Outcome::excluded:
            return Outcome::finished;
        case Incumbent::Outcome::accepted:
            break;
    }
    selection_.lower_upper_bound(space_.incumbent.cost());
    return Outcome::improved;
}

/// Local search goes on for a while.
Solver::Outcome ExactSolver::improve(WorkBudget& budget)
{
    const Outcome outcome = start_.run(budget);
    if (outcome == Outcome::improved) {
        selection_.lower_upper_bound(space_.incumbent.cost());
    } else if (outcome == Outcome::finished) {
        learn();
        stage_ = Stage::select;
    }
    return outcome;
}

SearchCounters ExactSolver::counters() const
{
    SearchCounters counters = counters_;
    counters += space_.counters();
    return counters;
}

}  // namespace layout_embedding
