#pragma once

#include <vector>

#include "base/result.hh"
#include "embedding/refined_mesh.hh"
#include "layout/layout.hh"

namespace layout_embedding {

/// How good the paths and patches of an embedding are, in the target's units. For reports: the last
/// digits of angles may differ between platforms.
struct QualityReport {
    struct Edge {
        /// Of the chain, on the surface.
        double length = 0;
        /// How far it is from straight: over its inner vertices, the sum of what the smaller of the
        /// two angles between it and itself (as the surface measures them) lacks to 180 degrees. 0
        /// for a locally shortest path. In degrees.
        double turning = 0;
    };
    struct Patch {
        double area = 0;
        double perimeter = 0;
        /// 4 pi area / perimeter^2: 1 for a flat disk, near 0 for a thin patch.
        double isoperimetric_quotient = 0;
        /// Distortion of the patch's map onto a rectangle (four sides) or a regular polygon:
        /// Parametrisation::stretch, 1 for an isometry; infinite where the map fails.
        double stretch = 0;
    };

    /// Per layout edge and per layout face.
    std::vector<Edge> edges;
    std::vector<Patch> patches;
};

/// Of an embedding that check_embedding() accepts. Parametrises every patch: about n^1.5 operations
/// for a patch of n triangles. Errors: those of patches_of().
Result<QualityReport> quality_report(const Layout& layout, const RefinedMesh& refined);

}  // namespace layout_embedding
