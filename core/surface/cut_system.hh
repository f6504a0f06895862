#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/types.hh"
#include "surface/path_graph.hh"

namespace layout_embedding {

/// Reduced words over the letters +1, -1, +2, -2, ... and their inverses (letter and inverse add up
/// to 0), each stored once: as its longest prefix and its last letter.
class Words {
public:
    using Letter = std::int32_t;

    static constexpr Index kEmpty = 0;

    /// The word times a letter, reduced.
    Index times(Index word, Letter letter);
    Letter last(Index word) const { return nodes_[word].letter; }
    /// The word without its last letter.
    Index prefix(Index word) const { return nodes_[word].prefix; }
    /// The word without powers of a letter at its end.
    Index without_turns(Index word, Letter letter) const
    {
        while (word != kEmpty && (last(word) == letter || last(word) == -letter)) {
            word = prefix(word);
        }
        return word;
    }
    Index size() const { return static_cast<Index>(nodes_.size()); }

private:
    struct Node {
        Index prefix;
        Letter letter;
    };
    std::vector<Node> nodes_{{kEmpty, 0}};
    std::unordered_map<std::uint64_t, Index> longer_;  // looked up, never iterated
};

/// Cuts that tell the homotopy classes of walks apart on a target of any genus that is punctured at
/// all landmarks (design, Sec. 3; proof.md, Sec. 4).
///
/// Punctures are the landmarks inside the target and its holes; one of them is the root. From every
/// other puncture an arc leads to the root, and 2 g arcs lead from the root to itself, where g is
/// the genus. Arcs don't meet: each runs on the left of a path of the root's shortest-path tree
/// (those back to the root: of two of them, which they change at an edge outside the tree), close
/// to it, and where paths share an edge their arcs lie side by side. They leave a disk of the
/// surface, so that walks between the same landmarks are homotopic exactly if they cross the arcs
/// in the same reduced sequence, up to turns around those of their own ends that are punctures; the
/// letter of such an end is a generator itself as long as it is not the root.
class CutSystem {
public:
    /// `landmark_nodes`: one per layout vertex. `root` is a layout vertex whose landmark lies
    /// inside the target, or kNone for the first of the target's holes. O(#nodes log #nodes).
    CutSystem(const PathGraph& graph, std::span<const Index> landmark_nodes, Index root);

    /// The letter of crossing a landmark's arc from its right to its left (seen from the landmark
    /// to the root); 0, which is no letter, where the landmark lies on the boundary.
    Words::Letter letter(Index layout_vertex) const { return letters_[layout_vertex]; }
    /// The dart of the landmark's node right after which, counter-clockwise, its arc begins; kNone
    /// where there is no letter.
    Index first_dart(Index layout_vertex) const { return first_darts_[layout_vertex]; }
    /// Calls function(letter) for every arc that a walk crosses along a dart, in order.
    template <typename Function>
    void for_each_crossing(Index dart, const Function& function) const
    {
        if (!crosses_[dart]) {
            return;
        }
        const Index twin = graph_.twin(dart);
        const Index head = graph_.head(dart);
        const Index tail = graph_.head(twin);
        for (const Words::Letter arc : crossed(tail, dart)) {
            function(arc);
        }
        if (!changes_.empty()) {
            const auto change = changes_.find(dart);
            if (change != changes_.end()) {
                function(change->second);
            }
        }
        const auto arriving = crossed(head, twin);
        for (std::size_t i = arriving.size(); i-- > 0;) {
            function(-arriving[i]);
        }
    }
    /// The word of a walk that goes on along a dart. Words only count up to turns around the layout
    /// vertex `start`, where the walk began and which is not the root: powers of its letter at
    /// their beginning are left away.
    Index advance(Words& words, Index word, Index dart, Index start) const;

private:
    /// A node that arcs pass, to its left as they see it.
    struct Passed {
        /// The letters of crossing the arcs from right to left, the nearest to the node first.
        std::vector<Words::Letter> arcs;
        /// Per dart of the node: how many of them it crosses.
        std::vector<Index> crossed;
    };
    std::span<const Words::Letter> crossed(Index node, Index dart) const;

    const PathGraph& graph_;
    std::vector<Words::Letter> letters_;        // per layout vertex
    std::vector<Index> first_darts_;            // likewise
    std::vector<bool> crosses_;                 // per dart, whether it crosses anything
    std::unordered_map<Index, Passed> passed_;  // by node; looked up, never iterated
    /// Edges that arcs from the root back to it cross at their middle: by dart, the letter of going
    /// along it. Their order does not matter.
    std::unordered_map<Index, Words::Letter> changes_;
};

}  // namespace layout_embedding
