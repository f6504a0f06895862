#include "search/partial_embedding.hh"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

#include "instances.hh"
#include "search_ground.hh"
#include "surface/conflicts.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

using test::Instance;
using test::random_instances;
using test::random_order;
using test::SearchGround;

/// Small closed targets, and disks with landmarks on their boundary.
std::vector<Instance> instances(std::uint64_t seed, int count)
{
    std::vector<Instance> all = random_instances(seed, count);
    for (const auto& layout : {zoo::wheel(5), zoo::quad_grid(2, 2)}) {
        const PolygonMesh target = zoo::grid_disk(7, 6);
        for (int round = 0; round < 3; ++round) {
            all.push_back(
                {"disk", test::problem_of(layout, target,
                                          zoo::displaced_landmarks(layout, target, 0.3, ++seed))});
        }
    }
    return all;
}

/// What a search stands on; strands belong to the embedding.
struct State {
    explicit State(const EmbeddingProblem& problem)
        : ground(problem, 1), pool(ground.strands), embedding(ground.strands, pool)
    {}

    /// The shortest walk of an edge here, kNone if it is blocked.
    Index shortest(Index edge)
    {
        EXPECT_TRUE(embedding.move_strands());
        ground.search.begin(edge);
        if (ground.search.run() != CutSurfaceSearch::Outcome::found) {
            return kNone;
        }
        return pool.add(edge, ground.search.darts());
    }

    SearchGround ground;
    WalkPool pool;
    PartialEmbedding embedding;
};

/// Walks of all kinds of states: those of a few random insertion orders.
void fill_pool(State& state, Random& random)
{
    const Index edges = state.embedding.layout().edge_count();
    for (int round = 0; round < 3; ++round) {
        for (const Index e : random_order(edges, random)) {
            const Index walk = state.shortest(e);
            if (walk != kNone) {
                ASSERT_TRUE(state.embedding.fits(walk));
                state.embedding.insert(walk);
            }
        }
        state.embedding.go_to({});
    }
}

/// Whether a walk passes some node twice. Strands trace such a walk only where other strands lie
/// between its passes, as they do in the states in which it is the shortest.
bool repeats_a_node(const PathGraph& graph, const std::vector<Index>& darts)
{
    std::set<Index> nodes;
    return std::any_of(darts.begin(), darts.end(),
                       [&](Index d) { return !nodes.insert(graph.head(d)).second; });
}

TEST(PartialEmbedding, a_walk_fits_exactly_if_it_traces_through_the_strands)
{
    Random random(31);
    int fitting = 0;
    int refused = 0;
    for (const Instance& instance : instances(31, 40)) {
        SCOPED_TRACE(instance.name);
        State state(instance.problem);
        fill_pool(state, random);
        const Index edges = state.embedding.layout().edge_count();
        const auto order = random_order(edges, random);
        for (std::size_t depth = 0; depth < order.size(); ++depth) {
            ASSERT_TRUE(state.embedding.move_strands());
            for (Index walk = 0; walk < state.pool.size(); ++walk) {
                const Index e = state.pool.layout_edge(walk);
                if (state.embedding.walk(e) != kNone ||
                    repeats_a_node(state.ground.graph, state.pool.darts(walk))) {
                    continue;
                }
                const bool traces =
                    state.ground.strands.trace(e, state.pool.darts(walk)).has_value();
                EXPECT_EQ(state.embedding.fits(walk), traces);
                ++(traces ? fitting : refused);
            }
            const Index walk = state.shortest(order[depth]);
            if (walk != kNone) {
                state.embedding.insert(walk);
            }
        }
    }
    EXPECT_GT(fitting, 2000);
    EXPECT_GT(refused, 2000);
}

TEST(PartialEmbedding, conflicts_are_those_that_the_strands_show)
{
    Random random(32);
    std::size_t pairs = 0;
    std::size_t triples = 0;
    for (const Instance& instance : instances(32, 60)) {
        SCOPED_TRACE(instance.name);
        State state(instance.problem);
        const Index edges = state.embedding.layout().edge_count();
        const auto order = random_order(edges, random);
        const auto depth = random.below(edges - 1);
        for (std::size_t i = 0; i < depth; ++i) {
            const Index walk = state.shortest(order[i]);
            if (walk != kNone) {
                state.embedding.insert(walk);
            }
        }
        std::vector<Index> candidates(edges, kNone);
        std::vector<CandidateWalk> walks;
        bool is_blocked = false;
        for (Index e = 0; e < edges && !is_blocked; ++e) {
            if (state.embedding.walk(e) == kNone) {
                candidates[e] = state.shortest(e);
                is_blocked = candidates[e] == kNone;
                if (!is_blocked) {
                    walks.push_back({e, state.pool.darts(candidates[e])});
                }
            }
        }
        if (is_blocked) {
            continue;
        }
        const CandidateConflicts told = state.embedding.conflicts(candidates);
        const Conflicts shown = find_conflicts(state.ground.strands, walks);
        ASSERT_EQ(told.pairs.size(), shown.pairs.size());
        ASSERT_EQ(told.triples.size(), shown.triples.size());
        for (std::size_t i = 0; i < told.pairs.size(); ++i) {
            EXPECT_EQ(told.pairs[i].first, walks[shown.pairs[i].first].layout_edge);
            EXPECT_EQ(told.pairs[i].second, walks[shown.pairs[i].second].layout_edge);
        }
        for (std::size_t i = 0; i < told.triples.size(); ++i) {
            for (int k = 0; k < 3; ++k) {
                EXPECT_EQ(told.triples[i][k], walks[shown.triples[i][k]].layout_edge);
            }
        }
        for (const CandidateWalk& walk : walks) {
            std::vector<Index> partners;
            for (const auto& [a, b] : told.pairs) {
                if (a == walk.layout_edge || b == walk.layout_edge) {
                    partners.push_back(a == walk.layout_edge ? b : a);
                }
            }
            std::sort(partners.begin(), partners.end());
            EXPECT_EQ(state.embedding.conflicting_with(walk.layout_edge, candidates), partners);
        }
        pairs += told.pairs.size();
        triples += told.triples.size();
    }
    EXPECT_GT(pairs, 200U);
    EXPECT_GT(triples, 20U);
}

TEST(PartialEmbedding, strands_reach_any_state_from_any_other)
{
    Random random(33);
    for (const Instance& instance : random_instances(33, 10)) {
        SCOPED_TRACE(instance.name);
        State state(instance.problem);
        const Index edges = state.embedding.layout().edge_count();
        std::vector<std::vector<Index>> states{{}};
        for (int round = 0; round < 6; ++round) {
            const auto depth = random.below(edges + 1);
            const auto order = test::random_tree_first_order(state.embedding.layout(), random);
            state.embedding.go_to({});
            for (std::size_t i = 0; i < depth; ++i) {
                const Index walk = state.shortest(order[i]);
                ASSERT_NE(walk, kNone);
                state.embedding.insert(walk);
            }
            states.push_back(state.embedding.sequence());
        }
        for (int round = 0; round < 12; ++round) {
            const auto& there = states[random.below(states.size())];
            state.embedding.go_to(there);
            EXPECT_EQ(state.embedding.sequence(), there);
            ASSERT_TRUE(state.embedding.move_strands());
            Length cost = 0;
            for (Index e = 0; e < edges; ++e) {
                const Index walk = state.embedding.walk(e);
                EXPECT_EQ(state.ground.strands.darts(e),
                          walk == kNone ? std::vector<Index>{} : state.pool.darts(walk));
                cost += walk == kNone ? 0 : state.pool.cost(walk);
            }
            EXPECT_EQ(state.embedding.cost(), cost);
        }
    }
}

}  // namespace
}  // namespace layout_embedding
