#pragma once

#include <vector>

#include "base/types.hh"
#include "surface/cut_systems.hh"

namespace layout_embedding {

/// What is asked of the homotopy class of one layout edge: to be that of a walk, or not to be.
struct ClassConstraint {
    Index layout_edge;
    /// Whether the edge has to be in the walk's class, or may not be.
    bool is_kept;
    /// Darts of the path graph from tail(2e) to head(2e), the shortest of their class or not. No
    /// landmark lies on the way.
    std::vector<Index> darts;
};

/// Which homotopy classes layout edges may take. All other classes count as if they did not exist,
/// so that bounds hold for the embeddings that are left.
class ClassConstraints {
public:
    /// Keeps a reference to `cuts`.
    ClassConstraints(CutSystems& cuts, const PathGraph& graph,
                     const std::vector<ClassConstraint>& constraints);

    bool empty() const { return edges_.empty(); }
    /// Whether there are classes that the edge may not take.
    bool constrains(Index layout_edge) const { return find(layout_edge) != nullptr; }
    /// Whether the edge may take one class only.
    bool keeps(Index layout_edge) const;
    /// Shortest walks of classes that the edge may take are shorter than this: kInfiniteLength but
    /// for an edge that is kept in a class.
    Length limit(Index layout_edge) const;
    /// Whether the edge may take the class of a walk.
    bool admit(Index layout_edge, const std::vector<Index>& darts) const;

private:
    struct Edge {
        Index layout_edge;
        std::vector<HomotopyClass> kept;  // at most one that differs from the others
        std::vector<HomotopyClass> avoided;
        Length limit = kInfiniteLength;
    };
    const Edge* find(Index layout_edge) const;

    CutSystems& cuts_;
    std::vector<Edge> edges_;
};

}  // namespace layout_embedding
