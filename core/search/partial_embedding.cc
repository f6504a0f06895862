#include "search/partial_embedding.hh"

#include <algorithm>

#include "surface/stretch.hh"

namespace layout_embedding {

namespace {

template <typename T>
void sort_unique(std::vector<T>& values)
{
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace

std::vector<Index> CandidateConflicts::edges() const
{
    std::vector<Index> edges;
    for (const auto& [a, b] : pairs) {
        edges.push_back(a);
        edges.push_back(b);
    }
    for (const auto& triple : triples) {
        edges.insert(edges.end(), triple.begin(), triple.end());
    }
    sort_unique(edges);
    return edges;
}

PartialEmbedding::PartialEmbedding(Strands& strands, WalkPool& pool)
    : strands_(strands),
      pool_(pool),
      hole_guard_(strands),
      walks_(strands.layout().edge_count(), kNone)
{
    const PathGraph& graph = strands.graph();
    for (Index v = 0; v < strands.layout().vertex_count(); ++v) {
        linear_.push_back(graph.is_boundary(strands.landmark_node(v)));
    }
    has_holes_ = false;
    for (Index node = 0; node < graph.node_count() && !has_holes_; ++node) {
        has_holes_ = graph.is_boundary(node);
    }
}

/// Whether a walk leaves the tail of its edge's halfedge between the embedded edges that are next
/// to it in the layout.
bool PartialEmbedding::in_order(Index halfedge, Index walk) const
{
    const Index v = layout().tail(halfedge);
    const auto around = layout().outgoing(v);
    const auto count = static_cast<Index>(around.size());
    const Index rank = layout().rank(halfedge);
    Index before = kNone;
    Index after = kNone;
    for (Index i = 1; i < count && before == kNone; ++i) {
        const Index h = around[(rank + count - i) % count];
        if (is_linear(v) && i > rank) {
            break;
        }
        before = walks_[Layout::edge(h)] != kNone ? h : kNone;
    }
    for (Index i = 1; i < count && after == kNone; ++i) {
        const Index h = around[(rank + i) % count];
        if (is_linear(v) && rank + i >= count) {
            break;
        }
        after = walks_[Layout::edge(h)] != kNone ? h : kNone;
    }
    const auto place = [&](Index h) { return pool_.place(h, walks_[Layout::edge(h)]); };
    const Index here = pool_.place(halfedge, walk);
    if (is_linear(v)) {
        return (before == kNone || place(before) < here) && (after == kNone || here < place(after));
    }
    return before == after || is_before(place(before), here, place(after));
}

bool PartialEmbedding::fits(Index walk) const
{
    if (std::any_of(sequence_.begin(), sequence_.end(),
                    [&](Index other) { return pool_.cross(walk, other); })) {
        return false;
    }
    const Index edge = pool_.layout_edge(walk);
    return in_order(2 * edge, walk) && in_order(2 * edge + 1, walk);
}

PartialEmbedding::Insertion PartialEmbedding::insert(Index walk)
{
    walks_[pool_.layout_edge(walk)] = walk;
    sequence_.push_back(walk);
    cost_ += pool_.cost(walk);
    ++insertion_count_;
    if (has_holes_) {
        const bool moved = move_strands();
        if (!moved || !hole_guard_.accepts()) {
            undo();
            return moved ? Insertion::refused : Insertion::torn;
        }
    }
    return Insertion::done;
}

void PartialEmbedding::undo()
{
    const Index walk = sequence_.back();
    walks_[pool_.layout_edge(walk)] = kNone;
    cost_ -= pool_.cost(walk);
    sequence_.pop_back();
}

void PartialEmbedding::go_to(std::span<const Index> sequence)
{
    std::size_t common = 0;
    while (common < sequence.size() && common < sequence_.size() &&
           sequence[common] == sequence_[common]) {
        ++common;
    }
    while (sequence_.size() > common) {
        undo();
    }
    for (const Index walk : sequence.subspan(common)) {
        walks_[pool_.layout_edge(walk)] = walk;
        sequence_.push_back(walk);
        cost_ += pool_.cost(walk);
        ++insertion_count_;
    }
}

std::vector<Index> PartialEmbedding::walks_around_misplaced_hole() const
{
    std::vector<Index> walks = hole_guard_.edges_around_misplaced_hole();
    for (Index& walk : walks) {
        walk = walks_[walk];
    }
    return walks;
}

bool PartialEmbedding::move_strands()
{
    std::size_t common = 0;
    while (common < strand_walks_.size() && common < sequence_.size() &&
           strand_walks_[common] == sequence_[common]) {
        ++common;
    }
    while (strand_walks_.size() > common) {
        strands_.undo();
        strand_walks_.pop_back();
    }
    for (std::size_t i = common; i < sequence_.size(); ++i) {
        const Index walk = sequence_[i];
        if (!strands_.insert(pool_.layout_edge(walk), pool_.darts(walk))) {
            return false;
        }
        strand_walks_.push_back(walk);
    }
    return true;
}

/// A halfedge at a vertex whose edge is embedded, kNone if there is none.
Index PartialEmbedding::embedded_at(Index layout_vertex) const
{
    for (const Index h : layout().outgoing(layout_vertex)) {
        if (walks_[Layout::edge(h)] != kNone) {
            return h;
        }
    }
    return kNone;
}

/// Whether two walks that leave the same landmark would be in the wrong order there, given what is
/// embedded.
bool PartialEmbedding::order_conflict(Index halfedge_a, Index walk_a, Index halfedge_b,
                                      Index walk_b) const
{
    const Index v = layout().tail(halfedge_a);
    const Index place_a = pool_.place(halfedge_a, walk_a);
    const Index place_b = pool_.place(halfedge_b, walk_b);
    const Index rank_a = layout().rank(halfedge_a);
    const Index rank_b = layout().rank(halfedge_b);
    if (is_linear(v)) {
        return (place_a < place_b) != (rank_a < rank_b);
    }
    const Index h = embedded_at(v);
    return h != kNone && is_before(pool_.place(h, walks_[Layout::edge(h)]), place_a, place_b) !=
                             is_before(layout().rank(h), rank_a, rank_b);
}

CandidateConflicts PartialEmbedding::conflicts(std::span<const Index> candidates) const
{
    CandidateConflicts found;
    IndexSet in_question;
    for (Index e = 0; e < candidates.size(); ++e) {
        if (walks_[e] == kNone) {
            in_question.insert(candidates[e]);
        }
    }
    for (Index a = 0; a < candidates.size(); ++a) {
        if (walks_[a] != kNone) {
            continue;
        }
        pool_.crossing(candidates[a]).for_each_common(in_question, [&](Index other) {
            const Index b = pool_.layout_edge(other);
            if (a < b) {
                found.pairs.emplace_back(a, b);
            }
        });
    }
    std::vector<Index> open;  // halfedges
    for (Index v = 0; v < layout().vertex_count(); ++v) {
        open.clear();
        for (const Index h : layout().outgoing(v)) {
            if (walks_[Layout::edge(h)] == kNone) {
                open.push_back(h);
            }
        }
        const auto walk = [&](Index h) { return candidates[Layout::edge(h)]; };
        if (is_linear(v) || open.size() < layout().outgoing(v).size()) {
            for (std::size_t x = 0; x < open.size(); ++x) {
                for (std::size_t y = x + 1; y < open.size(); ++y) {
                    if (order_conflict(open[x], walk(open[x]), open[y], walk(open[y]))) {
                        found.pairs.push_back(
                            std::minmax(Layout::edge(open[x]), Layout::edge(open[y])));
                    }
                }
            }
            continue;
        }
        std::vector<Index> places;
        for (const Index h : open) {
            places.push_back(pool_.place(h, walk(h)));
        }
        for (std::size_t x = 0; x < open.size(); ++x) {
            for (std::size_t y = x + 1; y < open.size(); ++y) {
                for (std::size_t z = y + 1; z < open.size(); ++z) {
                    if (!is_before(places[x], places[y], places[z])) {
                        std::array<Index, 3> triple{Layout::edge(open[x]), Layout::edge(open[y]),
                                                    Layout::edge(open[z])};
                        std::sort(triple.begin(), triple.end());
                        found.triples.push_back(triple);
                    }
                }
            }
        }
    }
    sort_unique(found.pairs);
    sort_unique(found.triples);
    return found;
}

std::vector<Index> PartialEmbedding::conflicting_with(Index layout_edge,
                                                      std::span<const Index> candidates) const
{
    std::vector<Index> edges;
    const Index walk = candidates[layout_edge];
    for (Index e = 0; e < candidates.size(); ++e) {
        if (walks_[e] == kNone && pool_.cross(walk, candidates[e])) {
            edges.push_back(e);
        }
    }
    for (const Index here : {2 * layout_edge, 2 * layout_edge + 1}) {
        for (const Index h : layout().outgoing(layout().tail(here))) {
            const Index e = Layout::edge(h);
            if (h != here && walks_[e] == kNone && order_conflict(here, walk, h, candidates[e])) {
                edges.push_back(e);
            }
        }
    }
    sort_unique(edges);
    return edges;
}

}  // namespace layout_embedding
