#include "search/choice_tree.hh"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <set>

#include "base/random.hh"

namespace layout_embedding {
namespace {

/// Edges with classes that cost something, exclude each other, and complete each other around
/// triangles. Class c of edge e is walk e * kClasses + c; classes become known in order of cost.
struct World {
    static constexpr Index kClasses = 5;

    World(Random& random, Index edge_count) : edges(edge_count)
    {
        for (Index e = 0; e < edges; ++e) {
            std::vector<Length> ascending;
            for (Index c = 0; c < kClasses; ++c) {
                ascending.push_back(random.below(1U << 20U) * (c == 0 ? 0 : 1));
            }
            std::sort(ascending.begin(), ascending.end());
            costs.insert(costs.end(), ascending.begin(), ascending.end());
        }
        for (Index a = 0; a < walk_count(); ++a) {
            for (Index b = a + 1; b < walk_count(); ++b) {
                if (edge(a) != edge(b) && random.below(10) < 3) {
                    excluded.insert({a, b});
                }
            }
        }
        for (Index t = 0; t + 2 < edges; t += 2) {
            triangles.push_back({t, t + 1, t + 2});
            completions.emplace_back();
            for (Index a = 0; a < kClasses; ++a) {
                for (Index b = 0; b < kClasses; ++b) {
                    const auto c = static_cast<Index>(random.below(kClasses + 1));
                    completions.back().push_back(c < kClasses ? walk(t + 2, c) : kNone);
                }
            }
        }
        for (int i = 0; i < 4; ++i) {
            std::set<Index> walks;
            for (int k = 0; k < 3; ++k) {
                walks.insert(walk(static_cast<Index>(random.below(edges)),
                                  static_cast<Index>(random.below(kClasses))));
            }
            forbidden.emplace_back(walks.begin(), walks.end());
        }
    }

    Index walk_count() const { return edges * kClasses; }
    static Index walk(Index e, Index c) { return e * kClasses + c; }
    static Index edge(Index walk) { return walk / kClasses; }
    bool exclude(Index a, Index b) const
    {
        return excluded.count({std::min(a, b), std::max(a, b)}) != 0;
    }
    Index completion(std::size_t triangle, Index a, Index b) const
    {
        return completions[triangle][(a % kClasses) * kClasses + b % kClasses];
    }

    /// The least cost of a choice of classes, kInfiniteLength if there is none.
    Length best() const
    {
        Length least = kInfiniteLength;
        std::vector<Index> chosen;
        complete(chosen, 0, least);
        return least;
    }

    void complete(std::vector<Index>& chosen, Length cost, Length& least) const
    {
        const auto e = static_cast<Index>(chosen.size());
        if (cost >= least) {
            return;
        }
        if (e == edges) {
            least = cost;
            return;
        }
        for (Index c = 0; c < kClasses; ++c) {
            chosen.push_back(walk(e, c));
            if (is_allowed(chosen)) {
                complete(chosen, cost + costs[walk(e, c)], least);
            }
            chosen.pop_back();
        }
    }

    /// Whether the last of the classes goes with those before it.
    bool is_allowed(const std::vector<Index>& chosen) const
    {
        const Index last = chosen.back();
        if (std::any_of(chosen.begin(), chosen.end() - 1,
                        [&](Index other) { return exclude(other, last); })) {
            return false;
        }
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            if (triangles[t][2] == edge(last) &&
                completion(t, chosen[triangles[t][0]], chosen[triangles[t][1]]) != last) {
                return false;
            }
        }
        return std::none_of(forbidden.begin(), forbidden.end(), [&](const auto& walks) {
            return std::all_of(walks.begin(), walks.end(), [&](Index walk) {
                return std::find(chosen.begin(), chosen.end(), walk) != chosen.end();
            });
        });
    }

    Index edges;
    std::vector<Length> costs;  // per walk
    std::set<std::pair<Index, Index>> excluded;
    std::vector<std::array<Index, 3>> triangles;
    std::vector<std::vector<Index>> completions;  // per triangle: by the classes of two edges
    std::vector<std::vector<Index>> forbidden;
};

/// A tree that is told of a world bit by bit.
class Teller {
public:
    Teller(const World& world, Length upper_bound)
        : tree(world.edges, upper_bound), world_(world), known_(world.edges, 0)
    {
        for (const auto& edges : world.triangles) {
            triangles_.push_back(tree.add_triangle(edges));
            tree.add_tuple(triangles_.back(), {kNone, kNone, kNone});
        }
        for (Index e = 0; e < world.edges; ++e) {
            tell_next(e);
        }
    }

    bool knows_all(Index e) const { return known_[e] == World::kClasses; }

    /// One more class of an edge, and what the rest costs then, alone and beside others.
    void tell_next(Index e)
    {
        const Index walk = World::walk(e, known_[e]++);
        tree.expect_news();
        tree.add_class(e, walk, world_.costs[walk]);
        for (Index other = 0; tree.knows(walk) && other < world_.walk_count(); ++other) {
            if (other != walk && tree.knows(other) && World::edge(other) != e &&
                world_.exclude(walk, other)) {
                tree.exclude(walk, other);
            }
        }
        tell_triangles();
        for (const auto& walks : world_.forbidden) {
            if (std::find(walks.begin(), walks.end(), walk) != walks.end()) {
                forbidden_.insert(walks);
            }
        }
        for (const auto& walks : forbidden_) {
            tree.forbid(walks);  // nothing happens while one of them is not known
        }
        tree.add_bound(e, {}, rest_cost(e, {}));
        std::vector<Index> blockers;
        for (Index other = 0; other < world_.walk_count(); other += 3) {
            if (World::edge(other) != e && tree.knows(other)) {
                const Index one[] = {other};
                tree.add_bound(e, one, rest_cost(e, one));
                if (blockers.empty() || World::edge(blockers.back()) != World::edge(other)) {
                    blockers.push_back(other);
                }
            }
        }
        if (blockers.size() > 1) {
            blockers.resize(2);
            tree.add_bound(e, blockers, rest_cost(e, blockers));
        }
    }

    ChoiceTree tree;

private:
    Length rest_cost(Index e, std::span<const Index> blockers) const
    {
        for (Index c = known_[e]; c < World::kClasses; ++c) {
            const Index walk = World::walk(e, c);
            if (std::none_of(blockers.begin(), blockers.end(),
                             [&](Index other) { return world_.exclude(walk, other); })) {
                return world_.costs[walk];
            }
        }
        return kInfiniteLength;
    }

    /// All tuples anew but for those that are there.
    void tell_triangles()
    {
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            std::set<std::array<Index, 3>> tuples;
            const auto& edges = world_.triangles[t];
            for (int k = 0; k < 3; ++k) {
                for (Index c = 0; c < known_[edges[k]]; ++c) {
                    std::array<Index, 3> alone{kNone, kNone, kNone};
                    alone[k] = World::walk(edges[k], c);
                    tuples.insert(alone);
                }
            }
            for (Index a = 0; a < World::kClasses; ++a) {
                for (Index b = 0; b < World::kClasses; ++b) {
                    const std::array<Index, 3> walks{
                        World::walk(edges[0], a), World::walk(edges[1], b),
                        world_.completion(t, World::walk(edges[0], a), World::walk(edges[1], b))};
                    std::array<Index, 3> tuple = walks;
                    for (int k = 0; k < 3; ++k) {
                        if (walks[k] != kNone && walks[k] % World::kClasses >= known_[edges[k]]) {
                            tuple[k] = kNone;
                        }
                    }
                    if (walks[2] != kNone) {
                        tuples.insert(tuple);
                    }
                }
            }
            std::erase_if(tuples, [&](const auto& tuple) {
                return std::any_of(tuple.begin(), tuple.end(),
                                   [&](Index walk) { return walk != kNone && !tree.knows(walk); });
            });
            auto& told = told_[t];
            for (auto it = told.begin(); it != told.end();) {
                if (tuples.count(it->first) == 0) {
                    tree.remove_tuple(triangles_[t], it->second);
                    it = told.erase(it);
                } else {
                    ++it;
                }
            }
            for (const auto& tuple : tuples) {
                if (told.count(tuple) == 0) {
                    told[tuple] = tree.add_tuple(triangles_[t], tuple);
                }
            }
        }
    }

    const World& world_;
    std::vector<Index> known_;  // classes per edge
    std::vector<Index> triangles_;
    std::map<std::size_t, std::map<std::array<Index, 3>, Index>> told_;
    std::set<std::vector<Index>> forbidden_;
};

TEST(ChoiceTree, finds_the_cheapest_choice_while_classes_become_known)
{
    Random random(401);
    int found = 0;
    int impossible = 0;
    std::uint64_t nodes = 0;
    std::uint64_t ruled_out = 0;
    int wishes = 0;
    for (int round = 0; round < 400; ++round) {
        SCOPED_TRACE(round);
        const World world(random, 3 + static_cast<Index>(random.below(5)));
        const Length best = world.best();
        const Length upper = random.below(3) == 0 && best != kInfiniteLength
                                 ? best + 1 + random.below(1000)
                                 : Length{1} << 24U;
        Teller teller(world, upper);
        const Length limit = std::min(best, upper);
        for (;;) {
            WorkBudget budget(random.below(2) == 0 ? 1 : 100'000);
            const auto outcome = teller.tree.run(budget);
            ASSERT_LE(teller.tree.lower_bound(), limit);
            std::vector<Index> walks;
            std::vector<Index> rests;
            teller.tree.take_ruled_out(walks, rests);
            ruled_out += walks.size() + rests.size();
            if (outcome == ChoiceTree::Outcome::exceeded) {
                EXPECT_GE(best, upper);
                ++impossible;
                break;
            }
            if (outcome == ChoiceTree::Outcome::wants_classes) {
                ++wishes;
                ASSERT_FALSE(teller.tree.wanted().empty());
                for (const Index e : teller.tree.wanted()) {
                    ASSERT_FALSE(teller.knows_all(e)) << "there are no other classes";
                }
                if (random.below(2) == 0) {
                    teller.tell_next(teller.tree.wanted().front());
                }
                continue;
            }
            if (outcome != ChoiceTree::Outcome::satisfied &&
                outcome != ChoiceTree::Outcome::optimal) {
                continue;
            }
            Length cost = 0;
            std::vector<Index> chosen;
            std::vector<Index> open;
            for (Index e = 0; e < world.edges; ++e) {
                const Index walk = teller.tree.choice(e);
                if (walk == kNone) {
                    open.push_back(e);
                } else {
                    cost += world.costs[walk];
                    chosen.push_back(walk);
                }
            }
            if (open.empty()) {
                std::vector<Index> so_far;
                for (const Index walk : chosen) {
                    so_far.push_back(walk);
                    EXPECT_TRUE(world.is_allowed(so_far));
                }
                EXPECT_GE(cost, best);
                if (outcome == ChoiceTree::Outcome::optimal) {
                    EXPECT_EQ(cost, best);
                    ++found;
                    break;
                }
                continue;
            }
            if (outcome == ChoiceTree::Outcome::optimal || random.below(4) == 0) {
                const auto some = std::find_if(open.begin(), open.end(),
                                               [&](Index e) { return !teller.knows_all(e); });
                ASSERT_NE(some, open.end()) << "a rest without classes was chosen";
                teller.tell_next(*some);
            }
        }
        nodes += teller.tree.node_count();
    }
    EXPECT_GT(found, 150);
    EXPECT_GT(impossible, 20);
    EXPECT_GT(nodes, 3000U);
    EXPECT_GT(ruled_out, 100U);
    EXPECT_GT(wishes, 100);
}

TEST(ChoiceTree, wants_classes_once_of_edges_whose_rest_it_takes)
{
    ChoiceTree tree(2, 1'000'000);
    tree.add_class(0, 0, 5000);
    tree.add_class(1, 1, 100);
    tree.add_bound(1, {}, 200'000);  // dearer than the class
    int wishes = 0;
    for (;;) {
        WorkBudget budget(1000);
        const auto outcome = tree.run(budget);
        if (outcome == ChoiceTree::Outcome::wants_classes) {
            ++wishes;
            EXPECT_EQ(tree.wanted(), std::vector<Index>{0});
        }
        if (outcome == ChoiceTree::Outcome::optimal) {
            break;
        }
    }
    EXPECT_EQ(wishes, 1);
    EXPECT_EQ(tree.choice(0), kNone);
    EXPECT_EQ(tree.choice(1), 1U);
    EXPECT_EQ(tree.lower_bound(), 100U);

    tree.expect_news();
    tree.add_bound(0, {}, 6000);
    for (auto outcome = ChoiceTree::Outcome::running; outcome != ChoiceTree::Outcome::optimal;) {
        WorkBudget budget(1000);
        outcome = tree.run(budget);
        EXPECT_NE(outcome, ChoiceTree::Outcome::wants_classes);
    }
    EXPECT_EQ(tree.choice(0), 0U);
    EXPECT_EQ(tree.lower_bound(), 5100U);
}

TEST(ChoiceTree, an_upper_bound_that_falls_ends_it)
{
    Random random(402);
    int ended = 0;
    for (int round = 0; round < 60; ++round) {
        const World world(random, 5);
        const Length best = world.best();
        if (best == kInfiniteLength || best == 0) {
            continue;
        }
        Teller teller(world, Length{1} << 24U);
        for (Index e = 0; e < world.edges; ++e) {
            while (!teller.knows_all(e)) {
                teller.tell_next(e);
            }
        }
        teller.tree.lower_upper_bound(best);
        WorkBudget budget;
        auto outcome = ChoiceTree::Outcome::raised;
        while (outcome == ChoiceTree::Outcome::raised) {
            outcome = teller.tree.run(budget);
        }
        EXPECT_EQ(outcome, ChoiceTree::Outcome::exceeded);
        EXPECT_EQ(teller.tree.lower_bound(), best);
        ++ended;
    }
    EXPECT_GT(ended, 20);
}

}  // namespace
}  // namespace layout_embedding
