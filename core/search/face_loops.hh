#pragma once

#include <array>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "base/types.hh"
#include "layout/layout.hh"
#include "surface/cut_systems.hh"
#include "surface/walk_pool.hh"

namespace layout_embedding {

/// What the faces of a layout demand of the walks around them. A face is a disk without landmarks
/// and holes, so the loop along its edges, pushed to its inside, is contractible in the punctured
/// target. The classes of all its edges but one thus say which class the last one is in
/// (exact_method.md, *Faces*).
///
/// A *side* is a class of walks along a halfedge, by an id.
class FaceLoops {
public:
    /// Keeps references. Cuts are not made before there is a walk to be taken note of.
    FaceLoops(const Layout& layout, const PathGraph& graph, const WalkPool& pool, CutSystems& cuts);

    /// Once a walk has been noted: whether the face demands anything. It does not if every layout
    /// vertex is one of its corners, so that none is left to root cuts at.
    bool demands(Index face) const { return cuts_[face] != nullptr; }
    /// Takes note of a walk of the pool.
    void add(Index walk);
    /// The side of a walk along a halfedge of its edge; kNone if the face there demands nothing.
    Index side(Index halfedge, Index walk) const { return words_[walk].sides[halfedge % 2]; }
    /// The walk that has been noted for a side; kNone if there is none.
    Index walk(Index side) const { return walks_[side]; }

    /// Whether the loop along these walks, one per halfedge of the face, is contractible.
    bool closes(Index face, std::span<const Index> walks);
    /// The only side on which the loop can be closed at a place among the face's halfedges, if it
    /// runs along these walks elsewhere. What `walks` says at the place itself does not matter.
    Index completion(Index face, std::span<const Index> walks, std::size_t place);

private:
    using Letters = HomotopyClass;
    struct Word {
        /// The letters of the arcs that a walk crosses from tail(2e) to head(2e), in the cuts of
        /// the faces left of halfedges 2e and 2e + 1.
        std::array<Letters, 2> letters;
        std::array<Index, 2> sides{kNone, kNone};
    };

    void make_cuts();
    void times(Words::Letter letter);
    void go_along(Index halfedge, Index walk);
    void turn(Index face, std::span<const Index> walks, std::size_t place);
    Index side_of(Index halfedge, Letters letters);

    const Layout& layout_;
    const PathGraph& graph_;
    const WalkPool& pool_;
    CutSystems& systems_;
    std::vector<const CutSystem*> cuts_;  // per face, rooted at none of its corners; null: none
    std::vector<Word> words_;             // per walk
    std::map<std::pair<Index, Letters>, Index> sides_;  // by halfedge and class
    std::vector<Index> walks_;                          // per side
    Letters product_;                                   // along the loop so far, reduced
};

}  // namespace layout_embedding
