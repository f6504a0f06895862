#include "search/excluded_embeddings.hh"

#include <algorithm>

namespace layout_embedding {

ExcludedEmbeddings::ExcludedEmbeddings(CutSystems& cuts, const WalkPool& pool,
                                       const std::vector<DartPaths>& embeddings)
    : cuts_(cuts), pool_(pool)
{
    for (const auto& paths : embeddings) {
        Embedding embedding;
        for (Index e = 0; e < paths.size(); ++e) {
            embedding.classes.push_back(cuts.class_of(e, paths[e]));
        }
        embedding.walks.assign(paths.size(), kNone);
        embedding.missing = static_cast<Index>(paths.size());
        embeddings_.push_back(std::move(embedding));
    }
}

/// The walks of the pool are the shortest of their classes: one at most per embedding and edge.
void ExcludedEmbeddings::update()
{
    for (; !empty() && seen_ < pool_.size(); ++seen_) {
        const Index e = pool_.layout_edge(seen_);
        const HomotopyClass word = cuts_.class_of(e, pool_.darts(seen_));
        for (Embedding& embedding : embeddings_) {
            if (embedding.walks[e] == kNone && embedding.classes[e] == word) {
                embedding.walks[e] = seen_;
                --embedding.missing;
            }
        }
    }
}

bool ExcludedEmbeddings::contain(std::span<const Index> walks)
{
    update();
    return std::any_of(embeddings_.begin(), embeddings_.end(), [&](const Embedding& embedding) {
        return std::all_of(walks.begin(), walks.end(), [&](Index walk) {
            return embedding.walks[pool_.layout_edge(walk)] == walk;
        });
    });
}

void ExcludedEmbeddings::for_each_new(const std::function<void(std::span<const Index>)>& visit)
{
    update();
    for (Embedding& embedding : embeddings_) {
        if (embedding.missing == 0 && !embedding.is_visited) {
            embedding.is_visited = true;
            visit(embedding.walks);
        }
    }
}

}  // namespace layout_embedding
