#include "search/walk_pool.hh"

#include "base/random.hh"

namespace layout_embedding {

Index WalkPool::add(Index layout_edge, const std::vector<Index>& darts)
{
    std::uint64_t hash = layout_edge;
    for (const Index dart : darts) {
        hash = Random::mix(hash + dart + 1);
    }
    const auto [begin, end] = ids_by_hash_.equal_range(hash);
    for (auto entry = begin; entry != end; ++entry) {
        const Walk& known = walks_[entry->second];
        if (known.layout_edge == layout_edge && known.darts == darts) {
            return entry->second;
        }
    }
    Length cost = 0;
    for (const Index dart : darts) {
        cost += graph_.dart(dart).length;
    }
    const Index id = size();
    walks_.push_back({layout_edge, darts, cost});
    ids_by_hash_.emplace(hash, id);
    return id;
}

}  // namespace layout_embedding
