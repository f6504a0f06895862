#include "surface/strand_checker.hh"

#include <algorithm>
#include <tuple>

namespace layout_embedding {

namespace {

/// Dart `place` of a path runs over an edge of the path graph.
struct Pass {
    Index edge;  // the smaller dart
    Index lane;  // as seen along the smaller dart
    Index path;
    Index place;

    auto key() const { return std::tie(edge, lane, path, place); }
};

class StrandCheck {
public:
    StrandCheck(const EmbeddingProblem& problem, const PathGraph& graph,
                const WeakEmbedding& embedding)
        : problem_(problem), graph_(graph), paths_(embedding.paths)
    {}

    std::vector<StrandViolation> run()
    {
        const Layout& layout = *problem_.layout;
        if (paths_.size() != layout.edge_count()) {
            add("strandSize", "There are " + std::to_string(paths_.size()) + " paths for " +
                                  std::to_string(layout.edge_count()) + " layout edges.");
            return std::move(violations_);
        }
        landmarks_.assign(graph_.node_count(), kNone);
        for (Index v = 0; v < layout.vertex_count(); ++v) {
            landmarks_[graph_.node_of_vertex(problem_.landmarks[v])] = v;
        }
        for (Index path = 0; path < paths_.size(); ++path) {
            check_path(path);
        }
        if (violations_.empty()) {
            sort_passes();
        }
        if (violations_.empty()) {
            for (const Index node : touched_nodes()) {
                check_node(node);
            }
        }
        return std::move(violations_);
    }

private:
    void add(const char* code, std::string message)
    {
        violations_.push_back({code, std::move(message)});
    }

    void check_path(Index path)
    {
        const std::vector<Index>& darts = paths_[path].darts;
        const std::string name = "The path of layout edge " + std::to_string(path);
        if (paths_[path].lanes.size() != darts.size()) {
            add("strandSize", name + " has not one lane per dart.");
            return;
        }
        if (darts.empty()) {
            return;
        }
        for (std::size_t i = 0; i < darts.size(); ++i) {
            if (darts[i] >= graph_.dart_count() ||
                (i > 0 && graph_.tail(darts[i]) != graph_.head(darts[i - 1]))) {
                add("strandBroken", name + " is broken at dart " + std::to_string(i) + ".");
                return;
            }
        }
        const auto landmark = [&](Index h) {
            return graph_.node_of_vertex(problem_.landmarks[problem_.layout->tail(h)]);
        };
        if (graph_.tail(darts.front()) != landmark(2 * path) ||
            graph_.head(darts.back()) != landmark(2 * path + 1)) {
            add("strandEnds", name + " does not run between its landmarks.");
            return;
        }
        for (std::size_t i = 1; i < darts.size(); ++i) {
            const Index node = graph_.tail(darts[i]);
            if (landmarks_[node] != kNone) {
                add("strandThroughLandmark", name + " passes the landmark of layout vertex " +
                                                 std::to_string(landmarks_[node]) + ".");
                return;
            }
        }
    }

    /// Sorts all passes by edge and lane, the lane as seen along the smaller dart.
    void sort_passes()
    {
        for (Index path = 0; path < paths_.size(); ++path) {
            for (Index i = 0; i < paths_[path].darts.size(); ++i) {
                const Index dart = paths_[path].darts[i];
                const Index edge = std::min(dart, graph_.twin(dart));
                passes_.push_back({edge, paths_[path].lanes[i], path, i});
            }
        }
        const auto less = [](const Pass& a, const Pass& b) { return a.key() < b.key(); };
        std::sort(passes_.begin(), passes_.end(), less);
        for (std::size_t first = 0; first < passes_.size();) {
            std::size_t last = first;
            while (last < passes_.size() && passes_[last].edge == passes_[first].edge) {
                ++last;
            }
            const Index count = static_cast<Index>(last - first);
            bool good = true;
            for (std::size_t i = first; i < last; ++i) {
                Pass& pass = passes_[i];
                good = good && pass.lane < count;
                if (dart_of(pass) != pass.edge) {
                    pass.lane = count - 1 - pass.lane;
                }
            }
            std::sort(passes_.begin() + static_cast<std::ptrdiff_t>(first),
                      passes_.begin() + static_cast<std::ptrdiff_t>(last), less);
            for (std::size_t i = first; i < last; ++i) {
                good = good && passes_[i].lane == i - first;
            }
            if (!good) {
                add("strandLanes", "The lanes of the " + std::to_string(count) +
                                       " passes over dart " + std::to_string(passes_[first].edge) +
                                       " are not 0 to " + std::to_string(count - 1) + ".");
            }
            first = last;
        }
    }
    Index dart_of(const Pass& pass) const { return paths_[pass.path].darts[pass.place]; }

    std::vector<Index> touched_nodes() const
    {
        std::vector<Index> nodes;
        for (const WeakPath& path : paths_) {
            for (const Index dart : path.darts) {
                nodes.push_back(graph_.tail(dart));
                nodes.push_back(graph_.head(dart));
            }
        }
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        return nodes;
    }

    /// The strand ends around a node counter-clockwise, at a boundary from the hole on: each the
    /// path, and how many of its darts come before the node.
    std::vector<std::pair<Index, Index>> ends_around(Index node) const
    {
        std::vector<std::pair<Index, Index>> ends;
        const Index first_dart = graph_.first_dart(node);
        for (Index dart = first_dart; dart < first_dart + graph_.degree(node); ++dart) {
            const Index edge = std::min(dart, graph_.twin(dart));
            const auto begin = std::lower_bound(passes_.begin(), passes_.end(), edge,
                                                [](const Pass& p, Index e) { return p.edge < e; });
            auto end = begin;
            while (end != passes_.end() && end->edge == edge) {
                ++end;
            }
            // Looking along a dart that leaves the node, counter-clockwise is from right to left.
            const std::size_t count = static_cast<std::size_t>(end - begin);
            for (std::size_t i = 0; i < count; ++i) {
                const Pass& pass =
                    begin[static_cast<std::ptrdiff_t>(dart == edge ? i : count - 1 - i)];
                ends.emplace_back(pass.path, pass.place + (dart_of(pass) == dart ? 0 : 1));
            }
        }
        return ends;
    }

    void check_node(Index node)
    {
        const auto ends = ends_around(node);
        if (landmarks_[node] != kNone) {
            check_order(node, ends);
            return;
        }
        // Chords do not cross if their ends match like parentheses.
        std::vector<std::pair<Index, Index>> open;
        for (const auto& end : ends) {
            if (!open.empty() && open.back() == end) {
                open.pop_back();
            } else {
                open.push_back(end);
            }
        }
        if (!open.empty()) {
            add("strandsCross", "The paths of the layout edges " + std::to_string(open[0].first) +
                                    " and " + std::to_string(open[1].first) +
                                    " or others cross at node " + std::to_string(node) + ".");
        }
    }

    void check_order(Index node, const std::vector<std::pair<Index, Index>>& ends)
    {
        const Layout& layout = *problem_.layout;
        std::size_t descents = 0;
        Index previous = 0;
        Index first = kNone;
        for (const auto& [path, place] : ends) {
            const Index rank = layout.rank(place == 0 ? 2 * path : 2 * path + 1);
            if (first == kNone) {
                first = rank;
            } else {
                descents += rank < previous ? 1 : 0;
            }
            previous = rank;
        }
        const bool cyclic = !graph_.is_boundary(node);
        if (cyclic && first != kNone && first < previous) {
            ++descents;  // from the last end around to the first
        }
        const bool several = ends.size() > 1;
        if (cyclic ? several && descents != 1 : descents != 0) {
            add("strandOrder", "The strands at the landmark of layout vertex " +
                                   std::to_string(landmarks_[node]) +
                                   " do not follow the layout's order.");
        }
    }

    const EmbeddingProblem& problem_;
    const PathGraph& graph_;
    const std::vector<WeakPath>& paths_;
    std::vector<Index> landmarks_;  // per node: the layout vertex, kNone elsewhere
    std::vector<Pass> passes_;
    std::vector<StrandViolation> violations_;
};

}  // namespace

std::vector<StrandViolation> check_strands(const EmbeddingProblem& problem, const PathGraph& graph,
                                           const WeakEmbedding& embedding)
{
    return StrandCheck(problem, graph, embedding).run();
}

}  // namespace layout_embedding
