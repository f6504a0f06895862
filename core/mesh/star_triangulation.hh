#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/types.hh"
#include "mesh/editable_mesh.hh"

namespace layout_embedding {

/// Finds the best way to fill the hole that a vertex leaves: a triangulation of the polygon of its
/// neighbours whose diagonals are not edges already, with the least sum of shape penalties (dynamic
/// programming, Klincsek 1980). Every fan is among them, so this includes all collapses of the
/// vertex. Keeps its memory from call to call.
class StarTriangulation {
public:
    /// More neighbours than this are not tried.
    static constexpr Index kMaxDegree = 64;

    /// Whether vertex v can be removed. With `any_shape` the faces may look as they like, otherwise
    /// all have to pass well_shaped(). O(degree^3) and the degrees of the neighbours.
    bool find(const EditableMesh& mesh, const std::vector<Vec3>& points, Index v, bool any_shape);

    /// Removes v as found: edge flips until it has three neighbours (two on a boundary), then a
    /// collapse.
    void apply(EditableMesh& mesh, Index v) const;

    /// The neighbours of v, counter-clockwise.
    const std::vector<Index>& ring() const { return ring_; }

private:
    void clip(EditableMesh& mesh, Index v, std::size_t i, std::size_t j) const;
    std::size_t at(std::size_t i, std::size_t j) const { return i * ring_.size() + j; }

    std::vector<Index> ring_;
    bool boundary_ = false;
    std::vector<char> forbidden_;       // per pair of ring_
    std::vector<double> penalties_;     // per pair: of the polygon between them
    std::vector<std::uint8_t> splits_;  // per pair: the third corner
};

/// How far a triangle is from equilateral, as 1 / quality; `up` is the unit normal it should have.
/// A triangle turned away from it is far worse than any needle.
double shape_penalty(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& up);

/// 2 sqrt(3) |n| / (sum of squared edges), n being (b - a) x (c - a): 1 for equilateral triangles,
/// 0 for those without area.
double triangle_quality(const Vec3& a, const Vec3& b, const Vec3& c);

/// Qualities below this are those of needles.
inline constexpr double kNeedle = 0.1;
/// The least cosine between the old and the new normal of a face.
inline constexpr double kLeastCosine = 0.2;

}  // namespace layout_embedding
