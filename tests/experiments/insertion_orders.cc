// Every order in which the edges of a small layout can be inserted, each as the shortest path that
// is left (paper, Sec. 3.1):
//
//   insertion_orders LAYOUT TARGET LANDMARKS
//
// Orders that lead to the same partial embedding are counted together. Prints one JSON object: the
// number of orders, of those that end without an embedding, and per embedding its cost, how many
// orders lead to it, one of these, and its paths as lists of target vertices (see WeakPoint).

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "embedding/check_input.hh"
#include "json_object.hh"
#include "problem_files.hh"
#include "search/search_space.hh"

namespace layout_embedding {
namespace {

constexpr std::uint64_t kFieldBytes = std::uint64_t{1} << 30U;

/// A partial embedding: how many orders lead to it, and one of these, as walks.
struct State {
    double orders = 0;
    std::vector<Index> sequence;
};
/// By its walks, ascending.
using States = std::map<std::vector<Index>, State>;

std::string list_of(const std::vector<std::string>& items)
{
    std::string list;
    for (const std::string& item : items) {
        list += (list.empty() ? "" : ",") + item;
    }
    return "[" + list + "]";
}

std::string list_of_numbers(const std::vector<Index>& numbers)
{
    std::vector<std::string> items;
    for (const Index number : numbers) {
        items.push_back(std::to_string(number));
    }
    return list_of(items);
}

std::string paths_of(SearchSpace& space, const EmbeddingProblem& problem, const PathGraph& graph)
{
    std::vector<std::string> paths;
    for (const auto& path :
         weak_points(*problem.target, graph, space.embedding.strands().weak_embedding())) {
        std::vector<std::string> points;
        for (const WeakPoint& point : path) {
            std::vector<Index> vertices(point.begin(), point.end());
            vertices.erase(std::remove(vertices.begin(), vertices.end(), kNone), vertices.end());
            points.push_back(list_of_numbers(vertices));
        }
        paths.push_back(list_of(points));
    }
    return list_of(paths);
}

/// The states with one path more; `blocked` counts orders that end because an edge has none.
States next_states(SearchSpace& space, const States& states, double& blocked, double& remaining)
{
    States next;
    for (const auto& [walks, state] : states) {
        for (Index e = 0; e < space.embedding.layout().edge_count(); ++e) {
            space.embedding.go_to(state.sequence);
            if (space.embedding.walk(e) != kNone) {
                continue;
            }
            WorkBudget budget;
            const auto answer = space.oracle.find(e, kInfiniteLength, budget);
            if (answer.outcome != PathOracle::Outcome::found ||
                space.embedding.insert(answer.walk) != PartialEmbedding::Insertion::done) {
                blocked += state.orders * remaining;
                continue;
            }
            std::vector<Index> key = walks;
            key.insert(std::upper_bound(key.begin(), key.end(), answer.walk), answer.walk);
            State& child = next[key];
            child.orders += state.orders;
            if (child.sequence.empty()) {
                child.sequence = space.embedding.sequence();
            }
        }
    }
    return next;
}

int run(char** words)
{
    const auto problem = load_problem(words[1], words[2], words[3]);
    if (!problem) {
        std::fprintf(stderr, "%s\n", problem.error().message.c_str());
        return 2;
    }
    const PathGraph graph = PathGraph::barycentric(*problem->target, {1, 0});
    SearchSpace space(*problem, graph, kFieldBytes);
    const Index edges = problem->layout->edge_count();
    States states;
    states[{}].orders = 1;
    double blocked = 0;
    std::uint64_t state_count = 1;
    double remaining = 1;  // orders of the edges that are left after the next one
    for (Index i = 2; i < edges; ++i) {
        remaining *= i;
    }
    for (Index left = edges; left > 0; --left) {
        states = next_states(space, states, blocked, remaining);
        state_count += states.size();
        remaining /= std::max<Index>(1, left - 1);
    }
    double orders = blocked;
    std::vector<std::string> embeddings;
    for (const auto& [walks, state] : states) {
        orders += state.orders;
        space.embedding.go_to(state.sequence);
        if (!space.embedding.move_strands()) {
            std::fprintf(stderr, "equal lengths\n");
            return 1;
        }
        std::vector<Index> order;
        for (const Index walk : state.sequence) {
            order.push_back(space.pool.layout_edge(walk));
        }
        embeddings.push_back(JsonObject()
                                 .put("cost", graph.to_units(space.embedding.cost()))
                                 .put("orders", state.orders)
                                 .put("order", list_of_numbers(order))
                                 .put("paths", paths_of(space, *problem, graph))
                                 .json());
    }
    std::printf("%s\n", JsonObject()
                            .put("orders", orders)
                            .put("blocked", blocked)
                            .put("states", state_count)
                            .put("cpu", cpu_seconds())
                            .put("embeddings", list_of(embeddings))
                            .json()
                            .c_str());
    return 0;
}

}  // namespace
}  // namespace layout_embedding

int main(int count, char** words)
{
    if (count != 4) {
        std::fprintf(stderr, "usage: insertion_orders LAYOUT TARGET LANDMARKS\n");
        return 2;
    }
    return layout_embedding::run(words);
}
