#pragma once

#include <vector>

#include "base/types.hh"

namespace layout_embedding {

/// A path of an embedding as a strand of zero width in the path graph: strands may share edges and
/// nodes of the path graph but never cross (design, Sec. 1).
struct WeakPath {
    /// Darts of the path graph from the landmark of tail(2e) to that of head(2e), e the layout
    /// edge.
    std::vector<Index> darts;
    /// Per dart: how many passes over the same path-graph edge (of any path, in either direction)
    /// lie to the right of this one, as seen along the dart.
    std::vector<Index> lanes;
};

/// An embedding of the layout as strands: one path per layout edge, empty where not embedded.
struct WeakEmbedding {
    std::vector<WeakPath> paths;
};

}  // namespace layout_embedding
