#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "apps/path_constraints.hh"
#include "base/error.hh"
#include "embedding/path_shape.hh"
#include "layout/embedding_problem.hh"
#include "surface/path_metric.hh"

namespace layout_embedding {

/// How paths are chosen: by a greedy heuristic (search/greedy.hh), by branch and bound over
/// insertion sequences (search/sequence_solver.hh), or by the exact selection of homotopy classes
/// (search/exact_solver.hh). The numbers stay as they are; interfaces count
/// on them.
enum class Algorithm : std::uint32_t { greedy, praun, kraevoy, schreiner, branch_and_bound, exact };

struct EmbedOptions {
    Algorithm algorithm = Algorithm::exact;
    /// The gap to be reached, (cost - lower bound) / cost; 0 asks for the optimum.
    double gap = 0.01;
    std::uint64_t seed = 1;
    /// Wall-clock seconds for the search; infinity for none. Results under this limit depend on the
    /// machine; use work_limit for reproducible ones.
    double time_limit = std::numeric_limits<double>::infinity();
    /// Units of work for the search (WorkBudget: about node expansions). If it is not given, the
    /// exact method and branch and bound stop kDefaultPatience units after their first embedding,
    /// or, while there is none, after what two searches of the whole path graph per layout edge
    /// would take.
    std::optional<std::uint64_t> work_limit;
    PathShape shape = PathShape::shortened;
    /// Bytes the job may take, estimated before it starts.
    std::uint64_t memory_limit = std::numeric_limits<std::uint64_t>::max();
    /// Whether to look for changes of the input that would make the embedding far shorter
    /// (apps/landmark_doubts.hh).
    bool look_for_doubts = true;
    /// What is asked of single paths; for the exact method alone. Costs and bounds are those of the
    /// embeddings that comply.
    std::vector<PathConstraint> constraints;
    /// Embeddings that are not to be found again, each differing from what is in the homotopy class
    /// of at least one path: with the best ones here, the next best is found. For the exact method
    /// alone; bounds are those of all other embeddings.
    std::vector<EmbeddingPaths> excluded;
    /// The embedding to be realised, as a rule one that an earlier job found: nothing is searched,
    /// and nothing proved. Error beside `constraints` and `excluded`: invalidOption.
    EmbeddingPaths given;
    /// Whether layout boundary edges with both landmarks on the target's boundary run along it
    /// (apps/boundary_paths.hh); for the exact method alone. Costs and bounds are those of the
    /// embeddings with these paths. Error: invalidOption.
    bool boundary_is_followed = false;
    /// What paths cost; costs, bounds and the gap are in this metric. Where a path of the embedding
    /// runs along whole sharp edges that a discount makes cheaper, it does so in every shape,
    /// unless it shares them with others, of which one keeps to the edge. Apart from that, `short`
    /// is short on the surface: vertex costs do not count there. Error: invalidOption.
    PathMetric metric;
    /// Per layout edge, how much the length of its path counts (EdgeWeights); none for 1. What the
    /// problem says of weights is replaced. Costs, bounds and the gap are of weighted lengths.
    /// Error: invalidOption.
    std::vector<double> edge_weights;
};

/// A few seconds on the machines of today.
inline constexpr std::uint64_t kDefaultPatience = 15'000'000;

/// Whether the options are meant for the problem and go together. Error: invalidOption.
Status check_options(const EmbedOptions& options, const EmbeddingProblem& problem);

}  // namespace layout_embedding
