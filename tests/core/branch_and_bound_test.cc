#include "search/branch_and_bound.hh"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

#include "instances.hh"
#include "search_ground.hh"
#include "surface/conflicts.hh"
#include "surface/strand_checker.hh"

namespace layout_embedding {
namespace {

using test::Instance;
using test::SearchGround;
using test::tiny_instances;

/// The best of all insertion sequences by trying them all, each embedding once; nothing is shared
/// with the search but the single shortest path.
class AllSequences {
public:
    explicit AllSequences(const EmbeddingProblem& problem) : ground_(problem, 1) { visit(0); }

    Length best() const { return best_; }
    std::size_t state_count() const { return seen_.size(); }

private:
    void visit(Length cost)
    {
        const Index edges = ground_.strands.layout().edge_count();
        std::vector<std::vector<Index>> key;
        bool complete = true;
        for (Index e = 0; e < edges; ++e) {
            key.push_back(ground_.strands.darts(e));
            complete = complete && ground_.strands.is_embedded(e);
        }
        if (!seen_.insert(std::move(key)).second) {
            return;
        }
        if (complete) {
            best_ = std::min(best_, cost);
            return;
        }
        for (Index e = 0; e < edges; ++e) {
            if (ground_.strands.is_embedded(e)) {
                continue;
            }
            ground_.search.begin(e);
            if (ground_.search.run() == CutSurfaceSearch::Outcome::found) {
                const Length path = ground_.search.cost();
                ground_.strands.insert(e, ground_.search.darts());
                visit(cost + path);
                ground_.strands.undo();
            }
        }
    }

    SearchGround ground_;
    std::set<std::vector<std::vector<Index>>> seen_;
    Length best_ = kInfiniteLength;
};

/// A whole branch and bound with what it stands on.
struct Search {
    Search(const EmbeddingProblem& problem, const BranchAndBoundOptions& options,
           bool remember = true)
        : ground(problem, 1),
          pool(ground.strands),
          embedding(ground.strands, pool),
          oracle(embedding, ground.search, remember),
          branch_and_bound(embedding, oracle, ground.fields, incumbent, options)
    {}

    /// Runs to the end in slices, and looks at the bounds on the way.
    void finish(std::uint64_t slice = UINT64_MAX)
    {
        Length bound = 0;
        Length cost = kInfiniteLength;
        for (;;) {
            WorkBudget budget(slice);
            const auto outcome = branch_and_bound.run(budget);
            work += budget.spent();
            ASSERT_NE(outcome, BranchAndBound::Outcome::tied);
            EXPECT_GE(branch_and_bound.lower_bound(), bound);
            EXPECT_LE(incumbent.cost(), cost);
            EXPECT_LE(branch_and_bound.lower_bound(), incumbent.cost());
            bound = branch_and_bound.lower_bound();
            cost = incumbent.cost();
            if (outcome == BranchAndBound::Outcome::finished) {
                return;
            }
        }
    }

    SearchGround ground;
    WalkPool pool;
    PartialEmbedding embedding;
    PathOracle oracle;
    Incumbent incumbent;
    BranchAndBound branch_and_bound;
    std::uint64_t work = 0;
};

BranchAndBoundOptions exact()
{
    BranchAndBoundOptions options;
    options.gap = 0;
    return options;
}

void expect_incumbent_is_an_embedding(const EmbeddingProblem& problem, Search& search)
{
    ASSERT_EQ(search.incumbent.walks().size(), problem.layout->edge_count());
    search.embedding.go_to(search.incumbent.walks());
    ASSERT_TRUE(search.embedding.is_complete());
    ASSERT_TRUE(search.embedding.move_strands());
    EXPECT_EQ(search.embedding.cost(), search.incumbent.cost());
    EXPECT_TRUE(
        check_strands(problem, search.ground.graph, search.incumbent.weak_embedding()).empty());
}

TEST(BranchAndBound, without_tolerance_it_finds_the_best_of_all_insertion_sequences)
{
    int branched = 0;
    std::size_t most_states = 0;
    std::uint64_t states[6] = {};
    for (const Instance& instance : tiny_instances(101, 320)) {
        SCOPED_TRACE(instance.name);
        const AllSequences all(instance.problem);
        most_states = std::max(most_states, all.state_count());
        for (int off = 0; off <= 5; ++off) {
            BranchAndBoundOptions options = exact();
            options.candidate_bounds = off != 1;
            options.detect_redundant_states = off != 2;
            options.delay_non_conflicting = off != 3;
            options.mixed_priority = off != 4;
            options.pairwise_bounds = off != 5;
            Search search(instance.problem, options);
            search.finish();
            EXPECT_EQ(search.incumbent.cost(), all.best());
            EXPECT_EQ(search.branch_and_bound.lower_bound(), all.best());
            const std::uint64_t expanded = search.branch_and_bound.counters().states_expanded;
            states[off] += expanded;
            if (off == 0) {
                expect_incumbent_is_an_embedding(instance.problem, search);
                branched += expanded > 1 ? 1 : 0;
            }
        }
    }
    EXPECT_GE(branched, 150);
    EXPECT_GT(most_states, 100U);
    // And each switch does something.
    EXPECT_GT(states[1], states[0]);
    EXPECT_GT(states[2], states[0]);
    EXPECT_GT(states[3], states[0]);
    EXPECT_NE(states[4], states[0]);
    EXPECT_GT(states[5], states[0]);
}

TEST(BranchAndBound, remembered_explanations_save_searches_and_change_nothing_else)
{
    std::uint64_t with = 0;
    std::uint64_t without = 0;
    for (const Instance& instance : tiny_instances(103, 12)) {
        SCOPED_TRACE(instance.name);
        Search remembering(instance.problem, exact());
        Search forgetting(instance.problem, exact(), false);
        remembering.finish();
        forgetting.finish();
        EXPECT_EQ(remembering.incumbent.cost(), forgetting.incumbent.cost());
        EXPECT_EQ(remembering.branch_and_bound.lower_bound(),
                  forgetting.branch_and_bound.lower_bound());
        with += remembering.ground.search.search_count();
        without += forgetting.ground.search.search_count();
    }
    EXPECT_LT(2 * with, without);
}

TEST(BranchAndBound, bounds_under_a_tolerance_hold_for_the_exact_optimum)
{
    int gaps = 0;
    for (const Instance& instance : tiny_instances(104, 12)) {
        SCOPED_TRACE(instance.name);
        Search optimal(instance.problem, exact());
        optimal.finish();
        for (const double gap : {0.01, 0.05, 0.2}) {
            BranchAndBoundOptions options;
            options.gap = gap;
            Search search(instance.problem, options);
            search.finish();
            const auto& bnb = search.branch_and_bound;
            EXPECT_LE(bnb.lower_bound(), optimal.incumbent.cost());
            EXPECT_GE(search.incumbent.cost(), optimal.incumbent.cost());
            const double reached =
                static_cast<double>(search.incumbent.cost() - bnb.lower_bound()) /
                static_cast<double>(search.incumbent.cost());
            EXPECT_LE(reached, gap);
            gaps += reached > 0 ? 1 : 0;
        }
    }
    EXPECT_GT(gaps, 5);
}

TEST(BranchAndBound, bounds_hold_with_few_states)
{
    int unproved = 0;
    for (const Instance& instance : tiny_instances(106, 40)) {
        SCOPED_TRACE(instance.name);
        Search optimal(instance.problem, exact());
        optimal.finish();
        BranchAndBoundOptions options = exact();
        options.max_states = 3;
        Search search(instance.problem, options);
        search.finish();
        EXPECT_LE(search.branch_and_bound.counters().states_created, 3U);
        EXPECT_LE(search.branch_and_bound.lower_bound(), optimal.incumbent.cost());
        EXPECT_GE(search.incumbent.cost(), optimal.incumbent.cost());
        unproved += search.branch_and_bound.lower_bound() < search.incumbent.cost() ? 1 : 0;
    }
    EXPECT_GT(unproved, 5);
}

TEST(BranchAndBound, slices_change_nothing)
{
    for (const Instance& instance : tiny_instances(105, 6)) {
        SCOPED_TRACE(instance.name);
        Search whole(instance.problem, exact());
        Search sliced(instance.problem, exact());
        whole.finish();
        sliced.finish(64);
        EXPECT_EQ(whole.incumbent.cost(), sliced.incumbent.cost());
        EXPECT_EQ(whole.incumbent.walks(), sliced.incumbent.walks());
        EXPECT_EQ(whole.branch_and_bound.counters().states_created,
                  sliced.branch_and_bound.counters().states_created);
        EXPECT_EQ(whole.ground.search.expansion_count(), sliced.ground.search.expansion_count());
    }
}

}  // namespace
}  // namespace layout_embedding
