#include "search/partial_embedding.hh"

namespace layout_embedding {

PartialEmbedding::PartialEmbedding(Strands& strands, WalkPool& pool)
    : strands_(strands),
      pool_(pool),
      hole_guard_(strands),
      walks_(strands.layout().edge_count(), kNone)
{}

bool PartialEmbedding::insert(Index walk)
{
    const Index edge = pool_.layout_edge(walk);
    if (!strands_.insert(edge, pool_.darts(walk))) {
        return false;
    }
    if (!hole_guard_.accepts()) {
        strands_.undo();
        return false;
    }
    walks_[edge] = walk;
    sequence_.push_back(walk);
    cost_ += pool_.cost(walk);
    ++insertion_count_;
    return true;
}

void PartialEmbedding::undo()
{
    const Index walk = sequence_.back();
    strands_.undo();
    walks_[pool_.layout_edge(walk)] = kNone;
    cost_ -= pool_.cost(walk);
    sequence_.pop_back();
}

void PartialEmbedding::go_to(std::span<const Index> sequence)
{
    std::size_t common = 0;
    while (common < sequence.size() && common < sequence_.size() &&
           sequence[common] == sequence_[common]) {
        ++common;
    }
    while (sequence_.size() > common) {
        undo();
    }
    for (const Index walk : sequence.subspan(common)) {
        insert(walk);
    }
}

}  // namespace layout_embedding
