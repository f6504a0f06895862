#include "search/repulsive_guide.hh"

#include <algorithm>

#include "surface/harmonic_functions.hh"

namespace layout_embedding {

namespace {
constexpr unsigned kFunctionBits = 15;
constexpr double kOne = 1U << kFunctionBits;
}  // namespace

RepulsiveGuide::RepulsiveGuide(const EmbeddingProblem& problem, const PathGraph& graph)
    : target_(*problem.target), graph_(graph), weights_(graph.node_count())
{
    const HarmonicFunctions functions(target_, problem.landmarks);
    for (Index i = 0; i < problem.landmarks.size(); ++i) {
        std::vector<std::uint16_t> rounded;
        rounded.reserve(target_.vertex_count());
        for (const double value : functions.solve(i)) {
            rounded.push_back(static_cast<std::uint16_t>(std::clamp(value, 0.0, 1.0) * kOne + 0.5));
        }
        functions_.push_back(std::move(rounded));
    }
}

const std::vector<NodeWeight>& RepulsiveGuide::node_weights(Index i, Index j)
{
    const auto& at_i = functions_[i];
    const auto& at_j = functions_[j];
    const Index vertices = target_.vertex_count();
    const auto weight = [&](Index vertex) -> NodeWeight& {
        return weights_[graph_.node_of_vertex(vertex)];
    };
    for (Index v = 0; v < vertices; ++v) {
        const NodeWeight near = NodeWeight{at_i[v]} + at_j[v];
        weight(v) = kFullWeight - std::min(near << (kWeightBits - kFunctionBits), kFullWeight);
    }
    for (Index e = 0; e < target_.edge_count(); ++e) {
        const Index h = target_.halfedge(e);
        weights_[graph_.node_of_edge(e)] = (weight(target_.tail(h)) + weight(target_.head(h))) / 2;
    }
    for (Index f = 0; f < target_.face_count(); ++f) {
        const auto [a, b, c] = target_.face(f);
        weights_[graph_.node_of_face(f)] = (weight(a) + weight(b) + weight(c)) / 3;
    }
    return weights_;
}

std::uint64_t RepulsiveGuide::estimate_bytes(Index target_vertices, Index landmarks)
{
    // Functions, node weights, and the factors while they are needed.
    return std::uint64_t{target_vertices} *
               (2 * std::uint64_t{landmarks} + 6 * sizeof(NodeWeight)) +
           HarmonicFunctions::estimate_bytes(target_vertices);
}

}  // namespace layout_embedding
