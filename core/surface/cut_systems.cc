#include "surface/cut_systems.hh"

#include <algorithm>

namespace layout_embedding {

CutSystems::CutSystems(const Strands& strands)
    : graph_(strands.graph()), layout_(strands.layout()), has_holes_(false)
{
    for (Index v = 0; v < layout_.vertex_count(); ++v) {
        nodes_.push_back(strands.landmark_node(v));
    }
    for (Index node = 0; node < graph_.node_count() && !has_holes_; ++node) {
        has_holes_ = graph_.is_boundary(node);
    }
}

const CutSystem& CutSystems::of(Index layout_edge)
{
    const Index ends[] = {layout_.tail(2 * layout_edge), layout_.head(2 * layout_edge)};
    return *away_from(ends);
}

const CutSystem* CutSystems::away_from(std::span<const Index> layout_vertices)
{
    Index root = has_holes_ ? kNone : 0;
    while (std::find(layout_vertices.begin(), layout_vertices.end(), root) !=
           layout_vertices.end()) {
        ++root;
    }
    if (root != kNone && root >= nodes_.size()) {
        return nullptr;
    }
    const auto known = by_root_.find(root);
    return known != by_root_.end()
               ? &known->second
               : &by_root_.emplace(root, CutSystem(graph_, nodes_, root)).first->second;
}

HomotopyClass CutSystems::class_of(Index layout_edge, const std::vector<Index>& darts)
{
    const CutSystem& cuts = of(layout_edge);
    Words words;
    Index word = Words::kEmpty;
    for (const Index d : darts) {
        word = cuts.advance(words, word, d, layout_.tail(2 * layout_edge));
    }
    word = words.without_turns(word, cuts.letter(layout_.head(2 * layout_edge)));
    HomotopyClass letters;
    for (; word != Words::kEmpty; word = words.prefix(word)) {
        letters.push_back(words.last(word));
    }
    std::reverse(letters.begin(), letters.end());
    return letters;
}

}  // namespace layout_embedding
