#include "search/sequence_solver.hh"

namespace layout_embedding {

SequenceSolver::SequenceSolver(const EmbeddingProblem& problem, const PathGraph& graph,
                               std::uint64_t field_bytes, const SequenceSolverOptions& options)
    : options_(options),
      strands_(problem, graph),
      fields_(graph, strands_.passable(), field_bytes),
      search_(strands_, fields_),
      pool_(strands_),
      embedding_(strands_, pool_),
      oracle_(embedding_, search_, options.remember),
      stage_(options.greedy_start ? Stage::greedy : Stage::branch_and_bound),
      greedy_(options.greedy_start ? std::make_unique<GreedySearch>(problem, strands_, search_)
                                   : nullptr),
      branch_and_bound_(embedding_, oracle_, incumbent_, options.branch_and_bound)
{}

Solver::Outcome SequenceSolver::run(WorkBudget& budget)
{
    for (;;) {
        const Stage stage = stage_;
        Outcome outcome = Outcome::finished;
        switch (stage) {
            case Stage::greedy:
                outcome = run_greedy(budget);
                break;
            case Stage::local_search:
                outcome = run_local_search(budget);
                break;
            case Stage::branch_and_bound:
                return run_branch_and_bound(budget);
        }
        if (outcome != Outcome::finished) {
            return outcome;
        }
        if (stage == stage_) {
            stage_ = Stage::branch_and_bound;
        }
    }
}

Solver::Outcome SequenceSolver::run_greedy(WorkBudget& budget)
{
    const std::uint64_t before = search_.expansion_count();
    const auto outcome = greedy_->run(budget.left());
    budget.charge(search_.expansion_count() - before);
    switch (outcome) {
        case GreedySearch::Outcome::running:
            return Outcome::running;
        case GreedySearch::Outcome::bounded:
            root_bound_ = greedy_->lower_bound();
            if (root_bound_ != kInfiniteLength) {
                for (Index e = 0; e < embedding_.layout().edge_count(); ++e) {
                    root_walks_.push_back(pool_.add(e, greedy_->candidate(e)));
                    oracle_.learn_unconstrained(root_walks_.back());
                }
            }
            return Outcome::bounded;
        case GreedySearch::Outcome::inserted:
            return Outcome::advanced;
        case GreedySearch::Outcome::complete:
            return take_greedy_embedding();
        case GreedySearch::Outcome::failed:
            while (!strands_.insertion_order().empty()) {
                strands_.undo();
            }
            return Outcome::finished;
        case GreedySearch::Outcome::tied:
            return Outcome::tied;
    }
    return Outcome::finished;
}

Solver::Outcome SequenceSolver::take_greedy_embedding()
{
    std::vector<Index> walks;
    for (const Index e : strands_.insertion_order()) {
        walks.push_back(pool_.add(e, strands_.darts(e)));
    }
    while (!strands_.insertion_order().empty()) {
        strands_.undo();
    }
    embedding_.go_to(walks);
    if (incumbent_.offer(embedding_) == Incumbent::Outcome::tied) {
        return Outcome::tied;
    }
    if (options_.local_search) {
        local_search_ = std::make_unique<LocalSearch>(embedding_, oracle_, incumbent_, root_walks_);
        stage_ = Stage::local_search;
    } else {
        embedding_.go_to({});
        stage_ = Stage::branch_and_bound;
    }
    return Outcome::improved;
}

Solver::Outcome SequenceSolver::run_local_search(WorkBudget& budget)
{
    const double gap = static_cast<double>(incumbent_.cost() - root_bound_) /
                       static_cast<double>(incumbent_.cost());
    const auto outcome = gap <= options_.branch_and_bound.gap ? LocalSearch::Outcome::finished
                                                              : local_search_->run(budget);
    switch (outcome) {
        case LocalSearch::Outcome::running:
            return Outcome::running;
        case LocalSearch::Outcome::improved:
            return Outcome::improved;
        case LocalSearch::Outcome::tied:
            return Outcome::tied;
        case LocalSearch::Outcome::finished:
            break;
    }
    embedding_.go_to({});
    local_search_.reset();
    return Outcome::finished;
}

Solver::Outcome SequenceSolver::run_branch_and_bound(WorkBudget& budget)
{
    for (;;) {
        switch (branch_and_bound_.run(budget)) {
            case BranchAndBound::Outcome::running:
                return Outcome::running;
            case BranchAndBound::Outcome::bounded:
                if (branch_and_bound_.lower_bound() <= root_bound_) {
                    continue;  // known since the greedy start
                }
                root_bound_ = std::max(root_bound_, branch_and_bound_.root_bound());
                return Outcome::bounded;
            case BranchAndBound::Outcome::improved:
                return Outcome::improved;
            case BranchAndBound::Outcome::finished:
                return Outcome::finished;
            case BranchAndBound::Outcome::tied:
                return Outcome::tied;
        }
    }
}

Length SequenceSolver::lower_bound() const
{
    return std::max(root_bound_, branch_and_bound_.lower_bound());
}

BoundScope SequenceSolver::bound_scope() const
{
    const Length root_bound = std::max(root_bound_, branch_and_bound_.root_bound());
    return lower_bound() == root_bound ? BoundScope::embeddings : BoundScope::insertion_sequences;
}

std::vector<Index> SequenceSolver::incumbent_order() const
{
    std::vector<Index> edges;
    for (const Index walk : incumbent_.walks()) {
        edges.push_back(pool_.layout_edge(walk));
    }
    return edges;
}

double SequenceSolver::progress() const
{
    return greedy_ ? greedy_->progress() : 0;
}

SearchCounters SequenceSolver::counters() const
{
    SearchCounters counters = branch_and_bound_.counters();
    counters.searches = search_.search_count();
    counters.expansions = search_.expansion_count();
    counters.field_nodes = fields_.settled_count();
    counters.insertions = embedding_.insertion_count();
    counters.remembered = oracle_.remembered_count();
    return counters;
}

}  // namespace layout_embedding
