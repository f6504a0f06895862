#include "surface/cut_system.hh"

#include <algorithm>

#include "base/quad_heap.hh"

namespace layout_embedding {

namespace {

/// Per node the dart by which the shortest path to the root leaves it; kNone where no landmark's
/// path comes by.
class ShortestPathTree {
public:
    ShortestPathTree(const PathGraph& graph, std::span<const Index> landmark_nodes, Index root)
        : parents_(graph.node_count(), kNone)
    {
        std::vector<bool> is_landmark(graph.node_count(), false);
        for (const Index node : landmark_nodes) {
            is_landmark[node] = true;
        }
        struct Item {
            Length distance;
            Index node;
            bool operator<(const Item& other) const
            {
                return distance != other.distance ? distance < other.distance : node < other.node;
            }
        };
        std::vector<Length> distances(graph.node_count(), kInfiniteLength);
        QuadHeap<Item> queue;
        distances[root] = 0;
        queue.push({0, root});
        std::size_t landmarks_left = landmark_nodes.size();
        while (!queue.empty() && landmarks_left > 0) {
            const auto [distance, node] = queue.top();
            queue.pop();
            if (distance > distances[node]) {
                continue;
            }
            landmarks_left -= is_landmark[node] ? 1 : 0;
            if (is_landmark[node] && node != root) {
                continue;
            }
            for (Index d = graph.first_dart(node); d < graph.first_dart(node + 1); ++d) {
                const Index head = graph.head(d);
                if (distance + graph.dart(d).length < distances[head]) {
                    distances[head] = distance + graph.dart(d).length;
                    parents_[head] = graph.twin(d);
                    queue.push({distances[head], head});
                }
            }
        }
    }

    Index parent_dart(Index node) const { return parents_[node]; }

private:
    std::vector<Index> parents_;
};

}  // namespace

Index Words::times(Index word, Letter letter)
{
    if (nodes_[word].letter == -letter) {
        return nodes_[word].prefix;
    }
    const std::uint64_t key = std::uint64_t{word} << 32U | static_cast<std::uint32_t>(letter);
    const auto [place, is_new] = longer_.try_emplace(key, size());
    if (is_new) {
        nodes_.push_back({word, letter});
    }
    return place->second;
}

CutSystem::CutSystem(const PathGraph& graph, std::span<const Index> landmark_nodes, Index root)
    : graph_(graph)
{
    const ShortestPathTree tree(graph, landmark_nodes, landmark_nodes[root]);
    // The part of the tree that leads to landmarks: per node, the darts to its children.
    std::unordered_map<Index, std::vector<Index>> children;  // looked up, never iterated
    std::unordered_map<Index, Index> landmarks;              // likewise
    std::vector<Index> nodes;                                // children before parents, reversed
    for (Index v = 0; v < landmark_nodes.size(); ++v) {
        landmarks.emplace(landmark_nodes[v], v);
        Index node = landmark_nodes[v];
        while (node != landmark_nodes[root]) {
            const Index dart = tree.parent_dart(node);
            const Index parent = graph.head(dart);
            auto& siblings = children[parent];
            const Index to_child = graph.twin(dart);
            if (std::find(siblings.begin(), siblings.end(), to_child) != siblings.end()) {
                break;  // the rest of the path is known
            }
            siblings.push_back(to_child);
            node = parent;
        }
    }
    // Depth first, without recursion: paths are long.
    nodes.push_back(landmark_nodes[root]);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const auto found = children.find(nodes[i]);
        if (found != children.end()) {
            for (const Index dart : found->second) {
                nodes.push_back(graph.head(dart));
            }
        }
    }
    std::reverse(nodes.begin(), nodes.end());
    std::unordered_map<Index, std::vector<Index>> arcs;  // on the edge from a node to its parent
    for (const Index node : nodes) {
        const auto landmark = landmarks.find(node);
        if (landmark != landmarks.end()) {
            if (landmark->second != root) {
                arcs[node] = {landmark->second};
            }
            continue;
        }
        // Arcs come in along the darts to the children and leave on the left of the dart to the
        // parent: they turn around the node through the darts that follow it counter-clockwise. The
        // later the child's dart, the nearer to the node its arcs pass.
        const Index first = graph.first_dart(node);
        const Index degree = graph.degree(node);
        const Index ahead = tree.parent_dart(node);
        const auto steps = [&](Index dart) { return (dart + degree - ahead) % degree; };
        auto darts = children[node];
        std::sort(darts.begin(), darts.end(),
                  [&](Index a, Index b) { return steps(a) > steps(b); });
        Passed passed;
        passed.crossed.assign(degree, 0);
        for (const Index dart : darts) {
            const auto& from_child = arcs[graph.head(dart)];
            passed.arcs.insert(passed.arcs.end(), from_child.begin(), from_child.end());
            for (Index d = first; d < first + degree; ++d) {
                if (steps(d) > 0 && steps(d) < steps(dart)) {
                    passed.crossed[d - first] = static_cast<Index>(passed.arcs.size());
                }
            }
        }
        arcs[node] = passed.arcs;
        passed_.emplace(node, std::move(passed));
    }
}

std::span<const Index> CutSystem::crossed(Index node, Index dart) const
{
    const auto passed = passed_.find(node);
    if (passed == passed_.end()) {
        return {};
    }
    return std::span(passed->second.arcs)
        .first(passed->second.crossed[dart - graph_.first_dart(node)]);
}

Index CutSystem::advance(Words& words, Index word, Index dart, Index start) const
{
    const Words::Letter own = letter(start);
    const auto times = [&](Words::Letter next) {
        const bool is_turn = word == Words::kEmpty && (next == own || next == -own);
        word = is_turn ? word : words.times(word, next);
    };
    const Index twin = graph_.twin(dart);
    const Index head = graph_.head(dart);
    for (const Index arc : crossed(graph_.head(twin), dart)) {
        times(letter(arc));
    }
    const auto arriving = crossed(head, twin);
    for (std::size_t i = arriving.size(); i-- > 0;) {
        times(-letter(arriving[i]));
    }
    return word;
}

}  // namespace layout_embedding
