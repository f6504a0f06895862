// Whole embeddings: bytes become a layout and a target, made from spheres or tori by splits, flips
// and collapses; layouts of any polygons with any rotation system, with holes or without, landmarks
// anywhere.
#include <memory>
#include <utility>
#include <vector>

#include "apps/embed_job.hh"
#include "fuzz.hh"
#include "mesh/validation.hh"
#include "random_surface.hh"

using namespace layout_embedding;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    Bytes bytes(data, size);
    EmbedOptions options;
    options.algorithm = static_cast<Algorithm>(bytes.below(6));
    options.shape = static_cast<PathShape>(bytes.below(3));
    options.metric.feature_discount = 0.5 * bytes.below(2);
    options.seed = bytes.below(256);
    options.gap = 0;
    options.work_limit = 20'000;

    const Index kind = bytes.below(16);
    const auto start = kind % 4 == 3 ? RandomSurface::torus : RandomSurface::sphere;
    RandomSurface layout_surface = start();
    layout_surface.change(bytes, bytes.below(6));
    RandomFaces layout_faces = layout_surface.faces();
    const Index holes = kind < 8 ? 0 : 1 + bytes.below(3);
    layout_faces.leave_out(bytes, holes);
    layout_faces.merge(bytes, bytes.below(6));
    RandomSurface target_surface = start();
    target_surface.change(bytes, 8 + bytes.below(16));
    RandomFaces target_faces = target_surface.faces();
    // A layout with holes fits into a target with as many, or with none.
    target_faces.leave_out(bytes, kind < 12 ? 0 : holes);

    const auto layout = Layout::from_polygons(layout_faces.mesh(), "the layout");
    if (!layout) {
        FUZZ_CHECK(layout.error().code == ErrorCode::duplicateFace);
        return 0;  // two merged faces have the same corners
    }
    const PolygonMesh target = target_faces.mesh();
    if (const Status usable = check_surface(target, SurfaceKind::target, "the target"); !usable) {
        FUZZ_CHECK(usable.error().code == ErrorCode::degenerateFace);
        return 0;  // a flip or collapse has left a face without area
    }
    std::vector<Index> free_vertices(target.positions.size());
    for (Index v = 0; v < free_vertices.size(); ++v) {
        free_vertices[v] = v;
    }
    std::vector<Index> landmarks;
    while (landmarks.size() < layout->vertex_count() && !free_vertices.empty()) {
        const Index place = bytes.below(free_vertices.size());
        landmarks.push_back(free_vertices[place]);
        free_vertices.erase(free_vertices.begin() + place);
    }
    auto problem = make_problem(std::make_shared<const Layout>(*layout),
                                std::make_shared<const TriangleMesh>(target), landmarks);
    if (!problem) {
        const ErrorCode code = problem.error().code;
        // More layout vertices than the target has, an inner one on a rim, holes that touch.
        FUZZ_CHECK(code == ErrorCode::landmarkCount || code == ErrorCode::landmarkOnBoundary ||
                   (code == ErrorCode::topologyMismatch && holes > 0));
        return 0;
    }
    EmbedJob job(std::move(*problem), options);
    while (job.step()) {
    }
    // The job sends what it found through the checker itself, and fails where that refuses.
    const EmbedResult& result = job.result();
    FUZZ_CHECK(result.status != EmbedStatus::failed ||
               job.error().code == ErrorCode::unresolvedTie);
    FUZZ_CHECK(result.exact_cost >= result.exact_lower_bound);
    FUZZ_CHECK(result.status != EmbedStatus::optimal || result.refined.has_value());
    return 0;
}
