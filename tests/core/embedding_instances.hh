#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/random.hh"
#include "layout/embedding_problem.hh"
#include "mesh/polygon_mesh.hh"
#include "surface/path_graph.hh"
#include "surface/weak_embedding.hh"

namespace layout_embedding::instances {

// Shapes, used as targets where they have triangles and as layouts.
PolygonMesh tetrahedron();
PolygonMesh octahedron();
PolygonMesh icosahedron();
PolygonMesh cube();
/// A prism over a regular polygon.
PolygonMesh prism(Index sides);
/// A pyramid over a regular polygon: one vertex of high degree.
PolygonMesh pyramid(Index sides);
/// Two triangle fans over a regular polygon.
PolygonMesh bipyramid(Index sides);
/// Quads on a torus, `across` by `around`.
PolygonMesh torus(Index across, Index around);
/// A square of `size` by `size` quads.
PolygonMesh disk(Index size);
/// A ring of `around` by `across` quads between two circles.
PolygonMesh annulus(Index around, Index across);

/// Every quad cut into two triangles along a random diagonal.
PolygonMesh triangulated(const PolygonMesh& mesh, Random& random);
/// Every triangle cut into four.
PolygonMesh subdivided(const PolygonMesh& mesh);
/// All vertices put on the unit sphere.
PolygonMesh on_sphere(PolygonMesh mesh);
/// Random edges flipped and vertices moved: irregular degrees, thin triangles.
PolygonMesh scrambled(const PolygonMesh& mesh, Random& random);

EmbeddingProblem problem(const PolygonMesh& layout, const PolygonMesh& target,
                         std::vector<Index> landmarks);

/// Different random vertices of the target for the layout's vertices, none on its boundary.
std::vector<Index> random_landmarks(Index count, const PolygonMesh& target, Random& random);

/// Inserts the layout edges one by one in random order along shortest paths, a spanning tree
/// first; nothing if an edge is blocked.
std::optional<WeakEmbedding> insert_in_random_order(const EmbeddingProblem& problem,
                                                    const PathGraph& graph, Random& random);

/// A problem, and an embedding found with a random order.
struct Instance {
    std::string name;
    EmbeddingProblem problem;
    PathGraph graph;
    WeakEmbedding weak;
};

/// Layouts on targets with random landmarks: spheres of all kinds, tori, disks and rings, with up
/// to a dozen strands over one edge. The same ones for the same seed.
std::vector<Instance> random_instances(std::uint64_t seed, int rounds);

}  // namespace layout_embedding::instances
