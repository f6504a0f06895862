#include "naive_greedy.hh"

#include <algorithm>
#include <numeric>
#include <set>

#include "surface/hole_guard.hh"

namespace layout_embedding::test {

std::vector<Index> components(const Layout& layout, const std::vector<Index>& edges)
{
    std::vector<Index> numbers(layout.vertex_count());
    std::iota(numbers.begin(), numbers.end(), Index{0});
    for (const Index e : edges) {
        const Index old_number = numbers[layout.tail(2 * e)];
        const Index new_number = numbers[layout.head(2 * e)];
        std::replace(numbers.begin(), numbers.end(), old_number, new_number);
    }
    return numbers;
}

bool insert_naively(SearchGround& ground, Holes holes)
{
    const Layout& layout = ground.strands.layout();
    const HoleGuard guard(ground.strands);
    std::set<Index> refused;
    while (ground.strands.insertion_order().size() < layout.edge_count()) {
        const auto numbers = components(layout, ground.strands.insertion_order());
        const bool connected = std::count(numbers.begin(), numbers.end(), numbers[0]) ==
                               static_cast<long>(numbers.size());
        Index best = kNone;
        Length best_cost = kInfiniteLength;
        std::vector<Index> best_walk;
        for (Index e = 0; e < layout.edge_count(); ++e) {
            const bool joins = numbers[layout.tail(2 * e)] != numbers[layout.head(2 * e)];
            if (ground.strands.is_embedded(e) || refused.count(e) != 0 || !(connected || joins)) {
                continue;
            }
            ground.search.begin(e);
            if (ground.search.run() == CutSurfaceSearch::Outcome::found &&
                ground.search.cost() < best_cost) {
                best = e;
                best_cost = ground.search.cost();
                best_walk = ground.search.darts();
            }
        }
        if (best == kNone || !ground.strands.insert(best, best_walk)) {
            return false;
        }
        if (holes == Holes::ignored || guard.accepts()) {
            refused.clear();
        } else {
            ground.strands.undo();
            refused.insert(best);
        }
    }
    return true;
}

}  // namespace layout_embedding::test
