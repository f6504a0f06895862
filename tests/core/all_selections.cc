#include "all_selections.hh"

#include <algorithm>
#include <gtest/gtest.h>

#include "surface/class_enumeration.hh"
#include "surface/cut_system.hh"
#include "surface/hole_guard.hh"
#include "surface/stretch.hh"

namespace layout_embedding::test {

AllSelections::AllSelections(const EmbeddingProblem& problem, Length limit,
                             const SelectionRules& rules)
    : ground_(problem, rules.graph),
      weights_(problem.weights),
      limit_(limit),
      count_(rules.count),
      classes_(problem.layout->edge_count())
{
    for (Index e = 0; e < classes_.size(); ++e) {
        if (rules.walks.count(e) > 0) {
            order_.push_back(e);
        }
    }
    for (Index e = 0; e < classes_.size(); ++e) {
        if (rules.walks.count(e) == 0) {
            order_.push_back(e);
        }
    }
    enumerate(problem, limit, rules);
    visit(0, 0);
}

void AllSelections::enumerate(const EmbeddingProblem& problem, Length limit,
                              const SelectionRules& rules)
{
    const Layout& layout = ground_.strands.layout();
    std::vector<Index> nodes;
    for (Index v = 0; v < layout.vertex_count(); ++v) {
        nodes.push_back(ground_.strands.landmark_node(v));
    }
    std::vector<Length> shortest(classes_.size(), 0);
    Length root = 0;
    for (Index e = 0; e < layout.edge_count(); ++e) {
        if (const auto walk = rules.walks.find(e); walk != rules.walks.end()) {
            for (const Index dart : walk->second) {
                shortest[e] += ground_.graph.dart(dart).length;
            }
            shortest[e] = weights_.cost(e, shortest[e]);
            classes_[e].push_back({shortest[e], walk->second});
        } else {
            ground_.search.begin(e);
            EXPECT_EQ(ground_.search.run(), CutSurfaceSearch::Outcome::found);
            shortest[e] = weights_.cost(e, ground_.search.cost());
        }
        root += shortest[e];
    }
    const bool has_holes = problem.target->boundary_loop_count() > 0;
    for (Index e = 0; e < layout.edge_count() && limit > root; ++e) {
        if (rules.walks.count(e) > 0) {
            continue;
        }
        Index v = has_holes ? kNone : 0;
        while (v == layout.tail(2 * e) || v == layout.head(2 * e)) {
            ++v;
        }
        const CutSystem cuts(ground_.graph, nodes, v);
        ClassEnumeration enumeration(ground_.strands, ground_.fields);
        enumeration.begin(cuts, e, weights_.length(e, shortest[e] + (limit - root)));
        while (enumeration.run() == ClassEnumeration::Outcome::found) {
            if (!rules.admits || rules.admits(e, enumeration.darts())) {
                classes_[e].push_back({weights_.cost(e, enumeration.cost()), enumeration.darts()});
            }
        }
    }
    rest_.assign(classes_.size() + 1, 0);
    for (std::size_t e = classes_.size(); e-- > 0;) {
        rest_[e] = rest_[e + 1] + shortest[e];
    }
}

bool AllSelections::crosses(const std::vector<Index>& a, const std::vector<Index>& b) const
{
    const PathGraph& graph = ground_.graph;
    for (Index i = 0; i + 1 < a.size(); ++i) {
        for (Index j = 0; j + 1 < b.size(); ++j) {
            if (graph.head(a[i]) == graph.head(b[j]) && stretch_crosses(graph, a, i, b, j)) {
                return true;
            }
        }
    }
    return false;
}

/// The strands themselves say whether the orders around the landmarks are right, and whether the
/// holes are where they belong.
bool AllSelections::fits()
{
    bool fits = true;
    std::size_t inserted = 0;
    for (std::size_t i = 0; i < order_.size() && fits; ++i) {
        fits = ground_.strands.insert(order_[i], chosen_[order_[i]]->darts);
        inserted += fits ? 1 : 0;
    }
    fits = fits && HoleGuard(ground_.strands).accepts();
    while (inserted-- > 0) {
        ground_.strands.undo();
    }
    return fits;
}

void AllSelections::visit(Index edge, Length cost)
{
    if (cost + rest_[edge] >= threshold()) {
        return;
    }
    if (edge == classes_.size()) {
        if (fits()) {
            costs_.insert(std::upper_bound(costs_.begin(), costs_.end(), cost), cost);
            costs_.resize(std::min(costs_.size(), count_));
        }
        return;
    }
    for (const Class& candidate : classes_[edge]) {
        if (std::none_of(chosen_.begin(), chosen_.end(), [&](const Class* other) {
                return crosses(candidate.darts, other->darts);
            })) {
            chosen_.push_back(&candidate);
            visit(edge + 1, cost + candidate.cost);
            chosen_.pop_back();
        }
    }
}

}  // namespace layout_embedding::test
