#pragma once

#include <vector>

#include "base/types.hh"

namespace layout_embedding {

/// A square sparse matrix, row by row.
struct SparseRows {
    /// Per row: its first place in `columns` and `values`; #rows + 1.
    std::vector<Index> offsets{0};
    std::vector<Index> columns;
    std::vector<double> values;

    Index row_count() const { return static_cast<Index>(offsets.size() - 1); }
};

/// LU factorisation without pivoting, for row-wise diagonally dominant matrices with a symmetric
/// pattern such as Laplacians with asymmetric positive weights; there it is stable. Approximate
/// minimum degree ordering (Amestoy, Davis, Duff 1996, as in Eigen), then up-looking elimination
/// along the elimination tree (Davis, "Direct Methods for Sparse Linear Systems", 2006, Ch. 4).
///
/// Written out as scalar operations in a fixed order, so that solutions have the same bits on every
/// platform: library solvers sum in an order that depends on vector units and cache sizes.
/// For a surface mesh of n vertices: about 70 n log2 n bytes and on the order of n^1.5 operations
/// (0.1 s for 10k, 0.9 s for 41k vertices).
class SparseLu {
public:
    /// `matrix` has its whole diagonal stored, and (i, j) wherever it has (j, i).
    explicit SparseLu(const SparseRows& matrix);

    /// Replaces a right-hand side by the solution. O(#nonzeros of the factors).
    void solve(std::vector<double>& x) const;

    /// Entries below the diagonal of L, as many as above that of U.
    std::size_t nonzero_count() const { return indices_.size(); }

private:
    struct Values {
        double lower;  // L(i, j)
        double upper;  // U(j, i)
    };
    std::vector<Index> order_;          // the row eliminated in each step
    std::vector<double> diagonal_;      // of U, per step
    std::vector<std::size_t> offsets_;  // per step j: its entries, i > j
    std::vector<Index> indices_;        // i
    std::vector<Values> values_;
};

}  // namespace layout_embedding
