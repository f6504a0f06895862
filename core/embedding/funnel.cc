#include "embedding/funnel.hh"

namespace layout_embedding {

void Funnel::extend(Chain& chain, Chain& other, Bend bend, double sign)
{
    // A path along the left chain turns left at each of its bends.
    while (!chain.empty()) {
        const Vec2 last = chain.bends.back().point;
        const Vec2 before = chain.bends.size() - chain.begin > 1
                                ? chain.bends[chain.bends.size() - 2].point
                                : apex_;
        if (sign * cross(last - before, bend.point - last) > 0) {
            break;
        }
        chain.bends.pop_back();
    }
    if (chain.empty()) {
        chain.clear();
        // What is beyond the other chain is seen from its bends only.
        while (!other.empty()) {
            const Bend& first = other.bends[other.begin];
            if (sign * cross(first.point - apex_, bend.point - apex_) >= 0) {
                break;
            }
            apex_ = first.point;
            path_.push_back(first);
            ++other.begin;
        }
    }
    chain.bends.push_back(bend);
}

std::span<const Bend> Funnel::shortest_path(Vec2 start, std::span<const Portal> portals, Vec2 end)
{
    apex_ = start;
    left_.clear();
    right_.clear();
    path_.clear();
    for (Index i = 0; i < portals.size(); ++i) {
        extend(left_, right_, {i, portals[i].left}, 1);
        extend(right_, left_, {i, portals[i].right}, -1);
    }
    extend(left_, right_, {static_cast<Index>(portals.size()), end}, 1);
    path_.insert(path_.end(), left_.bends.begin() + static_cast<std::ptrdiff_t>(left_.begin),
                 left_.bends.end() - 1);
    return path_;
}

}  // namespace layout_embedding
