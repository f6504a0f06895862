#include "apps/embed_options.hh"

#include <string>
#include <utility>

namespace layout_embedding {

namespace {

Status check_metric(const PathMetric& metric, const EmbeddingProblem& problem)
{
    const auto& [costs, discount] = metric;
    const Index vertices = problem.target->vertex_count();
    if (!costs.empty() && costs.size() != vertices) {
        return make_error(ErrorCode::invalidOption,
                          std::to_string(costs.size()) + " vertex costs are given for the " +
                              std::to_string(vertices) + " vertices of the target");
    }
    for (Index v = 0; v < costs.size(); ++v) {
        if (!(costs[v] >= kMinPathCost && costs[v] <= kMaxPathCost)) {
            return make_error(ErrorCode::invalidOption, "the cost of length at target vertex " +
                                                            std::to_string(v) +
                                                            " is not from 0.001 to 1000");
        }
    }
    if (!(discount >= 0 && discount <= kMaxFeatureDiscount)) {
        return make_error(ErrorCode::invalidOption,
                          "the discount along sharp edges is not from 0 to 0.95");
    }
    return {};
}

Status check_weights(const std::vector<double>& weights, const EmbeddingProblem& problem)
{
    const Index edges = problem.layout->edge_count();
    if (!weights.empty() && weights.size() != edges) {
        return make_error(ErrorCode::invalidOption,
                          std::to_string(weights.size()) + " weights are given for the " +
                              std::to_string(edges) + " edges of the layout");
    }
    for (Index e = 0; e < weights.size(); ++e) {
        if (!(weights[e] >= kMinEdgeWeight && weights[e] <= kMaxEdgeWeight)) {
            return make_error(
                ErrorCode::invalidOption,
                "the weight of layout edge " + std::to_string(e) + " is not from 0.001 to 1000",
                {{"edge", e}});
        }
    }
    return {};
}

/// What only the exact method can do must not be asked of another one.
Status check_algorithm(const EmbedOptions& options)
{
    const auto refuse = [](const char* what) {
        std::string message = what;
        message += ", which only the exact method can do";
        return make_error(ErrorCode::invalidOption, std::move(message));
    };
    if (options.algorithm == Algorithm::exact) {
        return {};
    }
    if (!options.constraints.empty()) {
        return refuse("paths are to be kept or avoided");
    }
    if (!options.excluded.empty()) {
        return refuse("embeddings are to be excluded");
    }
    if (options.boundary_is_followed) {
        return refuse("paths are to run along the target's boundary");
    }
    return {};
}

Status check_given(const EmbedOptions& options)
{
    if (!options.given.empty() && (!options.constraints.empty() || !options.excluded.empty())) {
        return make_error(ErrorCode::invalidOption,
                          "an embedding is given, and paths or embeddings are ruled out: leave out "
                          "one of the two");
    }
    return {};
}

}  // namespace

Status check_options(const EmbedOptions& options, const EmbeddingProblem& problem)
{
    for (Status status :
         {check_metric(options.metric, problem), check_weights(options.edge_weights, problem),
          check_algorithm(options), check_given(options)}) {
        if (!status) {
            return status;
        }
    }
    return {};
}

}  // namespace layout_embedding
