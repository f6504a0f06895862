#pragma once

#include <vector>

#include "layout/embedding_problem.hh"
#include "search/excluded_embeddings.hh"
#include "search/solver.hh"
#include "surface/strands.hh"

namespace layout_embedding {

/// Takes an embedding as it is given, as a rule one found earlier: its paths, without any search.
/// Proves nothing. Ends without an embedding where the paths meet, cross themselves, or leave a
/// landmark in another order than the layout's.
class GivenSolver : public Solver {
public:
    /// Keeps a reference to `graph`.
    GivenSolver(const EmbeddingProblem& problem, const PathGraph& graph, DartPaths paths);

    Outcome run(WorkBudget& budget) override;
    Length lower_bound() const override { return 0; }
    BoundScope bound_scope() const override { return BoundScope::embeddings; }
    Length incumbent_cost() const override { return cost_; }
    const WeakEmbedding& incumbent() const override { return weak_; }
    std::vector<Index> incumbent_order() const override { return strands_.insertion_order(); }
    const std::vector<Index>& current_path(Index layout_edge) const override
    {
        return strands_.darts(layout_edge);
    }
    double progress() const override { return has_ended_ ? 1 : 0; }
    SearchCounters counters() const override;

private:
    Strands strands_;
    DartPaths paths_;
    bool has_ended_ = false;
    Length cost_ = kInfiniteLength;
    WeakEmbedding weak_;
};

}  // namespace layout_embedding
