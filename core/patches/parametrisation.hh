#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/result.hh"
#include "base/types.hh"
#include "patches/domain.hh"
#include "patches/patch.hh"

namespace layout_embedding {

/// A piecewise linear one-to-one map of a patch onto a convex polygon.
struct Parametrisation {
    /// Per vertex: its place in the domain. The patch's vertices come first, then one per split
    /// edge.
    std::vector<PlanePoint> points;
    /// Per further vertex: the two patch vertices in whose middle it lies.
    std::vector<std::array<Index, 2>> splits;
    /// Per triangle: three vertices, counter-clockwise both on the surface and in the domain.
    std::vector<std::array<Index, 3>> corners;
    /// Per triangle: the place in Patch::triangles of the one that it is a part of.
    std::vector<Index> parents;
    /// Root mean square over the patch's area of the map's stretch from the domain to the surface
    /// (Sander et al., "Texture mapping progressive meshes", 2001), for equal total areas: 1 is
    /// an isometry, everything else is larger.
    double stretch = 0;

    /// The positions of all vertices, from those of the refined mesh.
    std::vector<Vec3> positions(const Patch& patch, std::span<const Vec3> refined) const;

    /// A point of a triangle, given as weights of its corners, as weights of the corners of the
    /// patch's triangle that it is a part of.
    std::array<double, 3> weights_in_parent(const Patch& patch, Index triangle,
                                            const std::array<double, 3>& weights) const;
};

struct ParametriseOptions {
    /// Weights are adapted for as long as that lowers the stretch, at most this often (Yoshizawa,
    /// Belyaev, Seidel, "A fast and simple stretch-minimizing mesh parameterization", 2004). 0:
    /// mean-value coordinates as they are.
    Index stretch_rounds = 8;
    /// Where the boundary vertices go, on the sides of the domain and in their order; empty for
    /// places by arc length.
    std::span<const PlanePoint> boundary{};
};

/// Maps a patch onto `domain`, which has one corner per side of the patch: boundary vertices go to
/// the sides by arc length, inner ones to weighted means of their neighbours (Tutte 1963;
/// mean-value weights of Floater 2003). The map is one-to-one as the weights are positive and no
/// inner edge joins two vertices of one side: such edges are split in their middle first. What
/// rounding makes of it is tested: every triangle is certainly positively oriented. `positions` are
/// those of the refined mesh.
///
/// Scalar operations in a fixed order: the same bits on every platform. Errors:
/// parametrisationFailed, where long limbs of the patch shrink below the resolution of doubles.
/// About n^1.5 operations per round for n vertices.
Result<Parametrisation> parametrise(const Patch& patch, std::span<const Vec3> positions,
                                    const Domain& domain, const ParametriseOptions& options = {});

/// The triangles of a map of a patch onto a polygon with a corner per side, edges that join two
/// vertices of one side split; without points and stretch.
Parametrisation unplaced_map(const Patch& patch);

/// The length of each side of a patch.
std::vector<double> side_lengths(const Patch& patch, std::span<const Vec3> positions);

/// A rectangle for a patch of four sides: as wide as the mean of sides 0 and 2, as high as that of
/// sides 1 and 3.
Domain fitting_rectangle(const Patch& patch, std::span<const Vec3> positions);

}  // namespace layout_embedding
