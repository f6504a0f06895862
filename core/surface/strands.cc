#include "surface/strands.hh"

#include <algorithm>

#include "surface/stretch.hh"

namespace layout_embedding {

Strands::Strands(const EmbeddingProblem& problem, const PathGraph& graph)
    : graph_(&graph),
      layout_(problem.layout),
      weights_(problem.weights),
      passable_(graph.node_count(), true),
      strands_(problem.layout->edge_count()),
      records_of_nodes_(graph.node_count(), kNone)
{
    for (const Index landmark : problem.landmarks) {
        landmark_nodes_.push_back(graph.node_of_vertex(landmark));
        passable_[landmark_nodes_.back()] = false;
    }
}

Index Strands::strand_count(Index tail, Index dart) const
{
    const Record* record = record_at(tail);
    if (record == nullptr) {
        return 0;
    }
    const Index place = dart - graph_->first_dart(tail);
    return record->slot_offsets[place + 1] - record->slot_offsets[place] - 1;
}

Index Strands::region(Index tail, Index dart, Index slot) const
{
    const Record* record = record_at(tail);
    if (record == nullptr) {
        return 0;
    }
    return record->slot_regions[record->slot_offsets[dart - graph_->first_dart(tail)] + slot];
}

Index Strands::slot_in_region(Index tail, Index dart, Index region) const
{
    const Record* record = record_at(tail);
    if (record == nullptr) {
        return 0;
    }
    const Index place = dart - graph_->first_dart(tail);
    const Index begin = record->slot_offsets[place];
    for (Index i = begin; i < record->slot_offsets[place + 1]; ++i) {
        if (record->slot_regions[i] == region) {
            return i - begin;
        }
    }
    return kNone;
}

Index Strands::state(Index node, Index region) const
{
    return region == 0 ? node : graph_->node_count() + record_at(node)->first_extra + region - 1;
}

Index Strands::slot_place(Index tail, Index dart, Index slot) const
{
    const Index place = dart - graph_->first_dart(tail);
    const Record* record = record_at(tail);
    return record == nullptr ? place : record->slot_offsets[place] + slot;
}

Index Strands::bordering_halfedge(Index state) const
{
    const Index node = node_of_state(state);
    const Record* record = record_at(node);
    if (record == nullptr) {
        return kNone;
    }
    const Index region = region_of_state(state);
    for (Index k = 0; k < record->ends.size(); ++k) {
        const End& end = record->ends[k];
        // The slot to the right of the end, looking outwards: see append_bordering().
        if (record->slot_regions[k + end.place] == region) {
            const auto& darts = strands_[end.layout_edge];
            const bool leaves = end.visit < darts.size() &&
                                darts[end.visit] == graph_->first_dart(node) + end.place;
            return leaves ? 2 * end.layout_edge + 1 : 2 * end.layout_edge;
        }
    }
    return kNone;
}

void Strands::append_bordering(Index state, std::vector<Index>& layout_edges) const
{
    const Record* record = record_at(node_of_state(state));
    if (record == nullptr) {
        return;
    }
    const Index region = region_of_state(state);
    // Slots and ends alternate but for one slot more per dart: end k at the i-th place has the
    // slots k + i to its right and k + i + 1 to its left.
    for (Index k = 0; k < record->ends.size(); ++k) {
        const End& end = record->ends[k];
        const Index right = k + end.place;
        if (record->slot_regions[right] == region || record->slot_regions[right + 1] == region) {
            layout_edges.push_back(end.layout_edge);
        }
    }
}

void Strands::append_sector_neighbours(Index layout_halfedge,
                                       std::vector<Index>& layout_edges) const
{
    const auto around = layout_->outgoing(layout_->tail(layout_halfedge));
    const Index rank = layout_->rank(layout_halfedge);
    const auto count = static_cast<Index>(around.size());
    for (const Index direction : {Index{1}, count - 1}) {
        for (Index step = 1; step < count; ++step) {
            const Index edge = Layout::edge(around[(rank + step * direction) % count]);
            if (is_embedded(edge)) {
                layout_edges.push_back(edge);
                break;
            }
        }
    }
}

Index Strands::sector(Index layout_halfedge) const
{
    const Index vertex = layout_->tail(layout_halfedge);
    const Index node = landmark_nodes_[vertex];
    const auto around = layout_->outgoing(vertex);
    const Index rank = layout_->rank(layout_halfedge);
    if (graph_->is_boundary(node)) {
        // Linear order, starting at the hole: sector i follows the first i strands.
        Index before = 0;
        for (Index i = 0; i < rank; ++i) {
            before += is_embedded(Layout::edge(around[i])) ? 1 : 0;
        }
        return before;
    }
    const auto count = static_cast<Index>(around.size());
    for (Index step = 1; step < count; ++step) {
        const Index edge = Layout::edge(around[(rank + count - step) % count]);
        if (!is_embedded(edge)) {
            continue;
        }
        const auto& ends = record_at(node)->ends;
        const auto end = std::find_if(ends.begin(), ends.end(),
                                      [&](const End& e) { return e.layout_edge == edge; });
        return static_cast<Index>(end - ends.begin() + 1) % static_cast<Index>(ends.size());
    }
    return 0;
}

std::optional<Strands::Trace> Strands::trace_from(Index layout_edge, std::span<const Index> darts,
                                                  Index first_slot) const
{
    Trace trace;
    trace.slots.reserve(darts.size());
    trace.states.reserve(darts.size());
    Index node = graph_->tail(darts[0]);
    Index slot = first_slot;
    for (std::size_t i = 0;; ++i) {
        const Index dart = darts[i];
        trace.slots.push_back(slot);
        const Index twin_slot = strand_count(node, dart) - slot;
        node = graph_->head(dart);
        const Index here = region(node, graph_->twin(dart), twin_slot);
        if (i + 1 == darts.size()) {
            if (here != sector(2 * layout_edge + 1)) {
                return std::nullopt;
            }
            break;
        }
        trace.states.push_back(state(node, here));
        slot = slot_in_region(node, darts[i + 1], here);
        if (slot == kNone) {
            return std::nullopt;
        }
    }
    return trace;
}

std::optional<Strands::Trace> Strands::trace(Index layout_edge, std::span<const Index> darts) const
{
    // With a single strand at the landmark the slots on both its sides lie in one sector: where the
    // walk leaves along that strand, only following it further shows on which side it runs.
    const Index start = landmark_nodes_[layout_->tail(2 * layout_edge)];
    const Index sector_here = sector(2 * layout_edge);
    const Index strands = strand_count(start, darts[0]);
    for (Index slot = 0; slot <= strands; ++slot) {
        if (region(start, darts[0], slot) == sector_here) {
            if (auto trace = trace_from(layout_edge, darts, slot)) {
                return trace;
            }
        }
    }
    return std::nullopt;
}

Strands::Record& Strands::touch(Index node)
{
    Index& r = records_of_nodes_[node];
    if (r == kNone) {
        if (free_records_.empty()) {
            r = static_cast<Index>(records_.size());
            records_.emplace_back();
        } else {
            r = free_records_.back();
            free_records_.pop_back();
        }
        records_[r].node = node;
        records_[r].first_extra = 0;
        records_[r].region_count = 1;
    }
    return records_[r];
}

void Strands::insert_end(Index node, Index dart, Index lane, Index layout_edge, Index visit)
{
    Record& record = touch(node);
    const Index place = dart - graph_->first_dart(node);
    const auto first = std::find_if(record.ends.begin(), record.ends.end(),
                                    [&](const End& e) { return e.place >= place; });
    record.ends.insert(first + lane, End{place, layout_edge, visit});
}

void Strands::update_regions(Record& record)
{
    const Index degree = graph_->degree(record.node);
    const bool landmark = !passable_[record.node];
    const bool linear = graph_->is_boundary(record.node);
    const auto ends = static_cast<Index>(record.ends.size());
    record.slot_offsets.clear();
    record.slot_regions.clear();

    // Going around counter-clockwise, a passing strand opens a region at its first end and returns
    // to the one around it at its second; strands that end here open the next sector each.
    std::vector<std::pair<const End*, Index>> open;
    Index region = 0;
    Index regions = 1;
    Index next = 0;
    for (Index place = 0; place < degree; ++place) {
        record.slot_offsets.push_back(static_cast<Index>(record.slot_regions.size()));
        record.slot_regions.push_back(region);
        for (; next < ends && record.ends[next].place == place; ++next) {
            const End& end = record.ends[next];
            if (landmark) {
                region = linear || next + 1 < ends ? next + 1 : 0;
                regions = std::max(regions, region + 1);
            } else if (!open.empty() && open.back().first->layout_edge == end.layout_edge &&
                       open.back().first->visit == end.visit) {
                region = open.back().second;
                open.pop_back();
            } else {
                open.emplace_back(&end, region);
                region = regions++;
            }
            record.slot_regions.push_back(region);
        }
    }
    record.slot_offsets.push_back(static_cast<Index>(record.slot_regions.size()));
    record.region_count = regions;
}

/// Whether of two passes of a walk over the same edge of the path graph the first lies to the right
/// of the second, both seen along the direction in which `a` is turned: the walk's i-th dart, or
/// its twin if `turned_i`, and likewise j. They lie as they diverge, ahead or, where the walk ends
/// before that, behind.
bool Strands::lies_right(std::span<const Index> darts, Index i, bool turned_i, Index j,
                         bool turned_j) const
{
    const auto count = static_cast<Index>(darts.size());
    for (const bool behind : {false, true}) {
        // Seen from the other end of the edge, right is left.
        const bool back_i = turned_i != behind;
        const bool back_j = turned_j != behind;
        for (Index step = 1;; ++step) {
            if ((back_i ? i < step : i + step >= count) ||
                (back_j ? j < step : j + step >= count)) {
                break;
            }
            const auto at = [&](Index place, bool back, Index k) {
                return back ? graph_->twin(darts[place - k]) : darts[place + k];
            };
            const Index on_i = at(i, back_i, step);
            const Index on_j = at(j, back_j, step);
            if (on_i != on_j) {
                const Index back = graph_->twin(at(i, back_i, step - 1));
                return is_before(back, on_i, on_j) != behind;
            }
        }
    }
    return i < j;
}

bool Strands::insert(Index layout_edge, std::vector<Index> darts)
{
    const auto trace = this->trace(layout_edge, darts);
    if (!trace) {
        return false;
    }
    // Where the walk uses an edge of the path graph twice, the lower lane goes first, so that the
    // lanes of both are right: see below.
    struct Pass {
        Index dart;   // the smaller one of the edge
        Index slot;   // along it
        Index place;  // in the walk
    };
    std::vector<Pass> passes(darts.size());
    for (Index i = 0; i < darts.size(); ++i) {
        const Index dart = darts[i];
        const Index twin = graph_->twin(dart);
        const Index slot = trace->slots[i];
        passes[i] = dart < twin ? Pass{dart, slot, i}
                                : Pass{twin, strand_count(graph_->head(twin), dart) - slot, i};
    }
    std::sort(passes.begin(), passes.end(), [&](const Pass& a, const Pass& b) {
        if (a.dart != b.dart) {
            return a.dart < b.dart;
        }
        if (a.slot != b.slot || a.place == b.place) {
            return a.slot < b.slot;
        }
        return lies_right(darts, a.place, darts[a.place] != a.dart, b.place,
                          darts[b.place] != b.dart);
    });
    std::vector<Index> counts(passes.size());
    for (std::size_t k = 0; k < passes.size(); ++k) {
        counts[k] = strand_count(graph_->tail(passes[k].dart), passes[k].dart);
    }
    Index same_edge = 0;
    for (std::size_t k = 0; k < passes.size(); ++k) {
        const Pass& pass = passes[k];
        same_edge = k > 0 && passes[k - 1].dart == pass.dart ? same_edge + 1 : 0;
        const bool forward = darts[pass.place] == pass.dart;
        const Index tail_visit = forward ? pass.place : pass.place + 1;
        const Index head_visit = forward ? pass.place + 1 : pass.place;
        const Index twin = graph_->twin(pass.dart);
        // The passes of this walk inserted before lie to the right, seen from the tail, and to the
        // left, seen from the head.
        insert_end(graph_->tail(pass.dart), pass.dart, pass.slot + same_edge, layout_edge,
                   tail_visit);
        insert_end(graph_->head(pass.dart), twin, counts[k] - pass.slot, layout_edge, head_visit);
    }

    Undo undo;
    undo.extra_count = static_cast<Index>(extra_nodes_.size());
    std::vector<Index> nodes;
    nodes.reserve(darts.size() + 1);
    for (const Index dart : darts) {
        nodes.push_back(graph_->tail(dart));
    }
    nodes.push_back(graph_->head(darts.back()));
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    for (const Index node : nodes) {
        Record& record = touch(node);
        undo.records.push_back({records_of_nodes_[node], record.first_extra});
        update_regions(record);
        record.first_extra = static_cast<Index>(extra_nodes_.size());
        for (Index r = 1; r < record.region_count; ++r) {
            extra_nodes_.push_back(node);
            extra_regions_.push_back(r);
        }
    }
    strands_[layout_edge] = std::move(darts);
    order_.push_back(layout_edge);
    undos_.push_back(std::move(undo));
    return true;
}

void Strands::undo()
{
    const Index layout_edge = order_.back();
    const Undo& undo = undos_.back();
    for (const SavedRecord& saved : undo.records) {
        Record& record = records_[saved.record];
        std::erase_if(record.ends, [&](const End& e) { return e.layout_edge == layout_edge; });
        if (record.ends.empty()) {
            records_of_nodes_[record.node] = kNone;
            free_records_.push_back(saved.record);
        } else {
            record.first_extra = saved.first_extra;
            update_regions(record);
        }
    }
    extra_nodes_.resize(undo.extra_count);
    extra_regions_.resize(undo.extra_count);
    strands_[layout_edge].clear();
    order_.pop_back();
    undos_.pop_back();
}

WeakEmbedding Strands::weak_embedding() const
{
    WeakEmbedding embedding;
    embedding.paths.resize(strands_.size());
    for (Index e = 0; e < strands_.size(); ++e) {
        WeakPath& path = embedding.paths[e];
        path.darts = strands_[e];
        for (Index i = 0; i < path.darts.size(); ++i) {
            const Index tail = graph_->tail(path.darts[i]);
            const Index place = path.darts[i] - graph_->first_dart(tail);
            Index lane = 0;
            for (const End& end : record_at(tail)->ends) {
                if (end.place == place) {
                    if (end.layout_edge == e && end.visit == i) {
                        break;
                    }
                    ++lane;
                }
            }
            path.lanes.push_back(lane);
        }
    }
    return embedding;
}

}  // namespace layout_embedding
