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
    Index size() const { return static_cast<Index>(nodes_.size()); }

private:
    struct Node {
        Index prefix;
        Letter letter;
    };
    std::vector<Node> nodes_{{kEmpty, 0}};
    std::unordered_map<std::uint64_t, Index> longer_;  // looked up, never iterated
};

/// Cuts that tell the homotopy classes of walks apart on a closed target of genus 0 that is
/// punctured at all landmarks (design, Sec. 3; proof.md, Sec. 4).
///
/// From every landmark but one, the root, an arc leads to the root. The arcs don't meet: each runs
/// on the left of a path of the shortest-path tree of the root, close to it, and where paths share
/// an edge their arcs lie side by side. They leave a disk of the surface, so that walks between the
/// same landmarks are homotopic exactly if they cross the arcs in the same reduced sequence, up to
/// turns around their own ends; the letter of an end is a generator itself as long as it is not the
/// root.
class CutSystem {
public:
    /// `landmark_nodes`: one per layout vertex; `root` is a layout vertex. A shortest-path search
    /// over the whole graph.
    CutSystem(const PathGraph& graph, std::span<const Index> landmark_nodes, Index root);

    /// The letter of crossing the arc of a layout vertex, other than the root, from its right to
    /// its left (seen from the landmark to the root).
    static Words::Letter letter(Index layout_vertex)
    {
        return static_cast<Words::Letter>(layout_vertex) + 1;
    }
    /// The word of a walk that goes on along a dart. Words only count up to turns around the layout
    /// vertex `start`, where the walk began and which is not the root: powers of its letter at their
    /// beginning are left away.
    Index advance(Words& words, Index word, Index dart, Index start) const;

private:
    /// A node that arcs pass, to its left as they see it.
    struct Passed {
        /// Layout vertices whose arcs pass, the nearest to the node first.
        std::vector<Index> arcs;
        /// Per dart of the node: how many of them it crosses.
        std::vector<Index> crossed;
    };
    std::span<const Index> crossed(Index node, Index dart) const;

    const PathGraph& graph_;
    std::unordered_map<Index, Passed> passed_;  // by node; looked up, never iterated
};

}  // namespace layout_embedding
