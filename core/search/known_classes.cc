#include "search/known_classes.hh"

#include <algorithm>
#include <utility>

#include "surface/stretch.hh"

namespace layout_embedding {

KnownClasses::KnownClasses(const Layout& layout, const WalkPool& pool,
                           std::optional<FaceLoops> faces, std::vector<bool> is_linear)
    : layout_(layout),
      pool_(pool),
      faces_(std::move(faces)),
      is_linear_(std::move(is_linear)),
      edges_(layout.edge_count())
{}

void KnownClasses::set_base(Index layout_edge, Length bound)
{
    edges_[layout_edge].base = bound;
    base_ += bound;
}

bool KnownClasses::add(Index walk)
{
    if (contains(walk)) {
        return false;
    }
    is_known_.resize(std::max<std::size_t>(is_known_.size(), walk + 1), false);
    is_known_[walk] = true;
    edges_[pool_.layout_edge(walk)].walks.push_back(walk);
    walks_.push_back(walk);
    return true;
}

bool KnownClasses::is_wrong(const std::array<Index, 3>& halfedges,
                            const std::array<Index, 3>& walks) const
{
    return !is_before(pool_.place(halfedges[0], walks[0]), pool_.place(halfedges[1], walks[1]),
                      pool_.place(halfedges[2], walks[2]));
}

bool KnownClasses::can_go_together(Index walk_a, Index walk_b) const
{
    return !pool_.cross(walk_a, walk_b) && (upper_bound_ == kInfiniteLength ||
                                            base_ + excess(walk_a) + excess(walk_b) < upper_bound_);
}

}  // namespace layout_embedding
