#include "surface/harmonic_functions.hh"

#include "mesh/mean_value_weights.hh"

namespace layout_embedding {

HarmonicFunctions::System HarmonicFunctions::assemble(const TriangleMesh& target,
                                                      const std::vector<Index>& landmarks)
{
    System system;
    std::vector<Index> landmarks_of_vertices(target.vertex_count(), kNone);
    for (Index i = 0; i < landmarks.size(); ++i) {
        landmarks_of_vertices[landmarks[i]] = i;
    }
    system.rows.assign(target.vertex_count(), kNone);
    Index row_count = 0;
    for (Index v = 0; v < target.vertex_count(); ++v) {
        if (landmarks_of_vertices[v] == kNone) {
            system.rows[v] = row_count++;
        }
    }
    system.couplings.resize(landmarks.size());

    const auto weights = mean_value_weights(target);
    struct Neighbour {
        Index vertex;
        double weight;
    };
    std::vector<Neighbour> neighbours;
    for (Index v = 0; v < target.vertex_count(); ++v) {
        if (system.rows[v] == kNone) {
            continue;
        }
        neighbours.clear();
        double sum = 0;
        const auto visit = [&](Index halfedge, bool leaves) {
            const Index e = target.edge(halfedge);
            const bool from_tail = (target.halfedge(e) == halfedge) == leaves;
            const double weight = weights[e][from_tail ? 0 : 1];
            neighbours.push_back({leaves ? target.head(halfedge) : target.tail(halfedge), weight});
            sum += weight;
        };
        const Index first = target.outgoing(v);
        Index last = first;
        for (Index h = first; h != kNone;) {
            visit(h, true);
            last = h;
            h = target.rotated_ccw(h);
            if (h == first) {
                last = kNone;
                break;
            }
        }
        if (last != kNone) {
            // On the boundary the last edge has no halfedge that leaves v.
            visit(TriangleMesh::previous(last), false);
        }
        // Rows are divided by their diagonal.
        const Index row = system.rows[v];
        system.matrix.columns.push_back(row);
        system.matrix.values.push_back(1);
        for (const Neighbour& neighbour : neighbours) {
            const double share = neighbour.weight / sum;
            const Index column = system.rows[neighbour.vertex];
            if (column != kNone) {
                system.matrix.columns.push_back(column);
                system.matrix.values.push_back(-share);
            } else {
                system.couplings[landmarks_of_vertices[neighbour.vertex]].emplace_back(row, share);
            }
        }
        system.matrix.offsets.push_back(static_cast<Index>(system.matrix.columns.size()));
    }
    return system;
}

HarmonicFunctions::HarmonicFunctions(const TriangleMesh& target,
                                     const std::vector<Index>& landmarks)
    : HarmonicFunctions(landmarks, assemble(target, landmarks))
{}

HarmonicFunctions::HarmonicFunctions(const std::vector<Index>& landmarks, System system)
    : landmarks_(landmarks),
      rows_(std::move(system.rows)),
      couplings_(std::move(system.couplings)),
      factors_(system.matrix)
{}

std::vector<double> HarmonicFunctions::solve(Index i) const
{
    std::vector<double> x(rows_.size() - landmarks_.size(), 0);
    for (const auto& [row, share] : couplings_[i]) {
        x[row] += share;
    }
    factors_.solve(x);
    std::vector<double> values(rows_.size(), 0);
    for (Index v = 0; v < rows_.size(); ++v) {
        if (rows_[v] != kNone) {
            values[v] = x[rows_[v]];
        }
    }
    values[landmarks_[i]] = 1;
    return values;
}

std::uint64_t HarmonicFunctions::estimate_bytes(Index vertices)
{
    std::uint64_t bits = 1;
    while (vertices >> bits != 0) {
        ++bits;
    }
    // The matrix twice, and the factors.
    return std::uint64_t{vertices} * (300 + 75 * bits);
}

}  // namespace layout_embedding
