#include "embedding/checker_chains.hh"

namespace layout_embedding::checker {

bool check_landmarks(const Surface& layout, const Surface& target,
                     const std::vector<Index>& landmarks, Violations& violations)
{
    if (layout.euler_characteristic() != target.euler_characteristic()) {
        violations.add("topologyMismatch", "Layout and target differ in genus.");
    }
    if (target.cap_count != 0 && target.cap_count != layout.cap_count) {
        violations.add("topologyMismatch", "The target has ", target.cap_count,
                       " holes and the layout ", layout.cap_count, " boundary loops.");
    }
    if (landmarks.size() != layout.vertex_count) {
        violations.add("landmarkCount", "There are ", static_cast<Index>(landmarks.size()),
                       " landmarks for ", layout.vertex_count, " layout vertices.");
        return false;
    }
    bool usable = true;
    std::vector<Index> layout_vertices(target.vertex_count, kNone);
    for (Index v = 0; v < layout.vertex_count; ++v) {
        const Index landmark = landmarks[v];
        if (landmark >= target.vertex_count) {
            violations.add("landmarkOutOfRange", "The landmark of layout vertex ", v, " is vertex ",
                           landmark, ", which the target does not have.");
            usable = false;
            continue;
        }
        if (layout_vertices[landmark] != kNone) {
            violations.add("duplicateLandmark", "The layout vertices ", layout_vertices[landmark],
                           " and ", v, " have the same landmark ", landmark, ".");
            usable = false;
        }
        layout_vertices[landmark] = v;
        if (target.is_boundary_vertex(landmark) && !layout.is_boundary_vertex(v)) {
            violations.add("landmarkOnBoundary", "The landmark ", landmark,
                           " of the inner layout vertex ", v, " is on the boundary of the target.");
        }
    }
    return usable;
}

namespace {

class ChainCheck {
public:
    ChainCheck(const Surface& layout, const std::vector<Index>& landmarks,
               const std::vector<std::array<Index, 2>>& layout_edges, const RefinedMesh& refined,
               const Surface& surface, Violations& violations, std::vector<Index>& chain_halfedges)
        : layout_(layout),
          landmarks_(landmarks),
          layout_edges_(layout_edges),
          chains_(refined.chains),
          surface_(surface),
          violations_(violations),
          chain_halfedges_(chain_halfedges)
    {}

    bool run()
    {
        const std::size_t before = violations_.total();
        if (layout_edges_.size() != chains_.size()) {
            violations_.add("sizeMismatch", "There are ", static_cast<Index>(chains_.size()),
                            " chains but layout edges for ",
                            static_cast<Index>(layout_edges_.size()), " of them.");
            return false;
        }
        owners_.assign(surface_.vertex_count, kNone);
        layout_vertices_.assign(surface_.vertex_count, kNone);
        for (Index v = 0; v < layout_.vertex_count; ++v) {
            layout_vertices_[landmarks_[v]] = v;
        }
        chain_halfedges_.assign(surface_.halfedge_count(), kNone);
        std::vector<Index> chain_of_edge(layout_.halfedge_count(), kNone);
        for (Index c = 0; c < chains_.size(); ++c) {
            const Index h = layout_halfedge(c);
            if (h == kNone) {
                continue;
            }
            Index& known = chain_of_edge[layout_.edge(h)];
            if (known != kNone) {
                violations_.add("chainDuplicate", "The chains ", known, " and ", c,
                                " both belong to ", name(h), ".");
            }
            known = c;
            trace(c, h);
        }
        for (Index h = 0; h < layout_.corner_count; ++h) {
            if (layout_.edge(h) == h && chain_of_edge[h] == kNone) {
                violations_.add("chainMissing", "There is no chain for ", name(h), ".");
            }
        }
        return violations_.total() == before;
    }

private:
    std::string name(Index h) const
    {
        return "the layout edge " + std::to_string(layout_.tails[h]) + "-" +
               std::to_string(layout_.head(h));
    }

    Index layout_halfedge(Index c)
    {
        const auto [tail, head] = layout_edges_[c];
        const Index h = tail < layout_.vertex_count && head < layout_.vertex_count
                            ? layout_.find(tail, head)
                            : kNone;
        if (h == kNone) {
            violations_.add("layoutEdgeUnknown", "Chain ", c, " is for the layout edge ", tail, "-",
                            head, ", which does not exist.");
        }
        return h;
    }

    /// Follows chain c of layout halfedge h until its end or the first thing wrong with it.
    void trace(Index c, Index h)
    {
        const std::vector<Index>& chain = chains_[c];
        const Index start = landmarks_[layout_.tails[h]];
        const Index end = landmarks_[layout_.head(h)];
        for (const Index v : chain) {
            if (v >= surface_.vertex_count) {
                violations_.add("indexOutOfRange", "Chain ", c, " names vertex ", v,
                                ", which does not exist.");
                return;
            }
        }
        if (chain.size() < 2 || chain.front() != start || chain.back() != end) {
            violations_.add("chainWrongEnd", "Chain ", c, " does not run from vertex ", start,
                            " to vertex ", end, ", the landmarks of ", name(h), ".");
            return;
        }
        for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
            const Index v = chain[i];
            if (i > 0 && !enter(c, v)) {
                return;
            }
            const Index along = surface_.find(v, chain[i + 1]);
            if (along == kNone) {
                violations_.add("chainOffMesh", "Chain ", c, " steps from vertex ", v,
                                " to vertex ", chain[i + 1],
                                ", which no edge of the refined mesh joins.");
                return;
            }
            const Index known = chain_halfedges_[along];
            if (known != kNone) {
                violations_.add(
                    layout_.edge(known) == layout_.edge(h) ? "chainTouchesItself" : "chainsMeet",
                    "Chain ", c, " runs along the edge ", v, "-", chain[i + 1],
                    ", which is taken by the chain of ", name(known), ".");
                return;
            }
            chain_halfedges_[along] = h;
            chain_halfedges_[surface_.twins[along]] = layout_.twins[h];
        }
    }

    /// Enters an inner vertex v of chain c.
    bool enter(Index c, Index v)
    {
        if (layout_vertices_[v] != kNone) {
            violations_.add("chainThroughLandmark", "Chain ", c, " passes vertex ", v,
                            ", the landmark of layout vertex ", layout_vertices_[v], ".");
        } else if (owners_[v] == c) {
            violations_.add("chainTouchesItself", "Chain ", c, " passes vertex ", v, " twice.");
        } else if (owners_[v] != kNone) {
            violations_.add("chainsMeet", "The chains ", owners_[v], " and ", c,
                            " both pass vertex ", v, ".");
        } else {
            owners_[v] = c;
            return true;
        }
        return false;
    }

    const Surface& layout_;
    const std::vector<Index>& landmarks_;
    const std::vector<std::array<Index, 2>>& layout_edges_;
    const std::vector<std::vector<Index>>& chains_;
    const Surface& surface_;
    Violations& violations_;
    std::vector<Index>& chain_halfedges_;
    std::vector<Index> owners_;           // per refined vertex, the chain inside which it lies
    std::vector<Index> layout_vertices_;  // per refined vertex, kNone where it is no landmark
};

}  // namespace

bool check_chains(const Surface& layout, const std::vector<Index>& landmarks,
                  const std::vector<std::array<Index, 2>>& layout_edges, const RefinedMesh& refined,
                  const Surface& surface, Violations& violations,
                  std::vector<Index>& chain_halfedges)
{
    return ChainCheck(layout, landmarks, layout_edges, refined, surface, violations,
                      chain_halfedges)
        .run();
}

void check_orders(const Surface& layout, const std::vector<Index>& landmarks,
                  const Surface& surface, const std::vector<Index>& chain_halfedges,
                  Violations& violations)
{
    for (Index v = 0; v < layout.vertex_count; ++v) {
        // The chains clockwise around the landmark, on a boundary starting at the hole.
        Index first = kNone;
        Index last = kNone;
        bool ordered = true;
        const Index start = surface.outgoing[landmarks[v]];
        Index h = start;
        do {
            const Index chain = chain_halfedges[h];
            if (chain != kNone) {
                if (first == kNone) {
                    first = chain;
                } else if (layout.clockwise(last) != chain) {
                    ordered = false;
                }
                last = chain;
            }
            h = surface.clockwise(h);
        } while (h != start);
        if (first == kNone || !ordered || layout.clockwise(last) != first) {
            violations.add("cyclicOrder", "The chains at vertex ", landmarks[v],
                           " do not follow the cyclic order of layout vertex ", v, ".");
        } else if (surface.is_boundary_vertex(landmarks[v]) && first != layout.outgoing[v]) {
            violations.add("boundaryOrder", "The hole at vertex ", landmarks[v],
                           " is not between the chains where layout vertex ", v,
                           " has the boundary.");
        }
    }
}

namespace {

/// A component of the refined mesh, holes capped, cut along the chains.
struct Patch {
    long long euler_characteristic = 0;
    Index caps = 0;
    Index loops = 0;
    /// A layout halfedge on its boundary.
    Index layout_halfedge = kNone;
    bool follows_layout = true;
    /// One of its triangles, for messages.
    Index triangle = kNone;
};

class PatchCheck {
public:
    PatchCheck(const Surface& layout, const std::vector<Index>& landmarks,
               const RefinedMesh& refined, const Surface& surface,
               const std::vector<Index>& chain_halfedges, Violations& violations)
        : layout_(layout),
          landmarks_(landmarks),
          refined_(refined),
          surface_(surface),
          chain_halfedges_(chain_halfedges),
          violations_(violations)
    {}

    void run()
    {
        flood();
        count_elements();
        walk_boundaries();
        for (const Patch& patch : patches_) {
            judge(patch);
        }
        for (Index t = 0; t < surface_.polygon_count; ++t) {
            const Patch& patch = patches_[patch_of_face_[t]];
            if (patch.layout_halfedge == kNone) {
                continue;
            }
            const Index layout_face = layout_.faces[patch.layout_halfedge];
            const Index expected = layout_.is_cap(layout_face) ? kNone : layout_face;
            if (refined_.triangle_patches[t] != expected) {
                if (expected == kNone) {
                    violations_.add("patchIds", "Refined triangle ", t,
                                    " is outside the layout but has patch ",
                                    refined_.triangle_patches[t], ".");
                } else {
                    violations_.add("patchIds", "Refined triangle ", t, " has another patch than ",
                                    expected, ", the layout face around it.");
                }
            }
        }
    }

private:
    bool cut(Index h) const { return chain_halfedges_[h] != kNone; }
    Patch& patch_left_of(Index h) { return patches_[patch_of_face_[surface_.faces[h]]]; }

    void flood()
    {
        patch_of_face_.assign(surface_.face_halfedges.size(), kNone);
        std::vector<Index> stack;
        for (Index seed = 0; seed < patch_of_face_.size(); ++seed) {
            if (patch_of_face_[seed] != kNone) {
                continue;
            }
            const Index id = static_cast<Index>(patches_.size());
            Patch& patch = patches_.emplace_back();
            patch_of_face_[seed] = id;
            stack.push_back(seed);
            while (!stack.empty()) {
                const Index face = stack.back();
                stack.pop_back();
                patch.euler_characteristic += 1;
                if (surface_.is_cap(face)) {
                    ++patch.caps;
                } else {
                    patch.triangle = face;
                }
                const Index start = surface_.face_halfedges[face];
                Index h = start;
                do {
                    Index& neighbor = patch_of_face_[surface_.faces[surface_.twins[h]]];
                    if (!cut(h) && neighbor == kNone) {
                        neighbor = id;
                        stack.push_back(surface_.faces[surface_.twins[h]]);
                    }
                    h = surface_.nexts[h];
                } while (h != start);
            }
        }
    }

    /// Boundary circles add nothing to the Euler characteristic, so only the elements inside count.
    void count_elements()
    {
        std::vector<bool> on_chain(surface_.vertex_count, false);
        for (Index h = 0; h < surface_.halfedge_count(); ++h) {
            if (cut(h)) {
                on_chain[surface_.tails[h]] = true;
            } else if (surface_.edge(h) == h) {
                patch_left_of(h).euler_characteristic -= 1;
            }
        }
        for (Index v = 0; v < surface_.vertex_count; ++v) {
            if (!on_chain[v]) {
                patch_left_of(surface_.outgoing[v]).euler_characteristic += 1;
            }
        }
    }

    void walk_boundaries()
    {
        std::vector<bool> seen(surface_.halfedge_count(), false);
        for (Index start = 0; start < surface_.halfedge_count(); ++start) {
            if (!cut(start) || seen[start]) {
                continue;
            }
            Patch& patch = patch_left_of(start);
            ++patch.loops;
            for (Index h = start; !seen[h];) {
                seen[h] = true;
                Index next = surface_.nexts[h];
                while (!cut(next)) {
                    next = surface_.clockwise(next);
                }
                const Index here = chain_halfedges_[h];
                const Index there = chain_halfedges_[next];
                // Another layout edge begins at each landmark and nowhere else.
                const bool at_landmark = surface_.tails[next] == landmarks_[layout_.tails[there]];
                if ((at_landmark ? layout_.nexts[here] : here) != there) {
                    patch.follows_layout = false;
                }
                patch.layout_halfedge = here;
                h = next;
            }
        }
    }

    void judge(const Patch& patch)
    {
        const std::string where = "The patch around refined triangle " +
                                  (patch.triangle == kNone ? "(none, a hole without a triangle)"
                                                           : std::to_string(patch.triangle));
        if (patch.loops != 1 || patch.euler_characteristic != 1) {
            violations_.add("patchNotDisk", where, " is not a disk: it has ", patch.loops,
                            " boundary loops and Euler characteristic ",
                            std::to_string(patch.euler_characteristic), ", holes filled.");
            return;
        }
        if (!patch.follows_layout) {
            violations_.add("patchBoundary", where,
                            " is not bounded by the edges of a layout face in their order.");
            return;
        }
        const Index layout_face = layout_.faces[patch.layout_halfedge];
        if (!layout_.is_cap(layout_face)) {
            if (patch.caps != 0) {
                violations_.add("holeInPatch", where, ", which is layout face ", layout_face,
                                ", holds a hole of the target.");
            }
        } else if (surface_.cap_count != 0 && patch.caps != 1) {
            violations_.add("holeCount", where, ", which is outside the layout, holds ", patch.caps,
                            " holes of the target instead of one.");
        }
    }

    const Surface& layout_;
    const std::vector<Index>& landmarks_;
    const RefinedMesh& refined_;
    const Surface& surface_;
    const std::vector<Index>& chain_halfedges_;
    Violations& violations_;
    std::vector<Patch> patches_;
    std::vector<Index> patch_of_face_;  // per face of the refined mesh, caps included
};

}  // namespace

void check_patches(const Surface& layout, const std::vector<Index>& landmarks,
                   const RefinedMesh& refined, const Surface& surface,
                   const std::vector<Index>& chain_halfedges, Violations& violations)
{
    PatchCheck(layout, landmarks, refined, surface, chain_halfedges, violations).run();
}

}  // namespace layout_embedding::checker
