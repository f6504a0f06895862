#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "base/types.hh"
#include "embedding/refined_mesh.hh"
#include "mesh/polygon_mesh.hh"

namespace layout_embedding {

/// A point of a weak path: one target vertex id (that vertex), two (the midpoint of their edge) or
/// three (the centroid of their face), in any order; unused places hold kNone and come last.
using WeakPoint = std::array<Index, 3>;

/// Everything the checker looks at: the input as it was read, and a claimed embedding. Nothing in
/// it has to be sound: what is not becomes a violation.
struct CheckInput {
    const PolygonMesh& layout;
    const PolygonMesh& target;
    /// Target vertex per layout vertex.
    const std::vector<Index>& landmarks;
    const RefinedMesh& refined;
    /// Per chain of `refined.chains`: its two layout vertices, start and end.
    const std::vector<std::array<Index, 2>>& layout_edges;
    /// Per chain: its weak path from start to end; empty as a whole to leave out the comparison of
    /// homotopy classes.
    const std::vector<std::vector<WeakPoint>>& weak_paths;
};

/// One reason to refuse an embedding.
struct Violation {
    /// A stable camelCase name, for example "chainsMeet".
    std::string code;
    /// One sentence with the ids concerned.
    std::string message;
};

struct CheckReport {
    /// Empty: the embedding is valid.
    std::vector<Violation> violations;
    bool valid() const { return violations.empty(); }
};

/// How many violations of one code are listed at most.
inline constexpr std::size_t kMaxViolationsPerCode = 10;

/// A new vertex may be this far from where its face and barycentric coordinates put it, relative to
/// the diagonal of the target's bounding box ...
inline constexpr double kPositionTolerance = 1e-9;
/// ... plus this share of the largest coordinate, for targets far from the origin.
inline constexpr double kRounding = 1e-14;
/// Barycentric coordinates are at least 0 and add up to 1 up to this.
inline constexpr double kBarycentricSumTolerance = 1e-9;
/// The barycentric areas of the refined triangles in a target face add up to 1 up to this. It only
/// has to tell 1 from 0 and 2: orientation is tested without tolerance, in exact arithmetic on the
/// coordinates as they are given.
inline constexpr double kAreaTolerance = 1e-6;

/// Confirms that `input` is a valid embedding (design, Sec. 5). Independent by intent: this module
/// (checker*.hh, .cc) shares nothing with the search, the layout class or the realisation but plain
/// arrays, and builds its own connectivity. Time is near-linear in the size of the meshes and paths
/// as long as the words of the homotopy test stay short.
///
/// What is confirmed, with the codes of the violations:
/// - Layout and target are connected, oriented manifold surfaces (layoutNotSurface,
///   targetNotSurface) of the same genus, and the target has no hole or one per boundary loop of
///   the layout (topologyMismatch); landmarks are different target vertices (landmarkCount,
///   landmarkOutOfRange, duplicateLandmark), those of inner layout vertices inside the target
///   (landmarkOnBoundary).
/// - The refined mesh is a subdivision of the target: arrays fit (sizeMismatch, indexOutOfRange),
///   target vertices keep ids and positions exactly (inputVertexMoved), new vertices lie where
///   their face and coordinates say (nonFinitePosition, barycentricOutOfRange, vertexMisplaced,
///   newVertexOnVertex), each triangle lies in its face (triangleOutsideFace), is positively
///   oriented there (triangleFlipped, triangleDegenerate), and the triangles of a face cover it
///   once (areaMismatch); the mesh is a manifold surface like the target (refinedNotSurface,
///   refinedTopology) whose edges join triangles that are neighbours in the target (trianglesTorn,
///   boundaryMismatch).
/// - There is one chain per layout edge (layoutEdgeUnknown, chainDuplicate, chainMissing), it runs
///   along edges (chainOffMesh) between its landmarks (chainWrongEnd), and meets neither itself
///   (chainTouchesItself), nor other landmarks (chainThroughLandmark), nor other chains
///   (chainsMeet).
/// - Around each landmark the chains follow the layout's cyclic order (cyclicOrder), on a boundary
///   its linear order (boundaryOrder).
/// - The chains cut the surface into one disk per layout face (patchNotDisk) with that face's
///   boundary (patchBoundary) and no hole of the target (holeInPatch), and one outside patch per
///   boundary loop of the layout, which holds one hole if the target has holes (holeCount);
///   triangle_patches says the same (patchIds).
/// - Each chain is homotopic to its weak path among arcs on the target punctured at the landmarks
///   and holes, which may turn freely about their own ends (homotopyClass); weak paths are walks
///   between vertices, midpoints and centroids next to each other (weakPathCount, weakPathPoint,
///   weakPathStep), from landmark to landmark (weakPathEnds) and through no other
///   (weakPathThroughLandmark).
///
/// Later tests are left out where earlier violations make them meaningless.
CheckReport check_embedding(const CheckInput& input);

}  // namespace layout_embedding
