#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "layout/embedding_problem.hh"
#include "mesh/polygon_mesh.hh"
#include "surface/path_graph.hh"
#include "surface/weak_embedding.hh"

/// Embedding problems for tests. Which to use:
///
/// - zoo.hh has the meshes alone, by name and as lists: for tests of meshes and layouts, and for a
///   problem with a certain shape or difficulty, by problem_of().
/// - random_instances(): problems on small spheres in which paths are in each other's way, for
/// tests
///   of searches.
/// - embedded_instances(): problems of every topology together with an embedding that is not a
/// short
///   one, for tests of what is done with an embedding.
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

/// Likewise with layouts of 6 to 9 edges, so small that a test can try every insertion sequence.
std::vector<Instance> tiny_instances(std::uint64_t seed, int count);

/// An instance whose best embedding no insertion sequence reaches (paper, Sec. 6), as small as
/// tests/experiments/find_counterexamples made one: seven layout edges in twelve target vertices.
Instance smallest_counterexample();

/// A problem and an embedding of it, not a short one.
struct EmbeddedInstance {
    std::string name;
    EmbeddingProblem problem;
    PathGraph graph;
    WeakEmbedding weak;
};

/// Embeddings with random landmarks and random orders of insertion: every layout of the zoo on
/// every small target that can hold it, some with landmarks on the boundary, and
/// random_instances(); up to dozens of strands over one edge. The same ones for the same seed.
std::vector<EmbeddedInstance> embedded_instances(std::uint64_t seed);

}  // namespace layout_embedding::test
