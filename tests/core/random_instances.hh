#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/random.hh"
#include "layout/embedding_problem.hh"
#include "mesh/polygon_mesh.hh"
#include "surface/cut_surface_search.hh"
#include "surface/distance_field.hh"
#include "surface/path_graph.hh"
#include "surface/strands.hh"

namespace layout_embedding::test {

/// An embedding problem with a name for messages.
struct Instance {
    std::string name;
    EmbeddingProblem problem;
};

/// A problem that is known to be one.
EmbeddingProblem problem_of(const PolygonMesh& layout, const PolygonMesh& target,
                            std::vector<Index> landmarks);

/// `count` instances on small closed targets of genus 0 (a handful to a few hundred faces, so that
/// paths crowd together) with layouts of 4 to 12 vertices and landmarks drawn at random: most of
/// them have real conflicts. The same for the same seed everywhere.
std::vector<Instance> random_instances(std::uint64_t seed, int count);

/// A path graph with everything a search in it needs.
struct SearchGround {
    SearchGround(const EmbeddingProblem& problem, std::uint64_t seed)
        : graph(PathGraph::barycentric(*problem.target, {seed, 0})),
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

}  // namespace layout_embedding::test
