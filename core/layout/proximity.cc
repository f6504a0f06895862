#include "layout/proximity.hh"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <string>
#include <utility>

#include "layout/nearest_points.hh"

namespace layout_embedding {
namespace {

using Neighbours = std::vector<NearestPoints::Neighbour>;

/// Assigns a column to each row at least total cost, by successive shortest augmenting paths on
/// reduced costs.
class Assignment {
public:
    /// Per row the columns it may take, with their costs.
    explicit Assignment(const std::vector<Neighbours>& rows, Index column_count)
        : rows_(rows),
          row_prices_(rows.size(), 0),
          column_prices_(column_count, 0),
          row_of_column_(column_count, kNone),
          column_of_row_(rows.size(), kNone),
          distances_(column_count),
          previous_(column_count),
          done_(column_count)
    {}

    /// Whether every row got a column.
    bool solve()
    {
        for (Index row = 0; row < rows_.size(); ++row) {
            if (!insert(row)) {
                return false;
            }
        }
        return true;
    }

    /// Per row its column.
    const std::vector<Index>& columns() const { return column_of_row_; }

    /// A further column of at least this cost for the row cannot make a better assignment: the
    /// prices of columns are at most zero.
    double price(Index row) const { return row_prices_[row]; }

private:
    bool insert(Index start)
    {
        std::fill(distances_.begin(), distances_.end(), std::numeric_limits<double>::infinity());
        std::fill(done_.begin(), done_.end(), false);
        std::vector<Index> finished;
        using Entry = std::pair<double, Index>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
        Index row = start;
        double distance = 0;
        for (;;) {
            for (const auto& [cost, column] : rows_[row]) {
                // Reduced costs are not negative but for rounding.
                const double reduced = cost - row_prices_[row] - column_prices_[column];
                const double reached = distance + std::max(reduced, 0.0);
                if (!done_[column] && reached < distances_[column]) {
                    distances_[column] = reached;
                    previous_[column] = row;
                    queue.emplace(reached, column);
                }
            }
            Index nearest = kNone;
            while (nearest == kNone && !queue.empty()) {
                nearest = done_[queue.top().second] ? kNone : queue.top().second;
                queue.pop();
            }
            if (nearest == kNone) {
                return false;
            }
            done_[nearest] = true;
            distance = distances_[nearest];
            if (row_of_column_[nearest] == kNone) {
                update_prices(start, finished, distance);
                augment(start, nearest);
                return true;
            }
            finished.push_back(nearest);
            row = row_of_column_[nearest];
        }
    }

    void update_prices(Index start, const std::vector<Index>& finished, double distance)
    {
        row_prices_[start] += distance;
        for (const Index column : finished) {
            const double change = distance - distances_[column];
            row_prices_[row_of_column_[column]] += change;
            column_prices_[column] -= change;
        }
    }

    void augment(Index start, Index column)
    {
        // Walk back along the path; every row on it moves on to the next column.
        for (Index row = kNone; row != start;) {
            row = previous_[column];
            row_of_column_[column] = row;
            std::swap(column_of_row_[row], column);
        }
    }

    const std::vector<Neighbours>& rows_;
    std::vector<double> row_prices_;
    std::vector<double> column_prices_;
    std::vector<Index> row_of_column_;
    std::vector<Index> column_of_row_;
    // Of the search in progress.
    std::vector<double> distances_;
    std::vector<Index> previous_;
    std::vector<bool> done_;
};

Status check_positions(std::span<const Vec3> positions)
{
    constexpr double kLargest = 1e60;
    for (std::size_t v = 0; v < positions.size(); ++v) {
        const std::string where =
            "the layout has vertex " + std::to_string(v) + " with a coordinate ";
        const std::int64_t vertex = static_cast<std::int64_t>(v);
        if (!positions[v].allFinite()) {
            return make_error(ErrorCode::nonFinitePosition, where + "that is not a finite number",
                              {{"vertex", vertex}});
        }
        if (positions[v].cwiseAbs().maxCoeff() > kLargest) {
            return make_error(ErrorCode::coordinateTooLarge, where + "beyond 1e60",
                              {{"vertex", vertex}});
        }
    }
    return {};
}

}  // namespace

Result<std::vector<Index>> landmarks_by_proximity(const Layout& layout,
                                                  std::span<const Vec3> layout_positions,
                                                  const TriangleMesh& target)
{
    if (Status status = check_positions(layout_positions); !status) {
        return status.error();
    }
    const Index count = layout.vertex_count();
    std::vector<Index> all;
    std::vector<Index> inner;
    for (Index v = 0; v < target.vertex_count(); ++v) {
        all.push_back(v);
        if (!target.is_boundary_vertex(v)) {
            inner.push_back(v);
        }
    }
    const std::size_t inner_count = inner.size();
    const NearestPoints all_points(target.positions(), std::move(all));
    const NearestPoints inner_points(target.positions(), std::move(inner));
    const auto suitable = [&](Index v) {
        return layout.is_boundary_vertex(v) ? target.vertex_count() : inner_count;
    };

    std::vector<std::size_t> sizes(count, std::min<std::size_t>(4, count));
    std::vector<Neighbours> rows(count);
    std::vector<bool> stale(count, true);
    for (;;) {
        // The candidates, as columns numbered in the order of their ids.
        std::vector<Index> columns;
        for (Index v = 0; v < count; ++v) {
            if (stale[v]) {
                const NearestPoints& points =
                    layout.is_boundary_vertex(v) ? all_points : inner_points;
                rows[v] = points.nearest(layout_positions[v], sizes[v]);
                stale[v] = false;
            }
            for (const auto& neighbour : rows[v]) {
                columns.push_back(neighbour.id);
            }
        }
        std::sort(columns.begin(), columns.end());
        columns.erase(std::unique(columns.begin(), columns.end()), columns.end());
        std::vector<Neighbours> local = rows;
        for (Neighbours& row : local) {
            for (auto& neighbour : row) {
                neighbour.id = static_cast<Index>(
                    std::lower_bound(columns.begin(), columns.end(), neighbour.id) -
                    columns.begin());
            }
        }
        Assignment assignment(local, static_cast<Index>(columns.size()));
        const bool solved = assignment.solve();
        // A vertex whose price is beyond its farthest candidate might gain by one still farther.
        bool enlarged = false;
        for (Index v = 0; v < count; ++v) {
            const bool complete = rows[v].size() >= std::min<std::size_t>(suitable(v), count);
            if (!complete && (!solved || assignment.price(v) > rows[v].back().squared_distance)) {
                sizes[v] *= 2;
                stale[v] = enlarged = true;
            }
        }
        if (!enlarged && !solved) {
            return make_error(
                ErrorCode::landmarkCount,
                "the layout has " + std::to_string(count) + " vertices but the target only " +
                    std::to_string(target.vertex_count()) + ", " + std::to_string(inner_count) +
                    " of them off its boundary, to put them on",
                {{"layoutVertices", count}, {"targetVertices", target.vertex_count()}});
        }
        if (!enlarged) {
            std::vector<Index> landmarks = assignment.columns();
            for (Index& landmark : landmarks) {
                landmark = columns[landmark];
            }
            return landmarks;
        }
    }
}

}  // namespace layout_embedding
