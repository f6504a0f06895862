#include "search/given_solver.hh"

#include <algorithm>
#include <utility>

#include "surface/class_enumeration.hh"
#include "surface/hole_guard.hh"
#include "surface/stretch.hh"

namespace layout_embedding {

namespace {

/// Whether a walk crosses itself or turns back on its way, as no path of an embedding does.
bool is_tangled(const PathGraph& graph, const std::vector<Index>& darts)
{
    const auto turns_back = [&](Index dart, Index next) { return graph.twin(dart) == next; };
    return std::adjacent_find(darts.begin(), darts.end(), turns_back) != darts.end() ||
           walk_crosses_itself(graph, darts);
}

}  // namespace

GivenSolver::GivenSolver(const EmbeddingProblem& problem, const PathGraph& graph, DartPaths paths)
    : strands_(problem, graph), paths_(std::move(paths))
{}

Solver::Outcome GivenSolver::run(WorkBudget& budget)
{
    if (has_ended_) {
        return Outcome::finished;
    }
    has_ended_ = true;
    Length cost = 0;
    for (Index e = 0; e < paths_.size(); ++e) {
        budget.charge(paths_[e].size());
        if (is_tangled(strands_.graph(), paths_[e]) || !strands_.insert(e, paths_[e])) {
            return Outcome::finished;
        }
        Length length = 0;
        for (const Index dart : paths_[e]) {
            length += strands_.graph().dart(dart).length;
        }
        cost += strands_.weights().cost(e, length);
    }
    if (!HoleGuard(strands_).accepts()) {
        return Outcome::finished;
    }
    cost_ = cost;
    weak_ = strands_.weak_embedding();
    return Outcome::improved;
}

SearchCounters GivenSolver::counters() const
{
    SearchCounters counters;
    counters.insertions = strands_.insertion_order().size();
    return counters;
}

}  // namespace layout_embedding
