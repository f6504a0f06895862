#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/result.hh"
#include "embedding/refined_mesh.hh"
#include "layout/layout.hh"
#include "maps/plane_grid.hh"
#include "mesh/surface_point.hh"
#include "mesh/triangle_mesh.hh"
#include "patches/parametrisation.hh"
#include "patches/patch.hh"

namespace layout_embedding {

/// A layout embedded in a target.
struct EmbeddedTarget {
    std::shared_ptr<const TriangleMesh> target;
    /// What check_embedding() accepts.
    std::shared_ptr<const RefinedMesh> refined;
};

/// A point of the domains of a layout's faces.
struct DomainPoint {
    /// The layout face; kNone for none.
    Index face = kNone;
    PlanePoint point{0, 0};
};

/// A patch and its one-to-one map onto the domain of its layout face.
struct PlacedPatch {
    Patch patch;
    /// All points lie on the plane grid, those of the boundary exactly on the sides of the domain,
    /// and every triangle is positively oriented there.
    Parametrisation map;
    /// The connectivity of the map; positions mean nothing.
    TriangleMesh mesh;
};

/// Domains for the faces of a layout that is embedded in all of `targets`: a rectangle for four
/// sides, else a polygon inscribed in a circle, with sides that follow the mean lengths on the
/// targets. Corners are multiples of 2^-20, no coordinate beyond 1 in size; all corners are
/// strictly convex. `patches` per target, as patches_of() gives them. Errors: parametrisationFailed
/// (a face with thousands of sides).
Result<std::vector<Domain>> common_domains(const Layout& layout,
                                           std::span<const EmbeddedTarget> targets,
                                           std::span<const std::vector<Patch>> patches);

/// Shares along a layout edge in whole steps of 2^-32, per vertex of its chain: increasing strictly
/// from 0 to kWholeShare.
using ChainShares = std::vector<std::int64_t>;

/// The shares of arc length.
ChainShares arc_length_shares(const RefinedMesh& refined, const std::vector<Index>& chain);

/// A target whose patches are mapped onto given domains. A chain's vertices have the same shares in
/// both patches beside it, so the maps of two targets onto the same domains make one map between
/// the targets.
class PlacedTarget {
public:
    /// Maps every patch onto its domain, its sides by arc length (mean-value coordinates adapted to
    /// the stretch, parametrise()). Errors: parametrisationFailed.
    static Result<PlacedTarget> place(const Layout& layout, EmbeddedTarget embedded,
                                      std::vector<Patch> patches,
                                      const std::vector<Domain>& domains);

    /// Of parts that fit together as said here.
    PlacedTarget(EmbeddedTarget embedded, std::vector<Domain> domains,
                 std::vector<PlacedPatch> patches, std::vector<ChainShares> shares);

    const EmbeddedTarget& embedded() const { return embedded_; }
    const TriangleMesh& target() const { return *embedded_.target; }
    const RefinedMesh& refined() const { return *embedded_.refined; }
    const std::vector<Domain>& domains() const { return domains_; }
    /// Per layout face.
    const std::vector<PlacedPatch>& patches() const { return patches_; }
    /// Per layout edge.
    const std::vector<ChainShares>& shares() const { return shares_; }

    /// Moves the vertices of one patch's map; those of its boundary stay, or move along their side.
    /// All points must be what PlacedPatch says.
    void set_points(Index face, const std::vector<PlanePoint>& points)
    {
        patches_[face].map.points = points;
    }
    /// To go with that.
    void set_shares(Index edge, ChainShares shares) { shares_[edge] = std::move(shares); }

    /// Where a point of the target lies in the domains. O(#refined triangles in its face).
    DomainPoint to_domain(const SurfacePoint& point) const;
    /// Where a point of a triangle of a patch's map, given as weights of its corners, lies on the
    /// target.
    SurfacePoint to_surface(Index face, Index triangle, const std::array<double, 3>& weights) const;

    /// Per vertex of a patch's map its position in space.
    std::vector<Vec3> positions(Index face) const;

private:
    void find_triangles_of_faces();

    EmbeddedTarget embedded_;
    std::vector<Domain> domains_;
    std::vector<PlacedPatch> patches_;
    std::vector<ChainShares> shares_;
    /// Per target face its refined triangles, by offsets; per refined triangle its place in its
    /// patch, kNone outside of all; per patch and triangle its parts in the map, by offsets.
    std::vector<Index> face_offsets_;
    std::vector<Index> face_triangles_;
    std::vector<Index> place_in_patch_;
    std::vector<std::vector<Index>> part_offsets_;
};

/// A corner of a domain in its whole steps of 2^-20; they are numbered cyclically.
std::array<std::int64_t, 2> corner_steps(const Domain& domain, std::size_t corner);

/// A domain with corners moved to multiples of 2^-20; nothing if it is not strictly convex then.
std::optional<Domain> snapped(Domain domain);

/// Where the boundary vertices of a patch lie in its domain, exactly. `halfedges` are its sides.
std::vector<PlanePoint> boundary_points(std::span<const Index> halfedges, const Patch& patch,
                                        const Domain& domain,
                                        const std::vector<ChainShares>& shares);

/// Maps a patch onto its domain with the given boundary, all points on the plane grid. Errors:
/// parametrisationFailed.
Result<PlacedPatch> place_patch(Patch patch, std::span<const Vec3> positions, const Domain& domain,
                                std::span<const PlanePoint> boundary);

/// The connectivity of a map.
TriangleMesh mesh_of_map(const Parametrisation& map);

/// Whether every triangle of a map is positively oriented on the plane grid.
bool is_positive(const Parametrisation& map);

}  // namespace layout_embedding
