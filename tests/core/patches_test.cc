#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <numeric>
#include <set>

#include "embedding/realisation.hh"
#include "embedding_checks.hh"
#include "instances.hh"
#include "patches/parametrisation.hh"
#include "search_ground.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

struct Realised {
    std::string name;
    EmbeddingProblem problem;
    RefinedMesh refined;
    std::vector<Patch> patches;
};

const std::vector<Realised>& realised_instances()
{
    static const std::vector<Realised> all = [] {
        std::vector<Realised> list;
        for (const test::EmbeddedInstance& instance : test::embedded_instances(1)) {
            const auto refined = realise(instance.problem, instance.graph, instance.weak);
            EXPECT_TRUE(refined.ok());
            test::expect_valid(instance.problem, instance.graph, instance.weak, *refined);
            auto patches = patches_of(*instance.problem.layout, *refined);
            EXPECT_TRUE(patches.ok()) << instance.name << ": " << patches.error().message;
            if (patches.ok()) {
                list.push_back({instance.name, instance.problem, *refined, std::move(*patches)});
            }
        }
        return list;
    }();
    return all;
}

/// Euler's characteristic of triangles, and the number of their boundary edges.
std::pair<long, long> characteristic(const std::vector<std::array<Index, 3>>& corners)
{
    std::set<Index> vertices;
    std::map<std::pair<Index, Index>, int> edges;
    for (const auto& c : corners) {
        for (int i = 0; i < 3; ++i) {
            vertices.insert(c[i]);
            ++edges[std::minmax(c[i], c[(i + 1) % 3])];
        }
    }
    const auto boundary = std::count_if(edges.begin(), edges.end(),
                                        [](const auto& edge) { return edge.second == 1; });
    return {static_cast<long>(vertices.size()) - static_cast<long>(edges.size()) +
                static_cast<long>(corners.size()),
            boundary};
}

double signed_area(const PlanePoint& a, const PlanePoint& b, const PlanePoint& c)
{
    return ((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x()) / 2;
}

/// Fails the test unless `map` is one-to-one: positive triangles that cover the domain once.
void expect_one_to_one(const Patch& patch, const Parametrisation& map, const Domain& domain)
{
    ASSERT_EQ(map.points.size(), patch.vertices.size() + map.splits.size());
    double sum = 0;
    for (const auto& c : map.corners) {
        const double size = signed_area(map.points[c[0]], map.points[c[1]], map.points[c[2]]);
        EXPECT_GT(size, 0);
        sum += size;
    }
    EXPECT_NEAR(sum, area(domain), 1e-9 * area(domain));
    EXPECT_EQ(characteristic(map.corners), std::pair(1L, static_cast<long>(patch.boundary_size())));
    for (Index side = 0; side < patch.side_count(); ++side) {
        const PlanePoint from = domain[side];
        const PlanePoint along = domain[(side + 1) % domain.size()] - from;
        double last = -1;
        for (Index v = patch.sides[side]; v < patch.sides[side + 1]; ++v) {
            const PlanePoint offset = map.points[v] - from;
            EXPECT_NEAR((offset - along * (offset.dot(along) / along.squaredNorm())).norm(), 0,
                        1e-12 * along.norm());
            EXPECT_GT(offset.dot(along), last);
            last = offset.dot(along);
        }
        EXPECT_EQ(map.points[patch.sides[side]], from);
    }
    EXPECT_GE(map.stretch, 1 - 1e-9);
}

TEST(Patch, is_the_disk_of_its_layout_face)
{
    std::size_t cut_open = 0;
    for (const Realised& instance : realised_instances()) {
        SCOPED_TRACE(instance.name);
        const Layout& layout = *instance.problem.layout;
        const RefinedMesh& refined = instance.refined;
        ASSERT_EQ(instance.patches.size(), layout.face_count());
        std::vector<int> seen(refined.triangle_faces.size(), 0);
        for (const Patch& patch : instance.patches) {
            const auto halfedges = layout.face_halfedges(patch.face);
            ASSERT_EQ(patch.side_count(), halfedges.size());
            // The sides are the chains.
            for (Index side = 0; side < patch.side_count(); ++side) {
                std::vector<Index> chain;
                for (Index v = patch.sides[side]; v < patch.sides[side + 1]; ++v) {
                    chain.push_back(patch.vertices[v]);
                }
                const bool last = side + 1 == patch.side_count();
                chain.push_back(patch.vertices[last ? 0 : patch.sides[side + 1]]);
                if (halfedges[side] % 2 == 1) {
                    std::reverse(chain.begin(), chain.end());
                }
                EXPECT_EQ(chain, refined.chains[Layout::edge(halfedges[side])]);
            }
            EXPECT_EQ(characteristic(patch.corners),
                      std::pair(1L, static_cast<long>(patch.boundary_size())));
            for (std::size_t t = 0; t < patch.triangles.size(); ++t) {
                ++seen[patch.triangles[t]];
                EXPECT_EQ(refined.triangle_patches[patch.triangles[t]], patch.face);
                for (Index i = 0; i < 3; ++i) {
                    EXPECT_EQ(patch.vertices[patch.corners[t][i]],
                              refined.corners[3 * patch.triangles[t] + i]);
                }
            }
            const std::set<Index> different(patch.vertices.begin(), patch.vertices.end());
            cut_open += patch.vertices.size() - different.size();
        }
        for (std::size_t t = 0; t < seen.size(); ++t) {
            EXPECT_EQ(seen[t], refined.triangle_patches[t] == kNone ? 0 : 1);
        }
    }
    RecordProperty("vertices_cut_open", static_cast<int>(cut_open));
}

TEST(Patch, chains_that_bound_other_triangles_are_refused)
{
    const Realised& instance = realised_instances().front();
    RefinedMesh damaged = instance.refined;
    std::reverse(damaged.chains[0].begin(), damaged.chains[0].end());
    const auto patches = patches_of(*instance.problem.layout, damaged);
    ASSERT_FALSE(patches.ok());
    EXPECT_EQ(patches.error().code, ErrorCode::realisationFailed);
    damaged = instance.refined;
    damaged.chains[0].insert(damaged.chains[0].begin() + 1, damaged.chains[0].front());
    EXPECT_FALSE(patches_of(*instance.problem.layout, damaged).ok());
}

TEST(Parametrisation, of_every_patch_is_one_to_one_onto_regular_polygons_and_rectangles)
{
    int count = 0;
    for (const Realised& instance : realised_instances()) {
        SCOPED_TRACE(instance.name);
        for (const Patch& patch : instance.patches) {
            SCOPED_TRACE("patch " + std::to_string(patch.face));
            const Domain domain = patch.side_count() == 4
                                      ? fitting_rectangle(patch, instance.refined.positions)
                                      : regular_polygon(patch.side_count());
            ++count;
            const auto map = parametrise(patch, instance.refined.positions, domain);
            ASSERT_TRUE(map.ok()) << map.error().message;
            expect_one_to_one(patch, *map, domain);
        }
    }
    EXPECT_GT(count, 1000);
}

TEST(Parametrisation, adapted_weights_lower_the_stretch)
{
    for (const Realised& instance : realised_instances()) {
        for (const Patch& patch : instance.patches) {
            const Domain domain = regular_polygon(patch.side_count());
            const auto plain = parametrise(patch, instance.refined.positions, domain, {0});
            const auto adapted = parametrise(patch, instance.refined.positions, domain);
            ASSERT_TRUE(adapted.ok());
            if (plain.ok()) {
                EXPECT_LE(adapted->stretch, plain->stretch);
            }
        }
    }
}

/// A patch of the whole of `mesh`, a disk, with corners at the given places of its boundary loop.
Patch whole(const PolygonMesh& mesh, const std::vector<Index>& boundary,
            const std::vector<Index>& sides)
{
    Patch patch;
    patch.face = 0;
    patch.vertices = boundary;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (std::find(boundary.begin(), boundary.end(), v) == boundary.end()) {
            patch.vertices.push_back(v);
        }
    }
    patch.sides = sides;
    patch.sides.push_back(static_cast<Index>(boundary.size()));
    std::vector<Index> ids(mesh.vertex_count());
    for (Index i = 0; i < patch.vertices.size(); ++i) {
        ids[patch.vertices[i]] = i;
    }
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const auto corners = mesh.face(f);
        patch.triangles.push_back(f);
        patch.corners.push_back({ids[corners[0]], ids[corners[1]], ids[corners[2]]});
    }
    return patch;
}

TEST(Parametrisation, a_flat_rectangle_is_mapped_to_itself)
{
    const PolygonMesh grid = zoo::grid_disk(4, 4);
    std::vector<Index> boundary;
    const auto at = [](Index i, Index j) { return 5 * i + j; };
    for (Index i = 0; i < 4; ++i)
        boundary.push_back(at(i, 0));
    for (Index i = 0; i < 4; ++i)
        boundary.push_back(at(4, i));
    for (Index i = 4; i > 0; --i)
        boundary.push_back(at(i, 4));
    for (Index i = 4; i > 0; --i)
        boundary.push_back(at(0, i));
    ASSERT_LT((grid.positions[at(4, 0)] - Vec3(1, 0, 0)).norm(), 1e-12);
    const Patch patch = whole(grid, boundary, {0, 4, 8, 12});
    const auto map = parametrise(patch, grid.positions, rectangle(1, 1));
    ASSERT_TRUE(map.ok());
    EXPECT_NEAR(map->stretch, 1, 1e-12);
    for (Index v = 0; v < patch.vertices.size(); ++v) {
        EXPECT_NEAR((map->points[v] - grid.positions[patch.vertices[v]].head<2>()).norm(), 0,
                    1e-12);
    }
}

TEST(Parametrisation, edges_that_join_two_vertices_of_a_side_are_split)
{
    // An octagon cut into triangles without an inner vertex, onto a triangle: most edges join two
    // vertices of one side.
    PolygonMesh fan;
    for (int i = 0; i < 8; ++i) {
        const Domain octagon = regular_polygon(8);
        fan.positions.emplace_back(octagon[i].x(), octagon[i].y(), 0.1 * i);
    }
    for (Index i = 1; i + 1 < 8; ++i) {
        fan.add_face(std::array<Index, 3>{0, i, i + 1});
    }
    std::vector<Index> boundary(8);
    std::iota(boundary.begin(), boundary.end(), Index{0});
    for (const std::vector<Index>& sides :
         {std::vector<Index>{0, 6, 7}, std::vector<Index>{0, 1, 2}, std::vector<Index>{0, 3, 5}}) {
        const Patch patch = whole(fan, boundary, sides);
        const Domain triangle = regular_polygon(3);
        const auto map = parametrise(patch, fan.positions, triangle);
        ASSERT_TRUE(map.ok());
        EXPECT_GT(map->splits.size(), 0U);
        expect_one_to_one(patch, *map, triangle);
    }
}

TEST(Parametrisation, long_limbs_and_slivers_are_mapped_one_to_one)
{
    // A tube closed at its far end, 8 vertices around, longer and longer.
    for (const int rings : {4, 16, 64}) {
        for (const double length : {0.01, 1.0, 1000.0}) {
            SCOPED_TRACE(std::to_string(rings) + " rings of " + std::to_string(length));
            PolygonMesh tube;
            const Domain octagon = regular_polygon(8);
            for (int ring = 0; ring < rings; ++ring) {
                for (const PlanePoint& p : octagon) {
                    tube.positions.emplace_back(p.x(), p.y(), ring * length);
                }
            }
            tube.positions.emplace_back(0, 0, rings * length);
            for (int ring = 0; ring < rings; ++ring) {
                for (Index i = 0; i < 8; ++i) {
                    const Index a = static_cast<Index>(8 * ring) + i;
                    const Index b = static_cast<Index>(8 * ring) + (i + 1) % 8;
                    if (ring + 1 == rings) {
                        tube.add_face(std::array<Index, 3>{a, b, tube.vertex_count() - 1});
                    } else {
                        tube.add_face(std::array<Index, 3>{a, b, b + 8});
                        tube.add_face(std::array<Index, 3>{a, b + 8, a + 8});
                    }
                }
            }
            std::vector<Index> boundary(8);
            std::iota(boundary.begin(), boundary.end(), Index{0});
            const Patch patch = whole(tube, boundary, {0, 2, 4, 6});
            const auto map = parametrise(patch, tube.positions, rectangle(1, 1));
            ASSERT_TRUE(map.ok()) << map.error().message;
            expect_one_to_one(patch, *map, rectangle(1, 1));
        }
    }
}

TEST(Domain, regular_polygons_are_regular)
{
    for (Index n = 3; n <= 40; ++n) {
        const Domain polygon = regular_polygon(n);
        for (Index i = 0; i < n; ++i) {
            const double angle = 2 * std::acos(-1.0) * i / n;
            EXPECT_NEAR(polygon[i].x(), std::cos(angle), 4e-15);
            EXPECT_NEAR(polygon[i].y(), std::sin(angle), 4e-15);
        }
    }
    EXPECT_DOUBLE_EQ(area(rectangle(3, 0.5)), 1.5);
    EXPECT_DOUBLE_EQ(area(regular_polygon(4)), 2);
}

}  // namespace
}  // namespace layout_embedding
