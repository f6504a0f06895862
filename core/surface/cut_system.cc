#include "surface/cut_system.hh"

#include <algorithm>
#include <numeric>

#include "base/quad_heap.hh"

namespace layout_embedding {

namespace {

/// Per node the dart by which the shortest path to the root leaves it. Paths lead neither through
/// landmarks nor, but for the root, through nodes on the boundary: arcs to their left would lie in
/// a hole.
class ShortestPathTree {
public:
    ShortestPathTree(const PathGraph& graph, std::span<const Index> landmark_nodes, Index root)
        : parents_(graph.node_count(), kNone)
    {
        std::vector<bool> is_leaf(graph.node_count(), false);
        for (Index node = 0; node < graph.node_count(); ++node) {
            is_leaf[node] = graph.is_boundary(node);
        }
        for (const Index node : landmark_nodes) {
            is_leaf[node] = true;
        }
        is_leaf[root] = false;
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
        while (!queue.empty()) {
            const auto [distance, node] = queue.top();
            queue.pop();
            if (distance > distances[node] || is_leaf[node]) {
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
    bool contains(const PathGraph& graph, Index dart) const
    {
        return parents_[graph.tail(dart)] == dart || parents_[graph.head(dart)] == graph.twin(dart);
    }

private:
    std::vector<Index> parents_;
};

/// One node per boundary loop that is no landmark.
std::vector<Index> nodes_of_holes(const PathGraph& graph, std::span<const Index> landmark_nodes)
{
    std::vector<bool> seen(graph.node_count(), false);
    std::vector<Index> nodes;
    for (Index start = 0; start < graph.node_count(); ++start) {
        if (!graph.is_boundary(start) || seen[start]) {
            continue;
        }
        Index hole = kNone;
        // The first dart of a boundary node runs along the boundary.
        for (Index node = start; !seen[node]; node = graph.head(graph.first_dart(node))) {
            seen[node] = true;
            if (std::find(landmark_nodes.begin(), landmark_nodes.end(), node) ==
                landmark_nodes.end()) {
                hole = node;
            }
        }
        nodes.push_back(hole);
    }
    return nodes;
}

/// Edges, by one of their darts, so that tree and arcs through them to the root and back on both
/// sides leave the surface in one piece without handles: those in neither the tree nor a tree of
/// the faces and holes that crosses no edge of it. None on genus 0.
std::vector<Index> handle_edges(const PathGraph& graph, const ShortestPathTree& tree)
{
    // Faces by their darts, which have them on their left. A hole is one as well.
    std::vector<Index> faces(graph.dart_count(), kNone);
    Index face_count = 0;
    for (Index start = 0; start < graph.dart_count(); ++start) {
        for (Index d = start; faces[d] == kNone;) {
            faces[d] = face_count;
            const Index twin = graph.twin(d);
            const Index node = graph.head(d);
            d = twin == graph.first_dart(node) ? graph.first_dart(node + 1) - 1 : twin - 1;
        }
        face_count = std::max(face_count, faces[start] + 1);
    }
    std::vector<Index> parents(face_count);
    std::iota(parents.begin(), parents.end(), Index{0});
    const auto find = [&](Index f) {
        while (parents[f] != f) {
            parents[f] = parents[parents[f]];
            f = parents[f];
        }
        return f;
    };
    std::vector<Index> handles;
    const auto is_border = [&](Index node) { return graph.is_boundary(node); };
    // Edges at the boundary first: arcs better keep away from it.
    for (const bool at_border : {true, false}) {
        for (Index d = 0; d < graph.dart_count(); ++d) {
            if (d > graph.twin(d) || tree.contains(graph, d) ||
                (is_border(graph.tail(d)) || is_border(graph.head(d))) != at_border) {
                continue;
            }
            const Index left = find(faces[d]);
            const Index right = find(faces[graph.twin(d)]);
            if (left == right) {
                handles.push_back(d);
            }
            parents[left] = right;
        }
    }
    return handles;
}

/// V - E + F = 2 - 2 g with the holes filled; counts faces by walking around them.
bool has_handles(const PathGraph& graph)
{
    std::vector<bool> seen(graph.dart_count(), false);
    std::int64_t faces = 0;
    for (Index start = 0; start < graph.dart_count(); ++start) {
        faces += seen[start] ? 0 : 1;
        for (Index d = start; !seen[d];) {
            seen[d] = true;
            const Index twin = graph.twin(d);
            const Index node = graph.head(d);
            d = twin == graph.first_dart(node) ? graph.first_dart(node + 1) - 1 : twin - 1;
        }
    }
    return std::int64_t{graph.node_count()} - graph.dart_count() / 2 + faces != 2;
}

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
    : graph_(graph),
      letters_(landmark_nodes.size(), 0),
      first_darts_(landmark_nodes.size(), kNone),
      crosses_(graph.dart_count(), false)
{
    const std::vector<Index> holes = nodes_of_holes(graph, landmark_nodes);
    const Index root_node = root == kNone ? holes.front() : landmark_nodes[root];
    const ShortestPathTree tree(graph, landmark_nodes, root_node);

    // Where arcs begin: at a node, between its darts or at its middle.
    struct Beginning {
        Index node;
        Index dart;  // the arc comes in along it; kNone from the node itself or from its hole
        Words::Letter letter;
    };
    std::vector<Beginning> beginnings;
    Words::Letter last_letter = 0;
    for (Index v = 0; v < landmark_nodes.size(); ++v) {
        if (v != root && !graph.is_boundary(landmark_nodes[v])) {
            letters_[v] = ++last_letter;
            first_darts_[v] = tree.parent_dart(landmark_nodes[v]);
            beginnings.push_back({landmark_nodes[v], kNone, last_letter});
        }
    }
    for (const Index node : holes) {
        if (node != root_node) {
            beginnings.push_back({node, kNone, ++last_letter});
        }
    }
    if (has_handles(graph)) {
        for (const Index dart : handle_edges(graph, tree)) {
            // The arc comes from the root to the dart's head, changes to its right side in the
            // middle and goes on to the tail and back to the root.
            ++last_letter;
            beginnings.push_back({graph.tail(dart), dart, last_letter});
            beginnings.push_back({graph.head(dart), graph.twin(dart), -last_letter});
            changes_.emplace(dart, last_letter);
            changes_.emplace(graph.twin(dart), -last_letter);
        }
    }

    // The part of the tree that arcs follow: per node, the darts to its children.
    std::unordered_map<Index, std::vector<Index>> children;        // looked up, never iterated
    std::unordered_map<Index, std::vector<Beginning>> begin_here;  // likewise
    for (const Beginning& beginning : beginnings) {
        begin_here[beginning.node].push_back(beginning);
        Index node = beginning.node;
        while (node != root_node) {
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
    // Children before parents, without recursion: paths are long.
    std::vector<Index> nodes{root_node};
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const auto found = children.find(nodes[i]);
        if (found != children.end()) {
            for (const Index dart : found->second) {
                nodes.push_back(graph.head(dart));
            }
        }
    }
    std::reverse(nodes.begin(), nodes.end());

    std::unordered_map<Index, std::vector<Words::Letter>> arcs;  // from a node to its parent
    for (const Index node : nodes) {
        if (node == root_node && root != kNone) {
            continue;  // arcs end here
        }
        // Arcs come in along the darts to the children and leave on the left of the dart to the
        // parent, at a root on the boundary into the hole: they turn around the node through the
        // darts that follow it counter-clockwise. The later the dart along which they come, the
        // nearer to the node they pass. Directions are counted in half steps, so that the hole has
        // one between the last dart and the first.
        const Index first = graph.first_dart(node);
        const Index degree = graph.degree(node);
        const auto direction = [&](Index dart) { return 2 * (dart - first) + 1; };
        const Index ahead = node == root_node ? 0 : direction(tree.parent_dart(node));
        const auto steps = [&](Index to) { return (to + 2 * degree - ahead) % (2 * degree); };
        struct Incoming {
            Index steps;
            std::vector<Words::Letter> letters;
        };
        std::vector<Incoming> incoming;
        for (const Index dart : children[node]) {
            incoming.push_back({steps(direction(dart)), arcs[graph.head(dart)]});
        }
        std::vector<Words::Letter> own;
        for (const Beginning& beginning : begin_here[node]) {
            if (beginning.dart != kNone) {
                incoming.push_back({steps(direction(beginning.dart)), {beginning.letter}});
            } else if (graph.is_boundary(node)) {
                incoming.push_back({steps(0), {beginning.letter}});
            } else {
                own.push_back(beginning.letter);
            }
        }
        std::sort(incoming.begin(), incoming.end(),
                  [](const Incoming& a, const Incoming& b) { return a.steps > b.steps; });
        Passed passed;
        passed.arcs = own;
        passed.crossed.assign(degree, 0);
        for (const Incoming& in : incoming) {
            passed.arcs.insert(passed.arcs.end(), in.letters.begin(), in.letters.end());
        }
        for (Index d = first; d < first + degree; ++d) {
            // An arc that begins at the node itself crosses none of its darts; it is the nearest
            // and leaves nothing between them and the others to count.
            Index count = 0;
            for (const Incoming& in : incoming) {
                if (steps(direction(d)) > 0 && steps(direction(d)) < in.steps) {
                    count += static_cast<Index>(in.letters.size());
                }
            }
            passed.crossed[d - first] = count;
        }
        arcs[node] = passed.arcs;
        passed.arcs.erase(passed.arcs.begin(),
                          passed.arcs.begin() + static_cast<std::ptrdiff_t>(own.size()));
        for (Index d = first; d < first + degree; ++d) {
            if (passed.crossed[d - first] > 0) {
                crosses_[d] = true;
                crosses_[graph.twin(d)] = true;
            }
        }
        passed_.emplace(node, std::move(passed));
    }
    for (const auto& [dart, letter] : changes_) {
        crosses_[dart] = true;
    }
}

std::span<const Words::Letter> CutSystem::crossed(Index node, Index dart) const
{
    const auto found = passed_.find(node);
    if (found == passed_.end()) {
        return {};
    }
    const Passed& passed = found->second;
    return std::span(passed.arcs).first(passed.crossed[dart - graph_.first_dart(node)]);
}

Index CutSystem::advance(Words& words, Index word, Index dart, Index start) const
{
    const Words::Letter own = letter(start);
    for_each_crossing(dart, [&](Words::Letter next) {
        const bool is_turn = word == Words::kEmpty && (next == own || next == -own);
        word = is_turn ? word : words.times(word, next);
    });
    return word;
}

}  // namespace layout_embedding
