#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/random.hh"
#include "layout/embedding_problem.hh"
#include "surface/path_graph.hh"
#include "surface/weak_embedding.hh"

namespace layout_embedding::test {

/// A problem and an embedding of it, not a short one.
struct EmbeddedInstance {
    std::string name;
    EmbeddingProblem problem;
    PathGraph graph;
    WeakEmbedding weak;
};

/// Inserts the layout edges one by one in random order along shortest paths, a spanning tree
/// first; nothing if an edge is blocked or a hole gets to the wrong side.
std::optional<WeakEmbedding> insert_in_random_order(const EmbeddingProblem& problem,
                                                    const PathGraph& graph, Random& random);

/// Embeddings with random landmarks and random orders of insertion: every layout of the zoo on
/// every small target that can hold it, some with landmarks on the boundary, and random layouts on
/// random spheres; up to dozens of strands over one edge. The same ones for the same seed.
std::vector<EmbeddedInstance> embedded_instances(std::uint64_t seed);

}  // namespace layout_embedding::test
