#include "surface/walk_pool.hh"

#include <algorithm>

#include "base/random.hh"
#include "surface/stretch.hh"

namespace layout_embedding {

WalkPool::WalkPool(const Strands& strands)
    : graph_(strands.graph()),
      layout_(strands.layout()),
      weights_(strands.weights()),
      leaving_(layout_.vertex_count())
{}

Index WalkPool::add(Index layout_edge, const std::vector<Index>& darts)
{
    std::uint64_t hash = layout_edge;
    Length length = 0;
    for (const Index d : darts) {
        hash = Random::mix(hash + d + 1);
        length += graph_.dart(d).length;
    }
    const auto [begin, end] = ids_by_hash_.equal_range(hash);
    for (auto it = begin; it != end; ++it) {
        const Walk& walk = walks_[it->second];
        if (walk.layout_edge == layout_edge && walk.darts == darts) {
            return it->second;
        }
    }
    const Index id = size();
    walks_.push_back({layout_edge, darts, weights_.cost(layout_edge, length), {}, {kNone, kNone}});
    ids_by_hash_.emplace(hash, id);
    find_crossings(id);
    find_place(id, 0);
    find_place(id, 1);
    return id;
}

void WalkPool::find_crossings(Index walk)
{
    Walk& a = walks_[walk];
    for (Index i = 0; i < a.inner_count(); ++i) {
        auto& visits = visits_of_nodes_[graph_.head(a.darts[i])];
        for (const Visit& visit : visits) {
            Walk& b = walks_[visit.walk];
            if (visit.walk != walk && b.layout_edge != a.layout_edge &&
                !a.crossing.contains(visit.walk) &&
                stretch_crosses(graph_, a.darts, i, b.darts, visit.k)) {
                a.crossing.insert(visit.walk);
                b.crossing.insert(walk);
            }
        }
        visits.push_back({walk, i});
    }
}

/// Whether x leaves a landmark before y, counter-clockwise from the landmark's first dart.
bool WalkPool::leaves_before(const Leaving& x, const Leaving& y) const
{
    const Walk& a = walks_[x.walk];
    const Walk& b = walks_[y.walk];
    const auto leaving = [&](const Walk& walk, Index from_end, Index step) {
        return from_end == 1 ? graph_.twin(walk.darts[walk.darts.size() - 1 - step])
                             : walk.darts[step];
    };
    Index previous = kNone;
    const std::size_t steps = std::min(a.darts.size(), b.darts.size());
    for (Index step = 0; step < steps; ++step) {
        const Index a_on = leaving(a, x.from_end, step);
        const Index b_on = leaving(b, y.from_end, step);
        if (a_on != b_on) {
            return previous == kNone ? a_on < b_on : is_before(graph_.twin(previous), a_on, b_on);
        }
        previous = a_on;
    }
    return false;  // the same walk: walks of different edges end at different landmarks
}

void WalkPool::find_place(Index walk, Index from_end)
{
    const Index h = 2 * walks_[walk].layout_edge + from_end;
    auto& leaving = leaving_[layout_.tail(h)];
    const Leaving here{walk, from_end};
    const auto place =
        std::upper_bound(leaving.begin(), leaving.end(), here,
                         [&](const Leaving& x, const Leaving& y) { return leaves_before(x, y); });
    for (auto it = leaving.insert(place, here); it != leaving.end(); ++it) {
        walks_[it->walk].places[it->from_end] = static_cast<Index>(it - leaving.begin());
    }
}

}  // namespace layout_embedding
