#include "apps/layout_shortening.hh"

#include <array>
#include <map>
#include <optional>
#include <utility>

#include "layout/embedding_problem.hh"
#include "mesh/editable_mesh.hh"
#include "search/exact_solver.hh"
#include "surface/cut_surface_search.hh"
#include "surface/distance_field.hh"
#include "surface/path_graph.hh"
#include "surface/strands.hh"

namespace layout_embedding {

namespace {

// Units of work for an embedding of each layout; well below a second.
constexpr std::uint64_t kEmbeddingWork = 500'000;
// Perturbations that are tried after ties.
constexpr std::uint32_t kMostAttempts = 4;
constexpr std::uint64_t kFieldBytes = std::uint64_t{64} << 20U;

using Ends = std::pair<Index, Index>;

/// A path per layout edge, from the first vertex of its key to the second, which is larger.
struct PathsByEnds {
    std::map<Ends, std::vector<Index>> darts;
    Length cost = kInfiniteLength;
};

std::vector<Index> reversed(const PathGraph& graph, const std::vector<Index>& darts)
{
    std::vector<Index> result;
    for (auto dart = darts.rbegin(); dart != darts.rend(); ++dart) {
        result.push_back(graph.twin(*dart));
    }
    return result;
}

Length length_of(const PathGraph& graph, const std::vector<Index>& darts)
{
    Length length = 0;
    for (const Index dart : darts) {
        length += graph.dart(dart).length;
    }
    return length;
}

/// A layout that changes by flips, and its embedding, which changes with it.
class Shortening {
public:
    Shortening(const PolygonMesh& layout, const std::shared_ptr<const TriangleMesh>& target,
               const std::vector<Index>& landmarks, std::uint32_t attempt)
        : positions_(layout.positions),
          mesh_(TriangleMesh(layout)),
          target_(target),
          landmarks_(landmarks),
          graph_(PathGraph::barycentric(*target, {.attempt = attempt}))
    {}

    /// False where ties were met.
    bool run()
    {
        for (;;) {
            const std::optional<PathsByEnds> embedding = embed();
            if (!embedding) {
                return false;
            }
            // Flips made the paths shorter; what the search finds for the new layout alone may
            // still be longer.
            if (embedding->cost < paths_.cost) {
                paths_ = *embedding;
            }
            if (paths_.cost == kInfiniteLength) {
                return true;
            }
            const Index before = flips_;
            while (flip_best()) {
            }
            if (has_tied_ || flips_ == before) {
                return !has_tied_;
            }
        }
    }

    ShortenedLayout result() const { return {layout_of(mesh_), flips_}; }

private:
    PolygonMesh layout_of(const EditableMesh& mesh) const
    {
        PolygonMesh layout;
        layout.positions = positions_;
        for (Index f = 0; f < mesh.face_capacity(); ++f) {
            const std::array<Index, 3> corners{mesh.tail(3 * f), mesh.tail(3 * f + 1),
                                               mesh.tail(3 * f + 2)};
            layout.add_face(corners);
        }
        return layout;
    }

    std::optional<EmbeddingProblem> problem_of(const EditableMesh& mesh) const
    {
        auto layout = Layout::from_polygons(layout_of(mesh), "the template");
        if (!layout) {
            return std::nullopt;
        }
        auto problem =
            make_problem(std::make_shared<const Layout>(std::move(*layout)), target_, landmarks_);
        return problem ? std::optional(std::move(*problem)) : std::nullopt;
    }

    /// A good embedding of the present layout; without paths where none is found, nothing after a
    /// tie.
    std::optional<PathsByEnds> embed() const
    {
        PathsByEnds paths;
        const std::optional<EmbeddingProblem> problem = problem_of(mesh_);
        if (!problem) {
            return paths;
        }
        ExactSolver solver(*problem, graph_, kFieldBytes, {});
        WorkBudget budget(kEmbeddingWork);
        while (!budget.is_spent()) {
            const Solver::Outcome outcome = solver.run(budget);
            if (outcome == Solver::Outcome::tied) {
                return std::nullopt;
            }
            if (outcome == Solver::Outcome::finished) {
                break;
            }
        }
        paths.cost = solver.incumbent_cost();
        if (paths.cost != kInfiniteLength) {
            const Layout& layout = *problem->layout;
            for (Index e = 0; e < layout.edge_count(); ++e) {
                set_path(paths, layout.tail(2 * e), layout.head(2 * e),
                         solver.incumbent().paths[e].darts);
            }
        }
        return paths;
    }

    void set_path(PathsByEnds& paths, Index tail, Index head, const std::vector<Index>& darts) const
    {
        paths.darts[std::minmax(tail, head)] = tail < head ? darts : reversed(graph_, darts);
    }

    /// The path of the edge between these vertices of a layout: the shortest beside all others,
    /// which run as they do, or beside none. Nothing where there is none.
    std::optional<std::vector<Index>> shortest_path(const EditableMesh& mesh, Ends ends,
                                                    bool beside_others)
    {
        const std::optional<EmbeddingProblem> problem = problem_of(mesh);
        if (!problem) {
            return std::nullopt;
        }
        const Layout& layout = *problem->layout;
        Strands strands(*problem, graph_);
        Index searched = kNone;
        for (Index e = 0; e < layout.edge_count(); ++e) {
            const Index tail = layout.tail(2 * e);
            const Index head = layout.head(2 * e);
            if (Ends(std::minmax(tail, head)) == ends) {
                searched = e;
            } else if (beside_others) {
                const std::vector<Index>& darts = paths_.darts.at(std::minmax(tail, head));
                if (!strands.insert(e, tail < head ? darts : reversed(graph_, darts))) {
                    return std::nullopt;
                }
            }
        }
        DistanceFields fields(graph_, strands.passable(), kFieldBytes);
        CutSurfaceSearch search(strands, fields);
        search.begin(searched);
        const auto outcome = search.run();
        has_tied_ = has_tied_ || outcome == CutSurfaceSearch::Outcome::tied;
        if (outcome != CutSurfaceSearch::Outcome::found) {
            return std::nullopt;
        }
        return layout.tail(2 * searched) == ends.first ? search.darts()
                                                       : reversed(graph_, search.darts());
    }

    /// Whether others keep the path between these vertices from being shorter.
    bool is_forced(Ends ends)
    {
        auto& free = free_lengths_[ends];
        if (free == 0) {
            const auto path = shortest_path(mesh_, ends, false);
            free = path ? length_of(graph_, *path) : kInfiniteLength;
        }
        return length_of(graph_, paths_.darts.at(ends)) > free;
    }

    /// Flips the edge that this makes shorter by the largest amount; false if there is none.
    bool flip_best()
    {
        Length best_gain = 0;
        Index best = kNone;
        std::vector<Index> best_path;
        for (Index h = 0; h < 3 * mesh_.face_capacity(); ++h) {
            const Ends ends = std::minmax(mesh_.tail(h), mesh_.head(h));
            if (mesh_.tail(h) != ends.first || mesh_.opposite(h) == kNone || !mesh_.can_flip(h) ||
                !is_forced(ends)) {
                continue;
            }
            EditableMesh flipped = mesh_;
            flipped.flip(h);
            const auto path = shortest_path(flipped, flipped_ends(flipped, h), true);
            if (has_tied_) {
                return false;
            }
            const Length length = length_of(graph_, paths_.darts.at(ends));
            const Length gain = path ? length - std::min(length, length_of(graph_, *path)) : 0;
            if (gain > best_gain) {
                best_gain = gain;
                best = h;
                best_path = *path;
            }
        }
        if (best == kNone) {
            return false;
        }
        paths_.darts.erase(std::minmax(mesh_.tail(best), mesh_.head(best)));
        mesh_.flip(best);
        paths_.darts[flipped_ends(mesh_, best)] = best_path;
        paths_.cost -= best_gain;
        ++flips_;
        return true;
    }

    /// The ends of the edge that took the place of halfedge h's.
    static Ends flipped_ends(const EditableMesh& mesh, Index h)
    {
        const Index edge = EditableMesh::previous(h);
        return std::minmax(mesh.tail(edge), mesh.head(edge));
    }

    std::vector<Vec3> positions_;
    EditableMesh mesh_;
    std::shared_ptr<const TriangleMesh> target_;
    std::vector<Index> landmarks_;
    PathGraph graph_;
    PathsByEnds paths_;
    std::map<Ends, Length> free_lengths_;
    bool has_tied_ = false;
    Index flips_ = 0;
};

}  // namespace

ShortenedLayout shortened_layout(const PolygonMesh& layout,
                                 const std::shared_ptr<const TriangleMesh>& target,
                                 const std::vector<Index>& landmarks)
{
    for (std::uint32_t attempt = 0; attempt < kMostAttempts; ++attempt) {
        Shortening shortening(layout, target, landmarks, attempt);
        if (shortening.run()) {
            return shortening.result();
        }
    }
    return {layout, 0};
}

}  // namespace layout_embedding
