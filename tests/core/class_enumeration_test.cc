#include "surface/class_enumeration.hh"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

#include "instances.hh"
#include "search_ground.hh"

namespace layout_embedding {
namespace {

using test::Instance;
using test::random_instances;
using test::SearchGround;

std::vector<Index> landmark_nodes(const Strands& strands)
{
    std::vector<Index> nodes;
    for (Index v = 0; v < strands.layout().vertex_count(); ++v) {
        nodes.push_back(strands.landmark_node(v));
    }
    return nodes;
}

/// A layout vertex that is no end of the edge, counted from the first or the last.
Index root_for(const Layout& layout, Index edge, bool last)
{
    for (Index i = 0;; ++i) {
        const Index v = last ? layout.vertex_count() - 1 - i : i;
        if (v != layout.tail(2 * edge) && v != layout.head(2 * edge)) {
            return v;
        }
    }
}

using Walks = std::vector<std::pair<Length, std::vector<Index>>>;

/// The classes below a limit, at most so many.
Walks enumerate(ClassEnumeration& enumeration, Length limit, std::size_t most,
                std::uint64_t slice = UINT64_MAX)
{
    Walks walks;
    while (walks.size() < most) {
        const auto outcome = enumeration.run(limit, slice);
        EXPECT_NE(outcome, ClassEnumeration::Outcome::tied);
        if (outcome == ClassEnumeration::Outcome::exceeded) {
            EXPECT_GE(enumeration.frontier(), limit);
            break;
        }
        if (outcome == ClassEnumeration::Outcome::found) {
            EXPECT_GE(enumeration.frontier(), enumeration.cost());
            walks.emplace_back(enumeration.cost(), enumeration.darts());
        }
    }
    return walks;
}

TEST(Words, are_reduced)
{
    Words words;
    const Index ab = words.times(words.times(Words::kEmpty, 1), 2);
    EXPECT_EQ(words.last(ab), 2);
    EXPECT_EQ(words.times(words.times(ab, -2), -1), Words::kEmpty);
    EXPECT_EQ(words.times(words.times(Words::kEmpty, 1), 2), ab);
    EXPECT_NE(words.times(words.times(Words::kEmpty, 2), 1), ab);
    EXPECT_NE(words.times(ab, 2), words.times(ab, 1));
}

TEST(ClassEnumeration, begins_with_the_shortest_path_and_does_not_depend_on_the_cuts)
{
    std::size_t classes = 0;
    std::size_t not_simple = 0;
    for (const Instance& instance : random_instances(41, 20)) {
        SCOPED_TRACE(instance.name);
        SearchGround ground(instance.problem, 1);
        const Layout& layout = ground.strands.layout();
        const auto nodes = landmark_nodes(ground.strands);
        for (Index e = 0; e < layout.edge_count(); e += 3) {
            ground.search.begin(e);
            ASSERT_EQ(ground.search.run(), CutSurfaceSearch::Outcome::found);
            const Length shortest = ground.search.cost();
            Walks walks[2];
            for (const bool last : {false, true}) {
                const CutSystem cuts(ground.graph, nodes, root_for(layout, e, last));
                ClassEnumeration enumeration(ground.strands, ground.fields, cuts, e);
                walks[last ? 1 : 0] =
                    enumerate(enumeration, 3 * shortest, 25, last ? UINT64_MAX : 50);
            }
            ASSERT_FALSE(walks[0].empty());
            EXPECT_EQ(walks[0].front().first, shortest);
            EXPECT_EQ(walks[0].front().second, ground.search.darts());
            EXPECT_TRUE(
                std::is_sorted(walks[0].begin(), walks[0].end(),
                               [](const auto& a, const auto& b) { return a.first < b.first; }));
            EXPECT_EQ(walks[0], walks[1]);
            classes += walks[0].size();
            for (const auto& [cost, darts] : walks[0]) {
                Length length = 0;
                for (const Index d : darts) {
                    length += ground.graph.dart(d).length;
                }
                EXPECT_EQ(length, cost);
                not_simple += walk_crosses_itself(ground.graph, darts) ? 1 : 0;
            }
        }
    }
    EXPECT_GT(classes, 800U);
    EXPECT_GT(not_simple, 30U);
    EXPECT_LT(not_simple, classes / 2);
}

TEST(ClassEnumeration, every_strand_is_the_shortest_walk_of_a_simple_class)
{
    Random random(42);
    int detours = 0;
    for (const Instance& instance : random_instances(42, 12)) {
        SCOPED_TRACE(instance.name);
        SearchGround ground(instance.problem, 1);
        const Layout& layout = ground.strands.layout();
        const auto nodes = landmark_nodes(ground.strands);
        for (const Index e : test::random_tree_first_order(layout, random)) {
            ground.search.begin(e);
            ASSERT_EQ(ground.search.run(), CutSurfaceSearch::Outcome::found);
            const auto darts = ground.search.darts();
            const Length cost = ground.search.cost();
            ASSERT_TRUE(ground.strands.insert(e, darts));
            EXPECT_FALSE(walk_crosses_itself(ground.graph, darts));
            const CutSystem cuts(ground.graph, nodes, root_for(layout, e, false));
            ClassEnumeration enumeration(ground.strands, ground.fields, cuts, e);
            const auto walks = enumerate(enumeration, cost + 1, 400);
            if (walks.size() == 400) {
                continue;
            }
            ASSERT_FALSE(walks.empty());
            EXPECT_EQ(walks.back().first, cost);
            // Two classes may tie, robustly: a walk that turns around something this way or that.
            EXPECT_NE(std::find(walks.begin(), walks.end(), std::pair(cost, darts)), walks.end());
            detours += walks.size() > 1 ? 1 : 0;
        }
    }
    EXPECT_GT(detours, 20);
}

}  // namespace
}  // namespace layout_embedding
