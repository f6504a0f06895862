#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <optional>
#include <queue>
#include <set>

#include "apps/embed_job.hh"
#include "instances.hh"
#include "search/greedy.hh"
#include "search/side_test.hh"
#include "search/swirl_test.hh"
#include "search_ground.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

using test::SearchGround;
using Outcome = GreedySearch::Outcome;

struct NamedRule {
    const char* name;
    GreedyRule rule;
};
const std::array<NamedRule, 4> kRules{{{"greedy", GreedyRule::plain()},
                                       {"praun", GreedyRule::praun()},
                                       {"kraevoy", GreedyRule::kraevoy()},
                                       {"schreiner", GreedyRule::schreiner()}}};

struct Instance {
    std::string name;
    EmbeddingProblem problem;
    bool is_sphere;
};

/// Small and crowded spheres, then all kinds of surfaces.
std::vector<Instance> all_instances(std::uint64_t seed, int spheres, bool with_others)
{
    std::vector<Instance> all;
    for (auto& instance : test::random_instances(seed, spheres)) {
        all.push_back({instance.name, instance.problem, true});
    }
    if (with_others) {
        for (auto& instance : test::embedded_instances(seed)) {
            all.push_back({instance.name, instance.problem, false});
        }
    }
    return all;
}

/// What a greedy heuristic came to.
struct Found {
    bool complete = false;
    std::vector<Index> order;
    Length cost = 0;
    std::vector<Outcome> outcomes;
    friend bool operator==(const Found&, const Found&) = default;
};

Found run_greedy(SearchGround& ground, const EmbeddingProblem& problem, const GreedyRule& rule,
                 std::uint64_t slice)
{
    GreedySearch greedy(problem, ground.strands, ground.search, rule);
    Found found;
    double progress = 0;
    for (;;) {
        const Outcome outcome = greedy.run(slice);
        EXPECT_NE(outcome, Outcome::tied);
        EXPECT_GE(greedy.progress(), progress);
        progress = greedy.progress();
        if (outcome == Outcome::running) {
            continue;
        }
        found.outcomes.push_back(outcome);
        if (outcome != Outcome::bounded && outcome != Outcome::inserted) {
            found.complete = outcome == Outcome::complete;
            break;
        }
    }
    if (found.complete) {
        EXPECT_EQ(progress, 1);
    }
    found.order = ground.strands.insertion_order();
    found.cost = greedy.embedded_cost();
    return found;
}

/// Union of layout vertices by the embedded edges, computed afresh.
std::vector<Index> components_of(const Strands& strands)
{
    const Layout& layout = strands.layout();
    std::vector<Index> component(layout.vertex_count());
    for (Index v = 0; v < component.size(); ++v) {
        component[v] = v;
    }
    for (const Index e : strands.insertion_order()) {
        const Index a = component[layout.tail(2 * e)];
        const Index b = component[layout.head(2 * e)];
        std::replace(component.begin(), component.end(), a, b);
    }
    return component;
}

std::set<Index> extremal_vertices(SearchGround& ground)
{
    const Layout& layout = ground.strands.layout();
    std::vector<std::pair<double, Index>> averages;
    for (Index v = 0; v < layout.vertex_count(); ++v) {
        double sum = 0;
        for (const Index h : layout.outgoing(v)) {
            ground.search.begin(Layout::edge(h));
            ground.search.run();
            sum += static_cast<double>(ground.search.cost());
        }
        averages.emplace_back(-sum / static_cast<double>(layout.outgoing(v).size()), v);
    }
    std::sort(averages.begin(), averages.end());
    std::set<Index> extremal;
    for (Index k = 0; k < layout.vertex_count() / 4; ++k) {
        extremal.insert(averages[k].second);
    }
    return extremal;
}

/// The heuristic by the letter: every edge is searched and judged again in every round.
Found run_naively(const EmbeddingProblem& problem, const GreedyRule& rule)
{
    SearchGround ground(problem, 1);
    Strands& strands = ground.strands;
    const Layout& layout = strands.layout();
    const HoleGuard guard(strands);
    SwirlTest swirl_test(strands);
    SideTest side_test(problem, strands);
    std::optional<RepulsiveGuide> guide;
    if (rule.repulsive_guide) {
        guide.emplace(problem, ground.graph);
    }
    const std::set<Index> extremal = extremal_vertices(ground);
    Found found;
    for (;;) {
        const auto component = components_of(strands);
        const bool has_tree =
            std::count(component.begin(), component.end(), component[0]) == layout.vertex_count();
        struct Choice {
            bool is_late;
            Length score;
            Index edge;
            std::vector<Index> darts;
        };
        std::optional<Choice> best;
        for (Index e = 0; e < layout.edge_count(); ++e) {
            const Index i = layout.tail(2 * e);
            const Index j = layout.head(2 * e);
            const bool closes = component[i] == component[j];
            if (strands.is_embedded(e) || (rule.spanning_tree_first && !has_tree && closes)) {
                continue;
            }
            if (guide) {
                ground.search.begin_weighted(e, guide->node_weights(i, j));
            } else {
                ground.search.begin(e);
            }
            if (ground.search.run() != CutSurfaceSearch::Outcome::found) {
                continue;
            }
            const auto darts = ground.search.darts();
            if (rule.side_test && closes && !side_test.accepts(e, darts)) {
                continue;
            }
            EXPECT_TRUE(strands.insert(e, darts));
            const bool accepted = guard.accepts();
            strands.undo();
            if (!accepted) {
                continue;
            }
            const Length factor = rule.swirl_test && swirl_test.suspects(e, darts) ? 2 : 1;
            const bool is_late =
                rule.extremal_first && !(extremal.count(i) != 0 && extremal.count(j) != 0);
            const Choice choice{is_late, factor * ground.search.cost(), e, darts};
            if (!best || std::tie(choice.is_late, choice.score, choice.edge) <
                             std::tie(best->is_late, best->score, best->edge)) {
                best = choice;
            }
        }
        if (!best) {
            break;
        }
        strands.insert(best->edge, best->darts);
    }
    found.order = strands.insertion_order();
    found.complete = found.order.size() == layout.edge_count();
    if (!found.complete) {
        for (const Index e : found.order) {
            for (const Index d : strands.darts(e)) {
                found.cost += ground.graph.dart(d).length;
            }
        }
        return found;
    }
    // The cost reported is that of the sequence with plain shortest paths.
    while (!strands.insertion_order().empty()) {
        strands.undo();
    }
    for (const Index e : found.order) {
        ground.search.begin(e);
        if (ground.search.run() != CutSurfaceSearch::Outcome::found) {
            found.complete = false;
            break;
        }
        strands.insert(e, ground.search.darts());
        if (!guard.accepts()) {
            strands.undo();
            found.complete = false;
            break;
        }
        found.cost += ground.search.cost();
    }
    found.order = strands.insertion_order();
    return found;
}

TEST(Greedy, looking_only_at_what_matters_gives_the_sequence_of_looking_at_everything)
{
    std::array<int, kRules.size()> completed{};
    for (const Instance& instance : all_instances(31, 45, true)) {
        // The letter is slow.
        if (instance.problem.layout->edge_count() > 24 ||
            instance.problem.target->face_count() > 400) {
            continue;
        }
        for (std::size_t r = 0; r < kRules.size(); ++r) {
            SearchGround ground(instance.problem, 1);
            Found found = run_greedy(ground, instance.problem, kRules[r].rule, UINT64_MAX);
            found.outcomes.clear();
            const Found naive = run_naively(instance.problem, kRules[r].rule);
            EXPECT_EQ(found.complete, naive.complete) << kRules[r].name << ", " << instance.name;
            EXPECT_EQ(found.order, naive.order) << kRules[r].name << ", " << instance.name;
            EXPECT_EQ(found.cost, naive.cost) << kRules[r].name << ", " << instance.name;
            completed[r] += found.complete ? 1 : 0;
        }
    }
    for (const int count : completed) {
        EXPECT_GE(count, 40);
    }
}

TEST(Greedy, every_rule_decides_something)
{
    // The switches of each rule are seen to change the sequence on crowded instances.
    std::array<int, 5> changed{};
    for (const Instance& instance : all_instances(32, 40, false)) {
        const auto order = [&](const GreedyRule& rule) {
            SearchGround ground(instance.problem, 1);
            return run_greedy(ground, instance.problem, rule, UINT64_MAX).order;
        };
        const auto plain = order(GreedyRule::plain());
        std::array<GreedyRule, 5> rules;
        rules.fill(GreedyRule::plain());
        rules[0].spanning_tree_first = false;
        rules[1].repulsive_guide = true;
        rules[2].swirl_test = true;
        rules[3].extremal_first = true;
        rules[4] = {.side_test = true};
        const auto unruled = order(rules[0]);
        for (std::size_t r = 0; r < rules.size(); ++r) {
            changed[r] += order(rules[r]) != (r == 4 ? unruled : plain) ? 1 : 0;
        }
    }
    for (const int count : changed) {
        EXPECT_GT(count, 0);
    }
}

TEST(Greedy, slicing_changes_nothing)
{
    for (const Instance& instance : all_instances(33, 9, false)) {
        for (const NamedRule& rule : kRules) {
            SearchGround whole(instance.problem, 1);
            SearchGround sliced(instance.problem, 1);
            EXPECT_EQ(run_greedy(whole, instance.problem, rule.rule, UINT64_MAX),
                      run_greedy(sliced, instance.problem, rule.rule, 7))
                << rule.name << ", " << instance.name;
            EXPECT_EQ(whole.search.expansion_count(), sliced.search.expansion_count());
            EXPECT_EQ(whole.search.search_count(), sliced.search.search_count());
        }
    }
}

TEST(Greedy, a_spanning_tree_comes_first_where_the_rule_asks_for_it)
{
    int trees = 0;
    int others = 0;
    for (const Instance& instance : all_instances(34, 30, false)) {
        for (const NamedRule& rule : kRules) {
            SearchGround ground(instance.problem, 1);
            const Found found = run_greedy(ground, instance.problem, rule.rule, UINT64_MAX);
            const Layout& layout = *instance.problem.layout;
            // Paths along a tree never block anything on a sphere.
            ASSERT_TRUE(found.complete || !rule.rule.spanning_tree_first);
            while (ground.strands.insertion_order().size() > layout.vertex_count() - 1) {
                ground.strands.undo();
            }
            const auto component = components_of(ground.strands);
            const bool is_tree = std::set<Index>(component.begin(), component.end()).size() == 1;
            EXPECT_TRUE(is_tree || !rule.rule.spanning_tree_first);
            trees += is_tree ? 1 : 0;
            others += is_tree ? 0 : 1;
        }
    }
    EXPECT_GT(trees, 0);
    EXPECT_GT(others, 0);
}

TEST(Greedy, schreiner_inserts_admitted_edges_between_extremal_vertices_before_all_others)
{
    int early = 0;
    for (const Instance& instance : all_instances(35, 40, false)) {
        SearchGround fresh(instance.problem, 1);
        const std::set<Index> extremal = extremal_vertices(fresh);
        SearchGround ground(instance.problem, 1);
        const Found found =
            run_greedy(ground, instance.problem, GreedyRule::schreiner(), UINT64_MAX);
        ASSERT_TRUE(found.complete);
        const Layout& layout = *instance.problem.layout;
        const auto is_early = [&](Index e) {
            return extremal.count(layout.tail(2 * e)) != 0 &&
                   extremal.count(layout.head(2 * e)) != 0;
        };
        while (!ground.strands.insertion_order().empty()) {
            const Index inserted = ground.strands.insertion_order().back();
            ground.strands.undo();
            const auto component = components_of(ground.strands);
            const bool has_tree =
                ground.strands.insertion_order().size() >= layout.vertex_count() - 1;
            for (Index e = 0; e < layout.edge_count(); ++e) {
                const bool admitted =
                    !ground.strands.is_embedded(e) &&
                    (has_tree || component[layout.tail(2 * e)] != component[layout.head(2 * e)]);
                EXPECT_TRUE(!admitted || !is_early(e) || is_early(inserted)) << instance.name;
            }
            early += is_early(inserted) ? 1 : 0;
        }
    }
    EXPECT_GT(early, 5);
}

TEST(Greedy, every_algorithm_ends_in_an_embedding_the_checker_accepts_or_says_that_it_failed)
{
    std::array<int, kRules.size()> found{};
    for (const Instance& instance : all_instances(36, 12, true)) {
        for (std::size_t r = 0; r < kRules.size(); ++r) {
            EmbedOptions options;
            options.algorithm = static_cast<Algorithm>(r);
            EmbedJob job(instance.problem, options);
            while (job.step()) {
            }
            const EmbedResult& result = job.result();
            EXPECT_EQ(job.error().code, ErrorCode::none)
                << kRules[r].name << ", " << instance.name << ": " << job.error().message;
            if (result.status == EmbedStatus::none_found) {
                EXPECT_FALSE(instance.is_sphere && kRules[r].rule.spanning_tree_first);
                EXPECT_TRUE(result.weak.paths.empty());
                continue;
            }
            ++found[r];
            ASSERT_TRUE(result.refined.has_value()) << kRules[r].name << ", " << instance.name;
            EXPECT_GE(result.exact_cost, result.exact_lower_bound);
            auto order = result.insertion_order;
            std::sort(order.begin(), order.end());
            for (Index e = 0; e < instance.problem.layout->edge_count(); ++e) {
                EXPECT_EQ(order[e], e);
            }
            EXPECT_EQ(order.size(), instance.problem.layout->edge_count());
        }
    }
    for (const int count : found) {
        EXPECT_GE(count, 12);
    }
}

TEST(CutSurfaceSearch, full_weights_give_the_plain_walk_and_others_a_shortest_one)
{
    for (const Instance& instance : all_instances(37, 8, false)) {
        SearchGround ground(instance.problem, 1);
        RepulsiveGuide guide(instance.problem, ground.graph);
        const Layout& layout = *instance.problem.layout;
        const std::vector<NodeWeight> full(ground.graph.node_count(), kFullWeight);
        for (Index e = 0; e < layout.edge_count(); ++e) {
            ground.search.begin(e);
            ASSERT_EQ(ground.search.run(), CutSurfaceSearch::Outcome::found);
            const auto plain = ground.search.darts();
            const Length cost = ground.search.cost();
            ground.search.begin_weighted(e, full);
            ASSERT_EQ(ground.search.run(), CutSurfaceSearch::Outcome::found);
            EXPECT_EQ(ground.search.darts(), plain);
            EXPECT_EQ(ground.search.cost(), cost + plain.size());

            const auto& weights = guide.node_weights(layout.tail(2 * e), layout.head(2 * e));
            const auto weighted = [&](const std::vector<Index>& darts) {
                Length sum = 0;
                for (const Index d : darts) {
                    sum +=
                        weighted_length(ground.graph.dart(d).length, weights[ground.graph.tail(d)],
                                        weights[ground.graph.head(d)]);
                }
                return sum;
            };
            ground.search.begin_weighted(e, weights);
            ASSERT_EQ(ground.search.run(), CutSurfaceSearch::Outcome::found);
            EXPECT_EQ(weighted(ground.search.darts()), ground.search.cost());
            EXPECT_LE(ground.search.cost(), weighted(plain));
        }
    }
}

/// A tetrahedron on a sphere, seen from +z: i in the west, j in the east, k in the north, l in the
/// south, the back of the sphere empty.
class Compass : public testing::Test {
protected:
    static constexpr Index i = 0;
    static constexpr Index j = 1;
    static constexpr Index k = 2;
    static constexpr Index l = 3;

    Compass() : problem_(make()), ground_(problem_, 1) {}

    static PolygonMesh sphere()
    {
        PolygonMesh mesh = zoo::octahedron();
        for (int level = 0; level < 4; ++level) {
            mesh = zoo::subdivided(mesh);
        }
        for (Vec3& position : mesh.positions) {
            position.normalize();
        }
        return mesh;
    }

    static Index nearest(const PolygonMesh& mesh, double x, double y)
    {
        const Vec3 point(x, y, std::sqrt(1 - x * x - y * y));
        Index best = 0;
        for (Index v = 0; v < mesh.positions.size(); ++v) {
            if ((mesh.positions[v] - point).norm() < (mesh.positions[best] - point).norm()) {
                best = v;
            }
        }
        return best;
    }

    static EmbeddingProblem make()
    {
        PolygonMesh layout;
        layout.positions.assign(4, Vec3::Zero());
        for (const std::array<Index, 3>& face :
             std::vector<std::array<Index, 3>>{{i, j, k}, {j, i, l}, {k, j, l}, {i, k, l}}) {
            layout.add_face(face);
        }
        const PolygonMesh mesh = sphere();
        return test::problem_of(layout, mesh,
                                {nearest(mesh, -0.5, 0), nearest(mesh, 0.5, 0),
                                 nearest(mesh, 0, 0.4), nearest(mesh, 0, -0.4)});
    }

    Index edge(Index a, Index b) const
    {
        for (const Index h : problem_.layout->outgoing(a)) {
            if (problem_.layout->head(h) == b) {
                return Layout::edge(h);
            }
        }
        return kNone;
    }

    /// The walk for an edge from a to b that goes by the given points, in the edge's direction.
    std::vector<Index> walk(Index a, Index b, const std::vector<std::array<double, 2>>& points)
    {
        std::vector<Index> stops{ground_.strands.landmark_node(a)};
        const PolygonMesh mesh = sphere();
        for (const auto& [x, y] : points) {
            stops.push_back(ground_.graph.node_of_vertex(nearest(mesh, x, y)));
        }
        stops.push_back(ground_.strands.landmark_node(b));
        std::vector<Index> darts;
        for (std::size_t s = 0; s + 1 < stops.size(); ++s) {
            const auto part = shortest(stops[s], stops[s + 1]);
            darts.insert(darts.end(), part.begin(), part.end());
        }
        if (problem_.layout->tail(2 * edge(a, b)) != a) {
            std::reverse(darts.begin(), darts.end());
            for (Index& dart : darts) {
                dart = ground_.graph.twin(dart);
            }
        }
        return darts;
    }

    std::vector<Index> shortest(Index from, Index to)
    {
        const PathGraph& graph = ground_.graph;
        std::vector<Length> distances(graph.node_count(), kInfiniteLength);
        std::vector<Index> parents(graph.node_count(), kNone);
        std::priority_queue<std::pair<Length, Index>, std::vector<std::pair<Length, Index>>,
                            std::greater<>>
            queue;
        distances[from] = 0;
        queue.emplace(0, from);
        while (!queue.empty()) {
            const auto [distance, node] = queue.top();
            queue.pop();
            if (distance > distances[node] || (node != from && !ground_.strands.passable()[node])) {
                continue;
            }
            for (Index d = graph.first_dart(node); d < graph.first_dart(node + 1); ++d) {
                if (distance + graph.dart(d).length < distances[graph.head(d)]) {
                    distances[graph.head(d)] = distance + graph.dart(d).length;
                    parents[graph.head(d)] = d;
                    queue.emplace(distances[graph.head(d)], graph.head(d));
                }
            }
        }
        std::vector<Index> darts;
        for (Index node = to; node != from; node = graph.tail(parents[node])) {
            darts.push_back(parents[node]);
        }
        std::reverse(darts.begin(), darts.end());
        return darts;
    }

    EmbeddingProblem problem_;
    SearchGround ground_;
};

TEST_F(Compass, straight_paths_are_not_suspected_of_a_swirl)
{
    SwirlTest swirl_test(ground_.strands);
    EXPECT_FALSE(swirl_test.suspects(edge(i, j), walk(i, j, {})));
    // Nor is a detour that keeps both other corners on their sides.
    EXPECT_FALSE(swirl_test.suspects(edge(i, j), walk(i, j, {{-0.2, 0.1}, {0.2, -0.1}})));
}

TEST_F(Compass, paths_around_an_opposite_corner_are_suspected_in_both_senses)
{
    SwirlTest swirl_test(ground_.strands);
    // North of k instead of south of it, and south of l instead of north of it.
    EXPECT_TRUE(swirl_test.suspects(edge(i, j), walk(i, j, {{-0.4, 0.5}, {0, 0.6}, {0.4, 0.5}})));
    EXPECT_TRUE(
        swirl_test.suspects(edge(i, j), walk(i, j, {{-0.4, -0.5}, {0, -0.6}, {0.4, -0.5}})));
}

TEST_F(Compass, a_cycle_is_accepted_if_it_parts_landmarks_as_the_layout_does)
{
    SideTest side_test(problem_, ground_.strands);
    ASSERT_TRUE(ground_.strands.insert(edge(i, j), walk(i, j, {})));
    ASSERT_TRUE(ground_.strands.insert(edge(j, k), walk(j, k, {})));
    EXPECT_TRUE(side_test.accepts(edge(k, i), walk(k, i, {})));
    EXPECT_TRUE(side_test.accepts(edge(k, i), walk(k, i, {{-0.3, 0.6}})));
    // The long way around j and l parts them the same way.
    EXPECT_TRUE(side_test.accepts(edge(k, i),
                                  walk(k, i, {{0.5, 0.6}, {0.8, 0}, {0.4, -0.7}, {-0.4, -0.7}})));
    EXPECT_EQ(ground_.strands.insertion_order().size(), 2U);
}

TEST_F(Compass, a_cycle_with_a_landmark_on_the_wrong_side_is_refused)
{
    SideTest side_test(problem_, ground_.strands);
    ASSERT_TRUE(ground_.strands.insert(edge(i, j), walk(i, j, {})));
    ASSERT_TRUE(ground_.strands.insert(edge(j, k), walk(j, k, {})));
    // West of i, around l and back between the two: l gets to the left, where the face i j k is.
    const auto around =
        walk(k, i, {{-0.8, 0}, {-0.4, -0.7}, {0.4, -0.7}, {0.3, -0.2}, {-0.2, -0.15}});
    ASSERT_TRUE(ground_.strands.trace(edge(k, i), around));
    EXPECT_FALSE(side_test.accepts(edge(k, i), around));
    EXPECT_EQ(ground_.strands.insertion_order().size(), 2U);
}

}  // namespace
}  // namespace layout_embedding
