#pragma once

#include <array>
#include <span>
#include <vector>

#include "apps/quad_mesh.hh"
#include "apps/quad_unfolding.hh"
#include "mesh/triangle_mesh.hh"

namespace layout_embedding {

/// A quad mesh on a target some of whose vertices may move: what is around its vertices, and how
/// good that is.
class MovableQuads {
public:
    struct Place {
        SurfacePoint point;
        Vec3 position;
    };
    /// Of all vertices.
    struct Places {
        std::vector<SurfacePoint> points;
        std::vector<Vec3> positions;
    };

    /// `target` and `mesh` must outlive this; `fixed` says of every vertex whether it stays.
    MovableQuads(const TriangleMesh& target, std::vector<bool> fixed, QuadMesh& mesh);

    Index vertex_count() const { return static_cast<Index>(mesh_.positions.size()); }
    Index quad_count() const { return static_cast<Index>(mesh_.quads.size()); }
    const std::array<Index, 4>& quad(Index q) const { return mesh_.quads[q]; }
    bool is_fixed(Index v) const { return fixed_[v]; }
    /// The vertices that are not fixed, in increasing order.
    const std::vector<Index>& free_vertices() const { return free_; }
    /// All quads at these, in increasing order.
    const std::vector<Index>& quads_around_free() const { return around_free_; }
    /// In increasing order.
    std::span<const Index> quads_at(Index v) const
    {
        return std::span(quads_).subspan(offsets_[v], offsets_[v + 1] - offsets_[v]);
    }
    std::vector<Index> quads_around(const std::vector<Index>& vertices) const;
    /// Within so many rings of vertices, the quad's own being the first one; in increasing order.
    std::vector<Index> free_vertices_around(Index quad, int rings) const;
    /// Marks the vertices of all quads at v.
    void mark_around(Index v, std::vector<bool>& marks) const;

    const Vec3& position(Index v) const { return mesh_.positions[v]; }
    /// The target's, where v is.
    const Vec3& normal(Index v) const { return normals_[mesh_.points[v].face]; }
    std::array<Vec3, 4> corners(const std::array<Index, 4>& quad) const;
    /// The surface's normal there, not of length 1.
    Vec3 up(const std::array<Index, 4>& quad) const;
    Vec3 mean_around(Index v) const;

    double jacobian(Index q) const;
    bool is_flipped(Index q) const { return !(jacobian(q) > 0); }
    /// Some quad's scaled Jacobian is not above this.
    bool has_quads_up_to(double jacobian) const;
    Index flipped_quads() const;
    /// The smallest scaled Jacobian of the quads at v.
    double quality(Index v) const;
    /// Those at v whose scaled Jacobian is not above `least`.
    Index flipped_around(Index v, double least = 0) const;
    /// How far the corners of the quads at v are from those of squares: at a corner with the edges
    /// a and b, (a^2 + b^2) / (d + sqrt(d^2 + e^2)), where d is the signed area between them as
    /// seen along quad_normal(), which `least_cosine` is for, and e a small share of a^2 + b^2, so
    /// that small quads beside large ones count as much. It grows as a corner becomes flat, and is
    /// finite for folded ones (Escobar et al., "Simultaneous untangling and smoothing of
    /// tetrahedral meshes", 2003).
    double distortion(Index v, double least_cosine = 0) const;

    Place place(Index v) const { return {mesh_.points[v], mesh_.positions[v]}; }
    void put(Index v, const Place& place);
    /// Puts v where a walk from a point of the surface towards `goal` ends.
    void walk(Index v, const SurfacePoint& from, const Vec3& goal);
    /// To look what would be; off the surface.
    void hold(Index v, const Vec3& position) { mesh_.positions[v] = position; }
    Places places() const { return {mesh_.points, mesh_.positions}; }
    void restore(const Places& places);
    /// A round of unfold_quads().
    void unfold(std::span<const Index> vertices, std::span<const Index> quads,
                const UnfoldingMeasure& measure);

private:
    const TriangleMesh& target_;
    std::vector<bool> fixed_;
    QuadMesh& mesh_;
    std::vector<Vec3> normals_;   // per face of the target
    std::vector<Index> offsets_;  // per vertex: its first place in quads_
    std::vector<Index> quads_;
    std::vector<Index> free_;
    std::vector<Index> around_free_;
};

}  // namespace layout_embedding
