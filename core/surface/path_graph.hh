#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/result.hh"
#include "base/types.hh"
#include "mesh/triangle_mesh.hh"

namespace layout_embedding {

/// Which element of the target a node of the path graph stands for.
enum class NodeKind : std::uint8_t { vertex, edge_midpoint, face_centroid };

struct NodeElement {
    NodeKind kind;
    /// Vertex, edge or face id of the target.
    Index id;
};

/// A directed edge of the path graph.
struct Dart {
    Length length;
    Index head;
    Index twin;
};

/// The path graph T' (design, Sec. 1): the target subdivided once, a planar map on the surface
/// whose edges paths run along. It never changes during a search.
///
/// Darts are numbered so that those leaving a node are consecutive and in counter-clockwise order;
/// at a node on the target's boundary the hole lies between the last dart and the first. Nodes are
/// numbered along a space-filling curve: neighbours lie near each other in memory.
///
/// Lengths are exact integers, made unequal by a seeded perturbation: sums are exact, shortest
/// paths unique but for ties that a search detects. unit() converts to the target's units.
class PathGraph {
public:
    struct Options {
        std::uint64_t seed = 1;
        /// 0 at first; raised after a tie to draw other perturbations.
        std::uint32_t attempt = 0;
        /// What a unit of length costs, as in PathMetric: per vertex, and along each edge relative
        /// to that; empty for 1.
        std::span<const double> vertex_costs = {};
        std::span<const double> edge_costs = {};
        /// How much sums of lengths may be multiplied by: EdgeWeights::largest().
        Length headroom = 1;
    };

    /// The barycentric subdivision: nodes are vertices, edge midpoints and face centroids
    /// (V + E + F of them), with 2 E + 6 F edges. Lengths are Euclidean, times what a unit of
    /// length costs on average. O(#F).
    static PathGraph barycentric(const TriangleMesh& target, const Options& options);
    static PathGraph barycentric(const TriangleMesh& target) { return barycentric(target, {}); }

    /// Bytes that barycentric() will take for a target of this size.
    static std::uint64_t estimate_bytes(Index vertices, Index edges, Index faces);

    /// Replaces all lengths: one per dart, the same for both darts of an edge, all positive. This
    /// is how another metric comes in; the lengths have to bring their own perturbation.
    void set_lengths(std::span<const Length> lengths);

    Index node_count() const { return static_cast<Index>(dart_offsets_.size() - 1); }
    Index dart_count() const { return static_cast<Index>(darts_.size()); }

    const Dart& dart(Index d) const { return darts_[d]; }
    Index head(Index d) const { return darts_[d].head; }
    Index tail(Index d) const { return darts_[darts_[d].twin].head; }
    Index twin(Index d) const { return darts_[d].twin; }
    /// The first dart that leaves the node; they end before first_dart(node + 1).
    Index first_dart(Index node) const { return dart_offsets_[node]; }
    /// Has the darts that leave a node brought near.
    void prefetch_darts(Index node) const
    {
#if defined(__GNUC__)
        const Dart* darts = darts_.data() + dart_offsets_[node];
        __builtin_prefetch(darts);
        __builtin_prefetch(darts + 4);
#endif
    }
    Index degree(Index node) const
    {
        return dart_offsets_[node + 1] - dart_offsets_[node];
    }
    /// Whether the node lies on the target's boundary.
    bool is_boundary(Index node) const
    {
        return boundary_[node];
    }

    NodeElement element(Index node) const;
    Index node_of_vertex(Index vertex) const
    {
        return nodes_of_elements_[vertex];
    }
    Index node_of_edge(Index edge) const
    {
        return nodes_of_elements_[vertex_count_ + edge];
    }
    Index node_of_face(Index face) const
    {
        return nodes_of_elements_[vertex_count_ + edge_count_ + face];
    }
    const Vec3& position(Index node) const
    {
        return positions_[node];
    }

    /// The length of the integer 1 in the target's units, times what a unit of length costs.
    double unit() const
    {
        return unit_;
    }
    /// A length in the target's units, infinity for kInfiniteLength.
    double to_units(Length length) const;

private:
    void number_nodes(const TriangleMesh& target, const std::vector<Index>& faces);

    Index vertex_count_ = 0;
    Index edge_count_ = 0;
    // Elements: vertices, then edges, then faces of the target.
    std::vector<Index> nodes_of_elements_;
    std::vector<Index> elements_of_nodes_;
    std::vector<Index> dart_offsets_;  // #nodes + 1
    std::vector<Dart> darts_;
    std::vector<Vec3> positions_;  // per node
    std::vector<bool> boundary_;   // per node
    double unit_ = 1;
};

}  // namespace layout_embedding
