#pragma once

#include <vector>

#include "layout/layout.hh"
#include "search_ground.hh"

namespace layout_embedding::test {

/// Per layout vertex: the number of its connected component by the given edges.
std::vector<Index> components(const Layout& layout, const std::vector<Index>& edges);

enum class Holes { guarded, ignored };

/// Greedy insertion as it is defined, the reference for GreedySearch: all paths are computed anew
/// after every insertion. Whether all edges got embedded. With Holes::ignored the target's holes
/// end up wherever they happen to.
bool insert_naively(SearchGround& ground, Holes holes);

}  // namespace layout_embedding::test
