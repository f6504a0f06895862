#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <memory>

#include "apps/embed_job.hh"
#include "apps/surface_map.hh"
#include "apps/template_layout.hh"
#include "embedding/triangle_quality.hh"
#include "embedding_checks.hh"
#include "geodesic_reference.hh"
#include "layout/landmark_reader.hh"
#include "layout/proximity.hh"
#include "mesh/mesh_reader.hh"
#include "mesh/validation.hh"
#include "patches/patch_shape.hh"
#include "test_data.hh"
#include "zoo.hh"

// The whole way on meshes of realistic size and shape; every result through both checkers.

namespace layout_embedding {
namespace {

PolygonMesh mesh_file(const std::string& file)
{
    auto mesh = read_mesh(read_bytes(test_data_path(file)), MeshFormat::detect, file);
    EXPECT_TRUE(mesh.ok()) << mesh.error().message;
    return mesh.ok() ? *mesh : PolygonMesh{};
}

std::shared_ptr<const Layout> layout_of(const PolygonMesh& mesh)
{
    auto layout = Layout::from_polygons(mesh, "the layout");
    EXPECT_TRUE(layout.ok()) << layout.error().message;
    return std::make_shared<const Layout>(std::move(*layout));
}

std::shared_ptr<const TriangleMesh> target_of(const PolygonMesh& mesh)
{
    const auto status = check_surface(mesh, SurfaceKind::target, "the target");
    EXPECT_TRUE(status.ok()) << status.error().message;
    return std::make_shared<const TriangleMesh>(mesh);
}

/// Landmarks far from each other, in an order that has nothing to do with the layout: each one is
/// the inner vertex farthest from all before it.
std::vector<Index> farthest_points(const TriangleMesh& target, Index count, Index first)
{
    std::vector<double> distances(target.vertex_count(), std::numeric_limits<double>::infinity());
    std::vector<Index> chosen;
    Index next = first;
    while (chosen.size() < count) {
        chosen.push_back(next);
        for (Index v = 0; v < target.vertex_count(); ++v) {
            distances[v] = std::min(distances[v],
                                    (target.position(v) - target.position(chosen.back())).norm());
            if (target.is_boundary_vertex(v)) {
                distances[v] = 0;
            }
        }
        next = static_cast<Index>(std::max_element(distances.begin(), distances.end()) -
                                  distances.begin());
    }
    return chosen;
}

/// Embeds and checks; the result for further questions. `must_complete`: an end without an
/// embedding is a failure.
EmbedResult embed(const std::shared_ptr<const Layout>& layout,
                  const std::shared_ptr<const TriangleMesh>& target, std::vector<Index> landmarks,
                  bool must_complete = true)
{
    auto problem = make_problem(layout, target, std::move(landmarks));
    EXPECT_TRUE(problem.ok()) << problem.error().message;
    if (!problem.ok()) {
        return {};
    }
    EmbedOptions options;
    options.work_limit = 800'000;  // enough for a good embedding
    EmbedJob job(std::move(*problem), options);
    while (job.step()) {
    }
    const EmbedResult& result = job.result();
    EXPECT_EQ(job.error().message, "");
    EXPECT_TRUE(result.refined.has_value() ||
                (!must_complete && (result.status == EmbedStatus::none_found ||
                                    result.status == EmbedStatus::work_limit)));
    if (result.refined) {
        test::expect_strands(job.problem(), *job.graph(), result.weak);
        test::expect_valid(job.problem(), *job.graph(), result.weak, *result.refined);
        EXPECT_LE(result.exact_lower_bound, result.exact_cost);
        EXPECT_EQ(result.exact_cost, test::total_length(*job.graph(), result.weak));
    }
    return result;
}

std::vector<Index> landmark_file(const std::string& file)
{
    const auto landmarks = read_landmarks(read_bytes(test_data_path(file)), file);
    EXPECT_TRUE(landmarks.ok()) << landmarks.error().message;
    return landmarks.ok() ? landmarks->vertices : std::vector<Index>{};
}

TEST(RealMesh, control_meshes_as_layouts_of_their_surfaces)
{
    for (const std::string name : {"spot", "penguin"}) {
        SCOPED_TRACE(name);
        LAYOUT_EMBEDDING_NEED_DATA("data/" + name + ".obj");
        const PolygonMesh control = mesh_file("data/" + name + "_control_mesh.obj");
        const auto layout = layout_of(control);
        const auto target = target_of(mesh_file("data/" + name + ".obj"));
        const auto landmarks = landmarks_by_proximity(*layout, control.positions, *target);
        ASSERT_TRUE(landmarks.ok()) << landmarks.error().message;
        // Plain greedy insertion is far from the optimum here.
        const EmbedResult result = embed(layout, target, *landmarks);
        EXPECT_GT(result.lower_bound, 0);
    }
}

TEST(RealMesh, cubes_on_spheres)
{
    LAYOUT_EMBEDDING_NEED_DATA("instances/sphere_cube");
    const auto layout = layout_of(mesh_file("instances/sphere_cube/cube_layout.obj"));
    for (const std::string sphere : {"sphere5", "sphere6"}) {
        const auto target = target_of(mesh_file("instances/" + sphere + ".obj"));
        for (int seed = 1; seed <= 10; ++seed) {
            SCOPED_TRACE(sphere + " seed " + std::to_string(seed));
            embed(layout, target,
                  landmark_file("instances/sphere_cube/" + sphere + "_seed" + std::to_string(seed) +
                                ".txt"));
        }
    }
}

TEST(RealMesh, hulls_and_icosahedra_with_displaced_landmarks)
{
    LAYOUT_EMBEDDING_NEED_DATA("instances/hull");
    const auto target = target_of(mesh_file("instances/sphere5.obj"));
    int count = 0;
    for (const std::string folder : {"instances/hull", "instances/icosahedron"}) {
        std::vector<std::filesystem::path> files;
        for (const auto& entry : std::filesystem::directory_iterator(test_data_path(folder))) {
            if (entry.path().extension() == ".txt") {
                files.push_back(entry.path());
            }
        }
        std::sort(files.begin(), files.end());
        for (const auto& file : files) {
            SCOPED_TRACE(file.filename().string());
            const std::string stem = file.stem().string();
            const std::string mesh =
                folder + "/" + (stem.substr(0, 3) == "ico" ? "icosahedron" : stem) + ".obj";
            embed(layout_of(mesh_file(mesh)), target, landmark_file(folder + "/" + stem + ".txt"));
            ++count;
        }
    }
    EXPECT_GE(count, 24);
}

TEST(RealMesh, icosahedra_at_far_points_of_scans)
{
    const auto layout = layout_of(zoo::icosahedron());
    for (const std::string file : {"human_man.obj", "fish.obj", "cino_humanoid.off"}) {
        SCOPED_TRACE(file);
        LAYOUT_EMBEDDING_NEED_DATA("data/" + file);
        const auto target = target_of(mesh_file("data/" + file));
        embed(layout, target, farthest_points(*target, layout->vertex_count(), 0));
    }
}

TEST(RealMesh, small_layouts_on_disks)
{
    for (const std::string file :
         {"hand_lowres.obj", "demosthenes-low-res.obj", "cino_maxFace.obj"}) {
        LAYOUT_EMBEDDING_NEED_DATA("data/" + file);
        const auto target = target_of(mesh_file("data/" + file));
        int complete = 0;
        for (const PolygonMesh& mesh : {zoo::polygon(4), zoo::wheel(3), zoo::quad_grid(2, 1)}) {
            for (Index shift = 0; shift < 4; ++shift) {
                SCOPED_TRACE(file + ", shift " + std::to_string(shift));
                const auto layout = layout_of(mesh);
                auto landmarks =
                    farthest_points(*target, layout->vertex_count(), target->vertex_count() / 2);
                std::rotate(landmarks.begin(), landmarks.begin() + shift % landmarks.size(),
                            landmarks.end());
                complete += embed(layout, target, landmarks, false).refined.has_value() ? 1 : 0;
            }
        }
        EXPECT_GT(complete, 0);
        RecordProperty("complete_on_" + file.substr(0, 4), complete);
    }
}

TEST(RealMesh, a_coarse_torus_on_a_fine_one)
{
    LAYOUT_EMBEDDING_NEED_DATA("data/torus.obj");
    const auto target = target_of(mesh_file("data/torus.obj"));
    // The ring of the torus lies in the plane of the two longest sides of its bounding box.
    Vec3 low = target->position(0);
    Vec3 high = low;
    for (const Vec3& p : target->positions()) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    const Vec3 size = high - low;
    int axis = 0;
    size.minCoeff(&axis);
    const PolygonMesh coarse = zoo::quad_torus(4, 4);
    Vec3 coarse_low = coarse.positions[0];
    Vec3 coarse_high = coarse_low;
    for (const Vec3& p : coarse.positions) {
        coarse_low = coarse_low.cwiseMin(p);
        coarse_high = coarse_high.cwiseMax(p);
    }
    int coarse_axis = 0;
    (coarse_high - coarse_low).minCoeff(&coarse_axis);
    std::vector<Vec3> positions;
    for (const Vec3& p : coarse.positions) {
        const Vec3 unit = (p - coarse_low).cwiseQuotient(coarse_high - coarse_low);
        Vec3 placed;
        for (int k = 0; k < 3; ++k) {
            placed[(axis + k) % 3] = unit[(coarse_axis + k) % 3];
        }
        positions.emplace_back(low + placed.cwiseProduct(size));
    }
    const auto layout = layout_of(coarse);
    const auto landmarks = landmarks_by_proximity(*layout, positions, *target);
    ASSERT_TRUE(landmarks.ok()) << landmarks.error().message;
    const EmbedResult result = embed(layout, target, *landmarks);
    EXPECT_LT(result.gap, 0.1);
}

double smallest_angle(const TriangleMesh& mesh)
{
    return triangle_quality(mesh.positions(), mesh.corners()).smallest_angle;
}

TEST(RealMesh, all_shapes_have_large_angles_and_short_paths_are_locally_shortest)
{
    int compared = 0;
    for (const std::string file : {"cat-low-resolution.obj",
                                   "cino_blub_triangulated.obj",
                                   "cino_cactus.off",
                                   "cino_humanoid.off",
                                   "cino_maxFace.obj",
                                   "demosthenes-low-res.obj",
                                   "fish.obj",
                                   "fish_low_resolution.obj",
                                   "goathead.obj",
                                   "hand_lowres.obj",
                                   "human_man.obj",
                                   "human_woman.obj",
                                   "koala_low_resolution.obj",
                                   "penguin.obj",
                                   "scorpion_low_resolution.obj",
                                   "skull_low_resolution.obj",
                                   "spot.obj",
                                   "spot_fourleg.obj",
                                   "spot_low_resolution.obj",
                                   "torus.obj",
                                   "wingnut.obj"}) {
        SCOPED_TRACE(file);
        LAYOUT_EMBEDDING_NEED_DATA("data/" + file);
        const auto target = target_of(mesh_file("data/" + file));
        const double angle = smallest_angle(*target);
        const std::vector<Index> landmarks =
            farthest_points(*target, 30, target->vertex_count() / 2);
        const auto made = template_layout(*target, landmarks);
        ASSERT_TRUE(made.ok()) << made.error().message;
        auto problem = make_problem(layout_of(made->mesh), target, landmarks);
        ASSERT_TRUE(problem.ok()) << problem.error().message;
        EmbedOptions options;
        options.work_limit = 1'000'000;
        options.shape = PathShape::even;
        options.look_for_doubts = false;
        EmbedJob job(std::move(*problem), options);
        for (const PathShape shape : {PathShape::even, PathShape::shortened, PathShape::fair}) {
            SCOPED_TRACE(static_cast<int>(shape));
            if (shape != PathShape::even) {
                ASSERT_TRUE(job.reshape(shape));
            }
            while (job.step()) {
            }
            const EmbedResult& result = job.result();
            ASSERT_TRUE(result.refined.has_value()) << job.error().message;
            test::expect_valid(job.problem(), *job.graph(), result.weak, *result.refined);
            EXPECT_GE(result.quality.smallest_angle, angle / 3);
            if (shape != PathShape::shortened) {
                continue;
            }
            double length = 0;
            double shortest = 0;
            // The comparison takes long on large targets.
            bool known = target->vertex_count() < 2600;
            for (std::size_t e = 0; e < result.weak.paths.size(); ++e) {
                length += chain_length(*result.refined, result.refined->chains[e]);
                if (known) {
                    const auto geodesic = test::geodesic_length(job.problem(), *job.graph(),
                                                                result.weak.paths[e].darts);
                    known = geodesic.has_value();
                    shortest += geodesic.value_or(0);
                }
            }
            EXPECT_LE(length, result.cost);
            if (known) {
                ++compared;
                EXPECT_NEAR(length / shortest, 1, 0.01);
            }
        }
    }
    EXPECT_GE(compared, 4);
}

TEST(RealMesh, a_map_between_two_people_is_near_to_the_known_correspondence)
{
    // Two meshes of the same connectivity: a vertex corresponds to itself.
    LAYOUT_EMBEDDING_NEED_DATA("data/human_woman.obj");
    const std::array<std::shared_ptr<const TriangleMesh>, 2> people{
        target_of(mesh_file("data/human_man.obj")), target_of(mesh_file("data/human_woman.obj"))};
    const std::vector<Index> landmarks = farthest_points(*people[0], 30, 0);
    const auto made = template_layout(*people[0], landmarks);
    ASSERT_TRUE(made.ok()) << made.error().message;
    const auto layout = layout_of(made->mesh);
    std::array<MappedTarget, 2> mapped;
    for (std::size_t side = 0; side < 2; ++side) {
        const EmbedResult result = embed(layout, people[side], landmarks);
        ASSERT_TRUE(result.refined.has_value());
        mapped[side] = {{people[side], std::make_shared<const RefinedMesh>(*result.refined)},
                        landmarks};
    }
    // The mean distance of images from the corresponding vertices, relative to the root of the
    // area.
    const auto mean_error = [&](const SurfaceMap& map, std::size_t side) {
        const TriangleMesh& other = *people[1 - side];
        double area = 0;
        for (Index f = 0; f < other.face_count(); ++f) {
            const auto c = other.face(f);
            area += (other.position(c[1]) - other.position(c[0]))
                        .cross(other.position(c[2]) - other.position(c[0]))
                        .norm() /
                    2;
        }
        double sum = 0;
        for (Index v = 0; v < other.vertex_count(); ++v) {
            sum += (position_of(other, map.vertex_images(side)[v]) - other.position(v)).norm();
        }
        return sum / other.vertex_count() / std::sqrt(area);
    };
    const auto first = SurfaceMap::make(layout, mapped[0], mapped[1], {0, 0});
    ASSERT_TRUE(first.ok()) << first.error().message;
    const auto map = SurfaceMap::make(layout, mapped[0], mapped[1], {0, 2});
    ASSERT_TRUE(map.ok()) << map.error().message;
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
        EXPECT_LT(mean_error(*first, side), 0.01);
        EXPECT_LT(mean_error(*map, side), 2.0 / 3 * mean_error(*first, side));
    }
    // The known correspondence itself has 4.043.
    EXPECT_LT(map->distortion().mean_energy, 4.2);
}

}  // namespace
}  // namespace layout_embedding
