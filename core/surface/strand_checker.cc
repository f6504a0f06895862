#include "surface/strand_checker.hh"

#include <algorithm>
#include <span>

namespace layout_embedding {

namespace {

class StrandChecker {
public:
    StrandChecker(const EmbeddingProblem& problem, const PathGraph& graph,
                  const WeakEmbedding& embedding)
        : layout_(*problem.layout), graph_(graph), paths_(embedding.paths)
    {
        for (const Index landmark : problem.landmarks) {
            landmark_nodes_.push_back(graph.node_of_vertex(landmark));
        }
    }

    std::vector<StrandViolation> run()
    {
        check_input();
        if (violations_.empty()) {
            for (Index e = 0; e < paths_.size(); ++e) {
                check_walk(e);
            }
        }
        if (violations_.empty()) {
            collect_ends();
        }
        if (violations_.empty()) {
            check_nodes();
        }
        return std::move(violations_);
    }

private:
    /// Where a path meets the neighbourhood of its `visit`-th node.
    struct End {
        Index dart;  // of those that leave the node
        Index lane;  // as seen along it
        Index path;
        Index visit;
    };

    void report(const char* code, std::string message)
    {
        violations_.push_back({code, std::move(message)});
    }

    static std::string path_name(Index e) { return "the path of layout edge " + std::to_string(e); }

    void check_input()
    {
        if (paths_.size() != layout_.edge_count()) {
            report("pathCount", "There are " + std::to_string(paths_.size()) + " paths for " +
                                    std::to_string(layout_.edge_count()) + " layout edges.");
        }
        auto sorted = landmark_nodes_;
        std::sort(sorted.begin(), sorted.end());
        if (sorted.size() != layout_.vertex_count() ||
            std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end() ||
            (!sorted.empty() && sorted.back() >= graph_.node_count())) {
            report("landmarks", "The landmarks are not one node each for " +
                                    std::to_string(layout_.vertex_count()) + " layout vertices.");
            return;
        }
        vertices_of_nodes_.assign(graph_.node_count(), kNone);
        for (Index v = 0; v < landmark_nodes_.size(); ++v) {
            vertices_of_nodes_[landmark_nodes_[v]] = v;
        }
    }

    void check_walk(Index e)
    {
        const auto& [darts, lanes] = paths_[e];
        if (lanes.size() != darts.size()) {
            report("laneCount", "There are " + std::to_string(lanes.size()) + " lanes for the " +
                                    std::to_string(darts.size()) + " darts of " + path_name(e) +
                                    ".");
            return;
        }
        for (const Index d : darts) {
            if (d >= graph_.dart_count()) {
                report("dartOutOfRange", "In " + path_name(e) + " there is dart " +
                                             std::to_string(d) + ", which does not exist.");
                return;
            }
        }
        if (darts.empty()) {
            return;  // not embedded
        }
        for (std::size_t i = 1; i < darts.size(); ++i) {
            const Index node = graph_.tail(darts[i]);
            if (graph_.head(darts[i - 1]) != node) {
                report("walkGap", "In " + path_name(e) + " dart " + std::to_string(i) +
                                      " does not begin where the one before it ends.");
            }
            if (vertices_of_nodes_[node] != kNone) {
                report("walkThroughLandmark", "In " + path_name(e) + " dart " + std::to_string(i) +
                                                  " leaves the landmark of layout vertex " +
                                                  std::to_string(vertices_of_nodes_[node]) + ".");
            }
        }
        if (graph_.tail(darts.front()) != landmark_nodes_[layout_.tail(2 * e)] ||
            graph_.head(darts.back()) != landmark_nodes_[layout_.head(2 * e)]) {
            report("walkEnds", "The path of layout edge " + std::to_string(e) +
                                   " does not lead from the landmark of layout vertex " +
                                   std::to_string(layout_.tail(2 * e)) + " to that of " +
                                   std::to_string(layout_.head(2 * e)) + ".");
        }
    }

    /// Fills ends_: by node, then counter-clockwise around it. Reports wrong lanes.
    void collect_ends()
    {
        std::vector<End> passes;  // along the smaller dart of each edge, lanes as they are claimed
        for (Index e = 0; e < paths_.size(); ++e) {
            for (Index i = 0; i < paths_[e].darts.size(); ++i) {
                const Index d = paths_[e].darts[i];
                passes.push_back({std::min(d, graph_.twin(d)), paths_[e].lanes[i], e, i});
            }
        }
        const auto by_dart_and_lane = [](const End& a, const End& b) {
            return a.dart != b.dart   ? a.dart < b.dart
                   : a.lane != b.lane ? a.lane < b.lane
                   : a.path != b.path ? a.path < b.path
                                      : a.visit < b.visit;
        };
        std::sort(passes.begin(), passes.end(), by_dart_and_lane);
        for (auto begin = passes.begin(); begin != passes.end();) {
            const auto end = std::find_if(
                begin, passes.end(), [&](const End& pass) { return pass.dart != begin->dart; });
            const auto count = static_cast<Index>(end - begin);
            std::vector<bool> taken(count, false);
            for (; begin != end; ++begin) {
                if (begin->lane >= count) {
                    report("lanes", "In " + path_name(begin->path) + " dart " +
                                        std::to_string(begin->visit) + " has lane " +
                                        std::to_string(begin->lane) + " of " +
                                        std::to_string(count) + ".");
                    continue;
                }
                // Lanes count from the right of the path, which may run against the dart.
                const Index here = paths_[begin->path].darts[begin->visit];
                const Index mirrored = count - 1 - begin->lane;
                const Index lane = here == begin->dart ? begin->lane : mirrored;
                if (taken[lane]) {
                    report("lanes", "In " + path_name(begin->path) + " dart " +
                                        std::to_string(begin->visit) +
                                        " has a lane that another pass has too.");
                }
                taken[lane] = true;
                ends_.push_back({here, begin->lane, begin->path, begin->visit});
                ends_.push_back({graph_.twin(here), mirrored, begin->path, begin->visit + 1});
            }
        }
        // Darts that leave a node are consecutive and counter-clockwise, and so are the lanes of
        // one of them, from right to left.
        std::sort(ends_.begin(), ends_.end(), by_dart_and_lane);
    }

    void check_nodes()
    {
        for (auto begin = ends_.begin(); begin != ends_.end();) {
            const Index node = graph_.tail(begin->dart);
            const auto end = std::find_if(begin, ends_.end(), [&](const End& other) {
                return graph_.tail(other.dart) != node;
            });
            if (vertices_of_nodes_[node] == kNone) {
                check_chords(node, {begin, end});
            } else {
                check_order(vertices_of_nodes_[node], {begin, end});
            }
            begin = end;
        }
    }

    static bool same_chord(const End& a, const End& b)
    {
        return a.path == b.path && a.visit == b.visit;
    }

    void check_chords(Index node, std::span<const End> ends)
    {
        // Chords are unlinked if they match like parentheses.
        std::vector<const End*> open;
        for (const End& end : ends) {
            if (!open.empty() && same_chord(*open.back(), end)) {
                open.pop_back();
            } else {
                open.push_back(&end);
            }
        }
        if (open.empty()) {
            return;
        }
        // Of what is left over, the two nearest ends of one chord enclose just one end of another.
        std::size_t width = open.size();
        std::size_t first = 0;
        for (std::size_t i = 0; i < open.size(); ++i) {
            for (std::size_t j = i + 1; j < std::min(open.size(), i + width); ++j) {
                if (same_chord(*open[i], *open[j])) {
                    first = i;
                    width = j - i;
                }
            }
        }
        report("strandsCross", "At path-graph node " + std::to_string(node) + " " +
                                   path_name(open[first]->path) + " and " +
                                   path_name(open[first + 1]->path) + " cross.");
    }

    void check_order(Index vertex, std::span<const End> ends)
    {
        std::vector<Index> expected;
        for (const Index h : layout_.outgoing(vertex)) {
            if (!paths_[Layout::edge(h)].darts.empty()) {
                expected.push_back(h);
            }
        }
        std::vector<Index> found;
        for (const End& end : ends) {
            found.push_back(2 * end.path + (end.visit == 0 ? 0 : 1));
        }
        if (!graph_.is_boundary(landmark_nodes_[vertex])) {
            const auto first = std::find(found.begin(), found.end(), expected.front());
            std::rotate(found.begin(), first, found.end());
        }
        if (found != expected) {
            report("landmarkOrder", "Around the landmark of layout vertex " +
                                        std::to_string(vertex) +
                                        " the strands are not in the layout's order.");
        }
    }

    const Layout& layout_;
    const PathGraph& graph_;
    const std::vector<WeakPath>& paths_;
    std::vector<Index> landmark_nodes_;
    std::vector<Index> vertices_of_nodes_;  // per node
    std::vector<End> ends_;
    std::vector<StrandViolation> violations_;
};

}  // namespace

std::vector<StrandViolation> check_strands(const EmbeddingProblem& problem, const PathGraph& graph,
                                           const WeakEmbedding& embedding)
{
    return StrandChecker(problem, graph, embedding).run();
}

}  // namespace layout_embedding
