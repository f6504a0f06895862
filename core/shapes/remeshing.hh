#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/types.hh"
#include "shapes/editable_mesh.hh"
#include "shapes/extraction.hh"
#include "shapes/solid.hh"

namespace layout_embedding::shapes {

/// A half-space that is cut away from a surface: that with (p - origin) . normal >= 0.
struct CutPlane {
    Vec3 origin;
    Vec3 normal;
};

/// A point of the surface that has to become a vertex.
struct Anchor {
    Vec3 position;
    /// On the rim that the cut plane leaves; only with a cut plane.
    bool on_boundary = false;
};

struct RemeshOptions {
    /// The number of vertices aimed at; met to a few per cent.
    Index vertices = 5000;
    /// 0: edges of equal length everywhere; 1: as long as the surface's curvature lets them be.
    double adaptivity = 0.7;
    /// 0: nearly equilateral triangles; 1: as uneven as those of a simplified scan.
    double irregularity = 0.5;
    std::uint64_t seed = 0;
    /// The size of the cells that `surface` came from.
    double cell = 0.0;
};

struct Remeshed {
    EditableMesh mesh;
    /// Per anchor its vertex.
    std::vector<Index> anchors;
};

/// A triangulation of the surface of `solid` without the look of a grid, from one with it:
/// edges that are too long are split, too short ones collapsed, flips restore the Delaunay
/// property, vertices move tangentially to even out the triangles and are projected onto the
/// surface (Botsch, Kobbelt, "A remeshing approach to multiresolution modeling", 2004), with edge
/// lengths that adapt to curvature and vary at random. Then a denser mesh than wanted is simplified
/// by random collapses, which leaves triangles like those of simplified scans. The topology is that
/// of `surface`, and anchors are vertices at exactly their positions.
Remeshed remesh(const Solid& solid, const RawSurface& surface, const std::optional<CutPlane>& cut,
                const std::vector<Anchor>& anchors, const RemeshOptions& options);

}  // namespace layout_embedding::shapes
