#include "apps/surface_map.hh"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <optional>
#include <set>

#include "apps/embed_job.hh"
#include "apps/template_layout.hh"
#include "base/random.hh"
#include "embedding_checks.hh"
#include "instances.hh"
#include "maps/map_checker.hh"
#include "mesh/mesh_reader.hh"
#include "test_data.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

MappedTarget embed(const EmbeddingProblem& problem, PathShape shape = PathShape::shortened)
{
    EmbedOptions options;
    options.algorithm = Algorithm::praun;
    options.shape = shape;
    EmbedJob job(problem, options);
    while (job.step()) {
    }
    EXPECT_TRUE(job.result().refined.has_value());
    test::expect_valid(problem, *job.graph(), job.result().weak, *job.result().refined);
    return {{problem.target, std::make_shared<const RefinedMesh>(*job.result().refined)},
            problem.landmarks};
}

EmbeddingProblem near(const PolygonMesh& layout, const PolygonMesh& target, double displacement = 0)
{
    return test::problem_of(layout, target,
                            zoo::displaced_landmarks(layout, target, displacement, 3));
}

SurfaceMap map_of(const EmbeddingProblem& problem, const MappedTarget& a, const MappedTarget& b,
                  Index rounds, Index seam_passes = 0)
{
    auto map = SurfaceMap::make(problem.layout, a, b, {rounds, seam_passes});
    EXPECT_TRUE(map.ok()) << map.error().message;
    return std::move(*map);
}

PolygonMesh polygons(const TriangleMesh& mesh)
{
    PolygonMesh result;
    result.positions = mesh.positions();
    for (Index f = 0; f < mesh.face_count(); ++f) {
        result.add_face(mesh.face(f));
    }
    return result;
}

/// Fails the test unless both targets are cut along embeddings of the layout.
void expect_embeddings(const PolygonMesh& layout_mesh, const SurfaceMap& map,
                       const std::vector<Index>& landmarks_a, const std::vector<Index>& landmarks_b)
{
    const Layout& layout = map.layout();
    std::vector<std::array<Index, 2>> edges;
    for (Index e = 0; e < layout.edge_count(); ++e) {
        edges.push_back({layout.tail(2 * e), layout.head(2 * e)});
    }
    for (std::size_t side = 0; side < 2; ++side) {
        const CheckReport report = check_embedding({layout_mesh,
                                                    polygons(map.placed(side).target()),
                                                    side == 0 ? landmarks_a : landmarks_b,
                                                    map.placed(side).refined(),
                                                    edges,
                                                    {}});
        for (const Violation& violation : report.violations) {
            ADD_FAILURE() << violation.code << ": " << violation.message;
        }
    }
}

double face_area(const TriangleMesh& mesh, Index face)
{
    const auto c = mesh.face(face);
    return (mesh.position(c[1]) - mesh.position(c[0]))
               .cross(mesh.position(c[2]) - mesh.position(c[0]))
               .norm() /
           2;
}

/// Fails the test unless the overlay is a common refinement of both targets' patches.
void expect_common_refinement(const SurfaceMap& map)
{
    const Overlay& overlay = map.overlay();
    for (std::size_t side = 0; side < 2; ++side) {
        SCOPED_TRACE(side);
        const TriangleMesh& target = map.placed(side).target();
        // The area of each face that is in a patch, and what the overlay covers of it.
        std::vector<double> wanted(target.face_count(), 0);
        const RefinedMesh& refined = map.placed(side).refined();
        for (std::size_t t = 0; t < refined.triangle_faces.size(); ++t) {
            if (refined.triangle_patches[t] != kNone) {
                const Vec3& a = refined.positions[refined.corners[3 * t]];
                wanted[refined.triangle_faces[t]] +=
                    (refined.positions[refined.corners[3 * t + 1]] - a)
                        .cross(refined.positions[refined.corners[3 * t + 2]] - a)
                        .norm() /
                    2;
            }
        }
        std::vector<double> covered(target.face_count(), 0);
        for (std::size_t t = 0; t < overlay.corners.size(); ++t) {
            const Index face = overlay.faces[t][side];
            // Barycentric coordinates in that face; the point may be given in a neighbour of it.
            std::array<PlanePoint, 3> in_face;
            for (std::size_t i = 0; i < 3; ++i) {
                const SurfacePoint& point = overlay.points[overlay.corners[t][i]][side];
                const auto b = coordinates_in_face(target, point, face);
                EXPECT_NEAR(b[0] + b[1] + b[2], 1, 1e-9);
                in_face[i] = PlanePoint(b[0], b[1]);
            }
            const double share = cross(in_face[1] - in_face[0], in_face[2] - in_face[0]);
            EXPECT_GE(share, -1e-9);
            covered[face] += share * face_area(target, face);
        }
        for (Index face = 0; face < target.face_count(); ++face) {
            EXPECT_NEAR(covered[face], wanted[face], 1e-7 * (1e-3 + face_area(target, face)));
        }
    }
    // It is a surface of the layout's topology: all edges join two triangles but for its boundary.
    std::map<std::pair<Index, Index>, int> edges;
    std::set<Index> vertices;
    for (const auto& c : overlay.corners) {
        for (std::size_t i = 0; i < 3; ++i) {
            vertices.insert(c[i]);
            EXPECT_NE(c[i], c[(i + 1) % 3]);
            const int count = ++edges[{c[i], c[(i + 1) % 3]}];
            EXPECT_EQ(count, 1);
        }
    }
    std::size_t undirected = 0;
    for (const auto& [edge, count] : edges) {
        undirected += edge.first < edge.second || !edges.contains({edge.second, edge.first});
    }
    EXPECT_EQ(vertices.size(), overlay.points.size());
    EXPECT_EQ(static_cast<long>(vertices.size()) - static_cast<long>(undirected) +
                  static_cast<long>(overlay.corners.size()),
              map.layout().euler_characteristic());
}

std::vector<SurfacePoint> random_points(const TriangleMesh& mesh, int count, std::uint64_t seed)
{
    Random random(seed);
    std::vector<SurfacePoint> points;
    for (int i = 0; i < count; ++i) {
        double x = random.unit();
        double y = random.unit();
        if (x + y > 1) {
            x = 1 - x;
            y = 1 - y;
        }
        points.push_back({static_cast<Index>(random.below(mesh.face_count())), {1 - x - y, x, y}});
    }
    return points;
}

TEST(SurfaceMap, of_a_target_onto_itself_is_the_identity)
{
    for (const auto& [layout, target] : {std::pair{zoo::cube(), zoo::bumpy_sphere(3, 2)},
                                         std::pair{zoo::quad_torus(4, 4), zoo::torus(16, 12)},
                                         std::pair{zoo::polygon(5), zoo::icosphere(2)}}) {
        const EmbeddingProblem problem =
            layout.face_count() == 1
                ? test::problem_of(layout, target, zoo::random_landmarks(target, 5, 3))
                : near(layout, target, 0.1);
        const MappedTarget embedded = embed(problem);
        const SurfaceMap map = map_of(problem, embedded, embedded, 3);
        const TriangleMesh& mesh = *problem.target;
        for (const std::size_t side : {0U, 1U}) {
            for (Index v = 0; v < mesh.vertex_count(); ++v) {
                const SurfacePoint& image = map.vertex_images(side)[v];
                if (layout.face_count() > 1 || image.face != kNone) {
                    EXPECT_LT((position_of(mesh, image) - mesh.position(v)).norm(), 1e-12);
                }
            }
        }
        EXPECT_NEAR(map.distortion().mean_energy, 4, 1e-9);
        EXPECT_NEAR(map.distortion().largest_energy, 4, 1e-6);
        EXPECT_NEAR(map.distortion().mean_conformal, 1, 1e-4);
        EXPECT_NEAR(map.distortion().mean_area, 1, 1e-9);
        // All vertices and edges of both meshes coincide: nothing is cut.
        std::size_t triangles = 0;
        for (const PlacedPatch& placed : map.placed(0).patches()) {
            triangles += placed.map.corners.size();
        }
        EXPECT_EQ(map.overlay().corners.size(), triangles);
        expect_common_refinement(map);
    }
}

TEST(SurfaceMap, onto_a_moved_and_scaled_copy_is_that_motion)
{
    const EmbeddingProblem problem = near(zoo::cube(), zoo::bumpy_sphere(3, 5), 0.1);
    const MappedTarget a = embed(problem);
    // A turn by 3-4-5 angles, a shift and a scale.
    Eigen::Matrix3d turn;
    turn << 0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1;
    const auto moved = [&](const Vec3& p) { return Vec3(2.5 * (turn * p) + Vec3(3, -1, 7)); };
    PolygonMesh copy;
    for (Index v = 0; v < problem.target->vertex_count(); ++v) {
        copy.positions.push_back(moved(problem.target->position(v)));
    }
    for (Index f = 0; f < problem.target->face_count(); ++f) {
        copy.add_face(problem.target->face(f));
    }
    RefinedMesh refined = *a.embedded.refined;
    for (Vec3& position : refined.positions) {
        position = moved(position);
    }
    const MappedTarget b{
        {std::make_shared<const TriangleMesh>(copy), std::make_shared<const RefinedMesh>(refined)},
        a.landmarks};
    const SurfaceMap map = map_of(problem, a, b, 0);
    for (Index v = 0; v < copy.vertex_count(); ++v) {
        EXPECT_LT(
            (position_of(*b.embedded.target, map.vertex_images(0)[v]) - copy.positions[v]).norm(),
            1e-9);
    }
    EXPECT_NEAR(map.distortion().mean_energy, 4, 1e-9);
    expect_common_refinement(map);
}

TEST(SurfaceMap, composed_with_its_inverse_is_the_identity)
{
    const EmbeddingProblem a = near(zoo::cube(), zoo::bumpy_sphere(3, 2), 0.2);
    const EmbeddingProblem b = near(zoo::cube(), zoo::icosphere(2), 0.2);
    const SurfaceMap map = map_of(a, embed(a), embed(b), 3);
    expect_common_refinement(map);
    for (const std::size_t side : {0U, 1U}) {
        const TriangleMesh& mesh = map.placed(side).target();
        for (const SurfacePoint& point : random_points(mesh, 500, 7)) {
            const SurfacePoint there = map.image(side, point);
            ASSERT_LT(there.face, map.placed(1 - side).target().face_count());
            const SurfacePoint back = map.image(1 - side, there);
            EXPECT_LT((position_of(mesh, back) - position_of(mesh, point)).norm(), 1e-9);
        }
        // Images of vertices are those of the map, landmarks exactly.
        const std::array<const EmbeddingProblem*, 2> problems{&a, &b};
        for (std::size_t i = 0; i < a.landmarks.size(); ++i) {
            const Index from = problems[side]->landmarks[i];
            const Index to = problems[1 - side]->landmarks[i];
            EXPECT_EQ(position_of(*problems[1 - side]->target, map.vertex_images(side)[from]),
                      problems[1 - side]->target->position(to));
        }
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
            const Index h = mesh.outgoing(v);
            SurfacePoint point{TriangleMesh::face_of(h), {0, 0, 0}};
            point.barycentrics[h % 3] = 1;
            const TriangleMesh& other = map.placed(1 - side).target();
            EXPECT_LT((position_of(other, map.image(side, point)) -
                       position_of(other, map.vertex_images(side)[v]))
                          .norm(),
                      1e-9);
        }
    }
}

TEST(SurfaceMap, onto_a_remeshed_copy_is_near_to_the_identity_and_optimisation_lowers_its_energy)
{
    // Two triangulations of the unit sphere, with landmarks at about the same places.
    const EmbeddingProblem a = near(zoo::icosahedron(), zoo::icosphere(3));
    const EmbeddingProblem b = near(
        zoo::icosahedron(),
        zoo::on_unit_sphere(zoo::subdivided(zoo::subdivided(zoo::subdivided(zoo::octahedron())))));
    const MappedTarget first = embed(a);
    const MappedTarget second = embed(b);
    const auto error = [&](const SurfaceMap& map) {
        double sum = 0;
        for (Index v = 0; v < a.target->vertex_count(); ++v) {
            sum += (position_of(*b.target, map.vertex_images(0)[v]) - a.target->position(v)).norm();
        }
        return sum / a.target->vertex_count();
    };
    const SurfaceMap plain = map_of(a, first, second, 0);
    const SurfaceMap better = map_of(a, first, second, 10);
    expect_common_refinement(plain);
    expect_common_refinement(better);
    // Landmarks themselves differ by up to an edge's length, 0.1.
    EXPECT_LT(error(plain), 0.05);
    EXPECT_LT(error(better), 0.05);
    EXPECT_EQ(better.first_distortion().mean_energy, plain.distortion().mean_energy);
    EXPECT_LT(better.distortion().mean_energy, plain.distortion().mean_energy);
    EXPECT_GT(better.distortion().mean_energy, 4);
}

TEST(SurfaceMap, exists_for_every_topology)
{
    const PolygonMesh disk = zoo::grid_disk(8, 8);
    const std::vector<std::array<EmbeddingProblem, 2>> pairs{
        {near(zoo::quad_torus(4, 4), zoo::torus(16, 12)),
         near(zoo::quad_torus(4, 4), zoo::torus(9, 9))},
        // Outside of the layout there is no map.
        {test::problem_of(zoo::polygon(5), zoo::icosphere(2),
                          zoo::random_landmarks(zoo::icosphere(2), 5, 3)),
         test::problem_of(zoo::polygon(5), zoo::bumpy_sphere(2, 1),
                          zoo::random_landmarks(zoo::bumpy_sphere(2, 1), 5, 8))},
        {near(zoo::prism(7), zoo::icosphere(2)), near(zoo::prism(7), zoo::crumpled_sphere(3, 1))},
        {near(zoo::quad_grid(2, 2), disk), near(zoo::quad_grid(2, 2), zoo::grid_disk(5, 9))}};
    for (const auto& [a, b] : pairs) {
        const SurfaceMap map = map_of(a, embed(a), embed(b, PathShape::even), 2);
        expect_common_refinement(map);
        EXPECT_GE(map.first_distortion().mean_energy, map.distortion().mean_energy);
    }
}

TEST(SurfaceMap, moves_the_paths_of_both_targets_to_lower_the_energy_and_keeps_embeddings)
{
    const std::vector<std::array<PolygonMesh, 3>> triples{
        {zoo::cube(), zoo::stretched_sphere(2, Vec3(1, 2, 1)), zoo::bumpy_sphere(2, 4)},
        {zoo::quad_torus(3, 3), zoo::torus(12, 9), zoo::torus(9, 9)},
        {zoo::quad_grid(2, 2), zoo::grid_disk(6, 6), zoo::grid_disk(4, 7)}};
    int moved = 0;
    for (const auto& [layout, first, second] : triples) {
        const EmbeddingProblem a = near(layout, first, 0.1);
        const EmbeddingProblem b = near(layout, second, 0.1);
        const MappedTarget in_a = embed(a);
        const MappedTarget in_b = embed(b, PathShape::even);
        const SurfaceMap plain = map_of(a, in_a, in_b, 3);
        const SurfaceMap better = map_of(a, in_a, in_b, 3, 1);
        EXPECT_LE(better.distortion().mean_energy, plain.distortion().mean_energy);
        moved += better.distortion().mean_energy < 4 + 0.9 * (plain.distortion().mean_energy - 4);
        expect_common_refinement(better);
        expect_embeddings(layout, better, a.landmarks, b.landmarks);
    }
    EXPECT_GE(moved, 2);
}

TEST(SurfaceMap, passes_over_the_paths_go_on_while_they_gain_and_then_end)
{
    // Bodies of rather different proportions.
    const EmbeddingProblem a = near(zoo::cube(), zoo::stretched_sphere(2, Vec3(1, 3, 1)), 0.2);
    const EmbeddingProblem b = near(zoo::cube(), zoo::bumpy_sphere(2, 4), 0.2);
    const MappedTarget in_a = embed(a);
    const MappedTarget in_b = embed(b, PathShape::even);
    std::vector<double> energies;
    for (const Index passes : {2U, 4U, 50U, 100U}) {
        const SurfaceMap map = map_of(a, in_a, in_b, 3, passes);
        expect_common_refinement(map);
        expect_embeddings(zoo::cube(), map, a.landmarks, b.landmarks);
        energies.push_back(map.distortion().mean_energy);
    }
    EXPECT_LT(energies[1], energies[0]);
    EXPECT_LE(energies[2], energies[1]);
    // Long before so many of them nothing is left to gain.
    EXPECT_EQ(energies[3], energies[2]);
}

TEST(SurfaceMapJob, works_in_small_steps_and_ends_as_far_as_it_is_at_any_of_them)
{
    const EmbeddingProblem problem = near(zoo::cube(), zoo::stretched_sphere(2, Vec3(1, 2, 1)));
    const MappedTarget a = embed(problem);
    const MappedTarget b = embed(near(zoo::cube(), zoo::bumpy_sphere(2, 4)));
    SurfaceMapJob whole(problem.layout, a, b, {3, 1});
    std::size_t steps = 1;
    double progress = 0;
    for (; whole.step(); ++steps) {
        EXPECT_GE(whole.progress(), progress);
        // Only rounds that would gain nothing are passed over.
        EXPECT_LT(whole.progress(), progress + 0.4);
        progress = whole.progress();
    }
    EXPECT_EQ(whole.progress(), 1);
    const auto best = whole.take();
    ASSERT_TRUE(best.ok()) << best.error().message;
    // Far more than one for each round and pass.
    EXPECT_GT(steps, 200U);
    double energy = std::numeric_limits<double>::infinity();
    for (const double share : {0.0, 0.1, 0.3, 0.6, 0.95}) {
        SurfaceMapJob part(problem.layout, a, b, {3, 1});
        for (std::size_t i = 0; i < static_cast<std::size_t>(share * double(steps)); ++i) {
            ASSERT_TRUE(part.step());
        }
        part.end_optimisation();
        while (part.step()) {
        }
        const auto map = part.take();
        ASSERT_TRUE(map.ok()) << map.error().message;
        expect_common_refinement(*map);
        EXPECT_LE(map->distortion().mean_energy, energy);
        EXPECT_GE(map->distortion().mean_energy, best->distortion().mean_energy);
        energy = map->distortion().mean_energy;
    }
    EXPECT_LT(energy, best->first_distortion().mean_energy);
}

TEST(MapCheck, refuses_what_is_not_one_to_one)
{
    const EmbeddingProblem problem = near(zoo::cube(), zoo::bumpy_sphere(2, 2), 0.1);
    const MappedTarget a = embed(problem);
    const SurfaceMap map = map_of(problem, a, a, 0);
    const auto codes = [&](const PlacedTarget& damaged, std::vector<Index> landmarks) {
        std::set<std::string> found;
        for (const Violation& violation :
             check_maps(*problem.layout, landmarks, damaged, problem.landmarks, map.placed(1))
                 .violations) {
            found.insert(violation.code);
        }
        return found;
    };
    EXPECT_TRUE(codes(map.placed(0), problem.landmarks).empty());
    // An inner vertex drawn over the opposite side of one of its triangles.
    PlacedTarget damaged = map.placed(0);
    const PlacedPatch& placed = damaged.patches()[2];
    const Index boundary = placed.patch.boundary_size();
    ASSERT_GT(placed.map.points.size(), boundary);
    std::vector<PlanePoint> points = placed.map.points;
    const std::vector<PlanePoint> sound = points;
    for (const auto& c : placed.map.corners) {
        if (c[0] >= boundary) {
            points[c[0]] = to_plane(to_grid(points[c[1]] + points[c[2]] - points[c[0]]));
            break;
        }
    }
    damaged.set_points(2, points);
    EXPECT_TRUE(codes(damaged, problem.landmarks).contains("triangleFlipped"));
    // A whole map turned over.
    points = sound;
    for (PlanePoint& point : points) {
        point = PlanePoint(point.y(), point.x());
    }
    damaged.set_points(2, points);
    EXPECT_TRUE(codes(damaged, problem.landmarks).contains("triangleFlipped"));
    // A point off the grid, one off its side, and one that its chain has elsewhere.
    points = sound;
    points[boundary].x() = 1e-17;
    damaged.set_points(2, points);
    EXPECT_TRUE(codes(damaged, problem.landmarks).contains("mapIncomplete"));
    points = sound;
    points[1] = to_plane(to_grid(points[1] + PlanePoint(1e-3, 2e-3)));
    damaged.set_points(2, points);
    EXPECT_TRUE(codes(damaged, problem.landmarks).contains("boundaryOffSide"));
    damaged.set_points(2, sound);
    EXPECT_TRUE(codes(damaged, problem.landmarks).empty());
    ChainShares shares = damaged.shares()[0];
    ASSERT_GT(shares.size(), 2U);
    ++shares[1];
    damaged.set_shares(0, shares);
    EXPECT_EQ(codes(damaged, problem.landmarks), std::set<std::string>{"sidesDisagree"});
    // Other landmarks than those at the corners.
    std::vector<Index> exchanged = problem.landmarks;
    std::swap(exchanged[0], exchanged[1]);
    EXPECT_TRUE(codes(map.placed(0), exchanged).contains("landmarkMisplaced"));
    // Other domains.
    const EmbeddingProblem other = near(zoo::cube(), zoo::stretched_sphere(2, Vec3(1, 1, 3)));
    const SurfaceMap second = map_of(other, embed(other), embed(other), 0);
    EXPECT_TRUE(codes(second.placed(0), other.landmarks).contains("domainsDiffer"));
}

}  // namespace
}  // namespace layout_embedding
