#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/random.hh"
#include "layout/embedding_problem.hh"
#include "surface/cut_surface_search.hh"
#include "surface/distance_field.hh"
#include "surface/path_graph.hh"
#include "surface/strands.hh"
#include "surface/weak_embedding.hh"

namespace layout_embedding::test {

/// A path graph with everything a search in it needs.
struct SearchGround {
    SearchGround(const EmbeddingProblem& problem, std::uint64_t seed)
        : SearchGround(problem, PathGraph::Options{seed, 0})
    {}
    SearchGround(const EmbeddingProblem& problem, const PathGraph::Options& options)
        : graph(PathGraph::barycentric(*problem.target, options)),
          strands(problem, graph),
          fields(graph, strands.passable(), std::uint64_t{1} << 30U),
          search(strands, fields)
    {}

    PathGraph graph;
    Strands strands;
    DistanceFields fields;
    CutSurfaceSearch search;
};

/// The numbers 0 .. count-1 in a random order.
std::vector<Index> random_order(Index count, Random& random);

/// The layout's edges in a random order that begins with a spanning tree: on closed surfaces of
/// genus 0 such an order can always be inserted to its end.
std::vector<Index> random_tree_first_order(const Layout& layout, Random& random);

/// Inserts the layout edges one by one in random order along shortest paths, a spanning tree
/// first; nothing if an edge is blocked or a hole gets to the wrong side.
std::optional<WeakEmbedding> insert_in_random_order(const EmbeddingProblem& problem,
                                                    const PathGraph& graph, Random& random);

}  // namespace layout_embedding::test
