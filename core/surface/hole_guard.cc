#include "surface/hole_guard.hh"

#include <numeric>

namespace layout_embedding {

HoleGuard::HoleGuard(const Strands& strands) : strands_(strands)
{
    const Layout& layout = strands.layout();
    const auto loops = layout.boundary_loops();
    layout_loop_count_ = static_cast<Index>(loops.size());
    faces_.resize(2 * std::size_t{layout.edge_count()});
    for (Index h = 0; h < faces_.size(); ++h) {
        faces_[h] = layout.face(h);
    }
    std::vector<Index> loops_of_vertices(layout.vertex_count(), kNone);
    for (Index loop = 0; loop < loops.size(); ++loop) {
        for (const Index h : loops[loop]) {
            faces_[h] = layout.face_count() + loop;
            loops_of_vertices[layout.tail(h)] = loop;
        }
    }

    // The first dart of a boundary node runs along the boundary.
    const PathGraph& graph = strands.graph();
    std::vector<bool> seen(graph.node_count(), false);
    for (Index start = 0; start < graph.node_count(); ++start) {
        if (!graph.is_boundary(start) || seen[start]) {
            continue;
        }
        Hole hole{start, kNone};
        for (Index node = start; !seen[node]; node = graph.head(graph.first_dart(node))) {
            seen[node] = true;
            if (strands.passable()[node]) {
                hole.node = node;
                continue;
            }
            for (Index v = 0; v < layout.vertex_count(); ++v) {
                if (strands.landmark_node(v) == node && loops_of_vertices[v] != kNone) {
                    hole.face = layout.face_count() + loops_of_vertices[v];
                }
            }
        }
        holes_.push_back(hole);
    }
}

std::vector<Index> HoleGuard::edges_around_misplaced_hole() const
{
    if (holes_.empty()) {
        return {};
    }
    const Layout& layout = strands_.layout();
    std::vector<Index> parents(layout.face_count() + layout_loop_count_);
    std::iota(parents.begin(), parents.end(), Index{0});
    const auto find = [&](Index f) {
        while (parents[f] != f) {
            parents[f] = parents[parents[f]];
            f = parents[f];
        }
        return f;
    };
    for (Index e = 0; e < layout.edge_count(); ++e) {
        if (!strands_.is_embedded(e)) {
            parents[find(faces_[2 * e])] = find(faces_[2 * e + 1]);
        }
    }
    std::vector<Index> room(parents.size(), 0);
    for (Index loop = 0; loop < layout_loop_count_; ++loop) {
        ++room[find(layout.face_count() + loop)];
    }
    for (const Hole& hole : holes_) {
        Index face = hole.face;
        if (face == kNone) {
            const Index h = bordering_halfedge(hole.node);
            if (h == kNone) {
                continue;
            }
            face = faces_[h];
        }
        if (room[find(face)]-- == 0) {
            std::vector<Index> edges;
            for (Index h = 0; h < faces_.size(); ++h) {
                const Index e = Layout::edge(h);
                if (strands_.is_embedded(e) && find(faces_[h]) == find(face) &&
                    (edges.empty() || edges.back() != e)) {
                    edges.push_back(e);
                }
            }
            return edges;
        }
    }
    return {};
}

Index HoleGuard::bordering_halfedge(Index boundary_node) const
{
    const PathGraph& graph = strands_.graph();
    // The hole lies before the first slot of the node's first dart.
    const Index first = graph.first_dart(boundary_node);
    std::vector<bool> seen(strands_.state_bound(), false);
    std::vector<Index> stack{
        strands_.state(boundary_node, strands_.region(boundary_node, first, 0))};
    seen[stack.back()] = true;
    while (!stack.empty()) {
        const Index state = stack.back();
        stack.pop_back();
        const Index border = strands_.bordering_halfedge(state);
        if (border != kNone) {
            return border;
        }
        // Nothing borders this region, so that it is all of its node's disk.
        const Index node = strands_.node_of_state(state);
        for (Index d = graph.first_dart(node); d < graph.first_dart(node + 1); ++d) {
            const Index head = graph.head(d);
            if (!strands_.passable()[head]) {
                continue;
            }
            const Index next = strands_.state(head, strands_.region(head, graph.twin(d), 0));
            if (!seen[next]) {
                seen[next] = true;
                stack.push_back(next);
            }
        }
    }
    return kNone;
}

}  // namespace layout_embedding
