#include "base/sparse_lu.hh"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>

namespace layout_embedding {

namespace {

/// The matrix with its rows and columns in elimination order: per step k the entries (k, j) and
/// (j, k), j < k.
struct Ordered {
    std::vector<std::size_t> offsets{0};
    std::vector<Index> indices;  // j, increasing
    std::vector<double> lower;   // (k, j)
    std::vector<double> upper;   // (j, k)
    std::vector<double> diagonal;
};

std::vector<Index> minimum_degree_order(const SparseRows& matrix)
{
    const auto n = static_cast<int>(matrix.row_count());
    std::vector<Eigen::Triplet<float>> entries;
    for (Index row = 0; row < matrix.row_count(); ++row) {
        for (Index k = matrix.offsets[row]; k < matrix.offsets[row + 1]; ++k) {
            entries.emplace_back(static_cast<int>(row), static_cast<int>(matrix.columns[k]), 1.0F);
        }
    }
    Eigen::SparseMatrix<float> pattern(n, n);
    pattern.setFromTriplets(entries.begin(), entries.end());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> permutation;
    Eigen::AMDOrdering<int>()(pattern, permutation);
    std::vector<Index> order(matrix.row_count());
    for (Index k = 0; k < order.size(); ++k) {
        order[k] = static_cast<Index>(permutation.indices()[k]);
    }
    return order;
}

Ordered reorder(const SparseRows& matrix, const std::vector<Index>& order)
{
    const Index n = matrix.row_count();
    std::vector<Index> steps(n);
    for (Index k = 0; k < n; ++k) {
        steps[order[k]] = k;
    }
    Ordered ordered;
    ordered.offsets.assign(n + 1, 0);
    ordered.diagonal.assign(n, 0);
    const auto for_each_entry = [&](auto&& action) {
        for (Index row = 0; row < n; ++row) {
            const Index i = order[row];
            for (Index place = matrix.offsets[i]; place < matrix.offsets[i + 1]; ++place) {
                action(row, steps[matrix.columns[place]], matrix.values[place]);
            }
        }
    };
    for_each_entry([&](Index row, Index column, double) {
        if (row < column) {
            ++ordered.offsets[column + 1];
        }
    });
    for (Index k = 0; k < n; ++k) {
        ordered.offsets[k + 1] += ordered.offsets[k];
    }
    ordered.indices.resize(ordered.offsets.back());
    ordered.lower.resize(ordered.offsets.back());
    ordered.upper.resize(ordered.offsets.back());
    // Rows come in elimination order, so that the indices of each step increase.
    std::vector<std::size_t> ends(ordered.offsets.begin(), ordered.offsets.end() - 1);
    for_each_entry([&](Index row, Index column, double value) {
        if (row < column) {
            ordered.indices[ends[column]] = row;
            ordered.upper[ends[column]++] = value;
        } else if (row == column) {
            ordered.diagonal[row] = value;
        } else {
            const auto begin = ordered.indices.begin();
            const auto place =
                std::lower_bound(begin + static_cast<std::ptrdiff_t>(ordered.offsets[row]),
                                 begin + static_cast<std::ptrdiff_t>(ends[row]), column);
            ordered.lower[static_cast<std::size_t>(place - begin)] = value;
        }
    });
    return ordered;
}

/// The elimination tree: per step the next one that it changes, kNone for a root.
std::vector<Index> elimination_tree(const Ordered& a)
{
    const auto n = static_cast<Index>(a.diagonal.size());
    std::vector<Index> parents(n, kNone);
    std::vector<Index> ancestors(n, kNone);
    for (Index k = 0; k < n; ++k) {
        for (std::size_t place = a.offsets[k]; place < a.offsets[k + 1]; ++place) {
            Index j = a.indices[place];
            while (j != kNone && j < k) {
                const Index next = ancestors[j];
                ancestors[j] = k;
                if (next == kNone) {
                    parents[j] = k;
                }
                j = next;
            }
        }
    }
    return parents;
}

/// Finds, step by step, where a row of L (a column of U) has entries.
class Reach {
public:
    Reach(const Ordered& a, const std::vector<Index>& parents)
        : a_(a), parents_(parents), marks_(parents.size(), kNone)
    {}

    /// The steps j < k whose elimination changes step k, in an order in which they can be done.
    const std::vector<Index>& operator()(Index k)
    {
        reached_.clear();
        marks_[k] = k;
        for (std::size_t place = a_.offsets[k]; place < a_.offsets[k + 1]; ++place) {
            for (Index j = a_.indices[place]; marks_[j] != k; j = parents_[j]) {
                marks_[j] = k;
                reached_.push_back(j);
            }
        }
        // Children come before parents in the elimination order itself.
        std::sort(reached_.begin(), reached_.end());
        return reached_;
    }

private:
    const Ordered& a_;
    const std::vector<Index>& parents_;
    std::vector<Index> marks_;
    std::vector<Index> reached_;
};

}  // namespace

SparseLu::SparseLu(const SparseRows& matrix) : order_(minimum_degree_order(matrix))
{
    const Ordered a = reorder(matrix, order_);
    const std::vector<Index> parents = elimination_tree(a);
    const Index n = matrix.row_count();

    offsets_.assign(n + 1, 0);
    Reach reach(a, parents);
    for (Index k = 0; k < n; ++k) {
        for (const Index j : reach(k)) {
            ++offsets_[j + 1];
        }
    }
    for (Index k = 0; k < n; ++k) {
        offsets_[k + 1] += offsets_[k];
    }
    indices_.resize(offsets_.back());
    values_.resize(offsets_.back());
    diagonal_.resize(n);

    std::vector<std::size_t> ends(offsets_.begin(), offsets_.end() - 1);
    std::vector<Values> work(n, Values{0, 0});
    Reach again(a, parents);
    for (Index k = 0; k < n; ++k) {
        for (std::size_t place = a.offsets[k]; place < a.offsets[k + 1]; ++place) {
            work[a.indices[place]] = {a.lower[place], a.upper[place]};
        }
        double diagonal = a.diagonal[k];
        for (const Index j : again(k)) {
            const Values entry{work[j].lower / diagonal_[j], work[j].upper};
            work[j] = {0, 0};
            for (std::size_t place = offsets_[j]; place < ends[j]; ++place) {
                Values& changed = work[indices_[place]];
                changed.lower -= entry.lower * values_[place].upper;
                changed.upper -= entry.upper * values_[place].lower;
            }
            diagonal -= entry.lower * entry.upper;
            indices_[ends[j]] = k;
            values_[ends[j]++] = entry;
        }
        diagonal_[k] = diagonal;
    }
}

void SparseLu::solve(std::vector<double>& x) const
{
    const auto n = static_cast<Index>(order_.size());
    std::vector<double> y(n);
    for (Index k = 0; k < n; ++k) {
        y[k] = x[order_[k]];
    }
    for (Index j = 0; j < n; ++j) {
        for (std::size_t place = offsets_[j]; place < offsets_[j + 1]; ++place) {
            y[indices_[place]] -= values_[place].lower * y[j];
        }
    }
    for (Index j = n; j-- > 0;) {
        double sum = y[j];
        for (std::size_t place = offsets_[j]; place < offsets_[j + 1]; ++place) {
            sum -= values_[place].upper * y[indices_[place]];
        }
        y[j] = sum / diagonal_[j];
    }
    for (Index k = 0; k < n; ++k) {
        x[order_[k]] = y[k];
    }
}

}  // namespace layout_embedding
