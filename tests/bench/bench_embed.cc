// One embedding, natively, measured for bench.mjs:
//
//   bench_embed LAYOUT TARGET LANDMARKS WORK [ALGORITHM [GAP]]
//
// LANDMARKS is a file or `proximity`, WORK the most units of work the search may spend; without an
// ALGORITHM or a GAP to be reached they are the library's defaults. Prints one JSON object, as
// embed_wasm.mjs does.

#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/embed_job.hh"
#include "layout/landmark_reader.hh"
#include "layout/proximity.hh"
#include "mesh/mesh_reader.hh"
#include "mesh/validation.hh"

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

double cpu_seconds()
{
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

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

Result<std::string> bytes_of(const char* path)
{
    std::ifstream file(path, std::ios::binary);
    if (!file) {
        return make_error(ErrorCode::invalidOption, std::string(path) + " cannot be read");
    }
    return std::string{std::istreambuf_iterator<char>(file), {}};
}

Result<PolygonMesh> read_file(const char* path)
{
    const auto bytes = bytes_of(path);
    if (!bytes) {
        return bytes.error();
    }
    return read_mesh(*bytes, format_of_file_name(path), path);
}

Result<std::vector<Index>> landmarks_of(const Arguments& arguments, const Layout& layout,
                                        const PolygonMesh& layout_mesh, const TriangleMesh& target)
{
    if (std::string(arguments.landmarks) == "proximity") {
        return landmarks_by_proximity(layout, layout_mesh.positions, target);
    }
    const auto bytes = bytes_of(arguments.landmarks);
    if (!bytes) {
        return bytes.error();
    }
    auto landmarks = read_landmarks(*bytes, arguments.landmarks);
    if (!landmarks) {
        return landmarks.error();
    }
    return std::move(landmarks->vertices);
}

Result<EmbeddingProblem> load(const Arguments& arguments)
{
    auto layout_mesh = read_file(arguments.layout);
    if (!layout_mesh) {
        return layout_mesh.error();
    }
    auto target_mesh = read_file(arguments.target);
    if (!target_mesh) {
        return target_mesh.error();
    }
    auto layout = Layout::from_polygons(*layout_mesh, arguments.layout);
    if (!layout) {
        return layout.error();
    }
    if (Status usable = check_surface(*target_mesh, SurfaceKind::target, arguments.target);
        !usable) {
        return usable.error();
    }
    auto target = std::make_shared<TriangleMesh>(*target_mesh);
    auto landmarks = landmarks_of(arguments, *layout, *layout_mesh, *target);
    if (!landmarks) {
        return landmarks.error();
    }
    return make_problem(std::make_shared<Layout>(std::move(*layout)), std::move(target),
                        std::move(*landmarks));
}

/// A JSON object in the making.
class Object {
public:
    Object& put(const char* name, const std::string& json)
    {
        text_ += text_.empty() ? "\"" : ",\"";
        text_ += name;
        text_ += "\":";
        text_ += json;
        return *this;
    }
    /// null for infinity.
    Object& put(const char* name, double number)
    {
        char digits[40];
        std::snprintf(digits, sizeof digits, "%.17g", number);
        return put(name, std::isfinite(number) ? std::string(digits) : "null");
    }
    Object& put(const char* name, std::uint64_t number)
    {
        return put(name, std::to_string(number));
    }
    Object& put_text(const char* name, const std::string& text)
    {
        std::string quoted = "\"";
        quoted += text;
        quoted += '"';
        return put(name, quoted);
    }
    std::string json() const { return "{" + text_ + "}"; }

private:
    std::string text_;
};

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
                record.history += Object()
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
    return Object()
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
    return Object()
        .put("length", length)
        .put("evenLength", even)
        .put("smallestAngle", result.quality.smallest_angle)
        .json();
}

int run(const Arguments& arguments)
{
    auto problem = load(arguments);
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
    const std::string size = Object()
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
    Object output;
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
        .put("cpu", Object()
                        .put("load", load_cpu)
                        .put("first", record.first)
                        .put("best", record.best)
                        .put("end", record.end)
                        .put("shape", result.shape_seconds)
                        .put("cut", result.cut_seconds)
                        .put("total", total)
                        .json())
        .put("paths", paths_json(result))
        .put("memory", Object()
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
