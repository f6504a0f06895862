// One embedding, natively, for comparison with the package (tests/node/native.test.ts):
//
//   native_embed LAYOUT TARGET LANDMARKS SEED WORK_LIMIT WORK_PER_STEP
//
// Prints the exact results as one line of JSON, then the refined mesh as OBJ, byte for byte what
// the package has to make of the same input.

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

#include "apps/embed_job.hh"
#include "embedding/refined_obj.hh"
#include "layout/landmark_reader.hh"
#include "mesh/mesh_reader.hh"
#include "mesh/validation.hh"
#include "native_tool.hh"

namespace layout_embedding {
namespace {

int run(char** arguments)
{
    auto layout_mesh = read_mesh(bytes_of(arguments[1]), MeshFormat::detect, "the layout");
    if (!layout_mesh) {
        return fail(layout_mesh.error());
    }
    auto layout = Layout::from_polygons(*layout_mesh, "the layout");
    if (!layout) {
        return fail(layout.error());
    }
    auto target_mesh = read_mesh(bytes_of(arguments[2]), MeshFormat::detect, "the target");
    if (!target_mesh) {
        return fail(target_mesh.error());
    }
    if (const Status valid = check_surface(*target_mesh, SurfaceKind::target, "the target");
        !valid) {
        return fail(valid.error());
    }
    auto landmarks = read_landmarks(bytes_of(arguments[3]), "the landmark file");
    if (!landmarks) {
        return fail(landmarks.error());
    }
    auto problem = make_problem(std::make_shared<Layout>(std::move(*layout)),
                                std::make_shared<TriangleMesh>(*target_mesh), landmarks->vertices);
    if (!problem) {
        return fail(problem.error());
    }
    EmbedOptions options;
    options.seed = std::strtoull(arguments[4], nullptr, 10);
    options.work_limit = std::strtoull(arguments[5], nullptr, 10);
    StepBudget budget;
    budget.work = std::strtoull(arguments[6], nullptr, 10);
    EmbedJob job(std::move(*problem), options);
    while (job.step(budget)) {
    }
    const EmbedResult& result = job.result();
    if (!result.refined) {
        return fail(job.error());
    }
    std::string order;
    for (const Index edge : result.insertion_order) {
        order += order.empty() ? "" : ",";
        order += std::to_string(edge);
    }
    std::printf(
        "{\"exactCost\":\"%s\",\"exactLowerBound\":\"%s\",\"insertionOrder\":[%s],"
        "\"searches\":%s,\"expansions\":%s}\n%s",
        std::to_string(result.exact_cost).c_str(), std::to_string(result.exact_lower_bound).c_str(),
        order.c_str(), std::to_string(result.counters.searches).c_str(),
        std::to_string(result.counters.expansions).c_str(),
        write_refined_obj(*result.refined).c_str());
    return 0;
}

}  // namespace
}  // namespace layout_embedding

int main(int count, char** arguments)
{
    if (count != 7) {
        std::fprintf(stderr,
                     "usage: native_embed LAYOUT TARGET LANDMARKS SEED WORK_LIMIT "
                     "WORK_PER_STEP\n");
        return 2;
    }
    return layout_embedding::run(arguments);
}
