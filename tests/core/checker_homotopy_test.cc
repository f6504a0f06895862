#include <gtest/gtest.h>
#include <map>

#include "checker_examples.hh"
#include "embedding/checker.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

/// A closed walk of target vertices that crosses the given layout edges in their order and no
/// others; neighbours in the list (and last and first) share a layout face.
std::vector<Index> loop_across(const ClaimedEmbedding& embedding,
                               const std::vector<std::array<Index, 2>>& edges)
{
    std::set<Index> on_paths;
    for (const std::vector<WeakPoint>& path : embedding.weak_paths) {
        for (const WeakPoint& point : path) {
            if (point[1] == kNone) {
                on_paths.insert(point[0]);
            }
        }
    }
    std::vector<Index> loop;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const auto station = [&](const std::array<Index, 2>& edge) {
            const auto& path = embedding.weak_paths[chain_of(embedding, edge[0], edge[1])];
            return path[path.size() / 4 * 2][0];
        };
        const std::vector<Index> walk =
            shortest_walk(embedding.target.corners, station(edges[i]),
                          station(edges[(i + 1) % edges.size()]), on_paths);
        loop.insert(loop.end(), walk.begin(), walk.end() - 1);
    }
    return loop;
}

/// The codes after the weak paths of an embedding, but not its chains, were twisted `times` times
/// around a loop that crosses the given layout edges.
Codes codes_after_twist(const PolygonMesh& polygons, int subdivisions,
                        const std::vector<std::array<Index, 2>>& edges, int times)
{
    ClaimedEmbedding e = embed_in_itself(polygons, subdivisions, true, 5);
    const std::vector<Index> loop = loop_across(e, edges);
    shake(e, 2000, 6);
    EXPECT_TRUE(e.check().valid());
    twist_weak_paths(e, loop, times);
    return e.codes();
}

struct Twist {
    std::string name;
    PolygonMesh polygons;
    int subdivisions;
    std::vector<std::array<Index, 2>> edges;
};

TEST(Checker, refuses_chains_that_differ_from_their_weak_paths_by_a_dehn_twist)
{
    const std::vector<Twist> twists = {
        {"tetrahedron, two landmarks on each side",
         zoo::tetrahedron(),
         2,
         {{0, 2}, {0, 3}, {1, 3}, {1, 2}}},
        {"octahedron, an edge and the rest",
         zoo::octahedron(),
         2,
         {{0, 3}, {0, 4}, {1, 4}, {1, 2}, {1, 5}, {0, 5}}},
        {"octahedron, a face and its opposite",
         zoo::octahedron(),
         2,
         {{0, 3}, {3, 4}, {2, 4}, {1, 2}, {1, 5}, {0, 5}}},
        {"cube, bottom and top", zoo::cube(), 2, {{0, 4}, {1, 5}, {2, 6}, {3, 7}}},
        {"torus, around the tube", grid_polygons(3, 4, true), 1, {{0, 1}, {3, 4}, {6, 7}, {9, 10}}},
        {"torus, along the tube", grid_polygons(3, 4, true), 1, {{0, 3}, {1, 4}, {2, 5}}},
        {"annulus, between two rows",
         grid_polygons(4, 2, false),
         1,
         {{0, 4}, {1, 5}, {2, 6}, {3, 7}}},
        {"annulus, all landmarks on the boundary",
         grid_polygons(4, 1, false),
         2,
         {{0, 4}, {1, 5}, {2, 6}, {3, 7}}},
    };
    for (const Twist& twist : twists) {
        for (const int times : {1, -1, 2, -3}) {
            EXPECT_EQ(codes_after_twist(twist.polygons, twist.subdivisions, twist.edges, times),
                      Codes{"homotopyClass"})
                << twist.name << ", " << times << " times";
        }
        EXPECT_EQ(codes_after_twist(twist.polygons, twist.subdivisions, twist.edges, 0), Codes{})
            << twist.name;
    }
}

TEST(Checker, accepts_a_turn_about_a_landmark)
{
    const std::vector<Twist> twists = {
        {"tetrahedron, around a vertex", zoo::tetrahedron(), 2, {{0, 1}, {0, 2}, {0, 3}}},
        {"octahedron, around a vertex", zoo::octahedron(), 2, {{0, 1}, {0, 4}, {0, 3}, {0, 5}}},
        {"torus, around a vertex", grid_polygons(3, 4, true), 1, {{4, 1}, {4, 3}, {4, 7}, {4, 5}}},
        {"annulus, around an inner vertex",
         grid_polygons(4, 2, false),
         1,
         {{5, 1}, {5, 4}, {5, 9}, {5, 6}}},
    };
    for (const Twist& twist : twists) {
        for (const int times : {1, -1, 2, -3}) {
            EXPECT_EQ(codes_after_twist(twist.polygons, twist.subdivisions, twist.edges, times),
                      Codes{})
                << twist.name << ", " << times << " times";
        }
    }
}

TEST(Checker, accepts_turns_about_all_landmarks_at_once)
{
    ClaimedEmbedding e = embed_in_itself(zoo::icosahedron(), 2, true);
    const PolygonMesh polygons = zoo::icosahedron();
    std::vector<std::vector<Index>> loops;
    for (const Index landmark : e.landmarks) {
        // The link of the landmark in the target.
        std::map<Index, Index> next;
        for (Index f = 0; f < e.target.face_count(); ++f) {
            const auto face = e.target.face(f);
            for (int i = 0; i < 3; ++i) {
                if (face[i] == landmark) {
                    next[face[(i + 1) % 3]] = face[(i + 2) % 3];
                }
            }
        }
        std::vector<Index> loop{next.begin()->first};
        while (next.at(loop.back()) != loop.front()) {
            loop.push_back(next.at(loop.back()));
        }
        loops.push_back(loop);
    }
    for (std::size_t i = 0; i < loops.size(); ++i) {
        twist_weak_paths(e, loops[i], static_cast<int>(i % 5) - 2);
    }
    EXPECT_TRUE(e.check().valid()) << describe(e.check());
}

TEST(Checker, a_single_twisted_weak_path_is_the_one_named)
{
    ClaimedEmbedding e = embed_in_itself(zoo::cube(), 2, true);
    ClaimedEmbedding twisted = e;
    twist_weak_paths(twisted, loop_across(e, {{0, 4}, {1, 5}, {2, 6}, {3, 7}}), 1);
    const Index c = chain_of(e, 1, 5);
    e.weak_paths[c] = twisted.weak_paths[c];
    const CheckReport report = e.check();
    ASSERT_EQ(report.violations.size(), 1U) << describe(report);
    EXPECT_EQ(report.violations[0].code, "homotopyClass");
    EXPECT_NE(report.violations[0].message.find("Chain " + std::to_string(c) + " "),
              std::string::npos)
        << describe(report);
}

/// An annulus of `size` by `size` quads, each cut along the diagonal, and the layout of four spokes
/// and two rings on it, the first spoke starting at column `shift`. The spokes are straight, or
/// wind around once along the diagonals.
ClaimedEmbedding spokes_on_annulus(Index size, Index shift, bool spiral)
{
    ClaimedEmbedding e;
    const Index columns = size;
    const Index rows = size;
    const PolygonMesh grid = grid_polygons(columns, rows, false);
    e.target.positions = grid.positions;
    for (Index f = 0; f < grid.face_count(); ++f) {
        const auto q = grid.face(f);  // (i, j), (i, j+1), (i+1, j+1), (i+1, j)
        e.target.add_face(std::array<Index, 3>{q[0], q[1], q[2]});
        e.target.add_face(std::array<Index, 3>{q[0], q[2], q[3]});
    }
    e.refined.positions = grid.positions;
    e.refined.corners = e.target.corners;
    e.layout = grid_polygons(4, 1, false);
    const Index quarter = columns / 4;
    for (Index i = 0; i < 4; ++i) {
        e.landmarks.push_back((i * quarter + shift) % columns);
    }
    for (Index i = 0; i < 4; ++i) {
        e.landmarks.push_back((i * quarter + shift) % columns + rows * columns);
    }
    for (Index i = 0; i < 4; ++i) {
        std::vector<Index> spoke;
        for (Index j = 0; j <= rows; ++j) {
            spoke.push_back(j * columns + (i * quarter + shift + (spiral ? j : 0)) % columns);
        }
        e.layout_edges.push_back({i, 4 + i});
        e.refined.chains.push_back(spoke);
        for (const Index ring : {0U, 1U}) {
            std::vector<Index> arc;
            for (Index k = 0; k <= quarter; ++k) {
                arc.push_back(ring * rows * columns + (i * quarter + shift + k) % columns);
            }
            e.layout_edges.push_back({4 * ring + i, 4 * ring + (i + 1) % 4});
            e.refined.chains.push_back(arc);
        }
    }
    for (const std::vector<Index>& chain : e.refined.chains) {
        e.weak_paths.push_back(weak_path_along(chain));
    }
    for (Index f = 0; f < e.target.face_count(); ++f) {
        const Index column = f / 2 % columns;
        const Index row = f / 2 / columns;
        // The upper triangle of a quad is left of the diagonal.
        const Index offset = column + 2 * columns - shift - (spiral ? row : 0);
        const Index place = offset % columns;
        const bool before = spiral && f % 2 == 0 && place % quarter == 0;
        e.refined.triangle_patches.push_back(((place / quarter) + (before ? 3 : 0)) % 4);
        e.refined.triangle_faces.push_back(f);
    }
    return e;
}

TEST(Checker, spiral_chains_are_refused_for_straight_weak_paths_and_the_other_way_round)
{
    for (const Index shift : {0U, 1U, 2U}) {
        const ClaimedEmbedding straight = spokes_on_annulus(12, shift, false);
        const ClaimedEmbedding spiral = spokes_on_annulus(12, shift, true);
        EXPECT_TRUE(straight.check().valid()) << describe(straight.check());
        EXPECT_TRUE(spiral.check().valid()) << describe(spiral.check());
        // All four spokes: landmarks on a boundary leave no freedom to turn.
        ClaimedEmbedding e = straight;
        e.weak_paths = spiral.weak_paths;
        EXPECT_EQ(e.codes(), Codes{"homotopyClass"}) << describe(e.check());
        EXPECT_EQ(e.check().violations.size(), 4U) << describe(e.check());
        e = spiral;
        e.weak_paths = straight.weak_paths;
        EXPECT_EQ(e.codes(), Codes{"homotopyClass"}) << describe(e.check());
        EXPECT_EQ(e.check().violations.size(), 4U) << describe(e.check());
        e.weak_paths.clear();
        EXPECT_TRUE(e.check().valid()) << describe(e.check());
    }
}

}  // namespace
}  // namespace layout_embedding
