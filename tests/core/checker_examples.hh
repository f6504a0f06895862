#pragma once

#include <array>
#include <set>
#include <string>
#include <vector>

#include "claimed_embedding.hh"

/// What the tests of the checker share: valid embeddings to start from, and finding one's way in
/// them.
namespace layout_embedding {

/// The codes of violations, to compare with ClaimedEmbedding::codes().
using Codes = std::set<std::string>;

struct Example {
    std::string name;
    ClaimedEmbedding embedding;
};

/// Valid embeddings: spheres, disks, annuli and tori, closed and with holes, chains along target
/// edges and through faces.
std::vector<Example> examples();

/// All violations, one per line.
std::string describe(const CheckReport& report);

/// A shortest walk along the edges of triangles, without vertices that are `forbidden` but for its
/// ends.
std::vector<Index> shortest_walk(const std::vector<Index>& corners, Index from, Index to,
                                 const std::set<Index>& forbidden);

/// The chain of the layout edge between two layout vertices; fails the test if there is none.
Index chain_of(const ClaimedEmbedding& embedding, Index a, Index b);

}  // namespace layout_embedding
