#include "shapes/editable_mesh.hh"

#include <algorithm>
#include <utility>

namespace layout_embedding::shapes {

EditableMesh::EditableMesh(std::vector<Vec3> vertex_positions, std::vector<Index> corners)
    : positions(std::move(vertex_positions)),
      corners_(std::move(corners)),
      opposites_(corners_.size(), kNone),
      outgoing_(positions.size(), kNone)
{
    std::vector<std::array<Index, 3>> edges;
    edges.reserve(corners_.size());
    for (Index h = 0; h < halfedge_count(); ++h) {
        edges.push_back({std::min(tail(h), head(h)), std::max(tail(h), head(h)), h});
    }
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
        if (edges[i][0] == edges[i + 1][0] && edges[i][1] == edges[i + 1][1]) {
            join(edges[i][2], edges[i + 1][2]);
        }
    }
    for (Index h = 0; h < halfedge_count(); ++h) {
        if (outgoing_[tail(h)] == kNone) {
            anchor(tail(h), h);
            ++live_vertices_;
        }
    }
}

Index EditableMesh::valence(Index v) const
{
    Index count = 0;
    for_neighbors(v, [&](Index) { ++count; });
    return count;
}

void EditableMesh::join(Index a, Index b)
{
    if (a != kNone) {
        opposites_[a] = b;
    }
    if (b != kNone) {
        opposites_[b] = a;
    }
}

/// Makes h, or the first one before it on a boundary, the outgoing halfedge of v.
void EditableMesh::anchor(Index v, Index h)
{
    const Index start = h;
    while (opposites_[h] != kNone) {
        h = next(opposites_[h]);
        if (h == start) {
            break;
        }
    }
    outgoing_[v] = h;
}

bool EditableMesh::adjacent(Index v, Index w) const
{
    bool found = false;
    for_neighbors(v, [&](Index u) { found = found || u == w; });
    return found;
}

Index EditableMesh::split_edge(Index h, const Vec3& position)
{
    const Index m = vertex_count();
    positions.push_back(position);
    outgoing_.push_back(kNone);
    ++live_vertices_;
    const Index b = head(h);
    const Index c = apex(h);
    const Index g = opposites_[h];
    // The half of the face beyond m; h keeps the other.
    const Index f = halfedge_count();
    corners_.insert(corners_.end(), {m, b, c});
    opposites_.insert(opposites_.end(), 3, kNone);
    join(f + 1, opposites_[next(h)]);
    corners_[next(h)] = m;
    join(next(h), f + 2);
    if (g == kNone) {
        opposites_[h] = kNone;
    } else {
        const Index a = tail(h);
        const Index d = apex(g);
        const Index e = halfedge_count();
        corners_.insert(corners_.end(), {m, a, d});
        opposites_.insert(opposites_.end(), 3, kNone);
        join(e + 1, opposites_[next(g)]);
        corners_[next(g)] = m;
        join(next(g), e + 2);
        join(g, f);
        join(h, e);
        anchor(d, previous(g));
        anchor(a, h);
    }
    anchor(m, f);
    anchor(b, f + 1);
    anchor(c, f + 2);
    return m;
}

Index EditableMesh::split_face(Index f, const Vec3& position)
{
    const Index m = vertex_count();
    positions.push_back(position);
    outgoing_.push_back(kNone);
    ++live_vertices_;
    const auto [a, b, c] = face(f);
    const Index second = halfedge_count();
    const Index third = second + 3;
    // (a, b, m), (b, c, m), (c, a, m)
    corners_.insert(corners_.end(), {b, c, m, c, a, m});
    opposites_.insert(opposites_.end(), 6, kNone);
    join(second, opposites_[3 * f + 1]);
    join(third, opposites_[3 * f + 2]);
    corners_[3 * f + 2] = m;
    join(3 * f + 1, second + 2);
    join(second + 1, third + 2);
    join(third + 1, 3 * f + 2);
    anchor(a, 3 * f);
    anchor(b, second);
    anchor(c, third);
    anchor(m, 3 * f + 2);
    return m;
}

bool EditableMesh::can_collapse(Index h) const
{
    const Index a = tail(h);
    const Index b = head(h);
    const Index g = opposites_[h];
    if (is_boundary(a) && g != kNone) {
        return false;
    }
    const auto side_can_go = [&](Index side) {
        const Index c = apex(side);
        if (opposites_[next(side)] == kNone && opposites_[previous(side)] == kNone) {
            return false;
        }
        return valence(c) > 3 || (is_boundary(c) && valence(c) > 2);
    };
    if (!side_can_go(h) || (g != kNone && !side_can_go(g))) {
        return false;
    }
    Index common = 0;
    for_neighbors(a, [&](Index u) { common += u != b && adjacent(b, u) ? 1 : 0; });
    return common == (g == kNone ? 1U : 2U);
}

void EditableMesh::collapse(Index h)
{
    const Index a = tail(h);
    const Index b = head(h);
    const Index c = apex(h);
    const Index g = opposites_[h];
    const Index d = g == kNone ? kNone : apex(g);
    std::vector<Index> around;
    for_outgoing(a, [&](Index x) { around.push_back(x); });
    for (const Index x : around) {
        corners_[x] = b;
    }
    const auto remove_face = [&](Index side) {
        join(opposites_[next(side)], opposites_[previous(side)]);
        corners_[side] = corners_[next(side)] = corners_[previous(side)] = kNone;
        opposites_[side] = opposites_[next(side)] = opposites_[previous(side)] = kNone;
    };
    const Index left = opposites_[next(h)];
    const Index left_other = opposites_[previous(h)];
    const Index right = g == kNone ? kNone : opposites_[next(g)];
    const Index right_other = g == kNone ? kNone : opposites_[previous(g)];
    remove_face(h);
    if (g != kNone) {
        remove_face(g);
    }
    outgoing_[a] = kNone;
    --live_vertices_;
    // Of the faces that stay: left runs c to b, left_other runs b (once a) to c; right d to b (once
    // a), right_other b to d.
    anchor(b, left_other != kNone ? left_other : next(left));
    anchor(c, left != kNone ? left : next(left_other));
    if (d != kNone) {
        anchor(d, right != kNone ? right : next(right_other));
    }
}

bool EditableMesh::can_flip(Index h) const
{
    const Index g = opposites_[h];
    if (g == kNone) {
        return false;
    }
    const auto can_lose = [&](Index v) { return valence(v) > (is_boundary(v) ? 2U : 3U); };
    return can_lose(tail(h)) && can_lose(head(h)) && !adjacent(apex(h), apex(g));
}

void EditableMesh::flip(Index h)
{
    const Index g = opposites_[h];
    const Index a = tail(h);
    const Index b = head(h);
    const Index c = apex(h);
    const Index d = apex(g);
    const Index bc = opposites_[next(h)];
    const Index ca = opposites_[previous(h)];
    const Index ad = opposites_[next(g)];
    const Index db = opposites_[previous(g)];
    // The faces become (d, c, a) at h and (c, d, b) at g.
    corners_[h] = d;
    corners_[next(h)] = c;
    corners_[previous(h)] = a;
    corners_[g] = c;
    corners_[next(g)] = d;
    corners_[previous(g)] = b;
    opposites_[next(h)] = opposites_[previous(h)] = kNone;
    opposites_[next(g)] = opposites_[previous(g)] = kNone;
    join(next(h), ca);
    join(previous(h), ad);
    join(next(g), db);
    join(previous(g), bc);
    join(h, g);
    anchor(a, previous(h));
    anchor(b, previous(g));
    anchor(c, next(h));
    anchor(d, next(g));
}

std::vector<Index> EditableMesh::compact()
{
    std::vector<Index> map(positions.size(), kNone);
    std::vector<Vec3> kept;
    for (Index v = 0; v < vertex_count(); ++v) {
        if (has_vertex(v)) {
            map[v] = static_cast<Index>(kept.size());
            kept.push_back(positions[v]);
        }
    }
    std::vector<Index> corners;
    for (const Index corner : corners_) {
        if (corner != kNone) {
            corners.push_back(map[corner]);
        }
    }
    *this = EditableMesh(std::move(kept), std::move(corners));
    return map;
}

PolygonMesh EditableMesh::polygon_mesh() const
{
    PolygonMesh mesh;
    mesh.positions = positions;
    for (Index f = 0; f < face_count(); ++f) {
        mesh.add_face(face(f));
    }
    return mesh;
}

}  // namespace layout_embedding::shapes
