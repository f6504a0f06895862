#pragma once

#include "layout/embedding_problem.hh"
#include "search/greedy.hh"
#include "search/solver.hh"
#include "surface/cut_surface_search.hh"
#include "surface/distance_field.hh"
#include "surface/strands.hh"

namespace layout_embedding {

/// A greedy heuristic alone: one embedding, and the sum of the unconstrained paths as its bound.
class GreedySolver : public Solver {
public:
    /// Keeps references to problem and graph.
    GreedySolver(const EmbeddingProblem& problem, const PathGraph& graph, std::uint64_t field_bytes,
                 const GreedyRule& rule);

    Outcome run(WorkBudget& budget) override;
    Length lower_bound() const override
    {
        return greedy_.has_root_bound() ? greedy_.lower_bound() : 0;
    }
    BoundScope bound_scope() const override { return BoundScope::embeddings; }
    Length incumbent_cost() const override { return cost_; }
    const WeakEmbedding& incumbent() const override { return weak_; }
    std::vector<Index> incumbent_order() const override { return strands_.insertion_order(); }
    const std::vector<Index>& current_path(Index layout_edge) const override
    {
        return strands_.darts(layout_edge);
    }
    double progress() const override { return greedy_.progress(); }
    SearchCounters counters() const override;

private:
    Strands strands_;
    DistanceFields fields_;
    CutSurfaceSearch search_;
    GreedySearch greedy_;
    Length cost_ = kInfiniteLength;
    WeakEmbedding weak_;
};

}  // namespace layout_embedding
