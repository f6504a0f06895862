#pragma once

#include <span>

#include "base/result.hh"
#include "layout/decimated_layout.hh"
#include "mesh/triangle_mesh.hh"

namespace layout_embedding {

struct TemplateOptions {
    /// Merges pairs of triangles into well-shaped quads (layout/quad_pairing.hh).
    bool quads = false;
};

struct TemplateLayout {
    /// A valid layout (layout/layout.hh): vertex i is landmark i and lies at its position.
    PolygonMesh mesh;
    /// How the other vertices of the target were removed.
    DecimationCounts counts;
    /// How often edges had to be flipped before a vertex could be removed at all.
    Index times_unblocked = 0;
    /// Edges flipped since the other diagonal is shorter.
    Index flips = 0;
};

/// Makes a layout of a landmarked target: decimated to its landmarks (paper, Sec. 5.1;
/// layout/decimated_layout.hh), then freed of twists (apps/layout_shortening.hh), then perhaps
/// merged into quads.
///
/// Errors: those of decimated_layout(). A second for some thousand vertices, a few more for a
/// million triangles; deterministic.
Result<TemplateLayout> template_layout(const TriangleMesh& target, std::span<const Index> landmarks,
                                       const TemplateOptions& options = {});

}  // namespace layout_embedding
