#include "embedding/weak_to_normal_form.hh"

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

namespace layout_embedding {

namespace {

/// A strand on its way through a node: it arrives along dart `step` of its path and leaves along
/// the next.
struct Pass {
    Index node;
    Index path;
    Index step;
    /// The crossings with target edges that this pass makes, in its own direction: a list linked by
    /// Conversion::links_. Or a vertex element.
    Index first_crossing = kNone;
    Index last_crossing = kNone;
};

/// Where a pass meets the small disk around its node.
struct End {
    Index pass = kNone;
    /// Whether the strand leaves the node here.
    bool outgoing = false;
    /// The place of the other end of the pass.
    Index mate = kNone;
};

/// A target edge on its way out of the disk around a node.
struct Ray {
    Index edge;
    /// Whether it leaves in the edge's own direction.
    bool forward;
    /// How many ends lie before it, counter-clockwise from the node's first dart.
    Index place;
};

/// Consecutive crossings of one edge, made in the fan of its tail (part 0), at its midpoint (1) or
/// in the fan of its head (2). In part 2 they are numbered against the edge's direction.
struct Bundle {
    Index edge;
    Index part;
    Index first;
    Index count;
};

class Conversion {
public:
    Conversion(const EmbeddingProblem& problem, const PathGraph& graph,
               const WeakEmbedding& embedding, std::span<const double> edge_costs)
        : problem_(problem),
          mesh_(*problem.target),
          graph_(graph),
          paths_(embedding.paths),
          edge_costs_(edge_costs),
          form_(mesh_, problem.layout->edge_count())
    {}

    Result<NormalForm> run();

private:
    Status check_paths() const;
    /// Fills passes_ with those through target vertices and edge midpoints, sorted by node.
    Status gather_passes();
    /// Adds the crossings made in the disk around the node of passes_[begin] .. passes_[end - 1].
    Status cross_at_node(Index begin, Index end);
    /// Sets ends_ and dart_begins_: the ends around the node, counter-clockwise.
    Status order_ends(Index begin, Index end);
    /// Sets the mates; false if two passes cross.
    bool match_ends();
    void gather_rays(const NodeElement& element, Index node);
    /// The gap between two ends in which the vertex crosses fewest passes with its rays.
    Index best_gap() const;
    /// How many lanes on the given dart (a half-edge that leaves the node) run right of the target
    /// edge, as seen from the node.
    Index lanes_right(Index dart_place, Index edge, bool forward) const;
    /// Whether a pass through a vertex comes or goes along a whole edge that costs less.
    bool runs_along_cheap_edge(const Pass& pass) const;
    /// The pass that is to run over the vertex in the given gap between ends; kNone if there is
    /// none.
    Index pass_over_vertex(Index gap) const;
    void link_strands();
    void link_edges();

    const EmbeddingProblem& problem_;
    const TriangleMesh& mesh_;
    const PathGraph& graph_;
    const std::vector<WeakPath>& paths_;
    std::span<const double> edge_costs_;
    NormalForm form_;

    std::vector<Pass> passes_;
    std::vector<Bundle> bundles_;
    std::vector<Index> links_;  // per element so far: the next one of its pass

    // Scratch, for one node at a time.
    std::vector<End> ends_;
    std::vector<Index> dart_begins_;  // per dart of the node (+1): its first place in ends_
    std::vector<Ray> rays_;
    std::vector<Index> stack_;
};

Error broken(std::string what, Index layout_edge)
{
    return make_error(ErrorCode::realisationFailed,
                      std::move(what) + " (layout edge " + std::to_string(layout_edge) + ")",
                      {{"edge", layout_edge}});
}

Status Conversion::check_paths() const
{
    const Layout& layout = *problem_.layout;
    if (paths_.size() != layout.edge_count()) {
        return make_error(ErrorCode::realisationFailed,
                          "the embedding has " + std::to_string(paths_.size()) + " paths for " +
                              std::to_string(layout.edge_count()) + " layout edges");
    }
    for (Index p = 0; p < layout.edge_count(); ++p) {
        const WeakPath& path = paths_[p];
        if (path.darts.empty() || path.lanes.size() != path.darts.size()) {
            return broken("a path or its lanes are missing", p);
        }
        const auto landmark = [&](Index h) {
            return graph_.node_of_vertex(problem_.landmarks[layout.tail(h)]);
        };
        for (std::size_t i = 0; i < path.darts.size(); ++i) {
            if (path.darts[i] >= graph_.dart_count() ||
                (i > 0 && graph_.tail(path.darts[i]) != graph_.head(path.darts[i - 1]))) {
                return broken("the darts of a path do not follow each other", p);
            }
        }
        if (graph_.tail(path.darts.front()) != landmark(2 * p) ||
            graph_.head(path.darts.back()) != landmark(2 * p + 1)) {
            return broken("a path does not join its landmarks", p);
        }
    }
    return {};
}

Status Conversion::gather_passes()
{
    std::vector<Index> landmarks = problem_.landmarks;
    std::sort(landmarks.begin(), landmarks.end());
    for (Index p = 0; p < paths_.size(); ++p) {
        const std::vector<Index>& darts = paths_[p].darts;
        for (Index i = 0; i + 1 < darts.size(); ++i) {
            const Index node = graph_.head(darts[i]);
            const NodeElement element = graph_.element(node);
            if (element.kind == NodeKind::face_centroid) {
                continue;  // No target edge comes near a centroid.
            }
            if (element.kind == NodeKind::vertex &&
                std::binary_search(landmarks.begin(), landmarks.end(), element.id)) {
                return broken("a path runs through landmark vertex " + std::to_string(element.id),
                              p);
            }
            passes_.push_back({node, p, i});
        }
    }
    std::sort(passes_.begin(), passes_.end(), [](const Pass& a, const Pass& b) {
        return std::tie(a.node, a.path, a.step) < std::tie(b.node, b.path, b.step);
    });
    return {};
}

Status Conversion::order_ends(Index begin, Index end)
{
    const Index node = passes_[begin].node;
    const Index first_dart = graph_.first_dart(node);
    const auto arrival = [&](const Pass& pass) {
        return graph_.twin(paths_[pass.path].darts[pass.step]) - first_dart;
    };
    const auto departure = [&](const Pass& pass) {
        return paths_[pass.path].darts[pass.step + 1] - first_dart;
    };
    // No strand ends here: all lanes of a dart belong to these passes.
    dart_begins_.assign(graph_.degree(node) + 1, 0);
    for (Index i = begin; i < end; ++i) {
        ++dart_begins_[arrival(passes_[i]) + 1];
        ++dart_begins_[departure(passes_[i]) + 1];
    }
    for (std::size_t d = 1; d < dart_begins_.size(); ++d) {
        dart_begins_[d] += dart_begins_[d - 1];
    }
    ends_.assign(dart_begins_.back(), {});
    for (Index i = begin; i < end; ++i) {
        const Pass& pass = passes_[i];
        for (const bool outgoing : {false, true}) {
            // Counter-clockwise around the node is from right to left as seen from it. Lanes count
            // from the right of the strand, which is the left from here when it arrives.
            const Index dart = outgoing ? departure(pass) : arrival(pass);
            const Index lanes = dart_begins_[dart + 1] - dart_begins_[dart];
            const Index lane = paths_[pass.path].lanes[pass.step + (outgoing ? 1 : 0)];
            if (lane >= lanes) {
                return broken("a lane number exceeds the passes on its edge", pass.path);
            }
            End& place = ends_[dart_begins_[dart] + (outgoing ? lane : lanes - 1 - lane)];
            if (place.pass != kNone) {
                return broken("two passes share a lane", pass.path);
            }
            place.pass = i;
            place.outgoing = outgoing;
        }
    }
    return {};
}

bool Conversion::match_ends()
{
    // stack_ holds the places of ends whose mate is still to come.
    stack_.clear();
    std::vector<Index>& open = stack_;
    for (Index i = 0; i < ends_.size(); ++i) {
        if (!open.empty() && ends_[open.back()].pass == ends_[i].pass) {
            ends_[i].mate = open.back();
            ends_[open.back()].mate = i;
            open.pop_back();
        } else {
            open.push_back(i);
        }
    }
    return open.empty();
}

Index Conversion::lanes_right(Index dart_place, Index edge, bool forward) const
{
    const Index begin = dart_begins_[dart_place];
    const Index lanes = dart_begins_[dart_place + 1] - begin;
    if (mesh_.is_boundary_edge(edge)) {
        // All inside, which is left of the edge in its own direction.
        return forward ? 0 : lanes;
    }
    if (lanes % 2 == 0) {
        return lanes / 2;
    }
    // The strand in the middle keeps the edge on its right all along its way: changing sides from
    // one edge to the next would cost crossings.
    return lanes / 2 + (ends_[begin + lanes / 2].outgoing ? 0 : 1);
}

void Conversion::gather_rays(const NodeElement& element, Index node)
{
    rays_.clear();
    for (Index place = 0; place < graph_.degree(node); ++place) {
        const NodeElement other = graph_.element(graph_.head(graph_.first_dart(node) + place));
        if (other.kind == NodeKind::face_centroid) {
            continue;
        }
        Ray ray;
        if (element.kind == NodeKind::vertex) {
            ray.edge = other.id;
            ray.forward = mesh_.tail(mesh_.halfedge(ray.edge)) == element.id;
        } else {
            ray.edge = element.id;
            ray.forward = mesh_.head(mesh_.halfedge(ray.edge)) == other.id;
        }
        ray.place = dart_begins_[place] + lanes_right(place, ray.edge, ray.forward);
        rays_.push_back(ray);
    }
}

Index Conversion::best_gap() const
{
    // Gap g lies just before end g. Moving the vertex across a pass makes that pass cross the rays
    // on its other side instead.
    const auto rays_until = [&](Index place) {
        const auto after = std::upper_bound(rays_.begin(), rays_.end(), place,
                                            [](Index p, const Ray& ray) { return p < ray.place; });
        return static_cast<long>(after - rays_.begin());
    };
    long cost = 0;
    long best_cost = 0;
    Index best = 0;
    for (Index i = 0; i + 1 < ends_.size(); ++i) {
        const Index low = std::min(i, ends_[i].mate);
        const Index high = std::max(i, ends_[i].mate);
        const long inside = rays_until(high) - rays_until(low);
        const long change = static_cast<long>(rays_.size()) - 2 * inside;
        cost += i == low ? change : -change;
        if (cost < best_cost) {
            best_cost = cost;
            best = i + 1;
        }
    }
    return best;
}

bool Conversion::runs_along_cheap_edge(const Pass& pass) const
{
    const std::vector<Index>& darts = paths_[pass.path].darts;
    const auto is_cheap = [&](std::size_t first) {
        if (first + 1 >= darts.size()) {
            return false;
        }
        const NodeElement middle = graph_.element(graph_.head(darts[first]));
        return middle.kind == NodeKind::edge_midpoint && edge_costs_[middle.id] < 1 &&
               graph_.element(graph_.tail(darts[first])).kind == NodeKind::vertex &&
               graph_.element(graph_.head(darts[first + 1])).kind == NodeKind::vertex;
    };
    return (pass.step > 0 && is_cheap(pass.step - 1)) || is_cheap(pass.step + 1);
}

Index Conversion::pass_over_vertex(Index gap) const
{
    // Only passes beside the gap have no other one between them and the vertex.
    const Index count = static_cast<Index>(ends_.size());
    Index best = kNone;
    for (const Index place : {gap, (gap + count - 1) % count}) {
        const Index pass = ends_[place].pass;
        if (runs_along_cheap_edge(passes_[pass]) &&
            (best == kNone || passes_[pass].path < passes_[best].path)) {
            best = pass;
        }
    }
    return best;
}

Status Conversion::cross_at_node(Index begin, Index end)
{
    const Index node = passes_[begin].node;
    const NodeElement element = graph_.element(node);
    if (const Status status = order_ends(begin, end); !status) {
        return status;
    }
    if (!match_ends()) {
        return broken("strands cross at node " + std::to_string(node) + " of the path graph",
                      passes_[begin].path);
    }
    gather_rays(element, node);

    // The node itself is put in a gap between two ends, its rays leave from there, and a pass
    // crosses those rays that it separates from the node. A midpoint is put where its edge arrives
    // from the tail, so that only the half towards the head is crossed; a boundary node is put
    // outside.
    Index gap = 0;
    if (element.kind == NodeKind::edge_midpoint) {
        gap = rays_[rays_[0].forward ? 1 : 0].place;
    } else if (!graph_.is_boundary(node)) {
        gap = best_gap();
    }
    const Index count = static_cast<Index>(ends_.size());
    gap %= count;
    Index over_vertex = kNone;
    if (!edge_costs_.empty() && element.kind == NodeKind::vertex && !graph_.is_boundary(node)) {
        over_vertex = pass_over_vertex(gap);
        if (over_vertex != kNone) {
            Pass& pass = passes_[over_vertex];
            pass.first_crossing = pass.last_crossing = form_.add_vertex(element.id);
            links_.push_back(kNone);
        }
    }

    // Walk around the node from the gap. The passes that are open at a ray are the ones that cross
    // it, the outermost nearest to the node.
    stack_.clear();
    std::vector<Index>& open = stack_;  // passes
    Index walked = 0;
    const auto cross = [&](const Ray& ray) -> bool {
        const Index place = ray.place > gap ? ray.place - gap : ray.place + count - gap;
        for (; walked < place; ++walked) {
            const Index i = (walked + gap) % count;
            if (ends_[i].pass == over_vertex) {
                continue;
            }
            // An end opens its pass unless its mate has been walked over.
            const Index mate = (ends_[i].mate + count - gap) % count;
            if (mate > walked) {
                open.push_back(i);
            } else {
                open.pop_back();
            }
        }
        if (open.empty()) {
            return true;
        }
        const Index h = mesh_.halfedge(ray.edge);
        const Index twin = mesh_.opposite(h);
        if (twin == kNone) {
            return false;
        }
        const Index part = element.kind == NodeKind::edge_midpoint ? 1 : ray.forward ? 0 : 2;
        bundles_.push_back(
            {ray.edge, part, form_.element_count(), static_cast<Index>(open.size())});
        const Index outwards = ray.forward ? h : twin;
        const Index inwards = ray.forward ? twin : h;
        for (const Index i : open) {
            Pass& pass = passes_[ends_[i].pass];
            // A pass that goes counter-clockwise comes from the right of the ray; it starts at the
            // end where it is opened.
            const bool counter_clockwise = !ends_[i].outgoing;
            const Index crossing = form_.add_crossing(counter_clockwise ? inwards : outwards);
            links_.push_back(kNone);
            if (pass.first_crossing == kNone) {
                pass.first_crossing = pass.last_crossing = crossing;
            } else if (counter_clockwise) {
                links_[pass.last_crossing] = crossing;
                pass.last_crossing = crossing;
            } else {
                links_[crossing] = pass.first_crossing;
                pass.first_crossing = crossing;
            }
        }
        return true;
    };
    for (const bool before_wrap : {true, false}) {
        for (const Ray& ray : rays_) {
            if ((ray.place > gap) == before_wrap && !cross(ray)) {
                return broken(
                    "a path crosses the target's boundary at edge " + std::to_string(ray.edge),
                    passes_[begin].path);
            }
        }
    }
    return {};
}

void Conversion::link_strands()
{
    std::vector<Index> offsets{0};
    for (const WeakPath& path : paths_) {
        offsets.push_back(offsets.back() + static_cast<Index>(path.darts.size()));
    }
    std::vector<Index> pass_of_step(offsets.back(), kNone);
    for (Index i = 0; i < passes_.size(); ++i) {
        pass_of_step[offsets[passes_[i].path] + passes_[i].step] = i;
    }
    const Layout& layout = *problem_.layout;
    for (Index p = 0; p < paths_.size(); ++p) {
        form_.append_to_strand(p, form_.add_vertex(problem_.landmarks[layout.tail(2 * p)]));
        for (Index step = offsets[p]; step < offsets[p + 1]; ++step) {
            if (pass_of_step[step] == kNone) {
                continue;
            }
            for (Index crossing = passes_[pass_of_step[step]].first_crossing; crossing != kNone;
                 crossing = links_[crossing]) {
                form_.append_to_strand(p, crossing);
            }
        }
        form_.append_to_strand(p, form_.add_vertex(problem_.landmarks[layout.head(2 * p)]));
    }
}

void Conversion::link_edges()
{
    std::sort(bundles_.begin(), bundles_.end(), [](const Bundle& a, const Bundle& b) {
        return std::tie(a.edge, a.part) < std::tie(b.edge, b.part);
    });
    for (const Bundle& bundle : bundles_) {
        for (Index i = 0; i < bundle.count; ++i) {
            form_.append_to_edge(bundle.first + (bundle.part == 2 ? bundle.count - 1 - i : i));
        }
    }
}

Result<NormalForm> Conversion::run()
{
    if (const Status status = check_paths(); !status) {
        return status.error();
    }
    if (const Status status = gather_passes(); !status) {
        return status.error();
    }
    for (Index begin = 0; begin < passes_.size();) {
        Index end = begin;
        while (end < passes_.size() && passes_[end].node == passes_[begin].node) {
            ++end;
        }
        if (const Status status = cross_at_node(begin, end); !status) {
            return status.error();
        }
        begin = end;
    }
    link_strands();
    link_edges();
    form_.remove_bigons();
    form_.compact();
    form_.spread_evenly();
    return std::move(form_);
}

}  // namespace

Result<NormalForm> normal_form_of(const EmbeddingProblem& problem, const PathGraph& graph,
                                  const WeakEmbedding& embedding,
                                  std::span<const double> edge_costs)
{
    return Conversion(problem, graph, embedding, edge_costs).run();
}

}  // namespace layout_embedding
