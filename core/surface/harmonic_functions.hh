#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "base/sparse_lu.hh"
#include "mesh/triangle_mesh.hh"

namespace layout_embedding {

/// Harmonic functions on the target with mean-value weights, one per landmark: 1 at its own
/// landmark and 0 at all others, elsewhere the weighted mean of the neighbours ([PSS01], as the
/// paper's Sec. 5 uses it). In [0, 1] by the maximum principle, and all of them sum to 1, both up
/// to rounding. The same bits on every platform.
class HarmonicFunctions {
public:
    /// Factorises once for all landmarks; see SparseLu for time and memory. Keeps a reference;
    /// `landmarks` are different vertices, at least one.
    HarmonicFunctions(const TriangleMesh& target, const std::vector<Index>& landmarks);

    /// The function of landmark i, #V values.
    std::vector<double> solve(Index i) const;

    /// Bytes taken while constructing, roughly, for a target of this size.
    static std::uint64_t estimate_bytes(Index vertices);

private:
    struct System {
        /// Per vertex: its row, kNone at landmarks.
        std::vector<Index> rows;
        SparseRows matrix;
        /// Per landmark: rows next to it, with its weight there.
        std::vector<std::vector<std::pair<Index, double>>> couplings;
    };
    static System assemble(const TriangleMesh& target, const std::vector<Index>& landmarks);
    explicit HarmonicFunctions(const std::vector<Index>& landmarks, System system);

    std::vector<Index> landmarks_;
    std::vector<Index> rows_;
    std::vector<std::vector<std::pair<Index, double>>> couplings_;
    SparseLu factors_;
};

}  // namespace layout_embedding
