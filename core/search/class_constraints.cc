#include "search/class_constraints.hh"

#include <algorithm>

namespace layout_embedding {

ClassConstraints::ClassConstraints(CutSystems& cuts, const PathGraph& graph,
                                   const std::vector<ClassConstraint>& constraints)
    : cuts_(cuts)
{
    for (const ClassConstraint& constraint : constraints) {
        if (find(constraint.layout_edge) == nullptr) {
            edges_.push_back({constraint.layout_edge, {}, {}, kInfiniteLength});
        }
        Edge& edge = *std::find_if(edges_.begin(), edges_.end(), [&](const Edge& other) {
            return other.layout_edge == constraint.layout_edge;
        });
        HomotopyClass word = cuts.class_of(constraint.layout_edge, constraint.darts);
        if (!constraint.is_kept) {
            edge.avoided.push_back(std::move(word));
            continue;
        }
        edge.kept.push_back(std::move(word));
        Length length = 1;
        for (const Index d : constraint.darts) {
            length += graph.dart(d).length;
        }
        edge.limit = std::min(edge.limit, length);
    }
}

const ClassConstraints::Edge* ClassConstraints::find(Index layout_edge) const
{
    const auto place = std::find_if(edges_.begin(), edges_.end(), [&](const Edge& edge) {
        return edge.layout_edge == layout_edge;
    });
    return place == edges_.end() ? nullptr : &*place;
}

bool ClassConstraints::keeps(Index layout_edge) const
{
    const Edge* edge = find(layout_edge);
    return edge != nullptr && !edge->kept.empty();
}

Length ClassConstraints::limit(Index layout_edge) const
{
    const Edge* edge = find(layout_edge);
    return edge == nullptr ? kInfiniteLength : edge->limit;
}

bool ClassConstraints::admit(Index layout_edge, const std::vector<Index>& darts) const
{
    const Edge* edge = find(layout_edge);
    if (edge == nullptr) {
        return true;
    }
    const HomotopyClass word = cuts_.class_of(layout_edge, darts);
    const auto is_same = [&](const HomotopyClass& other) { return other == word; };
    return std::all_of(edge->kept.begin(), edge->kept.end(), is_same) &&
           std::none_of(edge->avoided.begin(), edge->avoided.end(), is_same);
}

}  // namespace layout_embedding
