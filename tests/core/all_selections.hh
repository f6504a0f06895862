#pragma once

#include <functional>
#include <map>
#include <vector>

#include "layout/embedding_problem.hh"
#include "search_ground.hh"
#include "surface/path_graph.hh"

namespace layout_embedding::test {

struct SelectionRules {
    /// Whether a layout edge may be in the class of a shortest walk.
    std::function<bool(Index, const std::vector<Index>&)> admits = {};
    /// Layout edges with a given walk along the target's boundary.
    std::map<Index, std::vector<Index>> walks = {};
    PathGraph::Options graph = {};
    /// How many of the cheapest selections are wanted.
    std::size_t count = 1;
};

/// The cheapest selections of homotopy classes by trying all that are cheaper than a limit, each
/// edge's classes enumerated as far as that needs. Nothing is shared with the solver but the
/// enumeration and the test of two walks for a crossing.
class AllSelections {
public:
    AllSelections(const EmbeddingProblem& problem, Length limit, const SelectionRules& rules = {});

    /// The limit if there is nothing below it.
    Length best() const { return costs_.empty() ? limit_ : costs_.front(); }
    /// Of the cheapest ones below the limit, ascending.
    const std::vector<Length>& costs() const { return costs_; }

private:
    struct Class {
        Length cost;
        std::vector<Index> darts;
    };

    void enumerate(const EmbeddingProblem& problem, Length limit, const SelectionRules& rules);
    bool crosses(const std::vector<Index>& a, const std::vector<Index>& b) const;
    bool fits();
    Length threshold() const { return costs_.size() == count_ ? costs_.back() : limit_; }
    void visit(Index edge, Length cost);

    SearchGround ground_;
    EdgeWeights weights_;
    Length limit_;
    std::size_t count_;
    std::vector<Length> costs_;
    std::vector<std::vector<Class>> classes_;
    std::vector<Index> order_;  // of insertion: given walks first
    std::vector<Length> rest_;
    std::vector<const Class*> chosen_;
};

}  // namespace layout_embedding::test
