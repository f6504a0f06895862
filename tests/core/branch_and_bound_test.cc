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
using test::random_instances;
using test::SearchGround;

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
          pool(ground.graph),
          embedding(ground.strands, pool),
          oracle(embedding, ground.search, remember),
          branch_and_bound(embedding, oracle, options)
    {}

    /// Runs to the end in slices, and looks at the bounds on the way.
    void finish(std::uint64_t budget = UINT64_MAX)
    {
        Length bound = 0;
        Length cost = kInfiniteLength;
        for (;;) {
            const auto outcome = branch_and_bound.run(budget);
            ASSERT_NE(outcome, BranchAndBound::Outcome::tied);
            EXPECT_GE(branch_and_bound.lower_bound(), bound);
            EXPECT_LE(branch_and_bound.incumbent_cost(), cost);
            EXPECT_LE(branch_and_bound.lower_bound(), branch_and_bound.incumbent_cost());
            bound = branch_and_bound.lower_bound();
            cost = branch_and_bound.incumbent_cost();
            if (outcome == BranchAndBound::Outcome::finished) {
                return;
            }
        }
    }

    SearchGround ground;
    WalkPool pool;
    PartialEmbedding embedding;
    PathOracle oracle;
    BranchAndBound branch_and_bound;
};

/// Small enough to try all sequences.
std::vector<Instance> small_instances(std::uint64_t seed, int count)
{
    std::vector<Instance> small;
    for (Instance& instance : random_instances(seed, 6 * count)) {
        if (instance.problem.layout->edge_count() <= 9 && small.size() < std::size_t(count)) {
            small.push_back(std::move(instance));
        }
    }
    return small;
}

BranchAndBoundOptions exact()
{
    BranchAndBoundOptions options;
    options.gap = 0;
    return options;
}

void expect_incumbent_is_an_embedding(const EmbeddingProblem& problem, Search& search)
{
    const auto& bnb = search.branch_and_bound;
    ASSERT_EQ(bnb.incumbent().size(), problem.layout->edge_count());
    search.embedding.go_to(bnb.incumbent());
    ASSERT_TRUE(search.embedding.is_complete());
    EXPECT_EQ(search.embedding.cost(), bnb.incumbent_cost());
    EXPECT_TRUE(check_strands(problem, search.ground.graph, search.ground.strands.weak_embedding())
                    .empty());
}

TEST(BranchAndBound, without_tolerance_it_finds_the_best_of_all_insertion_sequences)
{
    int branched = 0;
    std::size_t most_states = 0;
    for (const Instance& instance : small_instances(101, 30)) {
        SCOPED_TRACE(instance.name);
        const AllSequences all(instance.problem);
        Search search(instance.problem, exact());
        search.finish();
        EXPECT_EQ(search.branch_and_bound.incumbent_cost(), all.best());
        EXPECT_EQ(search.branch_and_bound.lower_bound(), all.best());
        expect_incumbent_is_an_embedding(instance.problem, search);
        branched += search.branch_and_bound.counters().expanded > 1 ? 1 : 0;
        most_states = std::max(most_states, all.state_count());
    }
    EXPECT_GT(branched, 10);
    EXPECT_GT(most_states, 500U);
}

TEST(BranchAndBound, no_switch_changes_the_optimum)
{
    std::uint64_t states[5] = {};
    for (const Instance& instance : small_instances(102, 12)) {
        SCOPED_TRACE(instance.name);
        Search reference(instance.problem, exact());
        reference.finish();
        states[0] += reference.branch_and_bound.counters().expanded;
        for (int off = 0; off < 4; ++off) {
            BranchAndBoundOptions options = exact();
            options.candidate_bounds = off != 0;
            options.detect_redundant_states = off != 1;
            options.delay_non_conflicting = off != 2;
            options.mixed_priority = off != 3;
            Search search(instance.problem, options);
            search.finish();
            EXPECT_EQ(search.branch_and_bound.incumbent_cost(),
                      reference.branch_and_bound.incumbent_cost());
            EXPECT_EQ(search.branch_and_bound.lower_bound(),
                      reference.branch_and_bound.lower_bound());
            states[off + 1] += search.branch_and_bound.counters().expanded;
        }
    }
    // And each of them does something.
    EXPECT_GT(states[1], states[0]);
    EXPECT_GT(states[2], states[0]);
    EXPECT_GT(states[3], states[0]);
    EXPECT_NE(states[4], states[0]);
}

TEST(BranchAndBound, remembered_explanations_save_searches_and_change_nothing_else)
{
    std::uint64_t with = 0;
    std::uint64_t without = 0;
    for (const Instance& instance : small_instances(103, 12)) {
        SCOPED_TRACE(instance.name);
        Search remembering(instance.problem, exact());
        Search forgetting(instance.problem, exact(), false);
        remembering.finish();
        forgetting.finish();
        EXPECT_EQ(remembering.branch_and_bound.incumbent_cost(),
                  forgetting.branch_and_bound.incumbent_cost());
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
    for (const Instance& instance : small_instances(104, 12)) {
        SCOPED_TRACE(instance.name);
        Search optimal(instance.problem, exact());
        optimal.finish();
        for (const double gap : {0.01, 0.05, 0.2}) {
            BranchAndBoundOptions options;
            options.gap = gap;
            Search search(instance.problem, options);
            search.finish();
            const auto& bnb = search.branch_and_bound;
            EXPECT_LE(bnb.lower_bound(), optimal.branch_and_bound.incumbent_cost());
            EXPECT_GE(bnb.incumbent_cost(), optimal.branch_and_bound.incumbent_cost());
            const double reached = static_cast<double>(bnb.incumbent_cost() - bnb.lower_bound()) /
                                   static_cast<double>(bnb.incumbent_cost());
            EXPECT_LE(reached, gap);
            gaps += reached > 0 ? 1 : 0;
        }
    }
    EXPECT_GT(gaps, 5);
}

TEST(BranchAndBound, slices_change_nothing)
{
    for (const Instance& instance : small_instances(105, 6)) {
        SCOPED_TRACE(instance.name);
        Search whole(instance.problem, exact());
        Search sliced(instance.problem, exact());
        whole.finish();
        sliced.finish(64);
        EXPECT_EQ(whole.branch_and_bound.incumbent_cost(),
                  sliced.branch_and_bound.incumbent_cost());
        EXPECT_EQ(whole.branch_and_bound.incumbent(), sliced.branch_and_bound.incumbent());
        EXPECT_EQ(whole.branch_and_bound.counters().created,
                  sliced.branch_and_bound.counters().created);
        EXPECT_EQ(whole.ground.search.expansion_count(), sliced.ground.search.expansion_count());
    }
}

}  // namespace
}  // namespace layout_embedding
