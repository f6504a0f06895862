#pragma once

#include <memory>
#include <vector>

#include "search/lookahead_insertion.hh"
#include "search/search_space.hh"
#include "search/second_class.hh"

namespace layout_embedding {

/// Embeddings for where those that insertion finds are excluded: one layout edge takes its second
/// shortest homotopy class, all others follow by insertion that looks ahead. The edges that lose
/// least by it come first. Stepped.
class OtherRoutes {
public:
    enum class Outcome {
        running,
        /// `space.embedding` is complete.
        complete,
        /// No edge is left.
        finished,
        /// Equal lengths: start again with other perturbations.
        tied,
    };

    /// Keeps a reference. `root_walks`: the unconstrained path per layout edge.
    OtherRoutes(SearchSpace& space, std::vector<Index> root_walks);

    /// To the next embedding. Nothing is embedded at first, nor when it has finished.
    Outcome run(WorkBudget& budget);

private:
    struct Route {
        Index walk;
        Length extra;  // over the edge's shortest
    };
    Outcome find_routes(WorkBudget& budget);

    SearchSpace& space_;
    std::vector<Index> root_walks_;
    SecondClass second_;
    Index next_edge_ = 0;
    std::vector<Route> routes_;
    std::size_t next_route_ = 0;
    std::unique_ptr<LookaheadInsertion> lookahead_;
};

}  // namespace layout_embedding
