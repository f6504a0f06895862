#include "search/greedy.hh"

#include <algorithm>
#include <numeric>

namespace layout_embedding {

GreedySearch::GreedySearch(const EmbeddingProblem& problem, Strands& strands,
                           CutSurfaceSearch& search, const GreedyRule& rule)
    : problem_(problem),
      strands_(strands),
      search_(search),
      rule_(rule),
      hole_guard_(strands),
      on_sphere_(problem.target->euler_characteristic() == 2),
      edge_count_(strands.layout().edge_count()),
      candidates_(edge_count_),
      parents_(strands.layout().vertex_count()),
      component_count_(strands.layout().vertex_count())
{
    std::iota(parents_.begin(), parents_.end(), Index{0});
    if (rule.swirl_test) {
        swirl_test_ = std::make_unique<SwirlTest>(strands);
    }
    if (rule.side_test) {
        side_test_ = std::make_unique<SideTest>(problem, strands);
    }
}

double GreedySearch::progress() const
{
    return static_cast<double>(insertion_count_) / edge_count_ / (rule_.repulsive_guide ? 2 : 1);
}

GreedySearch::Outcome GreedySearch::run(std::uint64_t max_expansions)
{
    for (;;) {
        Outcome next = Outcome::running;
        if (searching_ != kNone) {
            const std::uint64_t before = search_.expansion_count();
            const auto outcome = search_.run(max_expansions);
            max_expansions -= search_.expansion_count() - before;
            if (outcome == CutSurfaceSearch::Outcome::running) {
                return Outcome::running;
            }
            if (outcome == CutSurfaceSearch::Outcome::tied) {
                searching_ = kNone;
                return Outcome::tied;
            }
            next = finish_search(outcome == CutSurfaceSearch::Outcome::found);
        } else {
            next = advance();
        }
        if (next != Outcome::running) {
            return next;
        }
    }
}

GreedySearch::Outcome GreedySearch::finish_search(bool found)
{
    const Index edge = searching_;
    searching_ = kNone;
    Candidate& candidate = (stage_ == Stage::inserting_again ? plain_ : candidates_)[edge];
    candidate = {};
    candidate.cost = search_.cost();
    candidate.darts = search_.darts();
    if (stage_ == Stage::bounding) {
        ++next_root_;
        lower_bound_ = found && lower_bound_ != kInfiniteLength
                           ? lower_bound_ + strands_.weights().cost(edge, search_.cost())
                           : kInfiniteLength;
        return has_root_bound() ? begin_inserting() : Outcome::running;
    }
    if (stage_ == Stage::inserting && found) {
        make_current(edge);
    }
    return Outcome::running;
}

GreedySearch::Outcome GreedySearch::begin_inserting()
{
    stage_ = Stage::inserting;
    if (lower_bound_ != kInfiniteLength) {
        if (rule_.extremal_first) {
            find_extremal_vertices();
        }
        if (rule_.repulsive_guide) {
            guide_ = std::make_unique<RepulsiveGuide>(problem_, strands_.graph());
            plain_ = std::move(candidates_);
            candidates_.assign(edge_count_, {});
        }
    }
    return Outcome::bounded;
}

GreedySearch::Outcome GreedySearch::advance()
{
    switch (stage_) {
        case Stage::bounding:
            begin_search(next_root_);
            return Outcome::running;
        case Stage::inserting:
            return insert_next();
        case Stage::inserting_again:
            return insert_next_again();
    }
    return Outcome::failed;
}

GreedySearch::Outcome GreedySearch::insert_next()
{
    const Index edge = lower_bound_ == kInfiniteLength ? kNone : best_admitted();
    if (edge == kNone) {
        return Outcome::failed;
    }
    Candidate& candidate = candidates_[edge];
    if (!candidate.is_current) {
        if (!candidate.darts.empty() && strands_.trace(edge, candidate.darts)) {
            make_current(edge);
        } else {
            begin_search(edge);
        }
        return Outcome::running;
    }
    if (side_test_ && closes_cycle(edge) && !parts_rightly(edge)) {
        candidate.is_refused = true;
        return Outcome::running;
    }
    strands_.insert(edge, candidate.darts);
    return keep_inserted(edge);
}

// Keeps the strand just inserted, unless a hole got to the wrong side.
GreedySearch::Outcome GreedySearch::keep_inserted(Index layout_edge)
{
    if (!hole_guard_.accepts()) {
        strands_.undo();
        candidates_[layout_edge].is_refused = true;
        return stage_ == Stage::inserting ? Outcome::running : Outcome::failed;
    }
    ++insertion_count_;
    embedded_cost_ += strands_.weights().cost(layout_edge, length(strands_.darts(layout_edge)));
    const bool complete = strands_.insertion_order().size() == edge_count_;
    if (stage_ == Stage::inserting_again) {
        return complete ? Outcome::complete : Outcome::inserted;
    }
    for (Candidate& candidate : candidates_) {
        candidate.is_current = false;
        candidate.is_refused = false;
    }
    if (!closes_cycle(layout_edge)) {
        parents_[component(strands_.layout().tail(2 * layout_edge))] =
            component(strands_.layout().head(2 * layout_edge));
        --component_count_;
    }
    if (complete && rule_.repulsive_guide) {
        stage_ = Stage::inserting_again;
        guide_.reset();
        return Outcome::inserted;
    }
    return complete ? Outcome::complete : Outcome::inserted;
}

// The order that the guided paths led to, along plain shortest paths.
GreedySearch::Outcome GreedySearch::insert_next_again()
{
    if (order_.empty()) {
        order_ = strands_.insertion_order();
        while (!strands_.insertion_order().empty()) {
            strands_.undo();
        }
        embedded_cost_ = 0;
    }
    const Index edge = order_[strands_.insertion_order().size()];
    const Candidate& candidate = plain_[edge];
    if (candidate.cost == kInfiniteLength) {
        return Outcome::failed;
    }
    if (strands_.insert(edge, candidate.darts)) {
        return keep_inserted(edge);
    }
    begin_search(edge);
    return Outcome::running;
}

void GreedySearch::begin_search(Index layout_edge)
{
    searching_ = layout_edge;
    if (stage_ == Stage::inserting && guide_) {
        const Layout& layout = strands_.layout();
        search_.begin_weighted(layout_edge, guide_->node_weights(layout.tail(2 * layout_edge),
                                                                 layout.head(2 * layout_edge)));
    } else {
        search_.begin(layout_edge);
    }
}

// Its path is the shortest one in the present state.
void GreedySearch::make_current(Index layout_edge)
{
    Candidate& candidate = candidates_[layout_edge];
    candidate.is_current = true;
    if (swirl_test_ && !candidate.is_judged) {
        candidate.is_judged = true;
        candidate.is_suspect = swirl_test_->suspects(layout_edge, candidate.darts);
    }
}

// On a sphere a refusal holds as long as the path traces. Path and embedded edges close a simple
// curve; some landmark lies on the wrong side of it, in a component of the embedded layout graph
// that is not joined to the curve, since cyclic orders decide for those that are. It cannot be
// joined later: in the layout that happens on the curve's other side, so that the joining strand
// would cross the path. And where other strands come to lie between it and the path, one of their
// own landmarks is on the wrong side by the same argument.
bool GreedySearch::parts_rightly(Index layout_edge)
{
    Candidate& candidate = candidates_[layout_edge];
    if (candidate.is_misparting) {
        return false;
    }
    const bool accepted = side_test_->accepts(layout_edge, candidate.darts);
    candidate.is_misparting = !accepted && on_sphere_;
    return accepted;
}

Index GreedySearch::component(Index layout_vertex)
{
    while (parents_[layout_vertex] != layout_vertex) {
        parents_[layout_vertex] = parents_[parents_[layout_vertex]];
        layout_vertex = parents_[layout_vertex];
    }
    return layout_vertex;
}

bool GreedySearch::closes_cycle(Index layout_edge)
{
    const Layout& layout = strands_.layout();
    return component(layout.tail(2 * layout_edge)) == component(layout.head(2 * layout_edge));
}

bool GreedySearch::is_admitted(Index layout_edge)
{
    const Candidate& candidate = candidates_[layout_edge];
    if (strands_.is_embedded(layout_edge) || candidate.is_refused ||
        candidate.cost == kInfiniteLength) {
        return false;
    }
    return !rule_.spanning_tree_first || component_count_ == 1 || !closes_cycle(layout_edge);
}

// At most the true rank, and equal to it if the candidate is current.
GreedySearch::Rank GreedySearch::rank(Index layout_edge) const
{
    const Candidate& candidate = candidates_[layout_edge];
    const Layout& layout = strands_.layout();
    const bool is_late = !extremal_.empty() && !(extremal_[layout.tail(2 * layout_edge)] &&
                                                 extremal_[layout.head(2 * layout_edge)]);
    const Length factor = candidate.is_current && candidate.is_suspect ? 2 : 1;
    return {is_late, factor * candidate.cost};
}

Index GreedySearch::best_admitted()
{
    Index best = kNone;
    for (Index e = 0; e < edge_count_; ++e) {
        if (is_admitted(e) && (best == kNone || rank(e) < rank(best))) {
            best = e;
        }
    }
    return best;
}

void GreedySearch::find_extremal_vertices()
{
    const Layout& layout = strands_.layout();
    std::vector<Length> averages;
    std::vector<Index> vertices(layout.vertex_count());
    std::iota(vertices.begin(), vertices.end(), Index{0});
    for (const Index v : vertices) {
        Length sum = 0;
        for (const Index h : layout.outgoing(v)) {
            sum += candidates_[Layout::edge(h)].cost;
        }
        averages.push_back(sum / layout.outgoing(v).size());
    }
    std::sort(vertices.begin(), vertices.end(), [&](Index a, Index b) {
        return averages[a] != averages[b] ? averages[a] > averages[b] : a < b;
    });
    vertices.resize(layout.vertex_count() / 4);
    extremal_.assign(layout.vertex_count(), false);
    for (const Index v : vertices) {
        extremal_[v] = true;
    }
}

Length GreedySearch::length(const std::vector<Index>& darts) const
{
    return std::accumulate(darts.begin(), darts.end(), Length{0}, [&](Length sum, Index d) {
        return sum + strands_.graph().dart(d).length;
    });
}

}  // namespace layout_embedding
