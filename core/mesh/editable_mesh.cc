#include "mesh/editable_mesh.hh"

#include <algorithm>

namespace layout_embedding {
namespace {

/// From this degree on, common neighbours are looked for around the other vertex.
constexpr Index kManyNeighbours = 64;

}  // namespace

EditableMesh::EditableMesh(const TriangleMesh& mesh)
    : vertex_count_(mesh.vertex_count()),
      corners_(mesh.corners()),
      opposites_(mesh.halfedge_count()),
      outgoing_(mesh.vertex_count()),
      degrees_(mesh.vertex_count(), 0),
      marks_(mesh.vertex_count(), 0)
{
    for (Index h = 0; h < mesh.halfedge_count(); ++h) {
        opposites_[h] = mesh.opposite(h);
        ++degrees_[mesh.tail(h)];
        if (opposites_[h] == kNone) {
            ++degrees_[mesh.head(h)];
        }
    }
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        outgoing_[v] = mesh.outgoing(v);
    }
}

Index EditableMesh::find_halfedge(Index v, Index w) const
{
    Index found = kNone;
    for_each_outgoing(v, [&](Index h) {
        if (head(h) == w) {
            found = h;
        }
    });
    return found;
}

bool EditableMesh::adjacent(Index v, Index w) const
{
    if (degrees_[w] < degrees_[v]) {
        std::swap(v, w);
    }
    bool found = false;
    for_each_neighbour(v, [&](Index u) { found = found || u == w; });
    return found;
}

bool EditableMesh::can_join(Index v, Index w) const
{
    for (const Index hole : holes_) {
        if ((v == hole && !can_touch(w, hole)) || (w == hole && !can_touch(v, hole))) {
            return false;
        }
    }
    return !adjacent(v, w);
}

/// Whether v can become a neighbour of the vertex that stands for a hole.
bool EditableMesh::can_touch(Index v, Index hole) const
{
    return !is_boundary_vertex(v) && std::none_of(holes_.begin(), holes_.end(), [&](Index other) {
        return other == v || (other != hole && adjacent(other, v));
    });
}

/// Whether moving v into w leaves no vertex on two holes: w takes over the holes at v.
bool EditableMesh::keeps_holes_apart(Index v, Index w) const
{
    bool apart = true;
    for (const Index hole : holes_) {
        if (hole == w) {
            for_each_neighbour(v, [&](Index u) {
                apart = apart && (u == w || adjacent(u, hole) || can_touch(u, hole));
            });
        } else if (adjacent(v, hole) && !adjacent(w, hole)) {
            apart = apart && can_touch(w, hole);
        }
    }
    return apart;
}

Index EditableMesh::common_neighbours(Index v, Index w) const
{
    if (degrees_[w] < degrees_[v]) {
        std::swap(v, w);
    }
    Index count = 0;
    if (degrees_[w] >= kManyNeighbours) {
        for_each_neighbour(v, [&](Index u) { count += u != w && adjacent(u, w) ? 1U : 0U; });
        return count;
    }
    if (++mark_ == 0) {
        std::fill(marks_.begin(), marks_.end(), 0U);
        mark_ = 1;
    }
    for_each_neighbour(v, [&](Index u) { marks_[u] = mark_; });
    for_each_neighbour(w, [&](Index u) { count += marks_[u] == mark_ ? 1U : 0U; });
    return count;
}

bool EditableMesh::can_collapse(Index v, Index w) const
{
    if (!keeps_holes_apart(v, w)) {
        return false;
    }
    const Index left = find_halfedge(v, w);
    const Index right = left == kNone ? find_halfedge(w, v) : opposites_[left];
    if (left != kNone && right != kNone) {
        // An inner edge; a tetrahedron is the one closed surface whose condition on vertices
        // alone would let it fold up.
        return !is_boundary_vertex(v) && common_neighbours(v, w) == 2 &&
               !(degrees_[v] == 3 && degrees_[w] == 3 && vertex_count_ == 4 &&
                 !is_boundary_vertex(w));
    }
    const Index h = left != kNone ? left : right;
    const bool lone_triangle = opposites_[next(h)] == kNone && opposites_[previous(h)] == kNone;
    return !lone_triangle && common_neighbours(v, w) == 1;
}

void EditableMesh::glue(Index a, Index b)
{
    if (a != kNone) {
        opposites_[a] = b;
    }
    if (b != kNone) {
        opposites_[b] = a;
    }
}

void EditableMesh::collapse(Index v, Index w)
{
    const Index left = find_halfedge(v, w);
    const Index right = left == kNone ? find_halfedge(w, v) : opposites_[left];
    Index faces = 0;
    // Halfedges at w that stay, one of them to find the first one from.
    Index at_w = kNone;
    degrees_[w] += degrees_[v] - 2;

    for_each_outgoing(v, [&](Index h) { corners_[h] = w; });
    // Each face at the edge folds up: of its two other edges, the one at v becomes that at w.
    for (const Index h : {left, right}) {
        if (h == kNone) {
            continue;
        }
        ++faces;
        const Index apex = corners_[previous(h)];
        // To the apex and from it, seen from outside of the face.
        const Index from_apex = opposites_[next(h)];
        const Index to_apex = opposites_[previous(h)];
        glue(from_apex, to_apex);
        --degrees_[apex];
        if (outgoing_[apex] == previous(h)) {
            outgoing_[apex] = from_apex;
        }
        if (at_w == kNone) {
            at_w = to_apex != kNone ? to_apex : next(from_apex);
        }
    }
    degrees_[w] -= faces;
    for (const Index h : {left, right}) {
        if (h != kNone) {
            const Index f = TriangleMesh::face_of(h);
            for (Index i = 3 * f; i < 3 * f + 3; ++i) {
                corners_[i] = kNone;
                opposites_[i] = kNone;
            }
        }
    }
    outgoing_[v] = kNone;
    degrees_[v] = 0;
    --vertex_count_;
    // Clockwise to the boundary, if there is one.
    Index first = at_w;
    while (opposites_[first] != kNone) {
        first = next(opposites_[first]);
        if (first == at_w) {
            break;
        }
    }
    outgoing_[w] = first;
}

bool EditableMesh::can_flip(Index h) const
{
    const Index twin = opposites_[h];
    if (twin == kNone) {
        return false;
    }
    const Index a = corners_[previous(h)];
    const Index b = corners_[previous(twin)];
    return a != b && can_join(a, b);
}

void EditableMesh::flip(Index h)
{
    const Index twin = opposites_[h];
    const Index v = corners_[h];
    const Index w = corners_[twin];
    const Index a = corners_[previous(h)];
    const Index b = corners_[previous(twin)];
    const Index outside_av = opposites_[previous(h)];
    const Index outside_bw = opposites_[previous(twin)];
    if (outgoing_[v] == h) {
        outgoing_[v] = next(twin);
    }
    if (outgoing_[w] == twin) {
        outgoing_[w] = next(h);
    }
    if (outgoing_[a] == previous(h)) {
        outgoing_[a] = twin;
    }
    if (outgoing_[b] == previous(twin)) {
        outgoing_[b] = h;
    }
    // h becomes b -> w, its face b, w, a; its opposite becomes a -> v, its face a, v, b.
    corners_[h] = b;
    corners_[twin] = a;
    glue(h, outside_bw);
    glue(twin, outside_av);
    glue(previous(h), previous(twin));
    --degrees_[v];
    --degrees_[w];
    ++degrees_[a];
    ++degrees_[b];
}

}  // namespace layout_embedding
