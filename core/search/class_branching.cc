#include "search/class_branching.hh"

#include <algorithm>
#include <array>
#include <utility>

namespace layout_embedding {

ClassBranching::ClassBranching(KnownClasses& known)
    : known_(known),
      tree_(known.layout().edge_count(), known.upper_bound() - known.base()),
      triangles_(known.layout().face_count(), kNone)
{
    const Layout& layout = known.layout();
    for (Index f = 0; known.faces() != nullptr && f < layout.face_count(); ++f) {
        const auto halfedges = layout.face_halfedges(f);
        if (halfedges.size() == 3 && known.faces()->demands(f)) {
            triangles_[f] =
                tree_.add_triangle({Layout::edge(halfedges[0]), Layout::edge(halfedges[1]),
                                    Layout::edge(halfedges[2])});
            tree_.add_tuple(triangles_[f], {kNone, kNone, kNone});
        }
    }
}

void ClassBranching::tell()
{
    const auto& walks = known_.walks();
    const auto& bounds = known_.bounds();
    const auto& forbidden = known_.forbidden();
    if (told_classes_ < walks.size() || told_bounds_ < bounds.size() ||
        told_forbidden_ < forbidden.size()) {
        tree_.expect_news();
    }
    while (told_classes_ < walks.size()) {
        tell_of(walks[told_classes_++]);
    }
    for (; told_bounds_ < bounds.size(); ++told_bounds_) {
        const KnownClasses::Bound& bound = bounds[told_bounds_];
        tree_.add_bound(bound.layout_edge, bound.walks, bound.excess);
    }
    for (; told_forbidden_ < forbidden.size(); ++told_forbidden_) {
        tree_.forbid(forbidden[told_forbidden_]);
    }
}

void ClassBranching::lower_upper_bound(Length cost)
{
    tree_.lower_upper_bound(cost - std::min(cost, known_.base()));
}

SelectionOutcome ClassBranching::run(WorkBudget& budget)
{
    budget.charge(std::exchange(uncharged_, 0));
    return tree_.run(budget);
}

void ClassBranching::tell_of(Index walk)
{
    tree_.add_class(known_.pool().layout_edge(walk), walk, known_.excess(walk));
    if (known_.faces() != nullptr) {
        tell_of_triangles(walk);
    }
    if (!tree_.knows(walk)) {
        return;
    }
    const auto exclude = [&](Index other) {
        if (tree_.knows(other)) {
            tree_.exclude(walk, other);
        }
        return true;
    };
    known_.pool().crossing(walk).all_of(exclude);
    known_.for_each_in_wrong_order(walk, exclude);
}

/// Which classes triangles allow beside a new one: of two edges' classes, the third edge's that
/// completes them, or its rest while that one is not known.
void ClassBranching::tell_of_triangles(Index walk)
{
    const Layout& layout = known_.layout();
    FaceLoops& faces = *known_.faces();
    const Index e = known_.pool().layout_edge(walk);
    for (const Index h : {2 * e, 2 * e + 1}) {
        const Index face = layout.face(h);
        if (face == kNone || triangles_[face] == kNone) {
            continue;
        }
        const Index triangle = triangles_[face];
        const auto waiting = tuples_.extract(faces.side(h, walk));
        if (!waiting.empty()) {
            for (const Index tuple : waiting.mapped()) {
                tree_.remove_tuple(triangle, tuple);
            }
        }
        if (!tree_.knows(walk)) {
            continue;
        }
        const auto halfedges = layout.face_halfedges(face);
        const auto place = static_cast<std::size_t>(
            std::find(halfedges.begin(), halfedges.end(), h) - halfedges.begin());
        std::array<Index, 3> walks{kNone, kNone, kNone};
        walks[place] = walk;
        tree_.add_tuple(triangle, walks);
        for (const std::size_t step : {1, 2}) {
            const std::size_t beside = (place + step) % 3;
            const std::size_t third = (place + 3 - step) % 3;
            for (const Index other : known_.walks(Layout::edge(halfedges[beside]))) {
                if (!tree_.knows(other) || !known_.can_go_together(walk, other)) {
                    continue;
                }
                uncharged_ += 4;
                walks[beside] = other;
                const Index side = faces.completion(face, walks, third);
                const Index completion = faces.walk(side);
                if (completion == kNone) {
                    tuples_[side].push_back(tree_.add_tuple(triangle, walks));
                } else if (step == 1 && tree_.knows(completion) &&
                           known_.can_go_together(walk, completion) &&
                           known_.can_go_together(other, completion)) {
                    walks[third] = completion;
                    if (faces.closes(face, walks)) {
                        tree_.add_tuple(triangle, walks);
                    }
                    walks[third] = kNone;
                }
            }
            walks[beside] = kNone;
        }
    }
}

}  // namespace layout_embedding
