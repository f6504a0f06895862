#pragma once

#include "layout/embedding_problem.hh"
#include "search/class_constraints.hh"
#include "search/excluded_embeddings.hh"
#include "search/incumbent.hh"
#include "search/partial_embedding.hh"
#include "search/path_oracle.hh"
#include "search/solver.hh"
#include "surface/cut_surface_search.hh"
#include "surface/cut_systems.hh"
#include "surface/distance_field.hh"
#include "surface/strands.hh"
#include "surface/walk_pool.hh"

namespace layout_embedding {

/// What the solvers search in: the embedded strands and the shortest paths beside them, the walks
/// met so far with what is known of them, and the best embedding. One owner at a time moves the
/// strands.
struct SearchSpace {
    /// Keeps a reference to `graph`. `field_bytes`: see DistanceFields.
    SearchSpace(const EmbeddingProblem& problem, const PathGraph& graph, std::uint64_t field_bytes,
                bool remember = true, const std::vector<ClassConstraint>& class_constraints = {},
                const std::vector<DartPaths>& excluded_embeddings = {})
        : strands(problem, graph),
          fields(graph, strands.passable(), field_bytes),
          search(strands, fields),
          cuts(strands),
          constraints(cuts, graph, class_constraints),
          pool(strands),
          excluded(cuts, pool, excluded_embeddings),
          embedding(strands, pool),
          oracle(embedding, search, remember),
          incumbent(excluded)
    {
        if (!constraints.empty()) {
            oracle.constrain(constraints, cuts, fields);
        }
    }
    SearchSpace(const SearchSpace&) = delete;
    SearchSpace& operator=(const SearchSpace&) = delete;

    /// The counts of all searches here.
    SearchCounters counters() const
    {
        SearchCounters counters;
        counters.searches = search.search_count();
        counters.expansions = search.expansion_count() + oracle.enumerated_count();
        counters.field_nodes = fields.settled_count();
        counters.insertions = embedding.insertion_count();
        counters.remembered = oracle.remembered_count();
        return counters;
    }
    /// The order of the incumbent's insertions, as layout edges.
    std::vector<Index> incumbent_order() const
    {
        std::vector<Index> edges;
        for (const Index walk : incumbent.walks()) {
            edges.push_back(pool.layout_edge(walk));
        }
        return edges;
    }

    Strands strands;
    DistanceFields fields;
    CutSurfaceSearch search;
    CutSystems cuts;
    ClassConstraints constraints;
    WalkPool pool;
    ExcludedEmbeddings excluded;
    PartialEmbedding embedding;
    PathOracle oracle;
    Incumbent incumbent;
};

}  // namespace layout_embedding
