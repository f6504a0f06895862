#include "embedding/vertex_moves.hh"

#include <algorithm>
#include <cmath>

#include "embedding/crossing_room.hh"

namespace layout_embedding {

namespace {

constexpr Index kForbidden = kNone - 1;

}  // namespace

VertexMoves::VertexMoves(NormalForm& form, const std::vector<Index>& landmarks,
                         std::span<const double> edge_costs)
    : form_(form), edge_costs_(edge_costs), carried_(form.mesh().vertex_count(), kNone)
{
    const TriangleMesh& mesh = form.mesh();
    for (Index h = 0; h < mesh.halfedge_count(); ++h) {
        if (mesh.opposite(h) == kNone) {
            carried_[mesh.tail(h)] = kForbidden;
            carried_[mesh.head(h)] = kForbidden;
        }
    }
    for (const Index vertex : landmarks) {
        carried_[vertex] = kForbidden;
    }
    for (Index strand = 0; strand < form.strand_count(); ++strand) {
        for (Index id = form.first(strand); id != kNone; id = form.element(id).next) {
            const Index vertex = form.element(id).vertex;
            if (vertex != kNone && carried_[vertex] == kNone) {
                carried_[vertex] = id;
            }
        }
    }
}

Index VertexMoves::vertex_beside(Index crossing, bool towards_tail) const
{
    const NormalForm::Element& x = form_.element(crossing);
    if ((towards_tail ? x.edge_previous : x.edge_next) != kNone) {
        return kNone;
    }
    const Index h = form_.mesh().halfedge(form_.edge(crossing));
    return towards_tail ? form_.mesh().tail(h) : form_.mesh().head(h);
}

bool VertexMoves::is_beside(Index element, Index vertex) const
{
    return form_.element(element).is_crossing() &&
           (vertex_beside(element, true) == vertex || vertex_beside(element, false) == vertex);
}

Index VertexMoves::snap_run(Index crossing, Index vertex, bool only_if_shorter)
{
    const TriangleMesh& mesh = form_.mesh();
    const Index before = form_.element(crossing).previous;
    const auto crosses_edge_at_vertex = [&](Index id) {
        const NormalForm::Element& x = form_.element(id);
        return x.is_crossing() &&
               (mesh.tail(x.halfedge) == vertex || mesh.head(x.halfedge) == vertex);
    };
    if (crosses_edge_at_vertex(before)) {
        return kNone;
    }
    Index last = crossing;
    Index after = form_.element(last).next;
    Vec3 here = form_.position(crossing);
    double length = (here - form_.position(before)).norm();
    while (is_beside(after, vertex)) {
        last = after;
        after = form_.element(last).next;
        const Vec3 there = form_.position(last);
        length += (there - here).norm();
        here = there;
    }
    if (crosses_edge_at_vertex(after)) {
        return kNone;
    }
    length += (form_.position(after) - here).norm();
    const Vec3& middle = mesh.position(vertex);
    const double shorter =
        (middle - form_.position(before)).norm() + (form_.position(after) - middle).norm();
    if (only_if_shorter && !(shorter < length * (1 - kLeastGain))) {
        return kNone;
    }
    const Index id = form_.snap_to_vertex(crossing, last, vertex);
    carried_[vertex] = id;
    return id;
}

Index VertexMoves::snap(Index crossing)
{
    for (const bool towards_tail : {true, false}) {
        const Index vertex = vertex_beside(crossing, towards_tail);
        if (vertex != kNone && is_free(vertex)) {
            if (const Index id = snap_run(crossing, vertex, true); id != kNone) {
                return id;
            }
        }
    }
    return kNone;
}

Index VertexMoves::snap_to(Index crossing, Index vertex)
{
    if (!is_free(vertex) || !is_beside(crossing, vertex)) {
        return kNone;
    }
    while (is_beside(form_.element(crossing).previous, vertex)) {
        crossing = form_.element(crossing).previous;
    }
    return snap_run(crossing, vertex, false);
}

Index VertexMoves::outgoing_in_face(Index vertex, Index face) const
{
    const Index h = 3 * face;
    return form_.mesh().tail(h) == vertex ? h : form_.mesh().tail(h + 1) == vertex ? h + 1 : h + 2;
}

Index VertexMoves::halfedge_between(Index tail, Index head) const
{
    const TriangleMesh& mesh = form_.mesh();
    const Index start = mesh.outgoing(tail);
    Index h = start;
    do {
        if (mesh.head(h) == head) {
            return h;
        }
        h = mesh.rotated_ccw(h);
    } while (h != start);
    return kNone;
}

void VertexMoves::gather_fan(Index vertex, Index from, Index to, bool left)
{
    const TriangleMesh& mesh = form_.mesh();
    const NormalForm::Element& a = form_.element(from);
    const NormalForm::Element& b = form_.element(to);
    // The face at the vertex that holds a crossing, by its outgoing halfedge, which is the one
    // clockwise of the crossing.
    const auto clockwise_of = [&](const NormalForm::Element& x, bool before_vertex) {
        const Index face =
            TriangleMesh::face_of(before_vertex ? mesh.opposite(x.halfedge) : x.halfedge);
        return outgoing_in_face(vertex, face);
    };
    fan_.clear();
    const Index start =
        a.is_crossing() ? clockwise_of(a, !left) : halfedge_between(vertex, a.vertex);
    const Index end = b.is_crossing() ? clockwise_of(b, left) : halfedge_between(vertex, b.vertex);
    if (start == end && a.is_crossing() && b.is_crossing()) {
        // Both on the edge opposite to the vertex, which runs counter-clockwise around it.
        const bool forward = mesh.halfedge(form_.edge(from)) == TriangleMesh::next(start);
        if ((a.parameter < b.parameter) == forward) {
            return;
        }
    } else if (start == end && b.is_crossing()) {
        return;  // From the edge into the face on its left.
    }
    Index h = mesh.rotated_ccw(start);
    while (h != end) {
        fan_.push_back(h);
        h = mesh.rotated_ccw(h);
    }
    if (b.is_crossing()) {
        fan_.push_back(end);
    }
}

bool VertexMoves::unfold_fan(Index vertex, Index from, Index to)
{
    const TriangleMesh& mesh = form_.mesh();
    const Vec3& centre = mesh.position(vertex);
    rays_.clear();
    Vec3 before = form_.position(from) - centre;
    Vec2 ray{1, 0};
    from_ = {before.norm(), 0};
    const auto turn = [&](const Vec3& arm) {
        const double cosine = before.dot(arm);
        const double sine = before.cross(arm).norm();
        const double size = std::sqrt(cosine * cosine + sine * sine);
        if (!(size > 0)) {
            return false;
        }
        ray = {(ray.x * cosine - ray.y * sine) / size, (ray.x * sine + ray.y * cosine) / size};
        before = arm;
        // Each step turns by at most pi, so a turn beyond pi is seen at once.
        return ray.y > 0 || (ray.y == 0 && ray.x > 0);
    };
    for (const Index h : fan_) {
        if (!turn(mesh.position(mesh.head(h)) - centre)) {
            return false;
        }
        rays_.push_back(ray);
    }
    const Vec3 arm = form_.position(to) - centre;
    if (!turn(arm)) {
        return false;
    }
    to_ = arm.norm() * ray;
    return true;
}

bool VertexMoves::pop_to_side(Index element, bool left, double spacing)
{
    const TriangleMesh& mesh = form_.mesh();
    const NormalForm::Element& e = form_.element(element);
    const Index vertex = e.vertex;
    const Index from = left ? e.next : e.previous;
    const Index to = left ? e.previous : e.next;
    gather_fan(vertex, from, to, left);
    if (!unfold_fan(vertex, from, to)) {
        return false;
    }
    // Where the straight line from one neighbour to the other crosses the fan.
    const Vec2 line = to_ - from_;
    const double numerator = cross(from_, to_);
    distances_.clear();
    least_.clear();
    double scale = 1;
    for (std::size_t i = 0; i < fan_.size(); ++i) {
        const Index h = fan_[i];
        const Index edge = mesh.edge(h);
        const double length = (mesh.position(mesh.head(h)) - mesh.position(vertex)).norm();
        const double distance = numerator / cross(rays_[i], line) / length;
        const double reach = reach_from(vertex, edge);
        const double least = std::min(spacing / (form_.crossing_count(edge) + 2.0), 0.5 * reach);
        if (!(distance >= least)) {
            return false;
        }
        scale = std::min(scale, (reach - least) / distance);
        distances_.push_back(distance);
        least_.push_back(least);
    }
    // Any common share of the distances is shorter than the way over the vertex: lengths are
    // convex.
    double length = 0;
    Vec3 here = form_.position(from);
    for (std::size_t i = 0; i < fan_.size(); ++i) {
        const Index h = fan_[i];
        distances_[i] = std::max(scale * distances_[i], least_[i]);
        const Vec3 there = mesh.position(vertex) +
                           distances_[i] * (mesh.position(mesh.head(h)) - mesh.position(vertex));
        length += (there - here).norm();
        here = there;
    }
    length += (form_.position(to) - here).norm();
    if (fan_.empty()) {
        length *= cost_between(from, to);
    }
    const double over_vertex =
        cost_between(from, element) * (form_.position(from) - mesh.position(vertex)).norm() +
        cost_between(element, to) * (form_.position(to) - mesh.position(vertex)).norm();
    if (!(length < over_vertex * (1 - kLeastGain))) {
        return false;
    }
    leave_vertex(element, left);
    return true;
}

void VertexMoves::leave_vertex(Index element, bool left)
{
    const TriangleMesh& mesh = form_.mesh();
    // A strand that goes counter-clockwise around the vertex leaves the faces right of the edges.
    halfedges_.clear();
    for (const Index h : fan_) {
        halfedges_.push_back(left ? h : mesh.opposite(h));
    }
    if (left) {
        std::reverse(halfedges_.begin(), halfedges_.end());
        std::reverse(distances_.begin(), distances_.end());
    }
    carried_[form_.element(element).vertex] = kNone;
    form_.pop_off_vertex(element, halfedges_, distances_);
}

double VertexMoves::cost_between(Index a, Index b) const
{
    const Index tail = form_.element(a).vertex;
    const Index head = form_.element(b).vertex;
    if (edge_costs_.empty() || tail == kNone || head == kNone) {
        return 1;
    }
    const Index edge = form_.mesh().edge_between(tail, head);
    return edge == kNone ? 1 : edge_costs_[edge];
}

bool VertexMoves::push_off(Index element, bool left)
{
    const NormalForm::Element& e = form_.element(element);
    if (cost_between(e.previous, element) < 1 || cost_between(element, e.next) < 1) {
        return false;
    }
    gather_fan(e.vertex, left ? e.next : e.previous, left ? e.previous : e.next, left);
    if (fan_.empty()) {
        return false;
    }
    distances_.clear();
    for (const Index h : fan_) {
        distances_.push_back(0.5 * reach_from(e.vertex, form_.mesh().edge(h)));
    }
    const Index before = e.previous;
    leave_vertex(element, left);
    form_.remove_bigon(before);
    return true;
}

double VertexMoves::reach_from(Index vertex, Index edge) const
{
    if (form_.mesh().tail(form_.mesh().halfedge(edge)) == vertex) {
        const Index first = form_.first_on_edge(edge);
        return first == kNone ? 1 : form_.element(first).parameter;
    }
    const Index last = form_.last_on_edge(edge);
    return last == kNone ? 1 : 1 - form_.element(last).parameter;
}

Index VertexMoves::pop(Index element, double spacing)
{
    const Index before = form_.element(element).previous;
    if (form_.mesh().is_boundary_vertex(form_.element(element).vertex)) {
        return kNone;  // It is to stay there.
    }
    if (!pop_to_side(element, true, spacing) && !pop_to_side(element, false, spacing)) {
        return kNone;
    }
    return form_.remove_bigon(before);
}

}  // namespace layout_embedding
