// One embedding, natively, measured: bench_embed LAYOUT TARGET < LANDMARKS
//
// Landmarks (one target vertex id per layout vertex) come from standard input, so that bench.mjs
// can give this program and the package the same ones. Prints one JSON object.

#include <chrono>
#include <cinttypes>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <sys/resource.h>

#include "apps/embed_job.hh"
#include "mesh/mesh_reader.hh"
#include "mesh/validation.hh"

namespace layout_embedding {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start)
{
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// The names the package uses.
const char* name(EmbedStatus status)
{
    switch (status) {
        case EmbedStatus::running:
            return "running";
        case EmbedStatus::optimal:
            return "optimal";
        case EmbedStatus::gap_reached:
            return "gapReached";
        case EmbedStatus::feasible:
            return "feasible";
        case EmbedStatus::time_limit:
            return "timeLimit";
        case EmbedStatus::work_limit:
            return "workLimit";
        case EmbedStatus::memory_limit:
            return "memoryLimit";
        case EmbedStatus::cancelled:
            return "cancelled";
        case EmbedStatus::infeasible:
            return "infeasible";
        case EmbedStatus::none_found:
            return "noneFound";
        case EmbedStatus::failed:
            return "failed";
    }
    return "unknown";
}

const char* name(EmbedPhase phase)
{
    switch (phase) {
        case EmbedPhase::prepare:
            return "prepare";
        case EmbedPhase::search:
            return "search";
        case EmbedPhase::realise:
            return "realise";
        case EmbedPhase::check:
            return "check";
        case EmbedPhase::done:
            return "done";
    }
    return "unknown";
}

Result<PolygonMesh> read_file(const char* path)
{
    std::ifstream file(path, std::ios::binary);
    if (!file) {
        return make_error(ErrorCode::invalidOption, std::string(path) + " cannot be read");
    }
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    return read_mesh(bytes, format_of_file_name(path), path);
}

Result<EmbeddingProblem> load(const char* layout_path, const char* target_path)
{
    auto layout_mesh = read_file(layout_path);
    if (!layout_mesh) {
        return layout_mesh.error();
    }
    auto target_mesh = read_file(target_path);
    if (!target_mesh) {
        return target_mesh.error();
    }
    auto layout = Layout::from_polygons(*layout_mesh, layout_path);
    if (!layout) {
        return layout.error();
    }
    if (Status usable = check_surface(*target_mesh, SurfaceKind::target, target_path); !usable) {
        return usable.error();
    }
    const std::vector<Index> landmarks{std::istream_iterator<Index>(std::cin), {}};
    return make_problem(std::make_shared<Layout>(std::move(*layout)),
                        std::make_shared<TriangleMesh>(*target_mesh), landmarks);
}

/// Seconds from each phase event to the next, as members of a JSON object.
std::string phase_seconds(const std::vector<EmbedEvent>& events)
{
    std::string text;
    const EmbedEvent* previous = nullptr;
    for (const EmbedEvent& event : events) {
        if (event.kind != EventKind::phase) {
            continue;
        }
        if (previous != nullptr) {
            text += (text.empty() ? "\"" : ",\"") + std::string(name(previous->phase)) +
                    "\":" + std::to_string(event.seconds - previous->seconds);
        }
        previous = &event;
    }
    return text;
}

int run(const char* layout_path, const char* target_path)
{
    const auto start = Clock::now();
    auto problem = load(layout_path, target_path);
    if (!problem) {
        std::fprintf(stderr, "%s\n", problem.error().message.c_str());
        return 2;
    }
    const double load_seconds = seconds_since(start);
    EmbedJob job(std::move(*problem), {});
    while (job.step()) {
    }
    const EmbedResult& result = job.result();
    if (job.error().code != ErrorCode::none) {
        std::fprintf(stderr, "%s\n", job.error().message.c_str());
    }
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const bool found = result.exact_cost != kInfiniteLength;
    std::printf("{\"status\":\"%s\"", name(result.status));
    if (found) {
        std::printf(",\"cost\":%.17g,\"exactCost\":\"%" PRIu64 "\"", result.cost,
                    std::uint64_t{result.exact_cost});
    } else {
        std::printf(",\"cost\":null,\"exactCost\":null");
    }
    std::printf(",\"lowerBound\":%.17g,\"exactLowerBound\":\"%" PRIu64 "\",\"gap\":%.17g",
                result.lower_bound, std::uint64_t{result.exact_lower_bound}, result.gap);
    std::printf(",\"phases\":{\"load\":%f%s%s}", load_seconds, job.events().empty() ? "" : ",",
                phase_seconds(job.events()).c_str());
    const EmbedCounters& counters = result.counters;
    std::printf(",\"counters\":{\"searches\":%" PRIu64 ",\"expansions\":%" PRIu64
                ",\"fieldNodes\":%" PRIu64 ",\"insertions\":%" PRIu64 ",\"ties\":%" PRIu64 "}",
                counters.searches, counters.expansions, counters.field_nodes, counters.insertions,
                counters.ties);
    std::printf(",\"seconds\":%f,\"cpuSeconds\":%f,\"peakMegabytes\":%.1f}\n", seconds_since(start),
                static_cast<double>(std::clock()) / CLOCKS_PER_SEC,
                static_cast<double>(usage.ru_maxrss) / 1024);
    return 0;
}

}  // namespace
}  // namespace layout_embedding

int main(int argc, char** argv)
{
    if (argc != 3) {
        std::fprintf(stderr, "usage: bench_embed LAYOUT TARGET < LANDMARKS\n");
        return 2;
    }
    return layout_embedding::run(argv[1], argv[2]);
}
