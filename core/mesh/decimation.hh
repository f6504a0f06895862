#pragma once

#include <cstdint>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "base/random.hh"
#include "base/types.hh"
#include "mesh/editable_mesh.hh"
#include "mesh/quadric.hh"
#include "mesh/star_triangulation.hh"
#include "mesh/triangle_mesh.hh"

namespace layout_embedding {

/// How far a decimation goes to get rid of vertices. Each one includes those before it.
enum class DecimationEffort {
    /// Halfedge collapses that turn no face over and leave no needles.
    collapses,
    /// Where no such collapse is left: edge flips around a vertex that let it be removed, under the
    /// same test of shapes.
    flips,
    /// Where that does not help either: the same without the test, only the surface counts.
    any_shape,
};

/// How many vertices were removed in which way.
struct DecimationCounts {
    Index collapses = 0;
    /// Removed after edge flips, well-shaped.
    Index after_flips = 0;
    /// Removed without the test of shapes.
    Index in_any_shape = 0;
};

/// Removes vertices from a triangle mesh by halfedge collapses in the order of their quadric error
/// (Garland and Heckbert 1997), vertices that are left never move. The surface stays a manifold of
/// the same genus with the same boundary loops and without parallel edges (link condition);
/// boundary vertices move along the boundary only.
///
/// The error is that of planes of the removed surface, planes upright on its boundary and, with a
/// small weight that decides where it is flat, its vertices. The order is strict and total (level
/// of effort, error, ids), so the result is the same on every platform. Faces without area are no
/// obstacle.
///
/// O(n log n) as long as vertices have few neighbours. The mesh must satisfy check_surface() as a
/// target (mesh/validation.hh).
class Decimation {
public:
    /// Vertices with `kept` true stay whatever happens (empty for none), and so do `holes`,
    /// vertices that stand for holes (EditableMesh::add_hole()),
    /// with the kept vertices on them.
    explicit Decimation(const TriangleMesh& mesh, std::vector<bool> kept = {},
                        std::span<const Index> holes = {});

    /// Removes vertices until `vertex_count` are left or no more can be removed with this effort.
    /// Can be called again, with fewer vertices or more effort.
    void run(Index vertex_count, DecimationEffort effort);

    /// Flips up to `tries` edges at random (seeded), away from what
    /// blocks the vertices that are still to be removed; true as soon as one of them can be removed
    /// again. For coarse meshes: a try takes as long as looking at all their stars.
    bool unblock(Random& random, int tries);

    const EditableMesh& mesh() const { return mesh_; }
    const DecimationCounts& counts() const { return counts_; }

private:
    /// An entry of the queue: the vertex to be removed next comes first. Entries whose stamp is not
    /// the vertex's are out of date.
    struct Entry {
        double cost;
        Index vertex;
        Index stamp;
        DecimationEffort level;
    };
    struct Later {
        bool operator()(const Entry& a, const Entry& b) const;
    };
    struct State {
        /// The neighbour to move to.
        Index target = kNone;
        double cost = 0;
        Index stamp = 0;
        DecimationEffort level = DecimationEffort::collapses;
        /// Cheaper targets were tried in vain.
        bool skipped = false;
    };

    double cost(Index v, Index w) const;
    void reset(Index v);
    void push(Index v);
    void process(Index v);
    bool collapse_somewhere(Index v);
    void collapse_in_any_shape(Index v);
    void sort_candidates(Index v);
    void collapse(Index v, Index w);
    void remove_with_flips(Index v);
    bool keeps_shape(Index v, Index w) const;

    EditableMesh mesh_;
    std::vector<bool> kept_;
    /// Per vertex that has to stay on a hole: the vertex that stands for it, else kNone.
    std::vector<Index> hole_of_;
    std::vector<Vec3> points_;  // scaled to a unit box
    std::vector<Quadric> quadrics_;
    std::vector<State> states_;
    std::priority_queue<Entry, std::vector<Entry>, Later> queue_;
    DecimationCounts counts_;
    StarTriangulation star_;
    // Memory that is used again and again: costs and neighbours in ascending order, neighbours.
    std::vector<std::pair<double, Index>> candidates_;
    std::vector<Index> ring_;
};

/// A mesh with fewer vertices.
struct SimplifiedMesh {
    PolygonMesh mesh;
    /// Per vertex of `mesh`: its id in the mesh that was simplified, ascending.
    std::vector<Index> vertices;
};

/// What is left of a decimation, vertices and faces in their old order.
SimplifiedMesh remaining_mesh(const Decimation& decimation, const std::vector<Vec3>& positions);

/// Removes vertices from `mesh` until `vertex_count` are left, or more where the rest could not be
/// removed without overturned faces or needles. Vertices with `kept` true (empty for none) stay.
/// The result is a surface of the same topology.
SimplifiedMesh simplified(const TriangleMesh& mesh, Index vertex_count,
                          std::vector<bool> kept = {});

}  // namespace layout_embedding
