#include "layout/layout.hh"

#include "mesh/polygon_halfedges.hh"
#include "mesh/validation.hh"

namespace layout_embedding {

Result<Layout> Layout::from_polygons(const PolygonMesh& mesh, std::string_view subject)
{
    if (Status status = check_surface(mesh, SurfaceKind::layout, subject); !status) {
        return status.error();
    }
    const PolygonHalfedges corners(mesh);
    Layout layout;

    // Edges are numbered and directed by the first corner that runs along them.
    std::vector<Index> halfedge_of_corner(corners.count(), kNone);
    for (Index c = 0; c < corners.count(); ++c) {
        if (halfedge_of_corner[c] != kNone) {
            continue;
        }
        const Index h = static_cast<Index>(layout.tails_.size());
        const Index opposite = corners.opposite(c);
        halfedge_of_corner[c] = h;
        layout.tails_.push_back(corners.tail(c));
        layout.tails_.push_back(corners.head(c));
        layout.faces_.push_back(corners.face(c));
        layout.faces_.push_back(opposite == kNone ? kNone : corners.face(opposite));
        if (opposite != kNone) {
            halfedge_of_corner[opposite] = twin(h);
        }
    }
    layout.face_offsets_ = mesh.face_offsets;
    layout.face_halfedges_ = halfedge_of_corner;

    // Per vertex the corner to start from: the one right after the gap, else the first.
    std::vector<Index> first(mesh.vertex_count(), kNone);
    for (Index c = 0; c < corners.count(); ++c) {
        Index& corner = first[corners.tail(c)];
        if (corner == kNone || corners.opposite(c) == kNone) {
            corner = c;
        }
    }
    layout.outgoing_offsets_.push_back(0);
    layout.ranks_.resize(layout.tails_.size());
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        const auto append = [&](Index h) {
            layout.ranks_[h] =
                static_cast<Index>(layout.outgoing_.size()) - layout.outgoing_offsets_[v];
            layout.outgoing_.push_back(h);
        };
        Index c = first[v];
        do {
            append(halfedge_of_corner[c]);
            const Index incoming = corners.previous(c);
            c = corners.opposite(incoming);
            if (c == kNone) {
                append(twin(halfedge_of_corner[incoming]));
            }
        } while (c != kNone && c != first[v]);
        layout.outgoing_offsets_.push_back(static_cast<Index>(layout.outgoing_.size()));
    }
    return layout;
}

bool Layout::is_boundary_vertex(Index v) const
{
    return face(outgoing(v).back()) == kNone;
}

std::vector<std::vector<Index>> Layout::boundary_loops() const
{
    std::vector<std::vector<Index>> loops;
    std::vector<bool> seen(tails_.size(), false);
    for (Index start = 0; start < tails_.size(); ++start) {
        if (face(start) != kNone || seen[start]) {
            continue;
        }
        loops.emplace_back();
        // The last halfedge around a boundary vertex has the hole on its left.
        for (Index h = start; !seen[h]; h = outgoing(head(h)).back()) {
            seen[h] = true;
            loops.back().push_back(h);
        }
    }
    return loops;
}

}  // namespace layout_embedding
