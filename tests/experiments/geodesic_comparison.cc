// The paths of a best embedding beside the geodesics of their homotopy classes:
//
//   geodesic_comparison LAYOUT TARGET LANDMARKS WORK
//
// Prints a JSON array, per layout edge: its length in the path graph (`cost`), on the surface in
// the shapes even and short, and that of the locally shortest path in its class whatever the other
// paths do (`geodesic`, null where the reference does not find it).

#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "apps/embed_job.hh"
#include "geodesic_reference.hh"
#include "json_object.hh"
#include "problem_files.hh"

namespace layout_embedding {
namespace {

int run(char** words)
{
    auto problem = load_problem(words[1], words[2], words[3]);
    if (!problem) {
        std::fprintf(stderr, "%s\n", problem.error().message.c_str());
        return 2;
    }
    EmbedOptions options;
    options.gap = 0;
    options.work_limit = std::strtoull(words[4], nullptr, 10);
    EmbedJob job(std::move(*problem), options);
    while (job.step()) {
    }
    const EmbedResult& result = job.result();
    if (!result.refined) {
        std::fprintf(stderr, "no embedding\n");
        return 1;
    }
    std::string list;
    for (Index e = 0; e < result.edge_costs.size(); ++e) {
        const std::vector<Index>& chain = result.refined->chains[e];
        double length = 0;
        for (std::size_t i = 1; i < chain.size(); ++i) {
            length +=
                (result.refined->positions[chain[i]] - result.refined->positions[chain[i - 1]])
                    .norm();
        }
        const auto geodesic =
            test::geodesic_length(job.problem(), *job.graph(), result.weak.paths[e].darts);
        list += list.empty() ? "" : ",";
        list += JsonObject()
                    .put("cost", result.edge_costs[e])
                    .put("even", result.even_lengths[e])
                    .put("short", length)
                    .put("geodesic", geodesic.value_or(std::numeric_limits<double>::infinity()))
                    .json();
    }
    std::printf("[%s]\n", list.c_str());
    return 0;
}

}  // namespace
}  // namespace layout_embedding

int main(int count, char** words)
{
    if (count != 5) {
        std::fprintf(stderr, "usage: geodesic_comparison LAYOUT TARGET LANDMARKS WORK\n");
        return 2;
    }
    return layout_embedding::run(words);
}
