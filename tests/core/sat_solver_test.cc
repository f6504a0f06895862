#include "search/sat_solver.hh"

#include <gtest/gtest.h>

#include "base/random.hh"
#include "search/weighted_sat.hh"

namespace layout_embedding {
namespace {

using Literal = SatSolver::Literal;
using Clauses = std::vector<std::vector<Literal>>;

bool holds(Literal l, std::uint32_t assignment)
{
    return ((assignment >> (l / 2)) & 1U) != (l & 1U);
}

bool satisfies(std::uint32_t assignment, const Clauses& clauses)
{
    return std::all_of(clauses.begin(), clauses.end(), [&](const auto& clause) {
        return std::any_of(clause.begin(), clause.end(),
                           [&](Literal l) { return holds(l, assignment); });
    });
}

std::vector<Literal> random_clause(Random& random, Index variables)
{
    std::vector<Literal> clause;
    const std::uint64_t size = 1 + random.below(4);
    for (std::uint64_t i = 0; i < size; ++i) {
        clause.push_back(static_cast<Literal>(random.below(2 * variables)));
    }
    return clause;
}

TEST(SatSolver, agrees_with_brute_force_while_clauses_are_added)
{
    Random random(1);
    int satisfiable = 0;
    int unsatisfiable = 0;
    for (int round = 0; round < 120; ++round) {
        const auto variables = static_cast<Index>(3 + random.below(8));
        SatSolver solver;
        for (Index v = 0; v < variables; ++v) {
            solver.add_variable(random.below(2) == 0);
        }
        Clauses clauses;
        for (int step = 0; step < 12; ++step) {
            for (int i = 0; i < 4; ++i) {
                clauses.push_back(random_clause(random, variables));
                solver.add_clause(clauses.back());
            }
            std::vector<Literal> assumptions;
            for (std::uint64_t i = random.below(4); i > 0; --i) {
                assumptions.push_back(static_cast<Literal>(random.below(2 * variables)));
            }
            const auto exists = [&](const std::vector<Literal>& assumed) {
                for (std::uint32_t a = 0; a < std::uint32_t{1} << variables; ++a) {
                    if (satisfies(a, clauses) &&
                        std::all_of(assumed.begin(), assumed.end(),
                                    [&](Literal l) { return holds(l, a); })) {
                        return true;
                    }
                }
                return false;
            };
            solver.begin(assumptions);
            auto outcome = SatSolver::Outcome::running;
            while (outcome == SatSolver::Outcome::running) {
                WorkBudget budget(1 + random.below(3));
                outcome = solver.run(budget);
            }
            ASSERT_EQ(outcome == SatSolver::Outcome::satisfiable, exists(assumptions));
            if (outcome == SatSolver::Outcome::satisfiable) {
                ++satisfiable;
                std::uint32_t model = 0;
                for (Index v = 0; v < variables; ++v) {
                    model |= solver.holds(2 * v) ? std::uint32_t{1} << v : 0;
                }
                EXPECT_TRUE(satisfies(model, clauses));
                for (const Literal l : assumptions) {
                    EXPECT_TRUE(solver.holds(l));
                }
            } else {
                ++unsatisfiable;
                for (const Literal l : solver.core()) {
                    EXPECT_NE(std::find(assumptions.begin(), assumptions.end(), l),
                              assumptions.end());
                }
                EXPECT_FALSE(exists(solver.core()));
            }
        }
    }
    EXPECT_GT(satisfiable, 200);
    EXPECT_GT(unsatisfiable, 200);
}

/// Pigeons that sit in one of a few holes each, alone, or stay out.
struct Pigeons {
    Pigeons(SatSolver& solver, Index pigeons, Index holes)
    {
        std::vector<std::vector<Literal>> sits(pigeons);
        for (auto& pigeon : sits) {
            stays_out.push_back(solver.add_variable());
            for (Index hole = 0; hole < holes; ++hole) {
                pigeon.push_back(solver.add_variable());
            }
            auto clause = pigeon;
            clause.push_back(stays_out.back());
            solver.add_clause(clause);
        }
        for (Index hole = 0; hole < holes; ++hole) {
            for (Index a = 0; a < pigeons; ++a) {
                for (Index b = 0; b < a; ++b) {
                    solver.add_clause(
                        {SatSolver::negate(sits[a][hole]), SatSolver::negate(sits[b][hole])});
                }
            }
        }
    }

    std::vector<Literal> stays_out;  // per pigeon
};

TEST(SatSolver, refutes_pigeons_in_too_few_holes)
{
    // Long enough for restarts and for learned clauses to be dropped.
    SatSolver solver;
    const Pigeons pigeons(solver, 8, 7);
    for (const Literal out : pigeons.stays_out) {
        solver.add_clause({SatSolver::negate(out)});
    }
    solver.begin({});
    WorkBudget budget;
    EXPECT_EQ(solver.run(budget), SatSolver::Outcome::unsatisfiable);
    EXPECT_TRUE(solver.core().empty());
    EXPECT_GT(solver.conflict_count(), 4000U);
}

TEST(SatSolver, forgets_between_short_calls_and_answers_stay_right)
{
    constexpr Index kHoles = 6;
    Random random(3);
    SatSolver solver;
    const Pigeons pigeons(solver, 10, kHoles);
    std::vector<Literal> assumptions;
    int refuted = 0;
    int placed = 0;
    int given_up = 0;
    while (solver.conflict_count() < 20'000) {
        // Calls that have assumptions in common, as where cores are made smaller.
        if (assumptions.empty() || random.below(4) == 0) {
            assumptions.clear();
            for (const Literal out : pigeons.stays_out) {
                if (random.below(4) != 0) {
                    assumptions.push_back(SatSolver::negate(out));
                }
            }
        } else {
            assumptions.erase(assumptions.begin() +
                              static_cast<std::ptrdiff_t>(random.below(assumptions.size())));
        }
        solver.begin(assumptions);
        solver.limit_conflicts(100);
        auto outcome = SatSolver::Outcome::running;
        while (outcome == SatSolver::Outcome::running && !solver.stopped()) {
            WorkBudget budget(1 + random.below(50));
            outcome = solver.run(budget);
        }
        if (outcome == SatSolver::Outcome::satisfiable) {
            ++placed;
            ASSERT_LE(assumptions.size(), kHoles);
        } else if (outcome == SatSolver::Outcome::unsatisfiable) {
            ++refuted;
            ASSERT_GT(solver.core().size(), kHoles);
        } else {
            ++given_up;
        }
    }
    EXPECT_GT(placed, 100);
    EXPECT_GT(refuted, 10);
    EXPECT_GT(given_up, 10);
    EXPECT_LT(solver.learned_count(), solver.conflict_count() / 2);
}

/// A random problem that grows, and its optimum by trying all assignments.
struct Weighted {
    Index variables;
    Clauses clauses;
    std::vector<std::pair<Literal, Length>> costs;

    Length optimum() const
    {
        Length best = kInfiniteLength;
        for (std::uint32_t a = 0; a < std::uint32_t{1} << variables; ++a) {
            if (satisfies(a, clauses)) {
                Length cost = 0;
                for (const auto& [l, weight] : costs) {
                    cost += holds(l, a) ? weight : 0;
                }
                best = std::min(best, cost);
            }
        }
        return best;
    }
};

TEST(WeightedSat, finds_the_optimum_that_brute_force_finds_while_the_problem_grows)
{
    Random random(2);
    std::uint64_t cores = 0;
    int infeasible = 0;
    for (int round = 0; round < 150; ++round) {
        Weighted problem{static_cast<Index>(4 + random.below(8)), {}, {}};
        WeightedSat solver;
        for (Index v = 0; v < problem.variables; ++v) {
            solver.add_variable(random.below(2) == 0);
        }
        Length told = 0;
        for (int step = 0; step < 5; ++step) {
            for (std::uint64_t i = 2 + random.below(6); i > 0; --i) {
                problem.clauses.push_back(random_clause(random, problem.variables));
                solver.add_clause(problem.clauses.back());
            }
            for (std::uint64_t i = 1 + random.below(4); i > 0; --i) {
                const auto literal = static_cast<Literal>(random.below(2 * problem.variables));
                const Length weight =
                    random.below(3) == 0 ? 1 + random.below(4) : 1 + random.below(1000);
                problem.costs.emplace_back(literal, weight);
                solver.add_cost(literal, weight);
            }
            const Length optimum = problem.optimum();
            auto outcome = WeightedSat::Outcome::running;
            const auto ends = [&] {
                return outcome == WeightedSat::Outcome::optimal ||
                       outcome == WeightedSat::Outcome::exceeded;
            };
            while (!ends()) {
                WorkBudget budget(1 + random.below(5));
                outcome = solver.run(budget);
                EXPECT_LE(solver.lower_bound(), optimum);
                EXPECT_GE(solver.lower_bound(), told);
                told = solver.lower_bound();
            }
            EXPECT_EQ(solver.lower_bound(), optimum);
            EXPECT_EQ(outcome == WeightedSat::Outcome::exceeded, optimum == kInfiniteLength);
            if (optimum == kInfiniteLength) {
                ++infeasible;
                break;
            }
            Length cost = 0;
            for (const auto& [l, weight] : problem.costs) {
                cost += solver.holds(l) ? weight : 0;
            }
            EXPECT_EQ(cost, optimum);
        }
        cores += solver.core_count();
    }
    EXPECT_GT(cores, 250U);
    EXPECT_GT(infeasible, 10);
}

TEST(WeightedSat, says_whether_anything_is_cheaper_than_the_upper_bound)
{
    Random random(3);
    for (int round = 0; round < 200; ++round) {
        Weighted problem{static_cast<Index>(4 + random.below(6)), {}, {}};
        WeightedSat solver;
        for (Index v = 0; v < problem.variables; ++v) {
            solver.add_variable();
        }
        for (int i = 0; i < 14; ++i) {
            problem.clauses.push_back(random_clause(random, problem.variables));
            problem.clauses.back().push_back(static_cast<Literal>(2 * random.below(3)));
            solver.add_clause(problem.clauses.back());
        }
        for (int i = 0; i < 8; ++i) {
            const auto literal = static_cast<Literal>(random.below(2 * problem.variables));
            problem.costs.emplace_back(literal, 1 + random.below(50));
            solver.add_cost(literal, problem.costs.back().second);
        }
        const Length optimum = problem.optimum();
        ASSERT_NE(optimum, kInfiniteLength);
        const Length limit = optimum + random.below(5);
        solver.lower_upper_bound(limit);
        auto outcome = WeightedSat::Outcome::running;
        WorkBudget budget;
        while (outcome != WeightedSat::Outcome::optimal &&
               outcome != WeightedSat::Outcome::exceeded) {
            outcome = solver.run(budget);
        }
        EXPECT_EQ(outcome == WeightedSat::Outcome::exceeded, limit == optimum);
        EXPECT_EQ(solver.lower_bound(), optimum);
    }
}

}  // namespace
}  // namespace layout_embedding
