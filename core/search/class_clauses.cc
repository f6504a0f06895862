#include "search/class_clauses.hh"

#include <algorithm>

namespace layout_embedding {

ClassClauses::ClassClauses(KnownClasses& known)
    : known_(known), crossings_(known.pool()), sat_(crossings_), edges_(known.layout().edge_count())
{}

/// The literal "this edge costs at least `excess` beyond its base", which is positive.
ClassClauses::Literal ClassClauses::level(Index layout_edge, Length excess)
{
    Edge& edge = edges_[layout_edge];
    const auto next = edge.levels.lower_bound(excess);
    if (next != edge.levels.end() && next->first == excess) {
        return next->second;
    }
    const Literal here = sat_.add_variable();
    const Length below = next == edge.levels.begin() ? 0 : std::prev(next)->first;
    if (next != edge.levels.begin()) {
        sat_.add_clause({WeightedSat::negate(here), std::prev(next)->second});
    }
    if (next == edge.levels.end()) {
        sat_.add_cost(here, excess - below);
    } else {
        // What the next level costs is counted from the one below; this one adds to it only where
        // the next is not reached.
        sat_.add_clause({WeightedSat::negate(next->second), here});
        const Literal only_here = sat_.add_variable();
        sat_.add_clause({WeightedSat::negate(here), next->second, only_here});
        sat_.add_cost(only_here, excess - below);
    }
    edge.levels.emplace_hint(next, excess, here);
    return here;
}

void ClassClauses::add_class(Index walk)
{
    const Index e = known_.pool().layout_edge(walk);
    Edge& edge = edges_[e];
    const Literal chosen = sat_.add_member(walk, known_.walks(e).size() == 1);
    const Literal rest = sat_.add_variable();
    if (edge.rest == kTrue) {
        sat_.add_clause({chosen, rest});
    } else {
        sat_.add_clause({WeightedSat::negate(edge.rest), chosen, rest});
        sat_.add_clause({WeightedSat::negate(rest), edge.rest});
    }
    edge.rest = rest;
    literals_.resize(std::max<std::size_t>(literals_.size(), walk + 1), kNone);
    literals_[walk] = chosen;
    if (known_.excess(walk) > 0) {
        sat_.add_clause({WeightedSat::negate(chosen), level(e, known_.excess(walk))});
    }
    known_.for_each_in_wrong_order(walk, [&](Index other) {
        sat_.add_clause({WeightedSat::negate(chosen), WeightedSat::negate(literals_[other])});
    });
}

void ClassClauses::add_bound(const KnownClasses::Bound& bound)
{
    const Edge& edge = edges_[bound.layout_edge];
    std::vector<Literal> clause;
    for (const Index walk : bound.walks) {
        clause.push_back(WeightedSat::negate(literals_[walk]));
    }
    if (edge.rest != kTrue) {
        clause.push_back(WeightedSat::negate(edge.rest));
    }
    if (bound.excess != kInfiniteLength) {
        clause.push_back(level(bound.layout_edge, bound.excess));
    }
    sat_.add_clause(clause);
}

void ClassClauses::forbid(std::span<const Index> walks)
{
    std::vector<Literal> clause;
    for (const Index walk : walks) {
        clause.push_back(WeightedSat::negate(literals_[walk]));
    }
    sat_.add_clause(clause);
}

void ClassClauses::rule_out_rest(Index layout_edge)
{
    if (edges_[layout_edge].rest != kTrue) {
        sat_.add_clause({WeightedSat::negate(edges_[layout_edge].rest)});
    }
}

Index ClassClauses::choice(Index layout_edge) const
{
    const WalkPool& pool = known_.pool();
    Index choice = kNone;
    for (const Index walk : known_.walks(layout_edge)) {
        if (sat_.holds(literals_[walk]) &&
            (choice == kNone || pool.cost(walk) < pool.cost(choice))) {
            choice = walk;
        }
    }
    return choice;
}

void ClassClauses::forbid_order(const std::array<Index, 3>& walks)
{
    if (forbidden_orders_.insert(walks).second) {
        known_.forbid(walks);
        forbid(walks);
    }
}

bool ClassClauses::add_violated_orders(std::span<const Index> choices)
{
    const Layout& layout = known_.layout();
    bool found = false;
    std::vector<Index> chosen;
    for (Index v = 0; v < layout.vertex_count(); ++v) {
        if (known_.is_linear(v)) {
            continue;
        }
        chosen.clear();
        for (const Index h : layout.outgoing(v)) {
            if (choices[Layout::edge(h)] != kNone) {
                chosen.push_back(h);
            }
        }
        for (std::size_t x = 0; x < chosen.size(); ++x) {
            for (std::size_t y = x + 1; y < chosen.size(); ++y) {
                for (std::size_t z = y + 1; z < chosen.size(); ++z) {
                    const std::array<Index, 3> halfedges{chosen[x], chosen[y], chosen[z]};
                    std::array<Index, 3> walks;
                    for (int i = 0; i < 3; ++i) {
                        walks[i] = choices[Layout::edge(halfedges[i])];
                    }
                    if (!known_.is_wrong(halfedges, walks)) {
                        continue;
                    }
                    found = true;
                    for (int i = 0; i < 3; ++i) {
                        std::array<Index, 3> others = walks;
                        for (const Index walk : known_.walks(Layout::edge(halfedges[i]))) {
                            others[i] = walk;
                            if (known_.is_wrong(halfedges, others)) {
                                forbid_order(others);
                            }
                        }
                    }
                }
            }
        }
    }
    return found;
}

bool ClassClauses::add_violated_faces(std::span<const Index> choices, bool is_own)
{
    if (known_.faces() == nullptr) {
        return false;
    }
    note_classes();
    const Layout& layout = known_.layout();
    FaceLoops& faces = *known_.faces();
    bool found = false;
    std::vector<Index> walks;
    for (Index f = 0; f < layout.face_count(); ++f) {
        if (!faces.demands(f)) {
            continue;
        }
        walks.clear();
        for (const Index h : layout.face_halfedges(f)) {
            walks.push_back(choices[Layout::edge(h)]);
        }
        const auto open_count = std::count(walks.begin(), walks.end(), kNone);
        const auto open =
            static_cast<std::size_t>(std::find(walks.begin(), walks.end(), kNone) - walks.begin());
        if (open_count > 1 || (open_count == 0 && faces.closes(f, walks)) ||
            (open_count == 1 && faces.walk(faces.completion(f, walks, open)) == kNone)) {
            continue;
        }
        found = true;
        bool is_excluded = false;
        for (std::size_t place = 0; place < walks.size(); ++place) {
            if (open_count == 0 || place == open) {
                is_excluded = add_completion(f, walks, place) || is_excluded;
            }
            if (walks.size() == 3 && place != open) {
                add_row(f, place, walks[place]);
            }
        }
        if (!is_excluded && is_own) {
            known_.forbid(walks);
            forbid(walks);  // the assignment holds several classes of an edge to be chosen
        }
        if (open_count == 0) {
            known_.forbid(walks);
        } else {
            std::erase(walks, kNone);
            known_.add_bound(
                {Layout::edge(layout.face_halfedges(f)[open]), walks, kInfiniteLength});
        }
    }
    return found;
}

void ClassClauses::note_classes()
{
    rows_.resize(known_.layout().face_count());
    for (; noted_ < known_.walks().size(); ++noted_) {
        const Index walk = known_.walks()[noted_];
        known_.faces()->add(walk);
        add_to_rows(walk);
    }
}

/// Adds all that a triangle demands where it has this walk at a place.
void ClassClauses::add_row(Index face, std::size_t place, Index walk)
{
    if (!rows_[face].insert({place, walk}).second) {
        return;
    }
    const auto halfedges = known_.layout().face_halfedges(face);
    std::vector<Index> walks(3, kNone);
    walks[place] = walk;
    for (const std::size_t step : {1, 2}) {
        const std::size_t beside = (place + step) % 3;
        for (const Index other : known_.walks(Layout::edge(halfedges[beside]))) {
            walks[beside] = other;
            if (known_.can_go_together(walk, other)) {
                add_completion(face, walks, (place + 3 - step) % 3);
            }
        }
    }
}

/// Adds what triangles demand of a new walk beside those that have rows, and that it completes what
/// had no completion.
void ClassClauses::add_to_rows(Index walk)
{
    const Layout& layout = known_.layout();
    const FaceLoops& faces = *known_.faces();
    const Index e = known_.pool().layout_edge(walk);
    std::vector<Index> walks(3, kNone);
    for (const Index h : {2 * e, 2 * e + 1}) {
        const Index face = layout.face(h);
        if (face == kNone || layout.face_halfedges(face).size() != 3 || !faces.demands(face)) {
            continue;
        }
        const auto halfedges = layout.face_halfedges(face);
        const auto place = static_cast<std::size_t>(
            std::find(halfedges.begin(), halfedges.end(), h) - halfedges.begin());
        const auto waiting = waiting_.extract(faces.side(h, walk));
        if (!waiting.empty()) {
            for (const auto& [after, before] : waiting.mapped()) {
                walks[(place + 1) % 3] = after;
                walks[(place + 2) % 3] = before;
                add_completion(face, walks, place);
            }
        }
        for (const Row& row : rows_[face]) {
            if (row.place != place && known_.can_go_together(walk, row.walk)) {
                walks[place] = walk;
                walks[row.place] = row.walk;
                add_completion(face, walks, 3 - place - row.place);
            }
        }
    }
}

/// Where a face has these walks but at one place, there it has the only class that can close its
/// loop, or one that is not known if that one is not. Returns whether this excludes the assignment
/// found last.
bool ClassClauses::add_completion(Index face, std::vector<Index>& walks, std::size_t place)
{
    FaceLoops& faces = *known_.faces();
    uncharged_ += 4;
    const Index side = faces.completion(face, walks, place);
    const Index completion = faces.walk(side);
    std::vector<Literal> clause;
    for (std::size_t i = 0; i < walks.size(); ++i) {
        if (i != place) {
            clause.push_back(WeightedSat::negate(literals_[walks[i]]));
        }
    }
    const Index e = Layout::edge(known_.layout().face_halfedges(face)[place]);
    if (completion != kNone) {
        const Index before = std::exchange(walks[place], completion);
        if (faces.closes(face, walks)) {
            clause.push_back(literals_[completion]);
        }
        walks[place] = before;
    } else if (walks.size() == 3 && edges_[e].rest != kTrue) {
        clause.push_back(edges_[e].rest);
        waiting_[side].push_back({walks[(place + 1) % 3], walks[(place + 2) % 3]});
    } else {
        return false;  // to look for it would cost more than it brings
    }
    sat_.add_clause(clause);
    return std::none_of(clause.begin(), clause.end(), [&](Literal l) { return sat_.holds(l); });
}

}  // namespace layout_embedding
