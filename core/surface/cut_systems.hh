#pragma once

#include <map>
#include <span>
#include <vector>

#include "base/types.hh"
#include "surface/cut_system.hh"
#include "surface/strands.hh"

namespace layout_embedding {

/// A homotopy class of arcs for one layout edge: the reduced word of the cuts crossed, without
/// turns around the arc's ends.
using HomotopyClass = std::vector<Words::Letter>;

/// Cuts that suit each layout edge, made when they are asked for.
class CutSystems {
public:
    /// Takes path graph, layout and landmarks from `strands`, whatever is embedded there.
    explicit CutSystems(const Strands& strands);

    /// Cuts whose root is no end of the edge; they stay as long as this object.
    const CutSystem& of(Index layout_edge);
    /// Cuts whose root is none of these layout vertices; null if these are all. Likewise.
    const CutSystem* away_from(std::span<const Index> layout_vertices);
    /// The class of a walk from tail(2e) to head(2e) that meets no landmark on its way.
    HomotopyClass class_of(Index layout_edge, const std::vector<Index>& darts);

private:
    const PathGraph& graph_;
    const Layout& layout_;
    std::vector<Index> nodes_;  // per layout vertex
    bool has_holes_;
    std::map<Index, CutSystem> by_root_;
};

}  // namespace layout_embedding
