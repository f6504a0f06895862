#include "surface/conflicts.hh"

#include <algorithm>

#include "surface/stretch.hh"

namespace layout_embedding {

namespace {

/// A traced candidate. Inner node k of the walk (0-based) lies between darts k and k+1.
struct Walk {
    Index layout_edge;
    const std::vector<Index>* darts;
    Strands::Trace trace;

    Index inner_count() const { return static_cast<Index>(trace.states.size()); }
};

class ConflictFinder {
public:
    ConflictFinder(const Strands& strands, const std::vector<CandidateWalk>& candidates)
        : strands_(strands), graph_(strands.graph())
    {
        for (const CandidateWalk& candidate : candidates) {
            auto trace = strands.trace(candidate.layout_edge, candidate.darts);
            walks_.push_back(
                {candidate.layout_edge, &candidate.darts, trace ? *trace : Strands::Trace{}});
        }
    }

    Conflicts run()
    {
        find_crossings();
        find_wrong_orders();
        std::sort(conflicts_.pairs.begin(), conflicts_.pairs.end());
        conflicts_.pairs.erase(std::unique(conflicts_.pairs.begin(), conflicts_.pairs.end()),
                               conflicts_.pairs.end());
        std::sort(conflicts_.triples.begin(), conflicts_.triples.end());
        conflicts_.triples.erase(std::unique(conflicts_.triples.begin(), conflicts_.triples.end()),
                                 conflicts_.triples.end());
        return std::move(conflicts_);
    }

private:
    // The slots by which a walk enters and leaves its inner node k, as places in the
    // counter-clockwise sequence of all slots around the node.
    Index way_back(const Walk& walk, Index k) const
    {
        const Index dart = (*walk.darts)[k];
        const Index node = graph_.head(dart);
        const Index twin = graph_.twin(dart);
        const Index slot = strands_.strand_count(node, twin) - walk.trace.slots[k];
        return strands_.slot_place(node, twin, slot);
    }
    Index way_on(const Walk& walk, Index k) const
    {
        const Index dart = (*walk.darts)[k + 1];
        return strands_.slot_place(graph_.tail(dart), dart, walk.trace.slots[k + 1]);
    }

    /// Whether the stretch that begins at inner node i of a and j of b, where the walks come
    /// together (seen along a), crosses. `forward`: b runs along with a, not against it.
    bool crosses(const Walk& a, Index i, const Walk& b, Index j) const
    {
        const Index a_back = way_back(a, i);
        Index a_on = way_on(a, i);
        const Index b_back = way_back(b, j);
        const Index b_on = way_on(b, j);
        if (b_back == a_back || b_on == a_back) {
            return false;  // not where the stretch begins
        }
        if (b_back != a_on && b_on != a_on) {
            // They share this node only.
            return is_before(a_back, b_back, a_on) != is_before(a_back, b_on, a_on);
        }
        const bool forward = b_on == a_on;
        const Index b_before = forward ? b_back : b_on;
        const bool begins_right = is_before(a_back, b_before, a_on);
        Index k = i;
        Index l = j;
        for (;;) {
            if (k + 1 == a.inner_count() || (forward ? l + 1 == b.inner_count() : l == 0)) {
                return false;  // ends at a landmark
            }
            ++k;
            l = forward ? l + 1 : l - 1;
            const Index back = way_back(a, k);
            a_on = way_on(a, k);
            const Index b_ahead = forward ? way_on(b, l) : way_back(b, l);
            if (b_ahead != a_on) {
                return begins_right != is_before(back, b_ahead, a_on);
            }
        }
    }

    void find_crossings()
    {
        struct Visit {
            Index state;
            Index walk;
            Index place;
        };
        std::vector<Visit> visits;
        for (Index w = 0; w < walks_.size(); ++w) {
            for (Index k = 0; k < walks_[w].inner_count(); ++k) {
                visits.push_back({walks_[w].trace.states[k], w, k});
            }
        }
        std::sort(visits.begin(), visits.end(), [](const Visit& x, const Visit& y) {
            return x.state != y.state ? x.state < y.state : x.walk < y.walk;
        });
        for (std::size_t begin = 0; begin < visits.size();) {
            std::size_t end = begin;
            while (end < visits.size() && visits[end].state == visits[begin].state) {
                ++end;
            }
            for (std::size_t x = begin; x < end; ++x) {
                for (std::size_t y = x + 1; y < end; ++y) {
                    if (crosses(walks_[visits[x].walk], visits[x].place, walks_[visits[y].walk],
                                visits[y].place)) {
                        conflicts_.pairs.emplace_back(visits[x].walk, visits[y].walk);
                    }
                }
            }
            begin = end;
        }
    }

    /// A walk as it leaves a landmark: the walk, and whether it is followed from its end.
    struct Leaving {
        Index walk;
        bool from_end;
        Index rank;   // in the layout's order, counted from the beginning of the sector
        Index place;  // of the first slot, counted from the beginning of the sector
    };

    /// Whether x leaves the landmark to the right of (counter-clockwise before) y, which leaves by
    /// the same slot: they are followed to where they diverge.
    bool leaves_before(const Leaving& x, const Leaving& y) const
    {
        const Walk& a = walks_[x.walk];
        const Walk& b = walks_[y.walk];
        for (Index step = 0; step < a.inner_count() && step < b.inner_count(); ++step) {
            const Index k = x.from_end ? a.inner_count() - 1 - step : step;
            const Index l = y.from_end ? b.inner_count() - 1 - step : step;
            const Index back = x.from_end ? way_on(a, k) : way_back(a, k);
            const Index a_on = x.from_end ? way_back(a, k) : way_on(a, k);
            const Index b_on = y.from_end ? way_back(b, l) : way_on(b, l);
            if (a_on != b_on) {
                return is_before(back, a_on, b_on);
            }
        }
        return x.rank < y.rank;  // identical walks: only parallel edges have them
    }

    void find_wrong_orders()
    {
        const Layout& layout = strands_.layout();
        std::vector<Index> walks_of_edges(layout.edge_count(), kNone);
        for (Index w = 0; w < walks_.size(); ++w) {
            if (!walks_[w].trace.slots.empty()) {
                walks_of_edges[walks_[w].layout_edge] = w;
            }
        }
        for (Index v = 0; v < layout.vertex_count(); ++v) {
            std::vector<std::vector<Leaving>> sectors;
            bool embedded = false;
            collect_leaving(v, walks_of_edges, sectors, embedded);
            const bool linear = embedded || graph_.is_boundary(strands_.landmark_node(v));
            for (auto& leaving : sectors) {
                std::sort(leaving.begin(), leaving.end(), [&](const Leaving& x, const Leaving& y) {
                    return x.place != y.place ? x.place < y.place : leaves_before(x, y);
                });
                if (linear) {
                    find_wrong_pairs(leaving);
                } else {
                    find_wrong_triples(leaving);
                }
            }
        }
    }

    /// The candidates at a layout vertex by sector.
    void collect_leaving(Index v, const std::vector<Index>& walks_of_edges,
                         std::vector<std::vector<Leaving>>& sectors, bool& embedded) const
    {
        const Layout& layout = strands_.layout();
        const auto around = layout.outgoing(v);
        const Index node = strands_.landmark_node(v);
        const auto count = static_cast<Index>(around.size());
        Index first = 0;  // after an embedded edge, if there is one and no boundary fixes the start
        for (Index i = 0; i < count; ++i) {
            if (strands_.is_embedded(Layout::edge(around[i]))) {
                embedded = true;
                if (!graph_.is_boundary(node)) {
                    first = i + 1;
                }
            }
        }
        sectors.emplace_back();
        for (Index i = 0; i < count; ++i) {
            const Index h = around[(first + i) % count];
            const Index edge = Layout::edge(h);
            if (strands_.is_embedded(edge)) {
                sectors.emplace_back();
                continue;
            }
            const Index w = walks_of_edges[edge];
            if (w != kNone) {
                sectors.back().push_back({w, h % 2 == 1, i, place_in_sector(node, h, w)});
            }
        }
    }

    /// The place of a walk's first slot at a landmark, so counted that places grow through the
    /// sector.
    Index place_in_sector(Index node, Index layout_halfedge, Index w) const
    {
        const Walk& walk = walks_[w];
        const bool from_end = layout_halfedge % 2 == 1;
        const Index dart = from_end ? graph_.twin(walk.darts->back()) : walk.darts->front();
        const Index slot = from_end ? strands_.strand_count(node, dart) - walk.trace.slots.back()
                                    : walk.trace.slots.front();
        const Index place = strands_.slot_place(node, dart, slot);
        // A sector that wraps around: its slots before the first strand end come last.
        const Index sector = strands_.sector(layout_halfedge);
        if (sector != 0 || graph_.is_boundary(node)) {
            return place;
        }
        const Index degree = graph_.degree(node);
        const Index last_dart = graph_.first_dart(node) + degree - 1;
        const Index places =
            strands_.slot_place(node, last_dart, strands_.strand_count(node, last_dart)) + 1;
        // Slots of sector 0 form the beginning and the end of the sequence; the end comes first.
        const Index first_dart = graph_.first_dart(node);
        bool before_first_end = true;
        for (Index d = first_dart; d <= dart && before_first_end; ++d) {
            const Index strands = strands_.strand_count(node, d);
            before_first_end = d < dart ? strands == 0 : slot == 0;
        }
        const bool has_ends = strands_.is_touched(node);
        return has_ends && before_first_end ? place + places : place;
    }

    void find_wrong_pairs(const std::vector<Leaving>& leaving)
    {
        for (std::size_t x = 0; x < leaving.size(); ++x) {
            for (std::size_t y = x + 1; y < leaving.size(); ++y) {
                if (leaving[x].rank > leaving[y].rank) {
                    conflicts_.pairs.push_back(std::minmax(leaving[x].walk, leaving[y].walk));
                }
            }
        }
    }

    void find_wrong_triples(const std::vector<Leaving>& leaving)
    {
        const std::size_t n = leaving.size();
        for (std::size_t x = 0; x < n; ++x) {
            for (std::size_t y = x + 1; y < n; ++y) {
                for (std::size_t z = y + 1; z < n; ++z) {
                    if (!is_before(leaving[x].rank, leaving[y].rank, leaving[z].rank)) {
                        std::array<Index, 3> triple{leaving[x].walk, leaving[y].walk,
                                                    leaving[z].walk};
                        std::sort(triple.begin(), triple.end());
                        conflicts_.triples.push_back(triple);
                    }
                }
            }
        }
    }

    const Strands& strands_;
    const PathGraph& graph_;
    std::vector<Walk> walks_;
    Conflicts conflicts_;
};

}  // namespace

Conflicts find_conflicts(const Strands& strands, const std::vector<CandidateWalk>& candidates)
{
    return ConflictFinder(strands, candidates).run();
}

}  // namespace layout_embedding
