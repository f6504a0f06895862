#include "search/sequence_solver.hh"

#include <algorithm>
#include <gtest/gtest.h>

#include "embedding_checks.hh"
#include "instances.hh"
#include "search_ground.hh"

namespace layout_embedding {
namespace {

using test::Instance;
using test::random_instances;

constexpr std::uint64_t kFieldBytes = std::uint64_t{1} << 30U;

struct WholeSearch {
    WholeSearch(const EmbeddingProblem& problem, const SequenceSolverOptions& options)
        : graph(PathGraph::barycentric(*problem.target, {1, 0})),
          solver(problem, graph, kFieldBytes, options)
    {}

    void finish(std::uint64_t slice = UINT64_MAX)
    {
        for (;;) {
            WorkBudget budget(slice);
            const auto outcome = solver.run(budget);
            work += budget.spent();
            ASSERT_NE(outcome, Solver::Outcome::tied);
            if (outcome != Solver::Outcome::running) {
                happened.emplace_back(outcome, work);
            }
            if (outcome == Solver::Outcome::finished) {
                return;
            }
        }
    }

    PathGraph graph;
    SequenceSolver solver;
    std::uint64_t work = 0;
    std::vector<std::pair<Solver::Outcome, std::uint64_t>> happened;
};

SequenceSolverOptions exact()
{
    SequenceSolverOptions options;
    options.branch_and_bound.gap = 0;
    return options;
}

TEST(SequenceSolver, no_start_changes_the_optimum)
{
    std::uint64_t searches[4] = {};
    for (const Instance& instance : random_instances(111, 16)) {
        if (instance.problem.layout->edge_count() > 12) {
            continue;
        }
        SCOPED_TRACE(instance.name);
        Length best = kInfiniteLength;
        for (int off = 0; off < 4; ++off) {
            SequenceSolverOptions options = exact();
            options.greedy_start = off != 1;
            options.local_search = off != 2;
            options.remember = off != 3;
            WholeSearch run(instance.problem, options);
            run.finish();
            EXPECT_EQ(run.solver.lower_bound(), run.solver.incumbent_cost());
            if (off == 0) {
                best = run.solver.incumbent_cost();
            }
            EXPECT_EQ(run.solver.incumbent_cost(), best);
            EXPECT_EQ(test::total_length(run.graph, run.solver.incumbent()), best);
            test::expect_strands(instance.problem, run.graph, run.solver.incumbent());
            searches[off] += run.solver.counters().searches;
        }
    }
    EXPECT_NE(searches[1], searches[0]);
    EXPECT_NE(searches[2], searches[0]);
    EXPECT_GT(searches[3], 2 * searches[0]);
}

TEST(SequenceSolver, slices_change_neither_what_happens_nor_when)
{
    for (const Instance& instance : test::tiny_instances(112, 24)) {
        SCOPED_TRACE(instance.name);
        SequenceSolverOptions options;
        WholeSearch whole(instance.problem, options);
        whole.finish();
        for (const std::uint64_t slice : {1U, 50U}) {
            WholeSearch sliced(instance.problem, options);
            sliced.finish(slice);
            EXPECT_EQ(sliced.happened, whole.happened);
            EXPECT_EQ(sliced.solver.incumbent_cost(), whole.solver.incumbent_cost());
            EXPECT_EQ(sliced.solver.lower_bound(), whole.solver.lower_bound());
            EXPECT_EQ(sliced.solver.incumbent_order(), whole.solver.incumbent_order());
            EXPECT_EQ(sliced.solver.counters().states_created,
                      whole.solver.counters().states_created);
        }
    }
}

/// Local search from the embedding of plain greedy insertion.
struct LocalSearchGround {
    LocalSearchGround(const EmbeddingProblem& problem, std::uint64_t max_work)
        : ground(problem, 1),
          pool(ground.strands),
          embedding(ground.strands, pool),
          oracle(embedding, ground.search)
    {
        GreedySearch greedy(problem, ground.strands, ground.search);
        GreedySearch::Outcome outcome = GreedySearch::Outcome::running;
        while (outcome != GreedySearch::Outcome::complete) {
            outcome = greedy.run();
            if (outcome == GreedySearch::Outcome::failed) {
                ADD_FAILURE() << "no embedding to begin with";
                return;
            }
        }
        std::vector<Index> walks;
        for (const Index e : ground.strands.insertion_order()) {
            walks.push_back(pool.add(e, ground.strands.darts(e)));
        }
        while (!ground.strands.insertion_order().empty()) {
            ground.strands.undo();
        }
        WorkBudget budget;
        for (Index e = 0; e < walks.size(); ++e) {
            root_walks.push_back(oracle.find(e, kInfiniteLength, budget).walk);
        }
        embedding.go_to(walks);
        EXPECT_EQ(incumbent.offer(embedding), Incumbent::Outcome::accepted);
        search.emplace(embedding, oracle, incumbent, root_walks);
        search->allow(max_work);
    }

    test::SearchGround ground;
    WalkPool pool;
    PartialEmbedding embedding;
    PathOracle oracle;
    std::vector<Index> root_walks;
    Incumbent incumbent;
    std::optional<LocalSearch> search;
};

TEST(SequenceSolver, local_search_alone_comes_close_to_the_best_insertion_sequence)
{
    int improved = 0;
    int best = 0;
    int count = 0;
    for (const Instance& instance : random_instances(113, 30)) {
        if (instance.problem.layout->edge_count() > 12) {
            continue;
        }
        SCOPED_TRACE(instance.name);
        WholeSearch run(instance.problem, exact());
        run.finish();
        LocalSearchGround local(instance.problem, UINT64_MAX);
        ASSERT_TRUE(local.search);
        const Length start = local.incumbent.cost();
        Length cost = start;
        WorkBudget budget;
        for (;;) {
            const auto step = local.search->run(budget);
            if (step == LocalSearch::Outcome::finished) {
                break;
            }
            ASSERT_EQ(step, LocalSearch::Outcome::improved);
            EXPECT_LT(local.incumbent.cost(), cost);
            cost = local.incumbent.cost();
            test::expect_strands(instance.problem, local.ground.graph,
                                 local.incumbent.weak_embedding());
        }
        EXPECT_GE(cost, run.solver.incumbent_cost());
        ++count;
        improved += cost < start ? 1 : 0;
        best += cost == run.solver.incumbent_cost() ? 1 : 0;
    }
    EXPECT_GT(improved, count / 4);
    EXPECT_GT(best, count / 2);
}

TEST(SequenceSolver, local_search_ends_at_the_same_place_however_it_is_sliced)
{
    int cut_short = 0;
    for (const Instance& instance : random_instances(117, 20)) {
        SCOPED_TRACE(instance.name);
        const auto run = [&](std::uint64_t max_work, std::uint64_t slice) {
            LocalSearchGround local(instance.problem, max_work);
            std::uint64_t work = 0;
            for (auto outcome = LocalSearch::Outcome::running;
                 outcome != LocalSearch::Outcome::finished;) {
                WorkBudget budget(slice);
                outcome = local.search->run(budget);
                work += budget.spent();
                if (outcome == LocalSearch::Outcome::tied) {
                    ADD_FAILURE() << "a tie";
                    break;
                }
            }
            // Nothing is left of a search that was cut short: the oracle answers what it is asked.
            local.embedding.go_to({});
            const std::uint64_t expansions = local.ground.search.expansion_count();
            WorkBudget budget;
            for (Index e = 0; e < local.root_walks.size(); ++e) {
                EXPECT_EQ(local.oracle.find(e, kInfiniteLength, budget).walk, local.root_walks[e]);
            }
            EXPECT_EQ(local.ground.search.expansion_count(), expansions);
            return std::tuple(work, expansions, local.incumbent.cost());
        };
        const auto whole = run(UINT64_MAX, UINT64_MAX);
        const std::uint64_t half = std::get<0>(whole) / 2;
        const auto cut = run(half, UINT64_MAX);
        cut_short += std::get<0>(cut) < std::get<0>(whole) ? 1 : 0;
        EXPECT_EQ(run(half, 1), cut);
        EXPECT_EQ(run(half, 17), cut);
    }
    EXPECT_GT(cut_short, 5);
}

}  // namespace
}  // namespace layout_embedding
