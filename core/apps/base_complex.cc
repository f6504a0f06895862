#include "apps/base_complex.hh"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace layout_embedding {
namespace {

constexpr Index kMaxSegments = 4096;

bool all_quads(const Layout& layout)
{
    for (Index face = 0; face < layout.face_count(); ++face) {
        if (layout.face_halfedges(face).size() != 4) {
            return false;
        }
    }
    return true;
}

/// The mean length of the layout edges that a loop passes, or of their halves. Every loop passes
/// one.
std::vector<double> loop_lengths(const BaseComplex& base, const Layout& layout,
                                 std::span<const double> lengths)
{
    const Index parts = base.is_subdivided() ? 2 : 1;
    std::vector<double> sums(base.loop_count(), 0);
    std::vector<Index> counts(base.loop_count(), 0);
    for (Index edge = 0; edge < layout.edge_count(); ++edge) {
        for (Index part = 0; part < parts; ++part) {
            const Index loop = base.loops()[base.edges_of(edge)[part]];
            sums[loop] += lengths[edge] / parts;
            ++counts[loop];
        }
    }
    for (Index loop = 0; loop < base.loop_count(); ++loop) {
        sums[loop] /= counts[loop];
    }
    return sums;
}

Index segments_for(double loop_length, double edge_length)
{
    const double wanted = std::floor(loop_length / edge_length + 0.5);
    return static_cast<Index>(std::clamp(wanted, 1.0, double(kMaxSegments)));
}

}  // namespace

BaseComplex::BaseComplex(const Layout& layout) : is_subdivided_(!all_quads(layout))
{
    add_quads(layout);
    find_loops();
}

void BaseComplex::add_quads(const Layout& layout)
{
    edge_count_ = is_subdivided_ ? 2 * layout.edge_count() : layout.edge_count();
    for (Index face = 0; face < layout.face_count(); ++face) {
        const auto sides = layout.face_halfedges(face);
        const auto count = static_cast<Index>(sides.size());
        if (!is_subdivided_) {
            Quad quad{face, 0, {}};
            for (Index i = 0; i < 4; ++i) {
                quad.sides[i] = {Layout::edge(sides[i]), sides[i] % 2 == 1};
            }
            quads_.push_back(quad);
            continue;
        }
        const Index spokes = edge_count_;
        for (Index i = 0; i < count; ++i) {
            const Index previous = i == 0 ? count - 1 : i - 1;
            quads_.push_back(
                {face,
                 i,
                 {Side{sides[i], false}, Side{spokes + i, false}, Side{spokes + previous, true},
                  Side{Layout::twin(sides[previous]), true}}});
        }
        edge_count_ += count;
    }
}

void BaseComplex::find_loops()
{
    std::vector<Index> parents(edge_count_);
    std::iota(parents.begin(), parents.end(), Index{0});
    const auto find = [&](Index edge) {
        while (parents[edge] != edge) {
            edge = parents[edge] = parents[parents[edge]];
        }
        return edge;
    };
    for (const Quad& quad : quads_) {
        for (const int side : {0, 1}) {
            const auto s = static_cast<std::size_t>(side);
            const Index a = find(quad.sides[s].edge);
            const Index b = find(quad.sides[s + 2].edge);
            parents[std::max(a, b)] = std::min(a, b);
        }
    }
    loops_.resize(edge_count_);
    for (Index edge = 0; edge < edge_count_; ++edge) {
        const Index first = find(edge);
        loops_[edge] = first == edge ? loop_count_++ : loops_[first];
    }
}

Result<std::vector<Index>> choose_segments(const BaseComplex& base, const Layout& layout,
                                           std::span<const double> lengths, double edge_length,
                                           std::span<const std::pair<Index, Index>> prescribed)
{
    if (!(edge_length > 0) || !std::isfinite(edge_length)) {
        return make_error(ErrorCode::invalidOption,
                          "the edge length of the quads is not a positive number");
    }
    const Index parts = base.is_subdivided() ? 2 : 1;
    std::vector<Index> of_loops;
    for (const double length : loop_lengths(base, layout, lengths)) {
        of_loops.push_back(segments_for(length, edge_length));
    }
    std::vector<Index> given(base.loop_count(), 0);
    for (const auto& [edge, count] : prescribed) {
        const std::string name =
            std::to_string(count) + " segments of layout edge " + std::to_string(edge);
        if (edge >= layout.edge_count() || count == 0 || count > kMaxSegments ||
            count % parts != 0) {
            return make_error(
                ErrorCode::invalidOption,
                name + " are not possible" + (parts == 2 ? " (an even number is needed)" : ""),
                {{"edge", edge}});
        }
        for (Index part = 0; part < parts; ++part) {
            const Index loop = base.loops()[base.edges_of(edge)[part]];
            if (given[loop] != 0 && given[loop] != count / parts) {
                return make_error(ErrorCode::invalidOption,
                                  name + " contradict another number for the same loop of quads",
                                  {{"edge", edge}});
            }
            given[loop] = count / parts;
            of_loops[loop] = count / parts;
        }
    }
    std::vector<Index> segments(base.edge_count());
    for (Index edge = 0; edge < base.edge_count(); ++edge) {
        segments[edge] = of_loops[base.loops()[edge]];
    }
    return segments;
}

double edge_length_for(const BaseComplex& base, const Layout& layout,
                       std::span<const double> lengths, double quads)
{
    const std::vector<double> of_loops = loop_lengths(base, layout, lengths);
    const double longest = *std::max_element(of_loops.begin(), of_loops.end());
    const auto count = [&](double segments_of_longest) {
        double sum = 0;
        for (const BaseComplex::Quad& quad : base.quads()) {
            double product = 1;
            for (const std::size_t side : {0, 1}) {
                const double length = of_loops[base.loops()[quad.sides[side].edge]];
                product *= segments_for(length, longest / segments_of_longest);
            }
            sum += product;
        }
        return sum;
    };
    // The number of quads only ever rises with the segments of the longest loop.
    double few = 1;
    double many = kMaxSegments;
    if (count(few) >= quads) {
        return longest / few;
    }
    constexpr int kHalvings = 50;
    for (int i = 0; i < kHalvings; ++i) {
        const double middle = (few + many) / 2;
        (count(middle) < quads ? few : many) = middle;
    }
    const double segments = quads / count(few) < count(many) / quads ? few : many;
    return longest / segments;
}

}  // namespace layout_embedding
