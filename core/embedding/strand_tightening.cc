#include "embedding/strand_tightening.hh"

#include <cmath>

namespace layout_embedding {

namespace {

/// Where `point` lies relative to the edge from `tail` to `head`: along it and away from it.
struct Offset {
    double along;
    double away;
};

Offset offset_of(const Vec3& tail, const Vec3& head, const Vec3& point)
{
    const Vec3 edge = head - tail;
    const Vec3 to_point = point - tail;
    const double length = edge.norm();
    // An edge without length has no direction.
    return length > 0 ? Offset{edge.dot(to_point) / length, edge.cross(to_point).norm() / length}
                      : Offset{0, to_point.norm()};
}

Vec2 direction(Vec2 from, Vec2 to)
{
    const Vec2 d = to - from;
    const double length = std::sqrt(dot(d, d));
    return length > 0 ? (1 / length) * d : Vec2{1, 0};
}

bool runs_backwards(const TriangleMesh& mesh, Index halfedge)
{
    return mesh.halfedge(mesh.edge(halfedge)) != halfedge;
}

}  // namespace

void StrandTightening::unfold(const NormalForm& form, Index from, Index to,
                              const CrossingGaps& gaps)
{
    const TriangleMesh& mesh = form.mesh();
    edges_.clear();
    portals_.clear();
    Index id = form.element(from).next;
    const Index first = form.element(id).halfedge;
    const Vec3& start = mesh.position(form.element(from).vertex);
    // The start is the origin, the first edge's tail lies on the x axis.
    Vec2 tail{(mesh.position(mesh.tail(first)) - start).norm(), 0};
    const Offset at =
        offset_of(start, mesh.position(mesh.tail(first)), mesh.position(mesh.head(first)));
    Vec2 head{at.along, at.away};
    for (;;) {
        const Index h = form.element(id).halfedge;
        const auto [low_gap, high_gap] = gaps.around(form, id);
        const Room room = room_of(form, id, low_gap, high_gap);
        const bool backwards = runs_backwards(mesh, h);
        const UnfoldedEdge edge{tail, head, id, backwards ? 1 - room.high : room.low,
                                backwards ? 1 - room.low : room.high};
        edges_.push_back(edge);
        portals_.push_back({tail + edge.high * (head - tail), tail + edge.low * (head - tail)});

        // The next face lies on the right of h.
        const Index into = mesh.opposite(h);
        const Index third = TriangleMesh::next(into);
        const Offset offset = offset_of(mesh.position(mesh.tail(h)), mesh.position(mesh.head(h)),
                                        mesh.position(mesh.head(third)));
        const Vec2 u = direction(tail, head);
        const Vec2 apex = tail + offset.along * u + offset.away * Vec2{u.y, -u.x};
        id = form.element(id).next;
        if (id == to) {
            end_ = apex;
            return;
        }
        // `into` runs from the head of h to its tail, `third` on to the apex.
        if (form.element(id).halfedge == third) {
            head = apex;
        } else {
            tail = apex;
        }
    }
}

void StrandTightening::place(NormalForm& form, std::span<const Bend> bends)
{
    Vec2 from{0, 0};
    Index next = 0;
    for (std::size_t b = 0; b <= bends.size(); ++b) {
        const Vec2 to = b < bends.size() ? bends[b].point : end_;
        const Index last =
            b < bends.size() ? bends[b].portal : static_cast<Index>(edges_.size()) - 1;
        const Vec2 line = to - from;
        for (; next <= last && next < edges_.size(); ++next) {
            const UnfoldedEdge& edge = edges_[next];
            double t = cross(from - edge.tail, line) / cross(edge.head - edge.tail, line);
            // Also where the line runs along the edge.
            t = t >= edge.low ? t : edge.low;
            t = t <= edge.high ? t : edge.high;
            const Index h = form.element(edge.crossing).halfedge;
            form.set_parameter(edge.crossing, runs_backwards(form.mesh(), h) ? 1 - t : t);
        }
        from = to;
    }
}

void StrandTightening::tighten(NormalForm& form, Index strand, const CrossingGaps& gaps)
{
    Index from = form.first(strand);
    while (form.element(from).next != kNone) {
        Index to = form.element(from).next;
        if (form.element(to).is_crossing()) {
            while (form.element(to).is_crossing()) {
                to = form.element(to).next;
            }
            unfold(form, from, to, gaps);
            place(form, funnel_.shortest_path({0, 0}, portals_, end_));
        }
        from = to;
    }
}

}  // namespace layout_embedding
