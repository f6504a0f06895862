#include "apps/quad_unfolding.hh"

#include <gtest/gtest.h>

#include "apps/quad_relaxation.hh"
#include "apps/quad_statistics.hh"
#include "base/random.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

constexpr Index kSide = 7;

/// A regular grid of quads on a plane target.
struct Grid {
    TriangleMesh target;
    std::vector<Vec3> normals;
    QuadMesh mesh;
    std::vector<Index> inner;
    std::vector<Index> quads;
};

void place(Grid& grid, Index v, const Vec3& position)
{
    grid.mesh.points[v] = walk_to_nearest(grid.target, grid.mesh.points[v], position);
    grid.mesh.positions[v] = position_of(grid.target, grid.mesh.points[v]);
}

Grid make_grid()
{
    PolygonMesh plane = zoo::triangulated(zoo::quad_grid(9, 9));
    Grid grid;
    grid.target = TriangleMesh(plane);
    for (Index face = 0; face < grid.target.face_count(); ++face) {
        grid.normals.push_back(face_normal(grid.target, face));
    }
    Vec3 low = plane.positions[0];
    Vec3 high = low;
    for (const Vec3& p : plane.positions) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    const Vec3 size = (high - low) / kSide;
    for (Index j = 0; j <= kSide; ++j) {
        for (Index i = 0; i <= kSide; ++i) {
            const Index v = j * (kSide + 1) + i;
            grid.mesh.points.push_back({0, {1, 0, 0}});
            grid.mesh.positions.emplace_back();
            place(grid, v, low + Vec3(i * size.x(), j * size.y(), 0));
            if (i > 0 && i < kSide && j > 0 && j < kSide) {
                grid.inner.push_back(v);
            }
            if (i < kSide && j < kSide) {
                grid.quads.push_back(static_cast<Index>(grid.mesh.quads.size()));
                grid.mesh.quads.push_back({v, v + 1, v + kSide + 2, v + kSide + 1});
            }
        }
    }
    return grid;
}

Index flipped(const Grid& grid)
{
    return quad_statistics(grid.mesh.positions, grid.mesh.quads,
                           surface_normals(grid.target, grid.mesh))
        .flipped;
}

/// Unfolds until nothing is flipped; the number of rounds that took.
int unfold(Grid& grid, const std::vector<Index>& vertices, const UnfoldingMeasure& measure)
{
    constexpr int kMostRounds = 60;
    int rounds = 0;
    for (; rounds < kMostRounds && flipped(grid) > 0; ++rounds) {
        unfold_quads(grid.target, grid.normals, vertices, grid.quads, measure, grid.mesh);
    }
    return rounds;
}

TEST(QuadUnfolding, opens_grids_whose_inner_vertices_lie_anywhere)
{
    const Grid regular = make_grid();
    ASSERT_EQ(flipped(regular), 0U);
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        for (const bool inflates : {false, true}) {
            SCOPED_TRACE(seed);
            SCOPED_TRACE(inflates);
            Grid grid = regular;
            Random random(seed);
            for (const Index v : grid.inner) {
                const Index other = grid.inner[random.below(grid.inner.size())];
                place(grid, v, (regular.mesh.positions[v] + regular.mesh.positions[other]) / 2);
            }
            ASSERT_GT(flipped(grid), 0U);
            unfold(grid, grid.inner, {1e-2, inflates});
            EXPECT_EQ(flipped(grid), 0U);
            for (Index v = 0; v < grid.mesh.positions.size(); ++v) {
                EXPECT_LT(
                    (position_of(grid.target, grid.mesh.points[v]) - grid.mesh.positions[v]).norm(),
                    1e-12);
                if (!std::binary_search(grid.inner.begin(), grid.inner.end(), v)) {
                    EXPECT_EQ(grid.mesh.positions[v], regular.mesh.positions[v]);
                }
            }
        }
    }
}

TEST(QuadUnfolding, keeps_corners_above_the_margin)
{
    // A fixed vertex between two of its neighbours further away: without a margin corners beside it
    // end below.
    const Grid regular = make_grid();
    const Index fixed = 3 * (kSide + 1) + 3;
    std::vector<Index> others = regular.inner;
    std::erase(others, fixed);
    const auto least_jacobian = [&](double margin) {
        Grid grid = regular;
        place(grid, fixed,
              regular.mesh.positions[fixed] +
                  2.5 * (regular.mesh.positions[fixed + 1] - regular.mesh.positions[fixed]));
        for (int round = 0; round < 60; ++round) {
            unfold_quads(grid.target, grid.normals, others, grid.quads,
                         {.softness = 1e-4, .inflates = false, .margin = margin}, grid.mesh);
        }
        return quad_statistics(grid.mesh.positions, grid.mesh.quads,
                               surface_normals(grid.target, grid.mesh))
            .least_jacobian;
    };
    constexpr double kMargin = 0.65;
    EXPECT_LT(least_jacobian(0), kMargin);
    EXPECT_GT(least_jacobian(kMargin), kMargin);
}

TEST(QuadUnfolding, leads_neighbours_back_around_a_fixed_vertex)
{
    // A fixed vertex in the middle of a quad further away: its own quads are pulled out of shape.
    const Grid regular = make_grid();
    Grid grid = regular;
    const Index fixed = 3 * (kSide + 1) + 3;
    place(grid, fixed,
          (regular.mesh.positions[fixed + kSide + 2] +
           regular.mesh.positions[fixed + 2 * (kSide + 2)]) /
              2);
    ASSERT_GT(flipped(grid), 0U);
    std::vector<Index> others = grid.inner;
    std::erase(others, fixed);
    const Vec3 there = grid.mesh.positions[fixed];
    unfold(grid, others, {1e-2, true});
    EXPECT_EQ(flipped(grid), 0U);
    EXPECT_EQ(grid.mesh.positions[fixed], there);
}

}  // namespace
}  // namespace layout_embedding
