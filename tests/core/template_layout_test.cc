#include "apps/template_layout.hh"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/embed_job.hh"
#include "base/random.hh"
#include "embedding_checks.hh"
#include "layout/embedding_problem.hh"
#include "layout/layout.hh"
#include "layout/quad_pairing.hh"
#include "mesh/mesh_reader.hh"
#include "mesh/polygon_halfedges.hh"
#include "mesh/repair.hh"
#include "mesh/validation.hh"
#include "shapes/shape.hh"
#include "test_data.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

using TargetPointer = std::shared_ptr<const TriangleMesh>;

/// `count` vertices, each one the farthest from all before it, boundary or not.
std::vector<Index> farthest_points(const TriangleMesh& target, Index count, Index first = 0)
{
    std::vector<double> distances(target.vertex_count(), std::numeric_limits<double>::infinity());
    std::vector<Index> chosen;
    Index next = first;
    while (chosen.size() < count) {
        chosen.push_back(next);
        for (Index v = 0; v < target.vertex_count(); ++v) {
            const Vec3 offset = target.position(v) - target.position(chosen.back());
            distances[v] = std::min(distances[v], offset.dot(offset));
        }
        next = static_cast<Index>(std::max_element(distances.begin(), distances.end()) -
                                  distances.begin());
    }
    return chosen;
}

/// `count` different vertices, boundary or not.
std::vector<Index> random_vertices(const TriangleMesh& target, Index count, std::uint64_t seed)
{
    Random random(seed);
    std::vector<Index> all(target.vertex_count());
    for (Index v = 0; v < all.size(); ++v) {
        all[v] = v;
    }
    for (Index i = 0; i < count; ++i) {
        std::swap(all[i], all[i + random.below(all.size() - i)]);
    }
    all.resize(count);
    return all;
}

long genus_of(long euler_characteristic, std::size_t loops)
{
    return (2 - euler_characteristic - static_cast<long>(loops)) / 2;
}

/// All that a template layout promises; the layout and its landmarks as a problem.
std::optional<EmbeddingProblem> expect_template(const TargetPointer& target,
                                                const std::vector<Index>& landmarks,
                                                const PolygonMesh& mesh)
{
    EXPECT_EQ(mesh.positions.size(), landmarks.size());
    if (mesh.positions.size() != landmarks.size()) {
        return std::nullopt;
    }
    for (Index i = 0; i < landmarks.size(); ++i) {
        EXPECT_EQ(mesh.positions[i], target->position(landmarks[i]));
    }
    auto layout = Layout::from_polygons(mesh, "the template");
    if (!layout) {
        ADD_FAILURE() << layout.error().message;
        return std::nullopt;
    }
    EXPECT_EQ(layout->boundary_loops().size(), target->boundary_loop_count());
    // This compares genus and boundaries, and which landmarks lie on them.
    auto problem =
        make_problem(std::make_shared<const Layout>(std::move(*layout)), target, landmarks);
    if (!problem) {
        ADD_FAILURE() << problem.error().message;
        return std::nullopt;
    }
    return std::move(*problem);
}

TemplateLayout made(const TargetPointer& target, const std::vector<Index>& landmarks,
                    const TemplateOptions& options = {})
{
    auto result = template_layout(*target, landmarks, options);
    EXPECT_TRUE(result.ok()) << result.error().message;
    return result.ok() ? std::move(*result) : TemplateLayout{};
}

TargetPointer target_of(const PolygonMesh& mesh)
{
    return std::make_shared<const TriangleMesh>(mesh);
}

/// The smallest number of vertices that the triangulations of the zoo's targets surely need.
Index enough_landmarks(const TriangleMesh& target)
{
    const long genus = genus_of(target.euler_characteristic(), target.boundary_loop_count());
    const Index loops = target.boundary_loop_count();
    return genus == 0 ? (loops < 2 ? 4 : 6 * loops) : genus == 1 ? 9 : genus == 2 ? 13 : 16;
}

TEST(TemplateLayout, has_the_landmarks_as_vertices_and_the_topology_of_the_target)
{
    int count = 0;
    for (const auto& [name, mesh] : zoo::targets()) {
        const auto target = target_of(mesh);
        for (const Index n : {4U, 7U, 9U, 13U, 16U, 25U, 50U}) {
            if (n < enough_landmarks(*target) || n > target->vertex_count()) {
                continue;
            }
            for (std::uint64_t seed = 0; seed < 4; ++seed) {
                SCOPED_TRACE(name + ", " + std::to_string(n) + " landmarks, seed " +
                             std::to_string(seed));
                const auto landmarks =
                    seed == 0 ? farthest_points(*target, n) : random_vertices(*target, n, seed);
                const TemplateLayout layout = made(target, landmarks);
                expect_template(target, landmarks, layout.mesh);
                if (target->boundary_loop_count() == 0) {
                    EXPECT_EQ(layout.counts.collapses + layout.counts.after_flips +
                                  layout.counts.in_any_shape,
                              target->vertex_count() - n);
                }
                for (Index f = 0; f < layout.mesh.face_count(); ++f) {
                    EXPECT_EQ(layout.mesh.face(f).size(), 3U);
                }
                ++count;
            }
        }
    }
    EXPECT_GT(count, 250);
}

TEST(TemplateLayout, is_the_target_itself_where_all_vertices_are_landmarks)
{
    for (const auto& [name, mesh] : zoo::targets()) {
        SCOPED_TRACE(name);
        const auto target = target_of(mesh);
        std::vector<Index> landmarks(target->vertex_count());
        for (Index v = 0; v < landmarks.size(); ++v) {
            landmarks[v] = v;
        }
        const TemplateLayout layout = made(target, landmarks);
        EXPECT_EQ(layout.mesh.corners, target->corners());
        EXPECT_EQ(layout.mesh.positions, target->positions());
    }
}

TEST(TemplateLayout, follows_the_order_of_the_landmarks_alone)
{
    const auto target = target_of(zoo::bumpy_sphere(3, 1));
    const auto landmarks = farthest_points(*target, 12);
    auto reversed = landmarks;
    std::reverse(reversed.begin(), reversed.end());
    TemplateLayout one = made(target, landmarks);
    const TemplateLayout other = made(target, reversed);
    for (Index& corner : one.mesh.corners) {
        corner = 11 - corner;
    }
    EXPECT_EQ(one.mesh.corners, other.mesh.corners);
}

TEST(TemplateLayout, keeps_boundary_loops_through_their_landmarks_in_order)
{
    for (const auto& [name, mesh] : {zoo::NamedMesh{"disk", zoo::grid_disk(12, 9)},
                                     zoo::NamedMesh{"annulus", zoo::annulus(24, 6)}}) {
        const auto target = target_of(mesh);
        int compared = 0;
        for (std::uint64_t seed = 1; seed <= 20; ++seed) {
            SCOPED_TRACE(name + " seed " + std::to_string(seed));
            const auto landmarks = random_vertices(*target, 30, seed);
            std::vector<Index> ids(target->vertex_count(), kNone);
            for (Index i = 0; i < landmarks.size(); ++i) {
                ids[landmarks[i]] = i;
            }
            const TemplateLayout layout = made(target, landmarks);
            const auto problem = expect_template(target, landmarks, layout.mesh);
            ASSERT_TRUE(problem.has_value());
            // The loops of the target, each with its landmarks in order.
            std::vector<std::vector<Index>> expected;
            std::vector<bool> seen(target->halfedge_count(), false);
            for (Index start = 0; start < target->halfedge_count(); ++start) {
                if (target->opposite(start) != kNone || seen[start]) {
                    continue;
                }
                expected.emplace_back();
                for (Index h = start; !seen[h]; h = target->outgoing(target->head(h))) {
                    seen[h] = true;
                    if (ids[target->tail(h)] != kNone) {
                        expected.back().push_back(ids[target->tail(h)]);
                    }
                }
            }
            std::vector<std::vector<Index>> loops;
            for (const auto& loop : problem->layout->boundary_loops()) {
                loops.emplace_back();
                for (const Index h : loop) {
                    loops.back().push_back(problem->layout->tail(h));
                }
                std::reverse(loops.back().begin(), loops.back().end());
            }
            ASSERT_EQ(loops.size(), expected.size());
            for (auto* side : {&loops, &expected}) {
                for (auto& loop : *side) {
                    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()),
                                loop.end());
                }
                std::sort(side->begin(), side->end());
            }
            const bool all_kept =
                std::all_of(expected.begin(), expected.end(),
                            [](const std::vector<Index>& loop) { return loop.size() >= 3; });
            if (all_kept) {
                EXPECT_EQ(loops, expected);
                ++compared;
            }
        }
        EXPECT_GT(compared, 10);
    }
}

TEST(TemplateLayout, goes_around_holes_with_fewer_than_three_landmarks)
{
    const auto target = target_of(zoo::hemisphere(3));
    std::vector<Index> inner;
    std::vector<Index> outer;
    for (Index v = 0; v < target->vertex_count(); ++v) {
        (target->is_boundary_vertex(v) ? outer : inner).push_back(v);
    }
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        for (const std::size_t on_boundary : {0U, 1U, 2U}) {
            for (const std::size_t count : {3U, 4U, 8U, 20U}) {
                SCOPED_TRACE(std::to_string(on_boundary) + " of " + std::to_string(count) +
                             " on the boundary, seed " + std::to_string(seed));
                Random random(seed);
                std::vector<Index> landmarks;
                while (landmarks.size() < count) {
                    const auto& from = landmarks.size() < on_boundary ? outer : inner;
                    const Index v = from[random.below(from.size())];
                    if (std::find(landmarks.begin(), landmarks.end(), v) == landmarks.end()) {
                        landmarks.push_back(v);
                    }
                }
                expect_template(target, landmarks, made(target, landmarks).mesh);
            }
        }
    }
}

TEST(TemplateLayout, three_landmarks_on_a_sphere_make_two_triangles)
{
    for (const PolygonMesh& mesh : {zoo::tetrahedron(), zoo::icosphere(2)}) {
        const auto target = target_of(mesh);
        const std::vector<Index> landmarks{2, 0, 3};
        const TemplateLayout layout = made(target, landmarks);
        EXPECT_EQ(layout.mesh.face_count(), 2U);
        expect_template(target, landmarks, layout.mesh);
    }
}

TEST(TemplateLayout, reaches_the_fewest_vertices_that_a_surface_can_have)
{
    // The triangulation of the torus with seven vertices joins each two of them and is unique.
    for (const auto& [mesh, fewest] :
         {std::pair{zoo::torus(14, 10), 7U}, std::pair{zoo::slab(2, 1), 10U},
          std::pair{zoo::slab(3, 1), 10U}, std::pair{zoo::icosphere(2), 4U},
          std::pair{zoo::hemisphere(2), 3U}}) {
        const auto target = target_of(mesh);
        for (std::uint64_t seed = 1; seed <= 10; ++seed) {
            SCOPED_TRACE(std::to_string(fewest) + " landmarks, seed " + std::to_string(seed));
            const auto landmarks = random_vertices(*target, fewest, seed);
            expect_template(target, landmarks, made(target, landmarks).mesh);
        }
    }
}

TEST(TemplateLayout, keeps_holes_apart_or_says_why_it_cannot)
{
    const auto target = target_of(zoo::annulus(24, 6));
    int reached = 0;
    int stuck = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const auto landmarks = random_vertices(*target, static_cast<Index>(5 + seed % 6), seed);
        const auto result = template_layout(*target, landmarks);
        if (result) {
            ++reached;
            expect_template(target, landmarks, result->mesh);
        } else if (result.error().code != ErrorCode::tooFewLandmarksForSurface) {
            EXPECT_EQ(result.error().code, ErrorCode::templateNotReached);
            ++stuck;
        }
    }
    std::cout << reached << " annuli reached, " << stuck << " not\n";
    EXPECT_GE(reached, 50);
    EXPECT_LE(stuck, 2);
}

TEST(TemplateLayout, refuses_what_has_no_layout)
{
    const auto expect_refusal = [](const PolygonMesh& mesh, std::vector<Index> landmarks,
                                   ErrorCode code, const std::string& words) {
        const auto result = template_layout(TriangleMesh(mesh), landmarks);
        ASSERT_FALSE(result.ok()) << words;
        EXPECT_EQ(result.error().code, code);
        EXPECT_NE(result.error().message.find(words), std::string::npos) << result.error().message;
    };
    const PolygonMesh sphere = zoo::icosphere(1);
    expect_refusal(sphere, {0, 1, 99}, ErrorCode::landmarkOutOfRange, "landmark 2 is vertex 99");
    expect_refusal(sphere, {0, 5, 7, 5}, ErrorCode::duplicateLandmark, "landmarks 1 and 3");
    expect_refusal(sphere, {}, ErrorCode::tooFewLandmarks, "0 landmarks");
    expect_refusal(sphere, {4}, ErrorCode::tooFewLandmarks, "1 landmark");
    expect_refusal(sphere, {0, 1}, ErrorCode::tooFewLandmarks, "2 landmarks");
    expect_refusal(zoo::torus(8, 6), {0, 5, 10, 20, 30, 40}, ErrorCode::tooFewLandmarksForSurface,
                   "genus 1 with 0 boundary loops, which takes at least 7");
    expect_refusal(zoo::slab(2, 1), {0, 1, 2, 3, 4, 5, 6, 7, 8},
                   ErrorCode::tooFewLandmarksForSurface, "at least 10");
    expect_refusal(zoo::annulus(12, 2), {0, 1, 12}, ErrorCode::tooFewLandmarksForSurface,
                   "2 boundary loops, which takes at least 6");
    Random random(3);
    for (int i = 0; i < 20; ++i) {
        // Whatever the landmarks, an annulus is made, or refused with a reason.
        const TriangleMesh annulus(zoo::annulus(9, 2));
        const auto count = static_cast<Index>(3 + random.below(7));
        const auto landmarks = random_vertices(annulus, count, random.bits());
        const auto result = template_layout(annulus, landmarks);
        if (result) {
            expect_template(std::make_shared<const TriangleMesh>(annulus), landmarks, result->mesh);
        } else {
            EXPECT_TRUE(result.error().code == ErrorCode::tooFewLandmarksForSurface ||
                        result.error().code == ErrorCode::templateNotReached)
                << result.error().message;
        }
    }
}

/// The triangles of a mesh of triangles and quads: each quad in both ways.
std::vector<std::array<Index, 3>> triangles_in(const PolygonMesh& mesh)
{
    std::vector<std::array<Index, 3>> result;
    const auto add = [&](Index a, Index b, Index c) {
        std::array<Index, 3> triangle{a, b, c};
        std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()),
                    triangle.end());
        result.push_back(triangle);
    };
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const auto face = mesh.face(f);
        add(face[0], face[1], face[2]);
        if (face.size() == 4) {
            add(face[0], face[2], face[3]);
            add(face[0], face[1], face[3]);
            add(face[1], face[2], face[3]);
        }
    }
    std::sort(result.begin(), result.end());
    return result;
}

TEST(TemplateLayout, quads_are_pairs_of_its_triangles)
{
    Index quads = 0;
    for (const auto& [name, mesh] : zoo::targets()) {
        const auto target = target_of(mesh);
        for (const Index n : {9U, 16U, 40U}) {
            if (n < enough_landmarks(*target) || n > target->vertex_count()) {
                continue;
            }
            SCOPED_TRACE(name + ", " + std::to_string(n) + " landmarks");
            const auto landmarks = farthest_points(*target, n);
            const PolygonMesh plain = made(target, landmarks).mesh;
            const PolygonMesh merged = made(target, landmarks, {.quads = true}).mesh;
            const auto problem = expect_template(target, landmarks, merged);
            ASSERT_TRUE(problem.has_value());
            for (Index v = 0; v < n; ++v) {
                EXPECT_GE(problem->layout->outgoing(v).size(),
                          problem->layout->is_boundary_vertex(v) ? 2U : 3U);
            }
            EXPECT_EQ(merged.positions, plain.positions);
            const auto old_triangles = triangles_in(plain);
            const auto new_triangles = triangles_in(merged);
            // Every old triangle is a face or half of one.
            EXPECT_TRUE(std::includes(new_triangles.begin(), new_triangles.end(),
                                      old_triangles.begin(), old_triangles.end()));
            Index merged_here = 0;
            for (Index f = 0; f < merged.face_count(); ++f) {
                merged_here += merged.face(f).size() == 4 ? 1U : 0U;
            }
            EXPECT_EQ(merged.face_count() + merged_here, plain.face_count());
            quads += merged_here;
        }
    }
    EXPECT_GT(quads, 150U);
}

TEST(QuadPairing, finds_the_quads_of_a_cut_up_quad_mesh)
{
    for (const PolygonMesh& quads : {zoo::quad_grid(5, 4), zoo::cube()}) {
        // A cube bends too much between its faces, a grid has diagonals of one direction.
        EXPECT_EQ(triangles_in(merged_into_quads(zoo::triangulated(quads))), triangles_in(quads));
    }
    // Rhombi in a hexagon; in a square there is no quad without a straight corner.
    EXPECT_EQ(merged_into_quads(zoo::wheel(6)).face_count(), 3U);
    EXPECT_EQ(merged_into_quads(zoo::wheel(4)).face_count(), 4U);
    const PolygonMesh tetrahedron = merged_into_quads(zoo::tetrahedron());
    EXPECT_EQ(tetrahedron.face_count(), 4U);
}

/// The best sum of quads over all pairings of neighbouring triangles, counting quads alone.
int most_quads(const PolygonHalfedges& halfedges, std::vector<bool>& taken, Index face)
{
    while (face < taken.size() && taken[face]) {
        ++face;
    }
    if (face == taken.size()) {
        return 0;
    }
    taken[face] = true;
    int best = most_quads(halfedges, taken, face + 1);
    for (Index h = 3 * face; h < 3 * face + 3; ++h) {
        const Index twin = halfedges.opposite(h);
        if (twin != kNone && !taken[halfedges.face(twin)]) {
            taken[halfedges.face(twin)] = true;
            best = std::max(best, 1 + most_quads(halfedges, taken, face + 1));
            taken[halfedges.face(twin)] = false;
        }
    }
    taken[face] = false;
    return best;
}

TEST(QuadPairing, leaves_few_triangles_in_flat_meshes)
{
    int found = 0;
    int possible = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        // A disk of about equal triangles in random numbering.
        const PolygonMesh mesh = zoo::shuffled(zoo::grid_disk(3, 3), seed);
        const PolygonMesh merged = merged_into_quads(mesh);
        const PolygonHalfedges halfedges(mesh);
        std::vector<bool> taken(mesh.face_count(), false);
        possible += most_quads(halfedges, taken, 0);
        found += static_cast<int>(mesh.face_count() - merged.face_count());
    }
    EXPECT_GE(found, possible * 9 / 10);
}

/// Embeds the template where its landmarks are; whether that worked, every result checked.
bool embeds(EmbeddingProblem problem, double* ratio = nullptr)
{
    EmbedOptions options;
    options.work_limit = 3'000'000;
    EmbedJob job(std::move(problem), options);
    while (job.step()) {
    }
    EXPECT_EQ(job.error().message, "");
    const EmbedResult& result = job.result();
    if (!result.refined) {
        return false;
    }
    test::expect_strands(job.problem(), *job.graph(), result.weak);
    test::expect_valid(job.problem(), *job.graph(), result.weak, *result.refined);
    if (ratio != nullptr) {
        *ratio = result.cost / result.lower_bound;
    }
    return true;
}

TEST(TemplateLayout, embeds_where_it_comes_from)
{
    int instances = 0;
    for (const auto& [name, mesh] : zoo::targets()) {
        const auto target = target_of(mesh);
        if (genus_of(target->euler_characteristic(), target->boundary_loop_count()) > 0 ||
            target->boundary_loop_count() > 1) {
            continue;  // Where greedy insertion can end in a dead end.
        }
        for (const Index n : {4U, 8U, 20U}) {
            if (n > target->vertex_count()) {
                continue;
            }
            for (const bool quads : {false, true}) {
                SCOPED_TRACE(name + ", " + std::to_string(n) + " landmarks" +
                             (quads ? ", quads" : ""));
                const auto landmarks = farthest_points(*target, n);
                auto problem = expect_template(target, landmarks,
                                               made(target, landmarks, {.quads = quads}).mesh);
                ASSERT_TRUE(problem.has_value());
                EXPECT_TRUE(embeds(std::move(*problem)));
                ++instances;
            }
        }
    }
    EXPECT_GT(instances, 60);
}

/// What the best embedding costs that is found with little work.
double embedded_cost(const TargetPointer& target, const std::vector<Index>& landmarks,
                     const PolygonMesh& mesh)
{
    auto problem = expect_template(target, landmarks, mesh);
    EmbedOptions options;
    options.work_limit = 2'000'000;
    EmbedJob job(std::move(problem.value()), options);
    while (job.step()) {
    }
    EXPECT_TRUE(job.result().refined.has_value());
    if (job.result().refined) {
        test::expect_valid(job.problem(), *job.graph(), job.result().weak, *job.result().refined);
    }
    return job.result().cost;
}

TEST(TemplateLayout, flips_make_its_embedding_shorter)
{
    Index flips = 0;
    for (const char* name : {"cup", "pretzel", "spectacles", "plane"}) {
        SCOPED_TRACE(name);
        const shapes::ShapeClass& shape_class = *shapes::find_shape_class(name);
        for (const Index member : {0U, 3U}) {
            const auto shape = shapes::make_shape(shape_class, member, {1200, 0});
            ASSERT_TRUE(shape.ok()) << shape.error().message;
            const auto target = target_of(shape->mesh);
            const auto decimated = decimated_layout(*target, shape->landmarks);
            ASSERT_TRUE(decimated.ok()) << decimated.error().message;
            const TemplateLayout shorter = made(target, shape->landmarks);
            EXPECT_EQ(shorter.mesh.face_count(), decimated->mesh.face_count());
            const double before = embedded_cost(target, shape->landmarks, decimated->mesh);
            const double after = embedded_cost(target, shape->landmarks, shorter.mesh);
            if (shorter.flips == 0) {
                EXPECT_EQ(shorter.mesh.corners.size(), decimated->mesh.corners.size());
                EXPECT_EQ(after, before);
            } else {
                EXPECT_LT(after, before);
            }
            flips += shorter.flips;
        }
    }
    EXPECT_GT(flips, 5U);
}

/// All triangle meshes among the real ones.
std::vector<std::filesystem::path> real_meshes()
{
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(test_data_path("data"))) {
        const std::string extension = entry.path().extension().string();
        const std::string name = entry.path().filename().string();
        if ((extension == ".obj" || extension == ".off") &&
            name.find("control_mesh") == std::string::npos) {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

TargetPointer real_target(const std::filesystem::path& file)
{
    auto mesh = read_mesh(read_bytes(file), MeshFormat::detect, "the target");
    EXPECT_TRUE(mesh.ok()) << mesh.error().message;
    const PolygonMesh repaired = repair_surface(*mesh, SurfaceKind::target).mesh;
    const Status valid = check_surface(repaired, SurfaceKind::target, "the target");
    EXPECT_TRUE(valid.ok()) << valid.error().message;
    return target_of(repaired);
}

TEST(RealMesh, every_template_layout_is_reached)
{
    LAYOUT_EMBEDDING_NEED_DATA("data");
    int total = 0;
    int by_collapses = 0;
    int with_flips = 0;
    int in_any_shape = 0;
    int unblocked = 0;
    for (const auto& file : real_meshes()) {
        const auto target = real_target(file);
        const long genus = genus_of(target->euler_characteristic(), target->boundary_loop_count());
        for (const Index n : {4U, 6U, 8U, 10U, 12U, 16U, 20U, 24U, 30U, 40U}) {
            SCOPED_TRACE(file.filename().string() + ", " + std::to_string(n) + " landmarks");
            const auto landmarks = farthest_points(*target, n);
            if (n < (genus == 0 ? 4 : genus == 1 ? 7 : 10)) {
                const auto refused = template_layout(*target, landmarks);
                ASSERT_FALSE(refused.ok());
                EXPECT_EQ(refused.error().code, ErrorCode::tooFewLandmarksForSurface);
                continue;
            }
            const TemplateLayout layout = made(target, landmarks);
            expect_template(target, landmarks, layout.mesh);
            const PolygonMesh quads = made(target, landmarks, {.quads = true}).mesh;
            expect_template(target, landmarks, quads);
            EXPECT_LE(quads.face_count(), layout.mesh.face_count());
            ++total;
            ++(layout.times_unblocked > 0       ? unblocked
               : layout.counts.in_any_shape > 0 ? in_any_shape
               : layout.counts.after_flips > 0  ? with_flips
                                                : by_collapses);
        }
    }
    std::cout << total << " template layouts: " << by_collapses << " by collapses alone, "
              << with_flips << " with flips, " << in_any_shape << " without regard to shapes, "
              << unblocked << " after flips elsewhere\n";
    EXPECT_GE(total, 200);
    EXPECT_GE(2 * by_collapses, total);
}

TEST(RealMesh, template_layouts_embed_where_they_come_from)
{
    LAYOUT_EMBEDDING_NEED_DATA("data");
    int total = 0;
    int embedded = 0;
    int close = 0;
    for (const auto& file : real_meshes()) {
        const auto target = real_target(file);
        if (target->euler_characteristic() != 2) {
            continue;
        }
        for (const Index n : {10U, 24U}) {
            for (const bool quads : {false, true}) {
                SCOPED_TRACE(file.filename().string() + ", " + std::to_string(n) + " landmarks");
                const auto landmarks = farthest_points(*target, n);
                auto problem = expect_template(target, landmarks,
                                               made(target, landmarks, {.quads = quads}).mesh);
                ASSERT_TRUE(problem.has_value());
                double ratio = std::numeric_limits<double>::infinity();
                ++total;
                embedded += embeds(std::move(*problem), &ratio) ? 1 : 0;
                close += ratio < 1.1 ? 1 : 0;
            }
        }
    }
    std::cout << embedded << " of " << total << " embedded, " << close
              << " of them within 10 % of the lower bound\n";
    // A sphere has no dead ends.
    EXPECT_EQ(embedded, total);
    EXPECT_GE(close, total * 3 / 4);
}

}  // namespace
}  // namespace layout_embedding
