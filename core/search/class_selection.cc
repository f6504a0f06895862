#include "search/class_selection.hh"

#include <algorithm>

#include "surface/stretch.hh"

namespace layout_embedding {

ClassSelection::ClassSelection(const Layout& layout, const WalkPool& pool,
                               std::vector<bool> is_linear)
    : layout_(layout),
      pool_(pool),
      is_linear_(std::move(is_linear)),
      crossings_(pool),
      sat_(crossings_),
      edges_(layout.edge_count()),
      choices_(layout.edge_count(), kNone)
{}

void ClassSelection::set_base(Index layout_edge, Length bound)
{
    edges_[layout_edge].base = bound;
    sat_.add_base(bound);
}

/// The literal "this edge costs at least `cost`", which is more than its base.
ClassSelection::Literal ClassSelection::level(Index layout_edge, Length cost)
{
    Edge& edge = edges_[layout_edge];
    const auto next = edge.levels.lower_bound(cost);
    if (next != edge.levels.end() && next->first == cost) {
        return next->second;
    }
    const Literal here = sat_.add_variable();
    const Length below = next == edge.levels.begin() ? edge.base : std::prev(next)->first;
    if (next != edge.levels.begin()) {
        sat_.add_clause({WeightedSat::negate(here), std::prev(next)->second});
    }
    if (next == edge.levels.end()) {
        sat_.add_cost(here, cost - below);
    } else {
        // What the next level costs is counted from the one below; this one adds to it only where
        // the next is not reached.
        sat_.add_clause({WeightedSat::negate(next->second), here});
        const Literal only_here = sat_.add_variable();
        sat_.add_clause({WeightedSat::negate(here), next->second, only_here});
        sat_.add_cost(only_here, cost - below);
    }
    edge.levels.emplace_hint(next, cost, here);
    return here;
}

void ClassSelection::add_class(Index walk)
{
    if (literal(walk) != kNone) {
        return;
    }
    const Index e = pool_.layout_edge(walk);
    Edge& edge = edges_[e];
    const Literal chosen = sat_.add_member(walk, edge.walks.empty());
    const Literal rest = sat_.add_variable();
    if (edge.rest == kTrue) {
        sat_.add_clause({chosen, rest});
    } else {
        sat_.add_clause({WeightedSat::negate(edge.rest), chosen, rest});
        sat_.add_clause({WeightedSat::negate(rest), edge.rest});
    }
    edge.rest = rest;
    edge.walks.push_back(walk);
    literals_.resize(std::max<std::size_t>(literals_.size(), walk + 1), kNone);
    literals_[walk] = chosen;
    ++class_count_;
    if (pool_.cost(walk) > edge.base) {
        sat_.add_clause({WeightedSat::negate(chosen), level(e, pool_.cost(walk))});
    }
    for (const Index h : {2 * e, 2 * e + 1}) {
        const Index v = layout_.tail(h);
        if (!is_linear_[v]) {
            continue;
        }
        for (const Index g : layout_.outgoing(v)) {
            if (Layout::edge(g) == e) {
                continue;
            }
            for (const Index other : edges_[Layout::edge(g)].walks) {
                if ((pool_.place(h, walk) < pool_.place(g, other)) !=
                    (layout_.rank(h) < layout_.rank(g))) {
                    sat_.add_clause(
                        {WeightedSat::negate(chosen), WeightedSat::negate(literal(other))});
                }
            }
        }
    }
}

void ClassSelection::add_bound(Index layout_edge, std::span<const Index> blockers, Length bound)
{
    Edge& edge = edges_[layout_edge];
    if (bound <= edge.base) {
        return;
    }
    std::vector<Literal> clause;
    for (const Index walk : blockers) {
        add_class(walk);
        clause.push_back(WeightedSat::negate(literal(walk)));
    }
    if (edge.rest != kTrue) {
        clause.push_back(WeightedSat::negate(edge.rest));
    }
    if (bound != kInfiniteLength) {
        clause.push_back(level(layout_edge, bound));
    }
    sat_.add_clause(clause);
}

void ClassSelection::forbid(std::span<const Index> walks)
{
    std::vector<Literal> clause;
    for (const Index walk : walks) {
        add_class(walk);
        clause.push_back(WeightedSat::negate(literal(walk)));
    }
    sat_.add_clause(clause);
}

ClassSelection::Outcome ClassSelection::run(WorkBudget& budget)
{
    for (;;) {
        const Outcome outcome = sat_.run(budget);
        if (outcome != Outcome::satisfied && outcome != Outcome::optimal) {
            return outcome;
        }
        read_choices();
        if (!add_violated_orders()) {
            return outcome;
        }
    }
}

void ClassSelection::read_choices()
{
    for (Index e = 0; e < edges_.size(); ++e) {
        choices_[e] = kNone;
        for (const Index walk : edges_[e].walks) {
            if (sat_.holds(literals_[walk]) &&
                (choices_[e] == kNone || pool_.cost(walk) < pool_.cost(choices_[e]))) {
                choices_[e] = walk;
            }
        }
    }
}

/// Whether three halfedges that leave a landmark, ascending in rank, do so in the wrong cyclic
/// order along these walks.
bool ClassSelection::is_wrong(const std::array<Index, 3>& halfedges,
                              const std::array<Index, 3>& walks) const
{
    return !is_before(pool_.place(halfedges[0], walks[0]), pool_.place(halfedges[1], walks[1]),
                      pool_.place(halfedges[2], walks[2]));
}

void ClassSelection::forbid_order(const std::array<Index, 3>& walks)
{
    if (forbidden_orders_.insert(walks).second) {
        sat_.add_clause({WeightedSat::negate(literals_[walks[0]]),
                         WeightedSat::negate(literals_[walks[1]]),
                         WeightedSat::negate(literals_[walks[2]])});
    }
}

/// Forbids the wrong orders of the present choice, and those that differ from one in a single
/// class; false if there is none.
bool ClassSelection::add_violated_orders()
{
    bool found = false;
    std::vector<Index> chosen;
    for (Index v = 0; v < layout_.vertex_count(); ++v) {
        if (is_linear_[v]) {
            continue;
        }
        chosen.clear();
        for (const Index h : layout_.outgoing(v)) {
            if (choices_[Layout::edge(h)] != kNone) {
                chosen.push_back(h);
            }
        }
        for (std::size_t x = 0; x < chosen.size(); ++x) {
            for (std::size_t y = x + 1; y < chosen.size(); ++y) {
                for (std::size_t z = y + 1; z < chosen.size(); ++z) {
                    const std::array<Index, 3> halfedges{chosen[x], chosen[y], chosen[z]};
                    std::array<Index, 3> walks;
                    for (int i = 0; i < 3; ++i) {
                        walks[i] = choices_[Layout::edge(halfedges[i])];
                    }
                    if (!is_wrong(halfedges, walks)) {
                        continue;
                    }
                    found = true;
                    for (int i = 0; i < 3; ++i) {
                        std::array<Index, 3> others = walks;
                        for (const Index walk : edges_[Layout::edge(halfedges[i])].walks) {
                            others[i] = walk;
                            if (is_wrong(halfedges, others)) {
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

}  // namespace layout_embedding
