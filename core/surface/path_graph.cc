#include "surface/path_graph.hh"

#include <algorithm>
#include <cmath>

#include "base/random.hh"

namespace layout_embedding {

namespace {

// The bounding-box diagonal is about 2^54 units: a path may be 512 diagonals long before a sum
// overflows. Every edge gets 32 random low bits, centred so that they do not lengthen paths on
// average; 2^-23 of the diagonal is far below the resolution of the subdivision. Headroom makes all
// of it smaller.
constexpr double kDiagonal = 0x1.0p54;
constexpr Length kNoise = Length{1} << 32U;

class LengthScale {
public:
    LengthScale(double unit, const PathGraph::Options& options)
        : unit_(unit),
          noise_(kNoise / options.headroom),
          random_(Random::mix(options.seed) ^ Random::mix(~std::uint64_t{options.attempt}))
    {}

    Length operator()(double distance)
    {
        const auto rounded = static_cast<Length>(distance / unit_ + 0.5);
        return std::max(rounded, noise_ / 2) - noise_ / 2 + random_.bits() % noise_ + 1;
    }

private:
    double unit_;
    Length noise_;
    Random random_;
};

/// The lowest 20 bits of x, two zeros between any two of them.
std::uint64_t spread(std::uint64_t x)
{
    x &= 0xfffff;
    x = (x | x << 32U) & 0x001f00000000ffff;
    x = (x | x << 16U) & 0x001f0000ff0000ff;
    x = (x | x << 8U) & 0x100f00f00f00f00f;
    x = (x | x << 4U) & 0x10c30c30c30c30c3;
    return (x | x << 2U) & 0x1249249249249249;
}

/// The faces of a mesh along a space-filling curve (Morton order of their first corners), so that
/// elements near each other get numbers near each other.
std::vector<Index> faces_along_curve(const TriangleMesh& mesh, const Vec3& low, const Vec3& high)
{
    const double extent = std::max((high - low).maxCoeff(), std::numeric_limits<double>::min());
    std::vector<std::pair<std::uint64_t, Index>> keys;
    keys.reserve(mesh.face_count());
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const Vec3 p = (mesh.position(mesh.face(f)[0]) - low) / extent * 0xfffff;
        const auto code = [&](int axis) { return spread(static_cast<std::uint64_t>(p[axis])); };
        keys.emplace_back(code(0) | code(1) << 1U | code(2) << 2U, f);
    }
    std::sort(keys.begin(), keys.end());
    std::vector<Index> faces;
    faces.reserve(keys.size());
    for (const auto& [key, f] : keys) {
        faces.push_back(f);
    }
    return faces;
}

}  // namespace

PathGraph PathGraph::barycentric(const TriangleMesh& target, const Options& options)
{
    PathGraph graph;
    const Index vertices = target.vertex_count();
    const Index edges = target.edge_count();
    const Index faces = target.face_count();
    const Index nodes = vertices + edges + faces;
    graph.vertex_count_ = vertices;
    graph.edge_count_ = edges;

    Vec3 low = target.position(0);
    Vec3 high = low;
    for (const Vec3& p : target.positions()) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    graph.number_nodes(target, faces_along_curve(target, low, high));

    graph.positions_.resize(nodes);
    for (Index v = 0; v < vertices; ++v) {
        graph.positions_[graph.node_of_vertex(v)] = target.position(v);
    }
    for (Index e = 0; e < edges; ++e) {
        const Index h = target.halfedge(e);
        graph.positions_[graph.node_of_edge(e)] =
            0.5 * (target.position(target.tail(h)) + target.position(target.head(h)));
    }
    for (Index f = 0; f < faces; ++f) {
        const auto [a, b, c] = target.face(f);
        graph.positions_[graph.node_of_face(f)] =
            (target.position(a) + target.position(b) + target.position(c)) / 3.0;
    }

    // The place of each halfedge among those that leave its tail.
    std::vector<Index> ranks(target.halfedge_count());
    graph.boundary_.assign(nodes, false);
    graph.dart_offsets_.assign(nodes + 1, 0);
    for (Index v = 0; v < vertices; ++v) {
        const Index first = target.outgoing(v);
        Index rank = 0;
        Index h = first;
        do {
            ranks[h] = rank++;
            h = target.rotated_ccw(h);
        } while (h != first && h != kNone);
        const Index node = graph.node_of_vertex(v);
        graph.boundary_[node] = h == kNone;
        graph.dart_offsets_[node + 1] = 2 * rank + (h == kNone ? 1 : 0);
    }
    for (Index e = 0; e < edges; ++e) {
        const bool boundary = target.is_boundary_edge(e);
        const Index node = graph.node_of_edge(e);
        graph.boundary_[node] = boundary;
        graph.dart_offsets_[node + 1] = boundary ? 3 : 4;
    }
    for (Index f = 0; f < faces; ++f) {
        graph.dart_offsets_[graph.node_of_face(f) + 1] = 6;
    }
    for (Index node = 0; node < nodes; ++node) {
        graph.dart_offsets_[node + 1] += graph.dart_offsets_[node];
    }

    // What a unit of length costs at a node.
    const std::span<const double> costs = options.vertex_costs;
    const auto at_vertex = [&](Index v) { return costs.empty() ? 1.0 : costs[v]; };
    const auto at_edge = [&](Index e) {
        const Index h = target.halfedge(e);
        return (at_vertex(target.tail(h)) + at_vertex(target.head(h))) / 2;
    };
    const auto at_face = [&](Index f) {
        const auto [a, b, c] = target.face(f);
        return (at_vertex(a) + at_vertex(b) + at_vertex(c)) / 3;
    };

    // However dear, no path may overflow.
    const double dearest = costs.empty() ? 1.0 : *std::max_element(costs.begin(), costs.end());
    graph.unit_ = (high - low).norm() / kDiagonal * dearest * static_cast<double>(options.headroom);
    LengthScale scaled(graph.unit_, options);

    graph.darts_.resize(graph.dart_offsets_.back());
    const auto join = [&](Index a, Index a_place, Index b, Index b_place, Length length) {
        const Index there = graph.dart_offsets_[a] + a_place;
        const Index back = graph.dart_offsets_[b] + b_place;
        graph.darts_[there] = {length, b, back};
        graph.darts_[back] = {length, a, there};
    };
    // Around an edge midpoint: head, left face, tail, right face. Around a centroid: corner 0,
    // midpoint of halfedge 0, corner 1, ...
    for (Index e = 0; e < edges; ++e) {
        const Index h = target.halfedge(e);
        const Index twin = target.opposite(h);
        const Index tail = graph.node_of_vertex(target.tail(h));
        const Index head = graph.node_of_vertex(target.head(h));
        const double half = 0.5 * (graph.positions_[tail] - graph.positions_[head]).norm();
        const Index midpoint = graph.node_of_edge(e);
        const double along = options.edge_costs.empty() ? 1.0 : options.edge_costs[e];
        const double from_tail = along * (at_vertex(target.tail(h)) + at_edge(e)) / 2;
        const double from_head = along * (at_vertex(target.head(h)) + at_edge(e)) / 2;
        join(tail, 2 * ranks[h], midpoint, 2, scaled(half * from_tail));
        // At a boundary vertex the last dart belongs to the edge that has no outgoing halfedge.
        const Index head_place = twin != kNone ? 2 * ranks[twin] : graph.degree(head) - 1;
        join(head, head_place, midpoint, 0, scaled(half * from_head));
    }
    for (Index h = 0; h < target.halfedge_count(); ++h) {
        const Index centroid = graph.node_of_face(TriangleMesh::face_of(h));
        const Index place = 2 * (h % 3);
        const Index corner = graph.node_of_vertex(target.tail(h));
        const Index e = target.edge(h);
        const double inside = at_face(TriangleMesh::face_of(h));
        const double to_corner = (at_vertex(target.tail(h)) + inside) / 2;
        const double to_midpoint = (at_edge(e) + inside) / 2;
        const Index midpoint = graph.node_of_edge(e);
        const Vec3& center = graph.positions_[centroid];
        join(corner, 2 * ranks[h] + 1, centroid, place,
             scaled((graph.positions_[corner] - center).norm() * to_corner));
        join(midpoint, target.halfedge(e) == h ? 1 : 3, centroid, place + 1,
             scaled((graph.positions_[midpoint] - center).norm() * to_midpoint));
    }
    return graph;
}

/// Face by face: corners and midpoints that have no number yet, then the centroid.
void PathGraph::number_nodes(const TriangleMesh& target, const std::vector<Index>& faces)
{
    const std::size_t nodes = std::size_t{vertex_count_} + edge_count_ + target.face_count();
    nodes_of_elements_.assign(nodes, kNone);
    elements_of_nodes_.reserve(nodes);
    const auto number = [&](Index element) {
        if (nodes_of_elements_[element] == kNone) {
            nodes_of_elements_[element] = static_cast<Index>(elements_of_nodes_.size());
            elements_of_nodes_.push_back(element);
        }
    };
    for (const Index f : faces) {
        for (Index corner = 0; corner < 3; ++corner) {
            number(target.face(f)[corner]);
            number(vertex_count_ + target.edge(3 * f + corner));
        }
        number(vertex_count_ + edge_count_ + f);
    }
}

void PathGraph::set_lengths(std::span<const Length> lengths)
{
    for (Index d = 0; d < dart_count(); ++d) {
        darts_[d].length = lengths[d];
    }
}

std::uint64_t PathGraph::estimate_bytes(Index vertices, Index edges, Index faces)
{
    const std::uint64_t nodes = std::uint64_t{vertices} + edges + faces;
    const std::uint64_t darts = 2 * (2 * std::uint64_t{edges} + 6 * std::uint64_t{faces});
    return darts * sizeof(Dart) + nodes * (3 * sizeof(Index) + sizeof(Vec3)) +
           3 * std::uint64_t{faces} * sizeof(Index);
}

NodeElement PathGraph::element(Index node) const
{
    const Index element = elements_of_nodes_[node];
    if (element < vertex_count_) {
        return {NodeKind::vertex, element};
    }
    if (element < vertex_count_ + edge_count_) {
        return {NodeKind::edge_midpoint, element - vertex_count_};
    }
    return {NodeKind::face_centroid, element - vertex_count_ - edge_count_};
}

double PathGraph::to_units(Length length) const
{
    return length == kInfiniteLength ? std::numeric_limits<double>::infinity()
                                     : static_cast<double>(length) * unit_;
}

}  // namespace layout_embedding
