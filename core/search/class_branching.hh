#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "search/choice_tree.hh"
#include "search/known_classes.hh"
#include "search/work_budget.hh"

namespace layout_embedding {

/// Branch and bound (ChoiceTree) on what is known of classes: tells it which there are, what their
/// edges' rests cost at least, which exclude each other, and which close the layout's triangles.
class ClassBranching {
public:
    /// Keeps a reference. There is an upper bound.
    explicit ClassBranching(KnownClasses& known);

    /// Passes on what has become known since the last time. The faces know of all classes.
    void tell();
    void lower_upper_bound(Length cost);

    /// As of ChoiceTree, but that costs are absolute here.
    SelectionOutcome run(WorkBudget& budget);
    Index choice(Index layout_edge) const { return tree_.choice(layout_edge); }
    const std::vector<Index>& wanted() const { return tree_.wanted(); }
    void take_ruled_out(std::vector<Index>& walks, std::vector<Index>& rests)
    {
        tree_.take_ruled_out(walks, rests);
    }
    Length lower_bound() const { return known_.base() + tree_.lower_bound(); }
    std::uint64_t table_size() const { return tree_.table_size(); }

private:
    void tell_of(Index walk);
    void tell_of_triangles(Index walk);

    KnownClasses& known_;
    ChoiceTree tree_;
    std::size_t told_classes_ = 0;
    std::size_t told_bounds_ = 0;
    std::size_t told_forbidden_ = 0;
    std::vector<Index> triangles_;  // per face; kNone
    /// Per side of a face that no class known to the tree is on: tuples with an edge's rest that
    /// would complete it.
    std::unordered_map<Index, std::vector<Index>> tuples_;  // never iterated
    std::uint64_t uncharged_ = 0;
};

}  // namespace layout_embedding
