#include "apps/landmark_drag.hh"

#include <algorithm>
#include <numeric>

#include "embedding/straightening.hh"
#include "embedding/weak_to_normal_form.hh"
#include "surface/cut_surface_search.hh"
#include "surface/hole_guard.hh"

namespace layout_embedding {

namespace {

constexpr std::uint64_t kDragFieldBytes = std::uint64_t{64} << 20U;
/// Of all searches of an attempt: a few tenths of a second at most.
constexpr std::uint64_t kDragExpansions = 400'000;
/// Detours of the landmark's own paths beyond this share are looked at, unless they are no longer
/// than after the last move.
constexpr double kVisibleDetour = 1.1;
constexpr double kDetourGrowth = 1.02;
/// Passes over a strand that the straightening gets, per layout edge.
constexpr Index kPassesPerEdge = 6;

std::vector<bool> passable_but_for(const EmbeddingProblem& problem, const PathGraph& graph,
                                   Index layout_vertex)
{
    std::vector<bool> passable(graph.node_count(), true);
    for (Index v = 0; v < problem.landmarks.size(); ++v) {
        passable[graph.node_of_vertex(problem.landmarks[v])] = v == layout_vertex;
    }
    return passable;
}

Length length_of(const PathGraph& graph, std::span<const Index> darts)
{
    return std::accumulate(darts.begin(), darts.end(), Length{0},
                           [&](Length sum, Index dart) { return sum + graph.dart(dart).length; });
}

}  // namespace

LandmarkDrag::LandmarkDrag(EmbeddingProblem problem, const PathGraph& graph,
                           std::span<const double> edge_costs, const WeakEmbedding& embedding,
                           Index layout_vertex)
    : problem_(std::move(problem)),
      graph_(graph),
      edge_costs_(edge_costs),
      layout_vertex_(layout_vertex),
      embedding_(embedding),
      order_(embedding.paths.size()),
      passable_(passable_but_for(problem_, graph, layout_vertex)),
      fields_(graph, passable_, kDragFieldBytes)
{
    std::iota(order_.begin(), order_.end(), Index{0});
}

double LandmarkDrag::cost() const
{
    return graph_.to_units(cost_of(embedding_)) * problem_.weights.unit();
}

Length LandmarkDrag::cost_of(const WeakEmbedding& embedding) const
{
    Length sum = 0;
    for (Index edge = 0; edge < embedding.paths.size(); ++edge) {
        sum += problem_.weights.cost(edge, length_of(graph_, embedding.paths[edge].darts));
    }
    return sum;
}

bool LandmarkDrag::is_allowed(Index target_vertex) const
{
    const TriangleMesh& target = *problem_.target;
    return target_vertex < target.vertex_count() &&
           target.is_boundary_vertex(target_vertex) ==
               target.is_boundary_vertex(problem_.landmarks[layout_vertex_]) &&
           std::find(problem_.landmarks.begin(), problem_.landmarks.end(), target_vertex) ==
               problem_.landmarks.end();
}

bool LandmarkDrag::is_at_landmark(Index layout_edge) const
{
    const Layout& layout = *problem_.layout;
    return layout.tail(2 * layout_edge) == layout_vertex_ ||
           layout.head(2 * layout_edge) == layout_vertex_;
}

bool LandmarkDrag::move_to(Index target_vertex)
{
    if (problem_.landmarks[layout_vertex_] == target_vertex) {
        return true;
    }
    if (!is_allowed(target_vertex)) {
        return false;
    }
    EmbeddingProblem moved = problem_;
    moved.landmarks[layout_vertex_] = target_vertex;
    std::optional<Attempt> best = embed(moved, false);
    if (!best || best->detour() > std::max(kVisibleDetour, kDetourGrowth * detour_)) {
        std::optional<Attempt> other = embed(moved, true);
        if (other && (!best || other->cost < best->cost)) {
            best = std::move(other);
        }
    }
    if (!best) {
        return false;
    }
    problem_ = std::move(moved);
    embedding_ = std::move(best->embedding);
    order_ = std::move(best->order);
    detour_ = best->detour();
    return true;
}

std::optional<LandmarkDrag::Attempt> LandmarkDrag::embed(const EmbeddingProblem& problem,
                                                         bool own_paths_first)
{
    const Layout& layout = *problem.layout;
    Strands strands(problem, graph_);
    CutSurfaceSearch search(strands, fields_);
    const Index node = strands.landmark_node(layout_vertex_);
    Attempt attempt;

    const auto find = [&](Index edge) {
        // Towards the end that stays where it is, whose distance field is kept.
        if (layout.head(2 * edge) == layout_vertex_) {
            search.begin_backwards(edge);
        } else {
            search.begin(edge);
        }
        const Length alone = search.lower_bound();
        const std::uint64_t spent = search.expansion_count();
        if (spent >= kDragExpansions ||
            search.run(kDragExpansions - spent) != CutSurfaceSearch::Outcome::found) {
            return false;
        }
        if (is_at_landmark(edge)) {
            attempt.alone += alone;
            attempt.together += search.cost();
        }
        return strands.insert(edge, search.darts());
    };
    std::vector<Index> own;
    for (const Index halfedge : layout.outgoing(layout_vertex_)) {
        own.push_back(Layout::edge(halfedge));
    }
    std::vector<Index> in_the_way;
    const auto insert_others = [&] {
        for (const Index edge : order_) {
            if (is_at_landmark(edge)) {
                continue;
            }
            const std::vector<Index>& darts = embedding_.paths[edge].darts;
            const bool through_it = std::any_of(
                darts.begin(), darts.end(), [&](Index dart) { return graph_.head(dart) == node; });
            if (through_it || !strands.insert(edge, darts)) {
                in_the_way.push_back(edge);
            }
        }
    };
    if (!own_paths_first) {
        insert_others();
    }
    if (!std::all_of(own.begin(), own.end(), find)) {
        return std::nullopt;
    }
    if (own_paths_first) {
        insert_others();
    }
    if (!std::all_of(in_the_way.begin(), in_the_way.end(), find) || !HoleGuard(strands).accepts()) {
        return std::nullopt;
    }
    attempt.embedding = strands.weak_embedding();
    attempt.order = strands.insertion_order();
    attempt.cost = cost_of(attempt.embedding);
    return attempt;
}

Polylines LandmarkDrag::paths() const
{
    Polylines lines;
    auto form = normal_form_of(problem_, graph_, embedding_, edge_costs_);
    if (!form) {
        for (Index edge = 0; edge < embedding_.paths.size(); ++edge) {
            lines.add(graph_, edge, embedding_.paths[edge].darts);
        }
        return lines;
    }
    StraighteningOptions options;
    options.edge_costs = edge_costs_;
    Straightening straightening(std::move(*form), problem_.landmarks, options);
    for (Index left = kPassesPerEdge * problem_.layout->edge_count(); left > 0; --left) {
        if (!straightening.step()) {
            break;
        }
    }
    const NormalForm& straight = straightening.form();
    for (Index edge = 0; edge < straight.strand_count(); ++edge) {
        for (Index id = straight.first(edge); id != kNone; id = straight.element(id).next) {
            lines.points.push_back(straight.position(id));
        }
        lines.offsets.push_back(static_cast<Index>(lines.points.size()));
        lines.layout_edges.push_back(edge);
    }
    return lines;
}

}  // namespace layout_embedding
