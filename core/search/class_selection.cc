#include "search/class_selection.hh"

#include <algorithm>
#include <utility>

#include "surface/stretch.hh"

namespace layout_embedding {

namespace {

// Once clauses have had so many units of work, the instance is hard: before, branch and bound waits
// so many times as long, and from then on it gets so many times as much work as clauses.
constexpr std::uint64_t kHard = 8'000'000;
constexpr std::uint64_t kWaitBeforeHard = 8;
constexpr std::uint64_t kTreeShare = 3;
// Units of work that clauses or branch and bound get at a time.
constexpr std::uint64_t kTurn = 50'000;
// No branch and bound on larger tables.
constexpr std::uint64_t kMostEntries = 32'000'000;

}  // namespace

ClassSelection::ClassSelection(const Layout& layout, const WalkPool& pool,
                               std::optional<FaceLoops> faces, std::vector<bool> is_linear,
                               std::uint64_t patience)
    : layout_(layout),
      pool_(pool),
      faces_(std::move(faces)),
      is_linear_(std::move(is_linear)),
      patience_(patience),
      crossings_(pool),
      sat_(crossings_),
      edges_(layout.edge_count()),
      choices_(layout.edge_count(), kNone)
{}

void ClassSelection::set_base(Index layout_edge, Length bound)
{
    edges_[layout_edge].base = bound;
    base_ += bound;
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
    unnoted_.push_back(walk);
    known_.push_back(walk);
    for_each_in_wrong_order(walk, [&](Index other) {
        sat_.add_clause({WeightedSat::negate(chosen), WeightedSat::negate(literal(other))});
    });
}

/// Calls `visit` with the known walks that leave a landmark on the boundary on the wrong side of
/// this one.
template <typename Visit>
void ClassSelection::for_each_in_wrong_order(Index walk, const Visit& visit) const
{
    const Index e = pool_.layout_edge(walk);
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
                    visit(other);
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
    bounds_.push_back({layout_edge,
                       {blockers.begin(), blockers.end()},
                       bound == kInfiniteLength ? bound : bound - edge.base});
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
    nogoods_.push_back({kNone, {walks.begin(), walks.end()}, 0});
}

void ClassSelection::lower_upper_bound(Length cost)
{
    sat_.lower_upper_bound(cost);
    if (tree_) {
        tree_->lower_upper_bound(cost - std::min(cost, base_));
    }
}

ClassSelection::Outcome ClassSelection::run(WorkBudget& budget)
{
    if (!rows_.empty()) {
        note_walks();
    }
    for (;;) {
        budget.charge(std::exchange(uncharged_, 0));
        const Outcome outcome = run_engine(budget);
        if (outcome == Outcome::running && !budget.is_spent()) {
            continue;  // the other one's turn
        }
        if (outcome != Outcome::satisfied && outcome != Outcome::optimal) {
            return outcome;
        }
        read_choices();
        const bool has_wrong_orders = add_violated_orders();
        const bool has_wrong_faces = faces_ && add_violated_faces();
        if (!has_wrong_orders && !has_wrong_faces) {
            return outcome;
        }
    }
}

/// Clauses and branch and bound take turns.
ClassSelection::Outcome ClassSelection::run_engine(WorkBudget& budget)
{
    if (turn_left_ == 0) {
        is_trees_turn_ = is_trees_turn();
        turn_left_ = kTurn;
    }
    WorkBudget turn(std::min(budget.left(), turn_left_));
    const Outcome outcome = is_trees_turn_ ? run_tree(turn) : run_sat(turn);
    budget.charge(turn.spent());
    turn_left_ -= std::min(turn_left_, turn.spent());
    (is_trees_turn_ ? tree_work_ : sat_work_) += turn.spent();
    all_sat_work_ += is_trees_turn_ ? 0 : turn.spent();
    choice_is_trees_ = is_trees_turn_;
    if (outcome != Outcome::running && is_trees_turn_) {
        sat_.interrupt();  // something may be added to it
    }
    return outcome;
}

/// Branch and bound is up where clauses have not told anything for a while.
bool ClassSelection::is_trees_turn()
{
    if (knowledge_ != known_.size() + bounds_.size()) {
        knowledge_ = known_.size() + bounds_.size();
        sat_work_ = 0;
        tree_work_ = 0;
    }
    const std::uint64_t wait = all_sat_work_ < kHard ? kWaitBeforeHard * patience_ : patience_;
    return sat_.upper_bound() != kInfiniteLength && sat_work_ >= wait &&
           (patience_ == 0 || tree_work_ < kTreeShare * (sat_work_ - wait)) &&
           (!tree_ || tree_->table_size() < kMostEntries);
}

ClassSelection::Outcome ClassSelection::run_tree(WorkBudget& budget)
{
    tell_tree();
    budget.charge(std::exchange(uncharged_, 0));
    const auto outcome = tree_->run(budget);
    std::vector<Index> walks;
    std::vector<Index> rests;
    tree_->take_ruled_out(walks, rests);
    if (!walks.empty() || !rests.empty()) {
        sat_.interrupt();
    }
    for (const Index walk : walks) {
        sat_.add_clause({WeightedSat::negate(literals_[walk])});
    }
    for (const Index e : rests) {
        if (edges_[e].rest != kTrue) {
            sat_.add_clause({WeightedSat::negate(edges_[e].rest)});
        }
    }
    switch (outcome) {
        case ChoiceTree::Outcome::raised:
            return Outcome::raised;
        case ChoiceTree::Outcome::wants_classes:
            return Outcome::wants_classes;
        case ChoiceTree::Outcome::satisfied:
            return Outcome::satisfied;
        case ChoiceTree::Outcome::optimal:
            return Outcome::optimal;
        case ChoiceTree::Outcome::exceeded:
            return Outcome::exceeded;
        case ChoiceTree::Outcome::running:
            break;
    }
    return Outcome::running;
}

ClassSelection::Outcome ClassSelection::run_sat(WorkBudget& budget)
{
    switch (sat_.run(budget)) {
        case WeightedSat::Outcome::raised:
            return Outcome::raised;
        case WeightedSat::Outcome::satisfied:
            return Outcome::satisfied;
        case WeightedSat::Outcome::optimal:
            return Outcome::optimal;
        case WeightedSat::Outcome::exceeded:
            return Outcome::exceeded;
        case WeightedSat::Outcome::running:
            break;
    }
    return Outcome::running;
}

/// Tells branch and bound what has become known since the last time.
void ClassSelection::tell_tree()
{
    if (faces_) {
        note_walks();
    }
    if (!tree_) {
        tree_ = std::make_unique<ChoiceTree>(static_cast<Index>(edges_.size()),
                                             sat_.upper_bound() - base_);
        triangles_.assign(layout_.face_count(), kNone);
        for (Index f = 0; faces_ && f < layout_.face_count(); ++f) {
            const auto halfedges = layout_.face_halfedges(f);
            if (halfedges.size() == 3 && faces_->demands(f)) {
                triangles_[f] =
                    tree_->add_triangle({Layout::edge(halfedges[0]), Layout::edge(halfedges[1]),
                                         Layout::edge(halfedges[2])});
                tree_->add_tuple(triangles_[f], {kNone, kNone, kNone});
            }
        }
    }
    if (told_classes_ < known_.size() || told_bounds_ < bounds_.size() ||
        told_nogoods_ < nogoods_.size()) {
        tree_->expect_news();
    }
    while (told_classes_ < known_.size()) {
        tell_tree_of(known_[told_classes_++]);
    }
    for (; told_bounds_ < bounds_.size(); ++told_bounds_) {
        const Told& told = bounds_[told_bounds_];
        tree_->add_bound(told.layout_edge, told.walks, told.cost);
    }
    for (; told_nogoods_ < nogoods_.size(); ++told_nogoods_) {
        tree_->forbid(nogoods_[told_nogoods_].walks);
    }
}

void ClassSelection::tell_tree_of(Index walk)
{
    const Index e = pool_.layout_edge(walk);
    tree_->add_class(e, walk, pool_.cost(walk) - edges_[e].base);
    if (faces_) {
        tell_tree_of_triangles(walk);
    }
    if (!tree_->knows(walk)) {
        return;
    }
    const auto exclude = [&](Index other) {
        if (tree_->knows(other)) {
            tree_->exclude(walk, other);
        }
        return true;
    };
    pool_.crossing(walk).all_of(exclude);
    for_each_in_wrong_order(walk, exclude);
}

/// Which classes triangles allow beside a new one: of two edges' classes, the third edge's that
/// completes them, or its rest while that one is not known.
void ClassSelection::tell_tree_of_triangles(Index walk)
{
    const Index e = pool_.layout_edge(walk);
    for (const Index h : {2 * e, 2 * e + 1}) {
        const Index face = layout_.face(h);
        if (face == kNone || triangles_[face] == kNone) {
            continue;
        }
        const Index triangle = triangles_[face];
        const auto waiting = tuples_.extract(faces_->side(h, walk));
        if (!waiting.empty()) {
            for (const Index tuple : waiting.mapped()) {
                tree_->remove_tuple(triangle, tuple);
            }
        }
        if (!tree_->knows(walk)) {
            continue;
        }
        const auto halfedges = layout_.face_halfedges(face);
        const auto place = static_cast<std::size_t>(
            std::find(halfedges.begin(), halfedges.end(), h) - halfedges.begin());
        std::array<Index, 3> walks{kNone, kNone, kNone};
        walks[place] = walk;
        tree_->add_tuple(triangle, walks);
        for (const std::size_t step : {1, 2}) {
            const std::size_t beside = (place + step) % 3;
            const std::size_t third = (place + 3 - step) % 3;
            for (const Index other : edges_[Layout::edge(halfedges[beside])].walks) {
                if (!tree_->knows(other) || !can_go_together(walk, other)) {
                    continue;
                }
                uncharged_ += 4;
                walks[beside] = other;
                const Index side = faces_->completion(face, walks, third);
                const Index completion = faces_->walk(side);
                if (completion == kNone) {
                    tuples_[side].push_back(tree_->add_tuple(triangle, walks));
                } else if (step == 1 && tree_->knows(completion) &&
                           can_go_together(walk, completion) &&
                           can_go_together(other, completion)) {
                    walks[third] = completion;
                    if (faces_->closes(face, walks)) {
                        tree_->add_tuple(triangle, walks);
                    }
                    walks[third] = kNone;
                }
            }
            walks[beside] = kNone;
        }
    }
}

void ClassSelection::read_choices()
{
    for (Index e = 0; e < edges_.size(); ++e) {
        choices_[e] = choice_is_trees_ ? tree_->choice(e) : kNone;
        if (choice_is_trees_) {
            continue;
        }
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
        nogoods_.push_back({kNone, {walks.begin(), walks.end()}, 0});
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

/// Adds what faces demand that the present choice does not comply with, and more of the kind; false
/// if it complies with all.
bool ClassSelection::add_violated_faces()
{
    note_walks();
    bool found = false;
    std::vector<Index> walks;
    for (Index f = 0; f < layout_.face_count(); ++f) {
        if (!faces_->demands(f)) {
            continue;
        }
        walks.clear();
        for (const Index h : layout_.face_halfedges(f)) {
            walks.push_back(choices_[Layout::edge(h)]);
        }
        const auto open_count = std::count(walks.begin(), walks.end(), kNone);
        const auto open =
            static_cast<std::size_t>(std::find(walks.begin(), walks.end(), kNone) - walks.begin());
        if (open_count > 1 || (open_count == 0 && faces_->closes(f, walks)) ||
            (open_count == 1 && faces_->walk(faces_->completion(f, walks, open)) == kNone)) {
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
        if (!is_excluded && !choice_is_trees_) {
            forbid(walks);  // the assignment holds several classes of an edge to be chosen
        }
        if (open_count == 0) {
            nogoods_.push_back({kNone, walks, 0});
        } else {
            std::erase(walks, kNone);
            bounds_.push_back(
                {Layout::edge(layout_.face_halfedges(f)[open]), walks, kInfiniteLength});
        }
    }
    return found;
}

/// Tells the faces of the walks that are new to them. Cuts for faces are not made before a choice
/// has been found.
void ClassSelection::note_walks()
{
    rows_.resize(layout_.face_count());
    for (const Index walk : std::exchange(unnoted_, {})) {
        faces_->add(walk);
        add_to_rows(walk);
    }
}

/// Adds all that a triangle demands where it has this walk at a place.
void ClassSelection::add_row(Index face, std::size_t place, Index walk)
{
    if (!rows_[face].insert({place, walk}).second) {
        return;
    }
    const auto halfedges = layout_.face_halfedges(face);
    std::vector<Index> walks(3, kNone);
    walks[place] = walk;
    for (const std::size_t step : {1, 2}) {
        const std::size_t beside = (place + step) % 3;
        for (const Index other : edges_[Layout::edge(halfedges[beside])].walks) {
            walks[beside] = other;
            if (can_go_together(walk, other)) {
                add_completion(face, walks, (place + 3 - step) % 3);
            }
        }
    }
}

/// Adds what triangles demand of a new walk beside those that have rows, and that it completes what
/// had no completion.
void ClassSelection::add_to_rows(Index walk)
{
    const Index e = pool_.layout_edge(walk);
    std::vector<Index> walks(3, kNone);
    for (const Index h : {2 * e, 2 * e + 1}) {
        const Index face = layout_.face(h);
        if (face == kNone || layout_.face_halfedges(face).size() != 3 || !faces_->demands(face)) {
            continue;
        }
        const auto halfedges = layout_.face_halfedges(face);
        const auto place = static_cast<std::size_t>(
            std::find(halfedges.begin(), halfedges.end(), h) - halfedges.begin());
        const auto waiting = waiting_.extract(faces_->side(h, walk));
        if (!waiting.empty()) {
            for (const auto& [after, before] : waiting.mapped()) {
                walks[(place + 1) % 3] = after;
                walks[(place + 2) % 3] = before;
                add_completion(face, walks, place);
            }
        }
        for (const Row& row : rows_[face]) {
            if (row.place != place && can_go_together(walk, row.walk)) {
                walks[place] = walk;
                walks[row.place] = row.walk;
                add_completion(face, walks, 3 - place - row.place);
            }
        }
    }
}

/// Whether two walks of different edges may be in a choice that matters.
bool ClassSelection::can_go_together(Index a, Index b) const
{
    const auto excess = [&](Index walk) {
        return pool_.cost(walk) - edges_[pool_.layout_edge(walk)].base;
    };
    return !pool_.cross(a, b) && (sat_.upper_bound() == kInfiniteLength ||
                                  base_ + excess(a) + excess(b) < sat_.upper_bound());
}

/// Where a face has these walks but at one place, there it has the only class that can close its
/// loop, or one that is not known if that one is not. Returns whether this excludes the assignment
/// found last.
bool ClassSelection::add_completion(Index face, std::vector<Index>& walks, std::size_t place)
{
    uncharged_ += 4;
    const Index side = faces_->completion(face, walks, place);
    const Index completion = faces_->walk(side);
    std::vector<Literal> clause;
    for (std::size_t i = 0; i < walks.size(); ++i) {
        if (i != place) {
            clause.push_back(WeightedSat::negate(literals_[walks[i]]));
        }
    }
    const Index e = Layout::edge(layout_.face_halfedges(face)[place]);
    if (completion != kNone) {
        const Index before = std::exchange(walks[place], completion);
        if (faces_->closes(face, walks)) {
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
