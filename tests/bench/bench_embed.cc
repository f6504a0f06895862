// One embedding, natively, measured for bench.mjs:
//
//   bench_embed LAYOUT TARGET LANDMARKS WORK [ALGORITHM [GAP]]
//
// LANDMARKS is a file or `proximity`, WORK the most units of work the search may spend; without an
// ALGORITHM or a GAP to be reached they are the library's defaults. Prints one JSON object, as
// embed_wasm.mjs does.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/embed_job.hh"
#include "json_object.hh"
#include "problem_files.hh"

namespace layout_embedding {
namespace {

// The names the package uses, in the order of the enumerations.
constexpr const char* kAlgorithms[] = {"greedy",           "praun", "kraevoy", "schreiner",
                                       "branch-and-bound", "exact"};
constexpr const char* kStatuses[] = {"running",    "optimal",   "gapReached",  "feasible",
                                     "timeLimit",  "workLimit", "memoryLimit", "cancelled",
                                     "infeasible", "noneFound", "failed"};

struct Arguments {
    const char* layout;
    const char* target;
    const char* landmarks;
    std::uint64_t work;
    std::optional<Algorithm> algorithm;
    std::optional<double> gap;
};

// Memory as Linux counts it for this process. Not getrusage(), whose peak begins with that of the
// process which started this one.
double megabytes(const char* field)
{
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        if (line.rfind(field, 0) == 0) {
            return std::strtod(line.c_str() + std::strlen(field), nullptr) / 1024;
        }
    }
    return 0;
}

double used_megabytes()
{
    return megabytes("VmRSS:");
}

double peak_megabytes()
{
    return megabytes("VmHWM:");
}

void forget_peak()
{
    std::ofstream("/proc/self/clear_refs") << "5";
}

/// What happened when, in CPU seconds since the job began.
struct Record {
    double first = std::numeric_limits<double>::infinity();
    double best = std::numeric_limits<double>::infinity();
    /// The end of the search.
    double end = 0;
    double search_megabytes = 0;
    std::string history;
};

/// Steps the job to its end, one action at a time.
Record run(EmbedJob& job)
{
    Record record;
    StepBudget one_action;
    one_action.milliseconds = 0;
    const double start = cpu_seconds();
    const double memory = used_megabytes();
    forget_peak();
    std::size_t seen = 0;
    for (bool running = true; running;) {
        running = job.step(one_action);
        const double now = cpu_seconds() - start;
        for (; seen < job.events().size(); ++seen) {
            const EmbedEvent& event = job.events()[seen];
            if (event.kind == EventKind::phase && event.phase > EmbedPhase::search &&
                record.end == 0) {
                record.end = now;
                record.search_megabytes = peak_megabytes() - memory;
            }
            if (event.kind == EventKind::incumbent) {
                record.first = std::min(record.first, now);
                record.best = now;
            }
            if (event.kind == EventKind::incumbent || event.kind == EventKind::bound) {
                record.history += record.history.empty() ? "" : ",";
                record.history += JsonObject()
                                      .put("cpu", now)
                                      .put("work", event.work)
                                      .put("cost", event.cost)
                                      .put("lowerBound", event.lower_bound)
                                      .json();
            }
        }
    }
    return record;
}

std::string counters_json(const EmbedCounters& counters)
{
    return JsonObject()
        .put("work", counters.work)
        .put("searches", counters.searches)
        .put("expansions", counters.expansions)
        .put("fieldNodes", counters.field_nodes)
        .put("insertions", counters.insertions)
        .put("remembered", counters.remembered)
        .put("statesCreated", counters.states_created)
        .put("statesExpanded", counters.states_expanded)
        .put("statesPruned", counters.states_pruned)
        .put("statesRedundant", counters.states_redundant)
        .put("deadEnds", counters.dead_ends)
        .put("ties", counters.ties)
        .json();
}

/// How long the chains are on the surface, and how good the triangles beside them.
std::string paths_json(const EmbedResult& result)
{
    double even = 0;
    for (const double length : result.even_lengths) {
        even += length;
    }
    double length = 0;
    if (result.refined) {
        for (const std::vector<Index>& chain : result.refined->chains) {
            for (std::size_t i = 1; i < chain.size(); ++i) {
                length +=
                    (result.refined->positions[chain[i]] - result.refined->positions[chain[i - 1]])
                        .norm();
            }
        }
    }
    return JsonObject()
        .put("length", length)
        .put("evenLength", even)
        .put("smallestAngle", result.quality.smallest_angle)
        .json();
}

int run(const Arguments& arguments)
{
    auto problem = load_problem(arguments.layout, arguments.target, arguments.landmarks);
    if (!problem) {
        std::fprintf(stderr, "%s\n", problem.error().message.c_str());
        return 2;
    }
    const double load_cpu = cpu_seconds();
    const double load_peak = peak_megabytes();
    EmbedOptions options;
    options.work_limit = arguments.work;
    options.algorithm = arguments.algorithm.value_or(options.algorithm);
    options.gap = arguments.gap.value_or(options.gap);
    const TriangleMesh& target = *problem->target;
    const std::string size = JsonObject()
                                 .put("vertices", std::uint64_t{target.vertex_count()})
                                 .put("triangles", std::uint64_t{target.face_count()})
                                 .put("nodes", std::uint64_t{target.vertex_count()} +
                                                   target.edge_count() + target.face_count())
                                 .put("landmarks", std::uint64_t{problem->layout->vertex_count()})
                                 .put("layoutEdges", std::uint64_t{problem->layout->edge_count()})
                                 .json();
    EmbedJob job(std::move(*problem), options);
    const Record record = run(job);
    const double total = cpu_seconds() - load_cpu;

    const EmbedResult& result = job.result();
    if (job.error().code != ErrorCode::none) {
        std::fprintf(stderr, "%s\n", job.error().message.c_str());
    }
    JsonObject output;
    if (result.exact_cost != kInfiniteLength) {
        output.put_text("exactCost", std::to_string(result.exact_cost));
    }
    output.put_text("algorithm", kAlgorithms[static_cast<std::size_t>(options.algorithm)])
        .put_text("status", kStatuses[static_cast<std::size_t>(result.status)])
        .put("valid", std::string(result.refined ? "true" : "false"))
        .put("cost", result.cost)
        .put("lowerBound", result.lower_bound)
        .put("gap", result.gap)
        .put_text("exactLowerBound", std::to_string(result.exact_lower_bound))
        .put("size", size)
        .put("counters", counters_json(result.counters))
        .put("cpu", JsonObject()
                        .put("load", load_cpu)
                        .put("first", record.first)
                        .put("best", record.best)
                        .put("end", record.end)
                        .put("shape", result.shape_seconds)
                        .put("cut", result.cut_seconds)
                        .put("total", total)
                        .json())
        .put("paths", paths_json(result))
        .put("memory", JsonObject()
                           .put("search", record.search_megabytes)
                           .put("peak", std::max(load_peak, peak_megabytes()))
                           .json())
        .put("history", "[" + record.history + "]");
    std::printf("%s\n", output.json().c_str());
    return 0;
}

std::optional<Algorithm> algorithm_of(const std::string& name)
{
    for (std::size_t i = 0; i < std::size(kAlgorithms); ++i) {
        if (name == kAlgorithms[i]) {
            return static_cast<Algorithm>(i);
        }
    }
    return std::nullopt;
}

int run(int count, char** words)
{
    if (count < 5 || count > 7) {
        std::fprintf(stderr, "usage: bench_embed LAYOUT TARGET LANDMARKS WORK [ALGORITHM [GAP]]\n");
        return 2;
    }
    Arguments arguments{words[1], words[2], words[3], std::strtoull(words[4], nullptr, 10), {}, {}};
    if (count >= 6) {
        arguments.algorithm = algorithm_of(words[5]);
        if (!arguments.algorithm) {
            std::fprintf(stderr, "there is no algorithm %s\n", words[5]);
            return 2;
        }
    }
    if (count == 7) {
        arguments.gap = std::strtod(words[6], nullptr);
    }
    return run(arguments);
}

}  // namespace
}  // namespace layout_embedding

int main(int argc, char** argv)
{
    return layout_embedding::run(argc, argv);
}
