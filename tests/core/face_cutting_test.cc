#include "embedding/face_cutting.hh"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <set>

#include "base/random.hh"

namespace layout_embedding {
namespace {

const std::array<Vec3, 3> kCorners{Vec3(0, 0, 1), Vec3(4, 0.5, 0), Vec3(1, 3, 0)};

/// `crossings` per side, evenly spread, without partners.
std::vector<PerimeterPoint> perimeter(const std::array<Index, 3>& crossings)
{
    std::vector<PerimeterPoint> points;
    for (Index side = 0; side < 3; ++side) {
        for (Index i = 0; i <= crossings[side]; ++i) {
            const double t = i / (crossings[side] + 1.0);
            points.push_back({side, t, i == 0 ? kNone : 0,
                              (1 - t) * kCorners[side] + t * kCorners[(side + 1) % 3]});
        }
    }
    return points;
}

/// The only way to join the crossings by disjoint chords, `at_corners` of them ending at corners.
/// Empty if there is none.
std::vector<PerimeterPoint> with_chords(const std::array<Index, 3>& around_corners, Index corner,
                                        Index at_corner)
{
    // Chords around corner c join the sides c - 1 and c; those from the corner end at the opposite
    // side, between the chords around the other two corners.
    std::array<Index, 3> counts{};
    for (Index c = 0; c < 3; ++c) {
        counts[c] += around_corners[c];
        counts[(c + 2) % 3] += around_corners[c];
    }
    counts[(corner + 1) % 3] += at_corner;
    std::vector<PerimeterPoint> points = perimeter(counts);
    std::array<Index, 3> corner_places{0, 1 + counts[0], 2 + counts[0] + counts[1]};
    const auto place = [&](Index side, Index i) { return corner_places[side] + 1 + i; };
    for (Index c = 0; c < 3; ++c) {
        const Index before = (c + 2) % 3;
        for (Index i = 0; i < around_corners[c]; ++i) {
            const Index a = place(c, i);
            const Index b = place(before, counts[before] - 1 - i);
            points[a].partner = b;
            points[b].partner = a;
        }
    }
    for (Index i = 0; i < at_corner; ++i) {
        points[place((corner + 1) % 3, around_corners[(corner + 1) % 3] + i)].partner =
            corner_places[corner];
    }
    return points;
}

double area(const Vec3& a, const Vec3& b, const Vec3& c)
{
    return 0.5 * (b - a).cross(c - a).dot(
                     (kCorners[1] - kCorners[0]).cross(kCorners[2] - kCorners[0]).normalized());
}

double smallest_angle(const std::array<Vec3, 3>& p)
{
    double smallest = 10;
    for (Index i = 0; i < 3; ++i) {
        const Vec3 a = (p[(i + 1) % 3] - p[i]).normalized();
        const Vec3 b = (p[(i + 2) % 3] - p[i]).normalized();
        smallest = std::min(smallest, std::acos(std::clamp(a.dot(b), -1.0, 1.0)));
    }
    return smallest;
}

/// The largest smallest angle over all triangulations of the polygon i .. j.
double best_angle(const std::vector<Vec3>& polygon, std::size_t i, std::size_t j)
{
    if (j - i < 2) {
        return 10;
    }
    double best = -1;
    for (std::size_t k = i + 1; k < j; ++k) {
        best = std::max(best, std::min({best_angle(polygon, i, k), best_angle(polygon, k, j),
                                        smallest_angle({polygon[i], polygon[k], polygon[j]})}));
    }
    return best;
}

std::vector<std::vector<PerimeterPoint>> random_faces()
{
    Random random(5);
    std::vector<std::vector<PerimeterPoint>> faces;
    for (int i = 0; i < 500; ++i) {
        const Index corner = static_cast<Index>(random.below(3));
        const Index at_corner = static_cast<Index>(random.below(4));
        std::array<Index, 3> around{};
        for (Index c = 0; c < 3; ++c) {
            around[c] = static_cast<Index>(random.below(5));
        }
        if (at_corner > 0) {
            around[corner] = 0;  // Such chords would cross those from the corner.
        }
        faces.push_back(with_chords(around, corner, at_corner));
    }
    return faces;
}

TEST(FaceCutting, pieces_tile_the_face_and_every_chord_borders_two_of_them)
{
    for (const auto& points : random_faces()) {
        FacePieces pieces;
        ASSERT_TRUE(cut_face(points, pieces));
        std::multiset<std::pair<Index, Index>> chords;
        std::multiset<Index> stretches;
        double total = 0;
        for (Index i = 0; i < pieces.count(); ++i) {
            const auto piece = pieces.piece(i);
            ASSERT_LE(piece.size(), 6U);
            std::vector<std::array<Index, 3>> triangles;
            triangulate_piece(points, piece, triangles);
            EXPECT_EQ(triangles.size(), piece.size() - 2);
            for (const auto& [a, b, c] : triangles) {
                const double size =
                    area(points[a].position, points[b].position, points[c].position);
                EXPECT_GT(size, 0);
                total += size;
            }
            for (std::size_t k = 0; k < piece.size(); ++k) {
                const Index a = piece[k];
                const Index b = piece[(k + 1) % piece.size()];
                if (b == (a + 1) % points.size()) {
                    stretches.insert(a);
                } else {
                    chords.insert(std::minmax(a, b));
                }
            }
        }
        EXPECT_NEAR(total, area(kCorners[0], kCorners[1], kCorners[2]), 1e-12);
        EXPECT_EQ(stretches.size(), points.size());
        EXPECT_EQ(std::set<Index>(stretches.begin(), stretches.end()).size(), points.size());
        std::set<std::pair<Index, Index>> expected;
        for (Index i = 0; i < points.size(); ++i) {
            if (!points[i].is_corner()) {
                expected.insert(std::minmax(i, points[i].partner));
            }
        }
        EXPECT_EQ(pieces.count(), expected.size() + 1);
        EXPECT_EQ(chords.size(), 2 * expected.size());
        for (const auto& chord : expected) {
            EXPECT_EQ(chords.count(chord), 2U);
        }
    }
}

TEST(FaceCutting, no_triangulation_of_a_piece_has_a_larger_smallest_angle)
{
    int hexagons = 0;
    for (const auto& points : random_faces()) {
        FacePieces pieces;
        ASSERT_TRUE(cut_face(points, pieces));
        for (Index i = 0; i < pieces.count(); ++i) {
            std::vector<Vec3> polygon;
            for (const Index place : pieces.piece(i)) {
                polygon.push_back(points[place].position);
            }
            hexagons += polygon.size() == 6 ? 1 : 0;
            std::vector<std::array<Index, 3>> triangles;
            triangulate_piece(points, pieces.piece(i), triangles);
            double smallest = 10;
            for (const auto& [a, b, c] : triangles) {
                smallest = std::min(
                    smallest,
                    smallest_angle({points[a].position, points[b].position, points[c].position}));
            }
            EXPECT_NEAR(smallest, best_angle(polygon, 0, polygon.size() - 1), 1e-9);
        }
    }
    EXPECT_GT(hexagons, 20);
}

TEST(FaceCutting, crossing_chords_are_refused)
{
    int refused = 0;
    for (const auto& points : random_faces()) {
        // Exchange the far ends of two chords that have both ends on the same two sides: they
        // become crossing ones.
        for (Index i = 0; i + 1 < points.size(); ++i) {
            if (points[i].is_corner() || points[i + 1].is_corner()) {
                continue;
            }
            const Index a = points[i].partner;
            const Index b = points[i + 1].partner;
            if (points[a].is_corner() || points[b].is_corner() ||
                points[a].side != points[b].side) {
                continue;
            }
            auto crossed = points;
            crossed[i].partner = b;
            crossed[b].partner = i;
            crossed[i + 1].partner = a;
            crossed[a].partner = i + 1;
            FacePieces pieces;
            EXPECT_FALSE(cut_face(crossed, pieces));
            ++refused;
        }
    }
    EXPECT_GT(refused, 100);
}

TEST(FaceCutting, chords_from_a_corner_that_cross_others_are_refused)
{
    // A chord around corner 0 and one from corner 0 to the opposite side.
    FacePieces pieces;
    for (Index corner = 0; corner < 3; ++corner) {
        std::array<Index, 3> around{};
        around[corner] = 1;
        EXPECT_FALSE(cut_face(with_chords(around, corner, 1), pieces));
        EXPECT_TRUE(cut_face(with_chords(around, (corner + 1) % 3, 1), pieces) ||
                    cut_face(with_chords(around, (corner + 2) % 3, 1), pieces));
    }
}

TEST(FaceCutting, chords_along_a_side_are_refused)
{
    auto two = perimeter({2, 0, 0});
    two[1].partner = 2;
    two[2].partner = 1;
    FacePieces pieces;
    EXPECT_FALSE(cut_face(two, pieces));
    for (const Index corner : {0U, 2U}) {
        auto one = perimeter({1, 0, 0});
        one[1].partner = corner;
        EXPECT_FALSE(cut_face(one, pieces));
    }
}

}  // namespace
}  // namespace layout_embedding
