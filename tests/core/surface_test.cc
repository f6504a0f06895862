#include <gtest/gtest.h>
#include <map>
#include <queue>

#include "instances.hh"
#include "search_ground.hh"
#include "surface/conflicts.hh"
#include "surface/path_metric.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

using test::Instance;
using test::random_instances;
using test::random_order;
using test::random_tree_first_order;
using test::SearchGround;
using Outcome = CutSurfaceSearch::Outcome;

/// The shortest walk for an edge, kInfiniteLength if it is blocked.
Length shortest(SearchGround& ground, Index edge)
{
    ground.search.begin(edge);
    const Outcome outcome = ground.search.run();
    EXPECT_NE(outcome, Outcome::tied);
    EXPECT_NE(outcome, Outcome::running);
    return ground.search.cost();
}

Length length_of(const PathGraph& graph, const std::vector<Index>& darts)
{
    Length sum = 0;
    for (const Index dart : darts) {
        sum += graph.dart(dart).length;
    }
    return sum;
}

/// Inserts up to `count` edges of a random order along their shortest walks.
void insert_some(SearchGround& ground, const std::vector<Index>& order, std::size_t count)
{
    for (std::size_t i = 0; i < count; ++i) {
        if (shortest(ground, order[i]) != kInfiniteLength) {
            ASSERT_TRUE(ground.strands.insert(order[i], ground.search.darts()));
        }
    }
}

std::vector<CandidateWalk> candidates_of(SearchGround& ground)
{
    std::vector<CandidateWalk> candidates;
    for (Index e = 0; e < ground.strands.layout().edge_count(); ++e) {
        if (!ground.strands.is_embedded(e) && shortest(ground, e) != kInfiniteLength) {
            candidates.push_back({e, ground.search.darts()});
        }
    }
    return candidates;
}

TEST(PathGraph, darts_around_a_node_are_counter_clockwise_faces_of_the_subdivision)
{
    // Following "twin, then next dart clockwise" walks around one triangle of the subdivision.
    for (const Instance& instance : random_instances(1, 6)) {
        const PathGraph graph = PathGraph::barycentric(*instance.problem.target);
        Index triangles = 0;
        for (Index d = 0; d < graph.dart_count(); ++d) {
            Index walked = d;
            Index steps = 0;
            do {
                const Index node = graph.head(walked);
                const Index back = graph.twin(walked) - graph.first_dart(node);
                const Index degree = graph.degree(node);
                walked = graph.first_dart(node) + (back + degree - 1) % degree;
                ++steps;
            } while (walked != d && steps < 4);
            EXPECT_EQ(steps, 3U) << instance.name;
            ++triangles;
        }
        EXPECT_EQ(triangles, 3 * 6 * instance.problem.target->face_count());
    }
}

TEST(PathGraph, lengths_are_euclidean_up_to_the_perturbation)
{
    for (const Instance& instance : random_instances(2, 4)) {
        const PathGraph graph = PathGraph::barycentric(*instance.problem.target);
        for (Index d = 0; d < graph.dart_count(); ++d) {
            const double distance =
                (graph.position(graph.tail(d)) - graph.position(graph.head(d))).norm();
            EXPECT_NEAR(graph.to_units(graph.dart(d).length), distance,
                        0x1.0p30 * 3 * graph.unit());
            EXPECT_EQ(graph.dart(d).length, graph.dart(graph.twin(d)).length);
        }
    }
}

TEST(PathGraph, lengths_are_what_length_costs_where_it_lies)
{
    const PolygonMesh ground = zoo::subdivided(zoo::triangulated(zoo::cube()));
    const TriangleMesh cube(ground);
    std::vector<double> vertex_costs;
    for (Index v = 0; v < cube.vertex_count(); ++v) {
        vertex_costs.push_back(0.5 + v);
    }
    const std::vector<double> edge_costs = feature_costs(cube, 0.75);
    const PathGraph graph = PathGraph::barycentric(cube, {1, 0, vertex_costs, edge_costs});
    const auto cost = [&](Index node) {
        const auto [kind, id] = graph.element(node);
        if (kind == NodeKind::vertex) {
            return vertex_costs[id];
        }
        if (kind == NodeKind::edge_midpoint) {
            const Index h = cube.halfedge(id);
            return (vertex_costs[cube.tail(h)] + vertex_costs[cube.head(h)]) / 2;
        }
        const auto [a, b, c] = cube.face(id);
        return (vertex_costs[a] + vertex_costs[b] + vertex_costs[c]) / 3;
    };
    int sharp = 0;
    for (Index d = 0; d < graph.dart_count(); ++d) {
        const Index a = graph.tail(d);
        const Index b = graph.head(d);
        double wanted = (graph.position(a) - graph.position(b)).norm() * (cost(a) + cost(b)) / 2;
        // Along the cube's edges two coordinates are extreme at both ends.
        const Vec3 size = graph.position(a).cwiseAbs();
        const double most = graph.position(graph.node_of_vertex(0)).cwiseAbs().maxCoeff();
        int extreme = 0;
        for (int axis = 0; axis < 3; ++axis) {
            extreme += size[axis] > 0.999 * most &&
                               std::abs(graph.position(b)[axis] - graph.position(a)[axis]) < 1e-9
                           ? 1
                           : 0;
        }
        if (extreme == 2) {
            wanted *= 0.25;
            ++sharp;
        }
        EXPECT_NEAR(graph.to_units(graph.dart(d).length), wanted, 0x1.0p30 * 3 * graph.unit());
    }
    EXPECT_EQ(sharp, 12 * 2 * 2 * 2);  // edges, halves, halves of these, directions
}

TEST(PathGraph, other_attempts_and_seeds_draw_other_lengths)
{
    const Instance instance = random_instances(3, 1)[0];
    const auto length = [&](std::uint64_t seed, std::uint32_t attempt) {
        return PathGraph::barycentric(*instance.problem.target, {seed, attempt}).dart(0).length;
    };
    EXPECT_EQ(length(1, 0), length(1, 0));
    EXPECT_NE(length(1, 0), length(1, 1));
    EXPECT_NE(length(1, 0), length(2, 0));
}

TEST(DistanceField, bounds_are_admissible_and_consistent_at_every_radius)
{
    for (const Instance& instance : random_instances(4, 6)) {
        const PathGraph graph = PathGraph::barycentric(*instance.problem.target);
        const Strands strands(instance.problem, graph);
        const Index source = strands.landmark_node(0);

        // Exact distances by plain Dijkstra.
        std::vector<Length> exact(graph.node_count(), kInfiniteLength);
        std::priority_queue<std::pair<Length, Index>, std::vector<std::pair<Length, Index>>,
                            std::greater<>>
            queue;
        exact[source] = 0;
        queue.emplace(0, source);
        while (!queue.empty()) {
            const auto [distance, node] = queue.top();
            queue.pop();
            if (distance > exact[node] || (node != source && !strands.passable()[node])) {
                continue;
            }
            for (Index d = graph.first_dart(node); d < graph.first_dart(node + 1); ++d) {
                if (distance + graph.dart(d).length < exact[graph.head(d)]) {
                    exact[graph.head(d)] = distance + graph.dart(d).length;
                    queue.emplace(exact[graph.head(d)], graph.head(d));
                }
            }
        }

        DistanceField field(graph, strands.passable(), source);
        const Length diagonal = Length{1} << 54U;
        for (Index goal = 1; goal < strands.layout().vertex_count(); ++goal) {
            // By turns to the goal, and as far as walks of one and a half times its distance come.
            const Length distance = exact[strands.landmark_node(goal)];
            const Length limit = goal % 2 == 0 ? distance + distance / 2 : 0;
            field.extend_to(strands.landmark_node(goal), limit);
            for (Index node = 0; node < graph.node_count(); ++node) {
                EXPECT_LE(field.bound(node), exact[node]);
                if (2 * exact[node] < distance + limit) {
                    EXPECT_NEAR(static_cast<double>(field.bound(node)),
                                static_cast<double>(exact[node]),
                                1e-5 * static_cast<double>(diagonal));
                }
                if (node != source && !strands.passable()[node]) {
                    continue;
                }
                for (Index d = graph.first_dart(node); d < graph.first_dart(node + 1); ++d) {
                    EXPECT_LE(field.bound(graph.head(d)), field.bound(node) + graph.dart(d).length);
                }
            }
            // And sharp where the field has been grown to.
            EXPECT_NEAR(static_cast<double>(field.bound(strands.landmark_node(goal))),
                        static_cast<double>(exact[strands.landmark_node(goal)]),
                        1e-5 * static_cast<double>(diagonal));
        }
    }
}

TEST(DistanceField, dropping_fields_changes_no_walk)
{
    for (const Instance& instance : random_instances(5, 4)) {
        const PathGraph graph = PathGraph::barycentric(*instance.problem.target);
        const Strands strands(instance.problem, graph);
        DistanceFields plenty(graph, strands.passable(), std::uint64_t{1} << 30U);
        DistanceFields one(graph, strands.passable(), 1);
        CutSurfaceSearch a(strands, plenty);
        CutSurfaceSearch b(strands, one);
        for (Index e = 0; e < strands.layout().edge_count(); ++e) {
            a.begin(e);
            b.begin(e);
            ASSERT_EQ(a.run(), Outcome::found);
            ASSERT_EQ(b.run(), Outcome::found);
            EXPECT_EQ(a.darts(), b.darts());
        }
        EXPECT_GT(one.settled_count(), plenty.settled_count());
    }
}

TEST(CutSurfaceSearch, after_a_spanning_tree_every_edge_finds_a_walk_that_traces)
{
    Random random(6);
    for (const Instance& instance : random_instances(6, 30)) {
        SearchGround ground(instance.problem, 1);
        for (const Index e : random_tree_first_order(ground.strands.layout(), random)) {
            ASSERT_NE(shortest(ground, e), kInfiniteLength) << instance.name;
            const auto darts = ground.search.darts();
            EXPECT_EQ(length_of(ground.graph, darts), ground.search.cost());
            EXPECT_EQ(ground.graph.tail(darts.front()),
                      ground.strands.landmark_node(ground.strands.layout().tail(2 * e)));
            EXPECT_EQ(ground.graph.head(darts.back()),
                      ground.strands.landmark_node(ground.strands.layout().head(2 * e)));
            EXPECT_TRUE(ground.strands.trace(e, darts)) << instance.name;
            EXPECT_TRUE(ground.strands.insert(e, darts));
        }
    }
}

TEST(CutSurfaceSearch, slicing_a_search_changes_nothing)
{
    for (const Instance& instance : random_instances(7, 5)) {
        SearchGround whole(instance.problem, 1);
        SearchGround sliced(instance.problem, 1);
        for (Index e = 0; e < whole.strands.layout().edge_count(); ++e) {
            shortest(whole, e);
            sliced.search.begin(e);
            while (sliced.search.run(3) == Outcome::running) {
            }
            EXPECT_EQ(whole.search.darts(), sliced.search.darts());
            EXPECT_EQ(whole.search.cost(), sliced.search.cost());
        }
        EXPECT_EQ(whole.search.expansion_count(), sliced.search.expansion_count());
    }
}

TEST(CutSurfaceSearch, inserting_a_strand_never_shortens_another_path)
{
    Random random(8);
    int lengthened = 0;
    for (const Instance& instance : random_instances(8, 20)) {
        SearchGround ground(instance.problem, 1);
        const Index edges = ground.strands.layout().edge_count();
        std::vector<Length> costs(edges);
        for (Index e = 0; e < edges; ++e) {
            costs[e] = shortest(ground, e);
        }
        for (const Index inserted : random_tree_first_order(ground.strands.layout(), random)) {
            ASSERT_NE(shortest(ground, inserted), kInfiniteLength) << instance.name;
            ASSERT_TRUE(ground.strands.insert(inserted, ground.search.darts()));
            for (Index e = 0; e < edges; ++e) {
                if (!ground.strands.is_embedded(e)) {
                    const Length cost = shortest(ground, e);
                    EXPECT_GE(cost, costs[e]);
                    lengthened += cost > costs[e] ? 1 : 0;
                    costs[e] = cost;
                }
            }
        }
    }
    EXPECT_GT(lengthened, 100);
}

TEST(CutSurfaceSearch, equal_lengths_are_reported_as_a_tie)
{
    for (const Instance& instance : random_instances(9, 10)) {
        // All edges of the path graph equally long: walks of equal length are everywhere.
        PathGraph graph = PathGraph::barycentric(*instance.problem.target);
        std::vector<Length> ones(graph.dart_count(), Length{1} << 40U);
        graph.set_lengths(ones);
        const Strands strands(instance.problem, graph);
        DistanceFields fields(graph, strands.passable(), std::uint64_t{1} << 30U);
        CutSurfaceSearch search(strands, fields);
        int ties = 0;
        for (Index e = 0; e < strands.layout().edge_count(); ++e) {
            search.begin(e);
            ties += search.run() == Outcome::tied ? 1 : 0;
        }
        EXPECT_GT(ties, 0) << instance.name;
    }
}

TEST(Strands, undo_restores_the_cut_surface)
{
    Random random(10);
    for (const Instance& instance : random_instances(10, 15)) {
        SearchGround walked(instance.problem, 1);
        SearchGround fresh(instance.problem, 1);
        const Index edges = walked.strands.layout().edge_count();
        const auto order = random_order(edges, random);
        insert_some(fresh, order, edges / 2);
        insert_some(walked, order, edges / 2);
        // Not simply the first half of the order: blocked edges are left out.
        const std::vector<Index> inserted = fresh.strands.insertion_order();
        // Up and down again, several times, to other depths along other orders.
        for (int round = 0; round < 5; ++round) {
            const std::size_t kept = random.below(inserted.size());
            while (walked.strands.insertion_order().size() > kept) {
                walked.strands.undo();
            }
            for (const Index e : random_order(edges, random)) {
                if (!walked.strands.is_embedded(e) && shortest(walked, e) != kInfiniteLength) {
                    ASSERT_TRUE(walked.strands.insert(e, walked.search.darts()));
                }
            }
            while (walked.strands.insertion_order().size() > kept) {
                walked.strands.undo();
            }
            for (std::size_t i = kept; i < inserted.size(); ++i) {
                ASSERT_NE(shortest(walked, inserted[i]), kInfiniteLength);
                ASSERT_TRUE(walked.strands.insert(inserted[i], walked.search.darts()));
            }
        }
        EXPECT_EQ(walked.strands.state_bound(), fresh.strands.state_bound());
        const auto a = walked.strands.weak_embedding();
        const auto b = fresh.strands.weak_embedding();
        for (Index e = 0; e < edges; ++e) {
            EXPECT_EQ(a.paths[e].darts, b.paths[e].darts);
            EXPECT_EQ(a.paths[e].lanes, b.paths[e].lanes);
            if (!fresh.strands.is_embedded(e)) {
                EXPECT_EQ(shortest(walked, e), shortest(fresh, e));
            }
        }
    }
}

TEST(Strands, a_walk_that_is_in_the_way_is_refused_without_a_trace)
{
    Random random(11);
    int refused = 0;
    for (const Instance& instance : random_instances(11, 10)) {
        SearchGround ground(instance.problem, 1);
        const auto candidates = candidates_of(ground);
        for (const CandidateWalk& candidate : candidates) {
            const Index before = ground.strands.state_bound();
            const auto strands = ground.strands.insertion_order().size();
            if (!ground.strands.insert(candidate.layout_edge, candidate.darts)) {
                ++refused;
                EXPECT_EQ(ground.strands.state_bound(), before);
                EXPECT_EQ(ground.strands.insertion_order().size(), strands);
                EXPECT_FALSE(ground.strands.is_embedded(candidate.layout_edge));
            }
        }
    }
    EXPECT_GT(refused, 10);
}

TEST(Conflicts, two_candidates_conflict_exactly_if_one_stops_tracing_after_the_other)
{
    Random random(12);
    int conflicts_seen = 0;
    int touching = 0;
    for (const Instance& instance : random_instances(12, 90)) {
        SearchGround ground(instance.problem, 1);
        const Index edges = ground.strands.layout().edge_count();
        insert_some(ground, random_order(edges, random), random.below(edges - 1));
        const auto candidates = candidates_of(ground);
        const auto conflicts = find_conflicts(ground.strands, candidates);
        std::map<std::pair<Index, Index>, bool> found;
        for (const auto& pair : conflicts.pairs) {
            found[pair] = true;
        }
        for (Index a = 0; a < candidates.size(); ++a) {
            ASSERT_TRUE(ground.strands.insert(candidates[a].layout_edge, candidates[a].darts));
            for (Index b = 0; b < candidates.size(); ++b) {
                if (a == b) {
                    continue;
                }
                const bool traces =
                    ground.strands.trace(candidates[b].layout_edge, candidates[b].darts)
                        .has_value();
                const bool conflict = found.count(std::minmax(a, b)) != 0;
                EXPECT_EQ(!traces, conflict)
                    << instance.name << ": edges " << candidates[a].layout_edge << " and "
                    << candidates[b].layout_edge;
                conflicts_seen += conflict ? 1 : 0;
                touching += traces ? 1 : 0;
            }
            ground.strands.undo();
        }
    }
    EXPECT_GT(conflicts_seen, 500);
    EXPECT_GT(touching, 500);
}

TEST(Conflicts, candidates_without_conflict_can_be_inserted_in_any_order)
{
    Random random(13);
    int rounds = 0;
    for (const Instance& instance : random_instances(13, 60)) {
        SearchGround ground(instance.problem, 1);
        const Index edges = ground.strands.layout().edge_count();
        insert_some(ground, random_order(edges, random), random.below(edges - 1));
        const auto candidates = candidates_of(ground);
        const auto conflicts = find_conflicts(ground.strands, candidates);
        std::vector<bool> clean(candidates.size(), true);
        for (const auto& [a, b] : conflicts.pairs) {
            clean[a] = clean[b] = false;
        }
        for (const auto& triple : conflicts.triples) {
            for (const Index c : triple) {
                clean[c] = false;
            }
        }
        for (int round = 0; round < 3; ++round) {
            std::size_t inserted = 0;
            for (const Index c : random_order(static_cast<Index>(candidates.size()), random)) {
                if (clean[c]) {
                    EXPECT_TRUE(
                        ground.strands.insert(candidates[c].layout_edge, candidates[c].darts))
                        << instance.name;
                    ++inserted;
                }
            }
            rounds += inserted > 1 ? 1 : 0;
            for (; inserted > 0; --inserted) {
                ground.strands.undo();
            }
        }
    }
    EXPECT_GT(rounds, 50);
}

TEST(Conflicts, of_a_wrong_triple_any_two_go_but_not_all_three)
{
    int triples = 0;
    for (const Instance& instance : random_instances(14, 80)) {
        SearchGround ground(instance.problem, 1);
        const auto candidates = candidates_of(ground);
        const auto conflicts = find_conflicts(ground.strands, candidates);
        std::map<std::pair<Index, Index>, bool> pairs;
        for (const auto& pair : conflicts.pairs) {
            pairs[pair] = true;
        }
        for (const auto& [a, b, c] : conflicts.triples) {
            if (pairs.count({a, b}) + pairs.count({a, c}) + pairs.count({b, c}) != 0) {
                continue;
            }
            ++triples;
            EXPECT_TRUE(ground.strands.insert(candidates[a].layout_edge, candidates[a].darts));
            EXPECT_TRUE(ground.strands.insert(candidates[b].layout_edge, candidates[b].darts));
            EXPECT_FALSE(ground.strands.insert(candidates[c].layout_edge, candidates[c].darts));
            ground.strands.undo();
            ground.strands.undo();
        }
    }
    EXPECT_GT(triples, 5);
}

}  // namespace
}  // namespace layout_embedding
