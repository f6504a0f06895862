#include "surface/class_enumeration.hh"

#include <algorithm>
#include <gtest/gtest.h>

#include "instances.hh"
#include "search_ground.hh"
#include "zoo.hh"

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

/// A layout vertex that is no end of the edge.
Index root_for(const Layout& layout, Index edge)
{
    Index v = 0;
    while (v == layout.tail(2 * edge) || v == layout.head(2 * edge)) {
        ++v;
    }
    return v;
}

using Walks = std::vector<std::pair<Length, std::vector<Index>>>;

/// The simple classes below a limit, at most so many.
Walks enumerate(ClassEnumeration& enumeration, const CutSystem& cuts, Index edge, Length limit,
                std::size_t most, std::uint64_t slice = UINT64_MAX)
{
    Walks walks;
    enumeration.begin(cuts, edge, limit);
    while (walks.size() < most) {
        const auto outcome = enumeration.run(slice);
        EXPECT_NE(outcome, ClassEnumeration::Outcome::tied);
        if (outcome == ClassEnumeration::Outcome::exceeded) {
            EXPECT_EQ(enumeration.frontier(), limit);
            break;
        }
        if (outcome == ClassEnumeration::Outcome::found) {
            EXPECT_GE(enumeration.frontier(), enumeration.cost());
            walks.emplace_back(enumeration.cost(), enumeration.darts());
        }
    }
    return walks;
}

/// Expects the same simple classes of some edges whatever the root; how many in all.
std::size_t expect_independent_of_cuts(const Instance& instance, const std::vector<Index>& roots)
{
    SCOPED_TRACE(instance.name);
    SearchGround ground(instance.problem, 1);
    const Layout& layout = ground.strands.layout();
    const auto nodes = landmark_nodes(ground.strands);
    std::size_t classes = 0;
    for (Index e = 0; e < layout.edge_count(); e += 3) {
        ground.search.begin(e);
        EXPECT_EQ(ground.search.run(), CutSurfaceSearch::Outcome::found);
        const Length shortest = ground.search.cost();
        std::vector<Walks> found;
        for (const Index root : roots) {
            if (root == layout.tail(2 * e) || root == layout.head(2 * e)) {
                continue;
            }
            const CutSystem cuts(ground.graph, nodes, root);
            ClassEnumeration enumeration(ground.strands, ground.fields);
            found.push_back(enumerate(enumeration, cuts, e, 5 * shortest / 2, 20,
                                      found.empty() ? UINT64_MAX : 50));
            EXPECT_FALSE(found.back().empty());
            EXPECT_EQ(found.back().front().first, shortest);
            EXPECT_EQ(found.back(), found.front());
        }
        for (const auto& [cost, darts] : found.front()) {
            Length length = 0;
            for (const Index d : darts) {
                length += ground.graph.dart(d).length;
            }
            EXPECT_EQ(length, cost);
            EXPECT_FALSE(walk_crosses_itself(ground.graph, darts));
        }
        EXPECT_TRUE(std::is_sorted(found.front().begin(), found.front().end(),
                                   [](const auto& a, const auto& b) { return a.first < b.first; }));
        classes += found.front().size();
    }
    return classes;
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
    for (const Instance& instance : random_instances(41, 12)) {
        const Index last = instance.problem.layout->vertex_count() - 1;
        classes += expect_independent_of_cuts(instance, {0, 1, 2, last});
    }
    EXPECT_GT(classes, 300U);
}

TEST(ClassEnumeration, does_not_depend_on_the_cuts_on_surfaces_of_higher_genus)
{
    std::size_t classes = 0;
    const auto count = [&](const std::string& name, const PolygonMesh& layout,
                           const PolygonMesh& target, std::uint64_t seed) {
        const Instance instance{
            name, test::problem_of(layout, target,
                                   zoo::random_landmarks(
                                       target, static_cast<Index>(layout.positions.size()), seed))};
        classes += expect_independent_of_cuts(instance, {0, 1, 2, 3});
    };
    count("torus", zoo::quad_torus(3, 3), zoo::torus(9, 7), 5);
    count("torus again", zoo::torus(3, 3), zoo::torus(8, 8), 6);
    count("two handles", zoo::slab(2, 0), zoo::slab(2, 1), 7);
    EXPECT_GT(classes, 150U);
}

TEST(ClassEnumeration, does_not_depend_on_the_cuts_on_surfaces_with_holes)
{
    // The root is a hole, or one of the landmarks inside.
    std::size_t classes = 0;
    for (const std::uint64_t seed : {3U, 4U, 5U}) {
        const PolygonMesh layout = zoo::quad_grid(2, 2);
        const PolygonMesh target = zoo::grid_disk(7, 6);
        const Instance instance{
            "disk",
            test::problem_of(layout, target, zoo::displaced_landmarks(layout, target, 0.3, seed))};
        std::vector<Index> roots{kNone};
        for (Index v = 0; v < instance.problem.layout->vertex_count() && roots.size() < 3; ++v) {
            if (!instance.problem.target->is_boundary_vertex(instance.problem.landmarks[v])) {
                roots.push_back(v);
            }
        }
        classes += expect_independent_of_cuts(instance, roots);
    }
    EXPECT_GT(classes, 25U);
}

TEST(ClassEnumeration, every_strand_is_the_shortest_walk_of_a_simple_class)
{
    Random random(42);
    int detours = 0;
    for (const Instance& instance : random_instances(42, 12)) {
        SCOPED_TRACE(instance.name);
        SearchGround ground(instance.problem, 1);
        SearchGround empty(instance.problem, 1);
        const Layout& layout = ground.strands.layout();
        const auto nodes = landmark_nodes(ground.strands);
        for (const Index e : test::random_tree_first_order(layout, random)) {
            ground.search.begin(e);
            ASSERT_EQ(ground.search.run(), CutSurfaceSearch::Outcome::found);
            const auto darts = ground.search.darts();
            const Length cost = ground.search.cost();
            const CutSystem cuts(ground.graph, nodes, root_for(layout, e));
            // In the surface cut open along what is embedded it is the first of all.
            ClassEnumeration beside(ground.strands, ground.fields);
            const auto first = enumerate(beside, cuts, e, kInfiniteLength, 1);
            ASSERT_EQ(first.size(), 1U);
            EXPECT_EQ(first.front(), std::pair(cost, darts));
            for (const Index blocker : beside.blockers()) {
                EXPECT_TRUE(ground.strands.is_embedded(blocker));
            }
            ASSERT_TRUE(ground.strands.insert(e, darts));
            EXPECT_FALSE(walk_crosses_itself(ground.graph, darts));
            ClassEnumeration enumeration(empty.strands, empty.fields);
            const auto walks = enumerate(enumeration, cuts, e, cost + 1, 400);
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
