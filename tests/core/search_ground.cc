#include "search_ground.hh"

#include <algorithm>
#include <numeric>

#include "random_draws.hh"
#include "surface/hole_guard.hh"

namespace layout_embedding::test {

std::vector<Index> random_order(Index count, Random& random)
{
    std::vector<Index> order(count);
    std::iota(order.begin(), order.end(), Index{0});
    shuffle(order, random);
    return order;
}

std::vector<Index> random_tree_first_order(const Layout& layout, Random& random)
{
    std::vector<Index> component(layout.vertex_count());
    std::iota(component.begin(), component.end(), Index{0});
    std::vector<Index> tree;
    std::vector<Index> others;
    for (const Index e : random_order(layout.edge_count(), random)) {
        const Index a = component[layout.tail(2 * e)];
        const Index b = component[layout.head(2 * e)];
        if (a == b) {
            others.push_back(e);
        } else {
            tree.push_back(e);
            std::replace(component.begin(), component.end(), a, b);
        }
    }
    tree.insert(tree.end(), others.begin(), others.end());
    return tree;
}

std::optional<WeakEmbedding> insert_in_random_order(const EmbeddingProblem& problem,
                                                    const PathGraph& graph, Random& random)
{
    Strands strands(problem, graph);
    DistanceFields fields(graph, strands.passable(), std::uint64_t{1} << 26U);
    CutSurfaceSearch search(strands, fields);
    const HoleGuard guard(strands);
    for (const Index e : random_tree_first_order(*problem.layout, random)) {
        search.begin(e);
        if (search.run() != CutSurfaceSearch::Outcome::found ||
            !strands.insert(e, search.darts()) || !guard.accepts()) {
            return std::nullopt;
        }
    }
    return strands.weak_embedding();
}

}  // namespace layout_embedding::test
