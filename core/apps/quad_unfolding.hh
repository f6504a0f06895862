#pragma once

#include <algorithm>
#include <span>

#include "apps/quad_mesh.hh"
#include "mesh/triangle_mesh.hh"

namespace layout_embedding {

/// Unfolding begins soft and ends hard.
inline constexpr double kMostSoftness = 0.2;
inline constexpr double kLeastSoftness = 1e-4;
/// That of the next round.
inline double harder(double softness)
{
    constexpr double kPerRound = 0.85;
    return std::max(softness * kPerRound, kLeastSoftness);
}

/// How unfold_quads() judges quads.
struct UnfoldingMeasure {
    /// The share of a quad's size that e is at least.
    double softness;
    /// Whether all quads are to become equally large, on the average as they are. Quads that have
    /// shrunk to nearly nothing, folded as they are, grow again.
    bool inflates;
    /// Corners with a scaled Jacobian up to this count as folded.
    double margin = 0;
    /// That of quad_normal().
    double least_cosine = 0;
};

/// Moves some vertices of a quad mesh on its target, all at a time, so that folded quads around
/// them open: lowers the sum over the corners of `quads` of (a^2 + b^2) / (d + sqrt(d^2 + e^2)),
/// where a and b are the edges there, d is the signed area between them as seen along the quad's
/// normal at first (quad_normal()), less the margin times |a| |b|, and e a share of the quad's
/// size: its mean squared edge. The share is at least the measure's softness, and as much as the
/// most folded corner asks for (Garanzha et al., "Foldover-free maps in 50 lines of code", 2021).
/// With `inflates`, the size is the mean area of all quads, A, and (d^2 + A^2) / A is added to a^2
/// + b^2. A round works in the tangent planes, by L-BFGS, and then goes back to the surface; a few
/// tens of rounds do. Nothing holds single vertices or quads back, so folds open that moves of one
/// vertex at a time can't.
///
/// `vertices` and `quads` in increasing order, `quads` being all those around the vertices;
/// `normals` are those of the target's faces. Scalar operations in a fixed order. O(#quads).
void unfold_quads(const TriangleMesh& target, std::span<const Vec3> normals,
                  std::span<const Index> vertices, std::span<const Index> quads,
                  const UnfoldingMeasure& measure, QuadMesh& mesh);

}  // namespace layout_embedding
