#include "embedding/normal_form.hh"

#include <utility>

namespace layout_embedding {

NormalForm::NormalForm(const TriangleMesh& mesh, Index strand_count)
    : mesh_(&mesh),
      strand_firsts_(strand_count, kNone),
      strand_lasts_(strand_count, kNone),
      edge_firsts_(mesh.edge_count(), kNone),
      edge_lasts_(mesh.edge_count(), kNone),
      edge_counts_(mesh.edge_count(), 0)
{}

Vec3 NormalForm::position(Index id) const
{
    const Element& e = elements_[id];
    if (!e.is_crossing()) {
        return mesh_->position(e.vertex);
    }
    const Index h = mesh_->halfedge(edge(id));
    return (1 - e.parameter) * mesh_->position(mesh_->tail(h)) +
           e.parameter * mesh_->position(mesh_->head(h));
}

double NormalForm::length(Index strand) const
{
    double sum = 0;
    Vec3 here = position(strand_firsts_[strand]);
    for (Index id = elements_[strand_firsts_[strand]].next; id != kNone; id = elements_[id].next) {
        const Vec3 there = position(id);
        sum += (there - here).norm();
        here = there;
    }
    return sum;
}

double NormalForm::total_length() const
{
    double sum = 0;
    for (Index strand = 0; strand < strand_count(); ++strand) {
        sum += length(strand);
    }
    return sum;
}

Index NormalForm::segment_face(Index id) const
{
    const Element& a = elements_[id];
    if (a.is_crossing()) {
        return TriangleMesh::face_of(mesh_->opposite(a.halfedge));
    }
    const Element& b = elements_[a.next];
    return b.is_crossing() ? TriangleMesh::face_of(b.halfedge) : kNone;
}

Index NormalForm::segment_edge(Index id) const
{
    const Element& a = elements_[id];
    const Element& b = elements_[a.next];
    if (a.is_crossing() || b.is_crossing()) {
        return kNone;
    }
    return mesh_->edge_between(a.vertex, b.vertex);
}

Index NormalForm::new_element()
{
    if (unused_.empty()) {
        elements_.emplace_back();
        return element_count() - 1;
    }
    const Index id = unused_.back();
    unused_.pop_back();
    return id;
}

Index NormalForm::add_vertex(Index vertex)
{
    const Index id = new_element();
    elements_[id].vertex = vertex;
    return id;
}

Index NormalForm::add_crossing(Index halfedge)
{
    const Index id = new_element();
    elements_[id].halfedge = halfedge;
    return id;
}

void NormalForm::append_to_strand(Index strand, Index id)
{
    Index& last = strand_lasts_[strand];
    elements_[id].previous = last;
    elements_[id].strand = strand;
    (last == kNone ? strand_firsts_[strand] : elements_[last].next) = id;
    last = id;
}

void NormalForm::append_to_edge(Index crossing)
{
    const Index e = edge(crossing);
    Index& last = edge_lasts_[e];
    elements_[crossing].edge_previous = last;
    (last == kNone ? edge_firsts_[e] : elements_[last].edge_next) = crossing;
    last = crossing;
    ++edge_counts_[e];
}

void NormalForm::erase_crossing(Index crossing)
{
    Element& x = elements_[crossing];
    // Strands start and end at vertices: a crossing has both neighbours along its strand.
    elements_[x.previous].next = x.next;
    elements_[x.next].previous = x.previous;
    const Index e = edge(crossing);
    (x.edge_previous == kNone ? edge_firsts_[e] : elements_[x.edge_previous].edge_next) =
        x.edge_next;
    (x.edge_next == kNone ? edge_lasts_[e] : elements_[x.edge_next].edge_previous) =
        x.edge_previous;
    --edge_counts_[e];
    x = Element{};
    unused_.push_back(crossing);
}

Index NormalForm::snap_to_vertex(Index first, Index last, Index vertex)
{
    const Index strand = elements_[first].strand;
    const Index before = elements_[first].previous;
    const Index after = elements_[last].next;
    for (Index id = first; id != after;) {
        const Index next = elements_[id].next;
        erase_crossing(id);
        id = next;
    }
    const Index id = add_vertex(vertex);
    elements_[id].strand = strand;
    elements_[id].previous = before;
    elements_[id].next = after;
    elements_[before].next = id;
    elements_[after].previous = id;
    return id;
}

void NormalForm::pop_off_vertex(Index id, std::span<const Index> halfedges,
                                std::span<const double> distances)
{
    const Element vertex = elements_[id];
    elements_[id] = Element{};
    unused_.push_back(id);
    Index before = vertex.previous;
    for (std::size_t i = 0; i < halfedges.size(); ++i) {
        const Index h = halfedges[i];
        const Index e = mesh_->edge(h);
        const bool at_tail = mesh_->tail(mesh_->halfedge(e)) == vertex.vertex;
        const Index crossing = add_crossing(h);
        Element& x = elements_[crossing];
        x.strand = vertex.strand;
        x.parameter = at_tail ? distances[i] : 1 - distances[i];
        x.previous = before;
        elements_[before].next = crossing;
        before = crossing;
        if (at_tail) {
            x.edge_next = edge_firsts_[e];
            (x.edge_next == kNone ? edge_lasts_[e] : elements_[x.edge_next].edge_previous) =
                crossing;
            edge_firsts_[e] = crossing;
        } else {
            x.edge_previous = edge_lasts_[e];
            (x.edge_previous == kNone ? edge_firsts_[e] : elements_[x.edge_previous].edge_next) =
                crossing;
            edge_lasts_[e] = crossing;
        }
        ++edge_counts_[e];
    }
    elements_[before].next = vertex.next;
    elements_[vertex.next].previous = before;
}

void NormalForm::reroute(Index strand, std::span<const Index> vertices)
{
    const Index last = strand_lasts_[strand];
    Index id = elements_[strand_firsts_[strand]].next;
    while (id != last) {
        const Index next = elements_[id].next;
        if (elements_[id].is_crossing()) {
            erase_crossing(id);
        } else {
            elements_[id] = Element{};
            unused_.push_back(id);
        }
        id = next;
    }
    Index before = strand_firsts_[strand];
    for (const Index vertex : vertices) {
        const Index added = add_vertex(vertex);
        elements_[added].strand = strand;
        elements_[added].previous = before;
        elements_[before].next = added;
        before = added;
    }
    elements_[before].next = last;
    elements_[last].previous = before;
}

Index NormalForm::remove_bigon(Index id)
{
    // Never runs out of elements: a strand starts at a vertex, which stays.
    while (elements_[id].next != kNone && is_bigon(id, elements_[id].next)) {
        const Index next = elements_[id].next;
        const Index before = elements_[id].previous;
        const bool first_crosses = elements_[id].is_crossing();
        if (elements_[next].is_crossing()) {
            erase_crossing(next);
        }
        if (first_crosses) {
            erase_crossing(id);
            id = before;
        }
    }
    return id;
}

bool NormalForm::is_bigon(Index a, Index b) const
{
    const Element& x = elements_[a];
    const Element& y = elements_[b];
    if (x.is_crossing() && y.is_crossing()) {
        return mesh_->edge(x.halfedge) == mesh_->edge(y.halfedge);
    }
    if (x.is_crossing() == y.is_crossing()) {
        return false;
    }
    const Index vertex = x.is_crossing() ? y.vertex : x.vertex;
    const Index h = x.is_crossing() ? x.halfedge : y.halfedge;
    return mesh_->tail(h) == vertex || mesh_->head(h) == vertex;
}

Index NormalForm::remove_bigons()
{
    Index erased = 0;
    for (Index strand = 0; strand < strand_count(); ++strand) {
        // Everything before `id` is free of bigons.
        Index id = strand_firsts_[strand];
        while (id != kNone && elements_[id].next != kNone) {
            const Index next = elements_[id].next;
            if (!is_bigon(id, next)) {
                id = next;
                continue;
            }
            const Index before = elements_[id].previous;
            const bool first_crosses = elements_[id].is_crossing();
            if (elements_[next].is_crossing()) {
                erase_crossing(next);
                ++erased;
            }
            if (first_crosses) {
                erase_crossing(id);
                ++erased;
                id = before;
            }
        }
    }
    return erased;
}

void NormalForm::compact()
{
    std::vector<Index> new_ids(elements_.size(), kNone);
    std::vector<Element> kept;
    kept.reserve(elements_.size());
    for (Index strand = 0; strand < strand_count(); ++strand) {
        for (Index id = strand_firsts_[strand]; id != kNone; id = elements_[id].next) {
            new_ids[id] = static_cast<Index>(kept.size());
            kept.push_back(elements_[id]);
        }
    }
    const auto renumber = [&](Index& id) {
        if (id != kNone) {
            id = new_ids[id];
        }
    };
    for (Element& e : kept) {
        renumber(e.previous);
        renumber(e.next);
        if (e.is_crossing()) {
            renumber(e.edge_previous);
            renumber(e.edge_next);
            const Index edge = mesh_->edge(e.halfedge);
            const Index self = static_cast<Index>(&e - kept.data());
            if (e.edge_previous == kNone) {
                edge_firsts_[edge] = self;
            }
            if (e.edge_next == kNone) {
                edge_lasts_[edge] = self;
            }
        }
    }
    for (Index strand = 0; strand < strand_count(); ++strand) {
        renumber(strand_firsts_[strand]);
        renumber(strand_lasts_[strand]);
    }
    elements_ = std::move(kept);
    unused_.clear();
}

void NormalForm::spread_evenly()
{
    for (Index start = 0; start < element_count(); ++start) {
        if (!elements_[start].is_crossing() || elements_[start].edge_previous != kNone) {
            continue;
        }
        Index count = 0;
        for (Index id = start; id != kNone; id = elements_[id].edge_next) {
            ++count;
        }
        Index place = 0;
        for (Index id = start; id != kNone; id = elements_[id].edge_next) {
            elements_[id].parameter = ++place / (count + 1.0);
        }
    }
}

}  // namespace layout_embedding
