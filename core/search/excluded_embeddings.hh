#pragma once

#include <functional>
#include <span>
#include <vector>

#include "base/types.hh"
#include "surface/cut_systems.hh"
#include "surface/walk_pool.hh"

namespace layout_embedding {

/// An embedding as one path per layout edge: darts from tail(2e) to head(2e) that meet no landmark
/// on their way.
using DartPaths = std::vector<std::vector<Index>>;

/// Embeddings that a search is not to find again, each as one homotopy class per layout edge. What
/// differs from all of them in the class of at least one edge is another embedding.
class ExcludedEmbeddings {
public:
    /// Keeps references to `cuts` and `pool`.
    ExcludedEmbeddings(CutSystems& cuts, const WalkPool& pool,
                       const std::vector<DartPaths>& embeddings);

    bool empty() const { return embeddings_.empty(); }
    /// Whether these walks of the pool, one per layout edge, are one of the embeddings.
    bool contain(std::span<const Index> walks);
    /// Calls `visit(walks)` once per embedding, as soon as the pool has all its walks.
    void for_each_new(const std::function<void(std::span<const Index>)>& visit);

private:
    struct Embedding {
        std::vector<HomotopyClass> classes;  // per layout edge
        std::vector<Index> walks;            // likewise; kNone while not known
        Index missing;
        bool is_visited = false;
    };
    void update();

    CutSystems& cuts_;
    const WalkPool& pool_;
    std::vector<Embedding> embeddings_;
    Index seen_ = 0;  // walks of the pool
};

}  // namespace layout_embedding
