// Searches with parts switched off, natively, for ablations:
//
//   search_variants LAYOUT TARGET LANDMARKS WORK GAP VARIANT...
//
// WORK: the most units of work a search may spend; GAP: the gap to be reached. A VARIANT is a
// method and what it goes without: `branch-and-bound`, with `-start`, `-local-search`,
// `-candidates`,
// `-redundant`, `-delay`, `-priority`, `-memory` after it; or `exact`, with `-local-search`,
// `-exploration`, `-faces`. Prints a JSON array, one object per VARIANT.

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "json_object.hh"
#include "problem_files.hh"
#include "search/exact_solver.hh"
#include "search/sequence_solver.hh"
#include "surface/path_graph.hh"

namespace layout_embedding {
namespace {

constexpr std::uint64_t kFieldBytes = std::uint64_t{1} << 30U;
constexpr std::uint64_t kSlice = 20'000;
constexpr std::uint32_t kMaxAttempts = 8;

bool without(const std::string& variant, const char* part)
{
    return (variant + "-").find(std::string("-") + part + "-") != std::string::npos;
}

std::unique_ptr<Solver> make_solver(const EmbeddingProblem& problem, const PathGraph& graph,
                                    double gap, const std::string& variant)
{
    if (variant.rfind("exact", 0) == 0) {
        ExactSolverOptions options;
        options.gap = gap;
        options.local_search = !without(variant, "local-search");
        options.exploration = !without(variant, "exploration");
        options.faces = !without(variant, "faces");
        return std::make_unique<ExactSolver>(problem, graph, kFieldBytes, options);
    }
    SequenceSolverOptions options;
    options.greedy_start = !without(variant, "start");
    options.local_search = options.greedy_start && !without(variant, "local-search");
    options.remember = !without(variant, "memory");
    options.branch_and_bound.gap = gap;
    options.branch_and_bound.candidate_bounds = !without(variant, "candidates");
    options.branch_and_bound.pairwise_bounds = !without(variant, "pairs");
    options.branch_and_bound.detect_redundant_states = !without(variant, "redundant");
    options.branch_and_bound.delay_non_conflicting = !without(variant, "delay");
    options.branch_and_bound.mixed_priority = !without(variant, "priority");
    return std::make_unique<SequenceSolver>(problem, graph, kFieldBytes, options);
}

struct Course {
    std::string history;
    double cpu = 0;
    std::uint64_t work = 0;
};

void note(Course& course, const PathGraph& graph, const Solver& solver, double begin)
{
    course.cpu = cpu_seconds() - begin;
    course.history += course.history.empty() ? "" : ",";
    course.history += JsonObject()
                          .put("cpu", course.cpu)
                          .put("work", course.work)
                          .put("cost", graph.to_units(solver.incumbent_cost()))
                          .put("lowerBound", graph.to_units(solver.lower_bound()))
                          .json();
}

/// One search; nothing after a tie.
std::optional<std::string> search(const EmbeddingProblem& problem, std::uint64_t work, double gap,
                                  const std::string& variant, std::uint32_t attempt)
{
    const double begin = cpu_seconds();
    const PathGraph graph = PathGraph::barycentric(*problem.target, {1, attempt});
    const auto solver = make_solver(problem, graph, gap, variant);
    Course course;
    bool finished = false;
    while (!finished && course.work < work) {
        WorkBudget budget(std::min(kSlice, work - course.work));
        const auto outcome = solver->run(budget);
        course.work += budget.spent();
        if (outcome == Solver::Outcome::tied) {
            return std::nullopt;
        }
        finished = outcome == Solver::Outcome::finished;
        if (outcome == Solver::Outcome::improved || outcome == Solver::Outcome::bounded) {
            note(course, graph, *solver, begin);
        }
    }
    note(course, graph, *solver, begin);
    const SearchCounters counters = solver->counters();
    const Length cost = solver->incumbent_cost();
    const Length bound = solver->lower_bound();
    return JsonObject()
        .put_text("variant", variant)
        .put("finished", std::string(finished ? "true" : "false"))
        .put("cost", graph.to_units(cost))
        .put("lowerBound", graph.to_units(bound))
        .put("gap", cost == kInfiniteLength
                        ? 1.0
                        : static_cast<double>(cost - bound) / static_cast<double>(cost))
        .put("cpu", course.cpu)
        .put("work", course.work)
        .put("searches", counters.searches)
        .put("states", counters.states_created)
        .put("history", "[" + course.history + "]")
        .json();
}

int run(int count, char** words)
{
    const auto problem = load_problem(words[1], words[2], words[3]);
    if (!problem) {
        std::fprintf(stderr, "%s\n", problem.error().message.c_str());
        return 2;
    }
    const std::uint64_t work = std::strtoull(words[4], nullptr, 10);
    const double gap = std::strtod(words[5], nullptr);
    std::string results;
    for (int i = 6; i < count; ++i) {
        std::optional<std::string> result;
        for (std::uint32_t attempt = 0; !result && attempt < kMaxAttempts; ++attempt) {
            result = search(*problem, work, gap, words[i], attempt);
        }
        if (!result) {
            std::fprintf(stderr, "equal lengths, whatever the perturbation\n");
            return 1;
        }
        results += (results.empty() ? "" : ",\n") + *result;
    }
    std::printf("[%s]\n", results.c_str());
    return 0;
}

}  // namespace
}  // namespace layout_embedding

int main(int count, char** words)
{
    if (count < 7) {
        std::fprintf(stderr,
                     "usage: search_variants LAYOUT TARGET LANDMARKS WORK GAP VARIANT...\n");
        return 2;
    }
    return layout_embedding::run(count, words);
}
