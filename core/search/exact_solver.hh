#pragma once

#include <vector>

#include "layout/embedding_problem.hh"
#include "search/class_selection.hh"
#include "search/search_space.hh"
#include "search/solver.hh"
#include "search/starting_search.hh"
#include "surface/class_enumeration.hh"

namespace layout_embedding {

struct ExactSolverOptions {
    /// The gap to be reached; 0 asks for the optimum.
    double gap = 0;
    /// What is asked of single edges. Bounds are those of the embeddings that comply.
    std::vector<ClassConstraint> constraints;
    /// Embeddings that do not count (ExcludedEmbeddings), as those found before when the next best
    /// is asked for. Bounds are those of all others.
    std::vector<DartPaths> excluded;
    /// Parts that can be switched off to see what they contribute; the optimum stays the same.
    /// Improve the start by insertion that looks ahead and local search on insertion orders.
    bool local_search = true;
    /// Enumerate classes of edges whatever the others do, before it is done beside others.
    bool exploration = true;
    /// Tell the selection what the layout's faces demand of the classes around them.
    bool faces = true;
    /// Units of work after which branch and bound helps where the selection's clauses are stuck
    /// (ClassSelection); 0 for branch and bound from the start.
    std::uint64_t patience = 200'000;
};

/// The best of all embeddings (design, Sec. 3): after a start by insertion, the cheapest selection
/// of one homotopy class per layout edge.
///
/// Classes become known where they matter. Where a cheapest selection, or one nearly as cheap,
/// leaves an edge *open*, in a class that is not known yet, more of the edge's classes are
/// enumerated, first whatever the other edges do, later beside their selected walks. Each time this
/// leaves new classes or a higher bound for those unknown, until a cheapest selection has known
/// classes only, which is the best embedding, or costs no less than the incumbent. In the counters,
/// selections stand in for states: all (created) and those looked into (expanded).
class ExactSolver : public Solver {
public:
    /// Keeps references to problem and graph.
    ExactSolver(const EmbeddingProblem& problem, const PathGraph& graph, std::uint64_t field_bytes,
                const ExactSolverOptions& options);

    Outcome run(WorkBudget& budget) override;
    Length lower_bound() const override;
    BoundScope bound_scope() const override { return BoundScope::embeddings; }
    Length incumbent_cost() const override { return space_.incumbent.cost(); }
    const WeakEmbedding& incumbent() const override { return space_.incumbent.weak_embedding(); }
    std::vector<Index> incumbent_order() const override { return space_.incumbent_order(); }
    const std::vector<Index>& current_path(Index layout_edge) const override
    {
        return space_.strands.darts(layout_edge);
    }
    double progress() const override { return start_.progress(); }
    SearchCounters counters() const override;

private:
    enum class Stage { start, select, explore, examine, enumerate, complete, improve, finished };

    /// A bound on all classes of an edge that are not known, where it is beside these walks.
    struct RestBound {
        Length bound;
        std::vector<Index> blockers;
    };
    /// How far the classes of an edge have been enumerated whatever the other edges do.
    struct Exploration {
        unsigned rounds = 0;  // of them so far
        Length frontier = 0;
    };
    /// An edge without a known class in the selection that is being looked into.
    struct OpenEdge {
        Index edge;
        /// What it costs at least beside the others' selected walks.
        Length bound;
    };

    Outcome step(WorkBudget& budget);
    Outcome begin(WorkBudget& budget);
    void learn();
    Outcome select(WorkBudget& budget);
    void explore_wanted();
    void look_into(bool is_optimal);
    Outcome explore();
    Outcome examine(WorkBudget& budget);
    bool begin_enumeration(Index edge, Length limit, std::uint64_t expansions);
    Outcome enumerate(WorkBudget& budget);
    void end_enumeration();
    Outcome complete(WorkBudget& budget);
    Outcome offer();
    Outcome improve(WorkBudget& budget);

    Length base(Index layout_edge) const;
    Length frontier() const;
    Length rest_bound(Index layout_edge) const;
    void add_rest_bound(Index layout_edge, std::vector<Index> blockers, Length bound);
    void raise_open_bound(Length bound);
    Length open_limit() const;
    bool gap_is_at_most(double gap) const;
    bool is_local_search_up() const;
    bool bound_has_risen();

    ExactSolverOptions options_;
    const PathGraph& graph_;
    SearchSpace space_;
    StartingSearch start_;
    ClassSelection selection_;
    ClassEnumeration enumeration_;
    bool has_holes_ = false;
    Stage stage_ = Stage::start;
    std::uint64_t work_ = 0;
    std::uint64_t exploration_work_ = 0;
    bool is_between_ = false;  // the last step came to its end

    // What the selection has been told of.
    Index learned_walks_ = 0;
    std::size_t learned_explanations_ = 0;

    std::vector<std::vector<RestBound>> rest_bounds_;  // per layout edge, the largest first
    std::vector<Exploration> explorations_;            // per layout edge

    // The selection that is being looked into.
    std::vector<OpenEdge> open_;
    std::size_t next_open_ = 0;
    Length cost_ = 0;  // at least

    // The enumeration that is going on, for open_[next_open_].
    bool is_exploration_ = false;
    bool is_wanted_ = false;  // edges are explored since the selection wants it
    bool has_explored_ = false;
    std::uint64_t expansions_ = 0;
    std::uint64_t max_expansions_ = 0;

    Length told_bound_ = 0;
    SearchCounters counters_;
};

}  // namespace layout_embedding
