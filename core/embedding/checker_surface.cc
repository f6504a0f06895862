#include "embedding/checker_surface.hh"

#include <algorithm>

namespace layout_embedding::checker {

bool Violations::count(std::string_view code)
{
    ++total_;
    for (auto& [known, number] : counts_) {
        if (known == code) {
            return ++number <= kMaxViolationsPerCode;
        }
    }
    counts_.emplace_back(code, 1);
    return true;
}

Index Surface::find(Index a, Index b) const
{
    Index from_a = outgoing[a];
    Index from_b = outgoing[b];
    do {
        if (head(from_a) == b) {
            return from_a;
        }
        if (head(from_b) == a) {
            return twins[from_b];
        }
        from_a = clockwise(from_a);
        from_b = clockwise(from_b);
    } while (from_a != outgoing[a] && from_b != outgoing[b]);
    return kNone;
}

namespace {

/// Ids are 32-bit and boundary halfedges double the edges at most.
constexpr std::size_t kMaxCorners = kNone / 4;

class Builder {
public:
    Builder(Index vertex_count, std::span<const Index> face_offsets, std::span<const Index> corners,
            std::string_view code, std::string_view subject, Violations& violations,
            Surface& surface)
        : offsets_(face_offsets),
          corners_(corners),
          code_(code),
          subject_(subject),
          violations_(violations),
          before_(violations.total()),
          surface_(surface)
    {
        surface_.vertex_count = vertex_count;
    }

    bool build()
    {
        return arrays_make_sense() && fill_polygons() && pair_halfedges() && fill_caps() &&
               one_fan_per_vertex() && connected();
    }

private:
    template <typename... Parts>
    void refuse(const Parts&... parts)
    {
        violations_.add(code_, subject_, parts...);
    }
    bool good() const { return violations_.total() == before_; }

    bool arrays_make_sense()
    {
        if (offsets_.size() < 2) {
            refuse(" has no faces.");
        } else if (corners_.size() > kMaxCorners || offsets_.size() > kMaxCorners ||
                   surface_.vertex_count > kMaxCorners) {
            refuse(" is too large.");
        } else if (offsets_.front() != 0 || offsets_.back() != corners_.size() ||
                   !std::is_sorted(offsets_.begin(), offsets_.end())) {
            refuse(" has face offsets that do not fit its corners.");
        }
        return good();
    }

    bool fill_polygons()
    {
        Surface& s = surface_;
        s.polygon_count = static_cast<Index>(offsets_.size() - 1);
        s.corner_count = static_cast<Index>(corners_.size());
        s.tails.assign(corners_.begin(), corners_.end());
        s.nexts.resize(s.corner_count);
        s.faces.resize(s.corner_count);
        s.face_halfedges.assign(offsets_.begin(), offsets_.end() - 1);
        std::vector<Index> seen_in(s.vertex_count, kNone);
        for (Index f = 0; f < s.polygon_count; ++f) {
            const Index size = offsets_[f + 1] - offsets_[f];
            if (size < 3) {
                refuse(" has fewer than three corners in face ", f, ".");
            }
            for (Index h = offsets_[f]; h < offsets_[f + 1]; ++h) {
                s.faces[h] = f;
                s.nexts[h] = h + 1 == offsets_[f + 1] ? offsets_[f] : h + 1;
                const Index v = s.tails[h];
                if (v >= s.vertex_count) {
                    refuse(" has a corner in face ", f, " that names vertex ", v, " of only ",
                           s.vertex_count, ".");
                } else if (v == corners_[s.nexts[h]]) {
                    refuse(" has vertex ", v, " twice in a row in face ", f, ".");
                } else if (size == 3 && seen_in[v] == f) {
                    // Larger faces may: an edge that hangs into a layout's face is met from both
                    // sides.
                    refuse(" has vertex ", v, " twice in face ", f, ".");
                } else {
                    seen_in[v] = f;
                }
            }
        }
        return good();
    }

    bool pair_halfedges()
    {
        Surface& s = surface_;
        const auto ends = [&](Index h) { return std::minmax(s.tails[h], s.tails[s.nexts[h]]); };
        // The halfedges of one edge become neighbours: bucketed by the smaller of their ends,
        // sorted by the larger one.
        std::vector<Index> begin(s.vertex_count + 1, 0);
        for (Index h = 0; h < s.corner_count; ++h) {
            ++begin[ends(h).first + 1];
        }
        for (Index v = 0; v < s.vertex_count; ++v) {
            begin[v + 1] += begin[v];
        }
        std::vector<Index> order(s.corner_count);
        {
            std::vector<Index> place(begin.begin(), begin.end() - 1);
            for (Index h = 0; h < s.corner_count; ++h) {
                order[place[ends(h).first]++] = h;
            }
        }
        for (Index v = 0; v < s.vertex_count; ++v) {
            std::sort(order.begin() + begin[v], order.begin() + begin[v + 1],
                      [&](Index a, Index b) {
                          const Index head_a = ends(a).second;
                          const Index head_b = ends(b).second;
                          return head_a != head_b ? head_a < head_b : a < b;
                      });
        }
        s.twins.assign(s.corner_count, kNone);
        for (Index first = 0; first < s.corner_count;) {
            Index last = first + 1;
            while (last < s.corner_count && ends(order[last]) == ends(order[first])) {
                ++last;
            }
            const Index a = order[first];
            if (last - first > 2) {
                refuse(" has more than two faces at the edge ", ends(a).first, "-", ends(a).second,
                       ".");
            } else if (last - first == 2) {
                const Index b = order[first + 1];
                if (s.tails[a] == s.tails[b]) {
                    refuse(" has two faces that run the same way along the edge ", ends(a).first,
                           "-", ends(a).second, ".");
                }
                s.twins[a] = b;
                s.twins[b] = a;
            }
            first = last;
        }
        return good();
    }

    bool fill_caps()
    {
        Surface& s = surface_;
        s.outgoing.assign(s.vertex_count, kNone);
        for (Index h = 0; h < s.corner_count; ++h) {
            s.outgoing[s.tails[h]] = h;
        }
        for (Index v = 0; v < s.vertex_count; ++v) {
            if (s.outgoing[v] == kNone) {
                refuse(" has vertex ", v, " in no face.");
            }
        }
        for (Index h = 0; h < s.corner_count; ++h) {
            if (s.twins[h] != kNone) {
                continue;
            }
            const Index v = s.tails[s.nexts[h]];
            if (s.outgoing[v] >= s.corner_count && s.outgoing[v] != kNone) {
                refuse(" has vertex ", v, " on the boundary more than once.");
                continue;
            }
            s.twins[h] = s.halfedge_count();
            s.outgoing[v] = s.halfedge_count();
            s.tails.push_back(v);
            s.twins.push_back(h);
        }
        if (!good()) {
            return false;
        }
        // A boundary halfedge is followed by the one that starts at its head. There is one: the
        // fan of faces around a boundary vertex has two ends.
        s.nexts.resize(s.tails.size(), kNone);
        s.faces.resize(s.tails.size(), kNone);
        for (Index h = s.corner_count; h < s.halfedge_count(); ++h) {
            s.nexts[h] = s.outgoing[s.head(h)];
        }
        for (Index start = s.corner_count; start < s.halfedge_count(); ++start) {
            if (s.faces[start] != kNone) {
                continue;
            }
            const Index cap = s.polygon_count + s.cap_count++;
            s.face_halfedges.push_back(start);
            for (Index h = start; s.faces[h] == kNone; h = s.nexts[h]) {
                s.faces[h] = cap;
            }
        }
        return true;
    }

    bool one_fan_per_vertex()
    {
        Surface& s = surface_;
        std::vector<bool> reached(s.halfedge_count(), false);
        for (Index v = 0; v < s.vertex_count; ++v) {
            for (Index h = s.outgoing[v]; !reached[h]; h = s.clockwise(h)) {
                reached[h] = true;
            }
        }
        for (Index h = 0; h < s.halfedge_count(); ++h) {
            if (!reached[h]) {
                refuse(" has several fans of faces at vertex ", s.tails[h], ".");
            }
        }
        return good();
    }

    bool connected()
    {
        Surface& s = surface_;
        std::vector<bool> reached(s.face_halfedges.size(), false);
        std::vector<Index> stack{0};
        reached[0] = true;
        std::size_t count = 0;
        while (!stack.empty()) {
            const Index start = s.face_halfedges[stack.back()];
            stack.pop_back();
            ++count;
            Index h = start;
            do {
                const Index neighbor = s.faces[s.twins[h]];
                if (!reached[neighbor]) {
                    reached[neighbor] = true;
                    stack.push_back(neighbor);
                }
                h = s.nexts[h];
            } while (h != start);
        }
        if (count != s.face_halfedges.size()) {
            refuse(" has several components.");
        }
        return good();
    }

    std::span<const Index> offsets_;
    std::span<const Index> corners_;
    std::string_view code_;
    std::string_view subject_;
    Violations& violations_;
    std::size_t before_;
    Surface& surface_;
};

}  // namespace

bool build_surface(Index vertex_count, std::span<const Index> face_offsets,
                   std::span<const Index> corners, std::string_view code, std::string_view subject,
                   Violations& violations, Surface& surface)
{
    return Builder(vertex_count, face_offsets, corners, code, subject, violations, surface).build();
}

}  // namespace layout_embedding::checker
