#pragma once

#include <array>
#include <vector>

#include "base/result.hh"
#include "layout/layout.hh"
#include "maps/placed_target.hh"
#include "mesh/surface_point.hh"

namespace layout_embedding {

/// The common refinement of two targets under their map: a triangle mesh of which every triangle
/// lies in one triangle of either target. Patches only; what lies outside of a layout with boundary
/// is left out.
struct Overlay {
    /// Per vertex its place on target a and on target b.
    std::vector<std::array<SurfacePoint, 2>> points;
    /// Per triangle: 3 vertex ids, counter-clockwise.
    std::vector<std::array<Index, 3>> corners;
    /// Per triangle: the layout face, and the face of target a and of target b.
    std::vector<Index> layout_faces;
    std::vector<std::array<Index, 2>> faces;
    /// Per triangle: the triangles of the two maps of its patch (Parametrisation::corners).
    std::vector<std::array<Index, 2>> map_triangles;
    /// Per triangle: its area in the domain.
    std::vector<double> domain_areas;
};

/// Overlays two targets that are placed on the same domains.
///
/// Everything that decides about connectivity is exact (integer orientations of grid points, no
/// tolerance): vertices of one map that lie on vertices or edges of the other one become one with
/// them, and edges that run along each other become one; so a target overlaid with itself gives
/// itself. Only the places of crossings of two edges are rounded, which may leave a triangle with
/// three different corners but hardly any area, or none. Errors: internal (a map that is not what
/// PlacedPatch says). O((n + k) log k) for n triangles and k crossings.
Result<Overlay> overlay(const Layout& layout, const PlacedTarget& a, const PlacedTarget& b);

/// The pieces of the overlay of one layout face's patches: the triangle of either map, and the area
/// in the domain. Empty where the maps do not lie over each other.
struct OverlayPiece {
    std::array<Index, 2> map_triangles;
    double domain_area;
};
std::vector<OverlayPiece> overlay_pieces(const PlacedPatch& a, const PlacedPatch& b);

}  // namespace layout_embedding
