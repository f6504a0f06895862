#include <algorithm>
#include <gtest/gtest.h>

#include "checker_examples.hh"
#include "embedding/checker.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

TEST(Checker, refuses_chains_that_meet_at_a_vertex)
{
    for (Example& example : examples()) {
        ClaimedEmbedding& e = example.embedding;
        const Index other = e.layout_edges[1][0] == e.layout_edges[0][0] ||
                                    e.layout_edges[1][0] == e.layout_edges[0][1]
                                ? e.refined.chains[1][1]
                                : *(e.refined.chains[1].end() - 2);
        std::set<Index> landmarks(e.landmarks.begin(), e.landmarks.end());
        std::vector<Index>& chain = e.refined.chains[0];
        const std::vector<Index> rest =
            shortest_walk(e.refined.corners, other, chain.back(), landmarks);
        landmarks.insert(rest.begin(), rest.end());
        chain = shortest_walk(e.refined.corners, chain.front(), other, landmarks);
        chain.insert(chain.end(), rest.begin() + 1, rest.end());
        const Codes codes = e.codes();
        EXPECT_EQ(codes.count("chainsMeet"), 1U) << example.name << "\n" << describe(e.check());
    }
}

TEST(Checker, refuses_a_mirrored_layout)
{
    for (Example& example : examples()) {
        PolygonMesh& layout = example.embedding.layout;
        for (Index f = 0; f < layout.face_count(); ++f) {
            std::reverse(layout.corners.begin() + layout.face_offsets[f],
                         layout.corners.begin() + layout.face_offsets[f + 1]);
        }
        const Codes codes = example.embedding.codes();
        EXPECT_EQ(codes.count("cyclicOrder"), 1U) << example.name << "\n"
                                                  << describe(example.embedding.check());
        EXPECT_EQ(codes.count("patchBoundary"), 1U) << example.name << "\n"
                                                    << describe(example.embedding.check());
    }
}

TEST(Checker, refuses_two_landmarks_exchanged_together_with_their_chains)
{
    // Opposite corners of the octahedron have the same neighbours, so that all chains fit.
    ClaimedEmbedding e = embed_in_itself(zoo::octahedron(), 1, true);
    std::swap(e.landmarks[0], e.landmarks[2]);
    for (std::array<Index, 2>& edge : e.layout_edges) {
        for (Index& v : edge) {
            v = v == 0 ? 2 : v == 2 ? 0 : v;
        }
    }
    const Codes codes = e.codes();
    EXPECT_EQ(codes.count("cyclicOrder"), 1U) << describe(e.check());
    EXPECT_EQ(codes.count("patchBoundary"), 1U) << describe(e.check());
    EXPECT_EQ(codes.count("chainWrongEnd"), 0U) << describe(e.check());
}

TEST(Checker, refuses_a_patch_that_is_no_disk)
{
    // A square and its back, drawn on a torus: all of the torus's handle is in the back.
    ClaimedEmbedding e = embed_in_itself(grid_polygons(4, 4, true), 1, true);
    PolygonMesh pillow;
    pillow.positions.resize(4);
    pillow.add_face(std::array<Index, 4>{0, 1, 2, 3});
    pillow.add_face(std::array<Index, 4>{3, 2, 1, 0});
    const std::array<Index, 4> corners{0, 4, 5, 1};
    ClaimedEmbedding drawn = e;
    drawn.layout = pillow;
    drawn.landmarks.assign(corners.begin(), corners.end());
    drawn.layout_edges.clear();
    drawn.refined.chains.clear();
    drawn.weak_paths.clear();
    for (Index i = 0; i < 4; ++i) {
        const Index j = (i + 1) % 4;
        const Index c = chain_of(e, corners[i], corners[j]);
        std::vector<Index> chain = e.refined.chains[c];
        std::vector<WeakPoint> path = e.weak_paths[c];
        if (e.layout_edges[c][0] != corners[i]) {
            std::reverse(chain.begin(), chain.end());
            std::reverse(path.begin(), path.end());
        }
        drawn.layout_edges.push_back({i, j});
        drawn.refined.chains.push_back(chain);
        drawn.weak_paths.push_back(path);
    }
    for (Index& patch : drawn.refined.triangle_patches) {
        patch = patch == 0 ? 0 : 1;
    }
    EXPECT_EQ(drawn.codes(), (Codes{"topologyMismatch", "patchNotDisk"}))
        << describe(drawn.check());
}

TEST(Checker, refuses_a_hole_on_the_wrong_side_of_a_boundary_landmark)
{
    // A disk of two triangles. The other layout has one of them, and the outside for a second one.
    ClaimedEmbedding e = embed_in_itself(
        zoo::polygon_mesh({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}), 2,
        true);
    PolygonMesh other;
    other.positions.resize(4);
    other.add_face(std::array<Index, 4>{3, 2, 1, 0});
    other.add_face(std::array<Index, 3>{0, 2, 3});
    e.layout = other;
    EXPECT_EQ(e.codes(), (Codes{"boundaryOrder", "holeCount", "holeInPatch", "landmarkOnBoundary",
                                "patchIds"}))
        << describe(e.check());
}

TEST(Checker, refuses_a_target_of_another_genus_or_with_other_holes)
{
    const ClaimedEmbedding sphere = embed_in_itself(zoo::cube(), 1, true);
    ClaimedEmbedding e = sphere;
    e.layout = grid_polygons(3, 3, true);
    EXPECT_EQ(e.codes().count("topologyMismatch"), 1U) << describe(e.check());

    // An annulus has two holes, a disk layout only one boundary loop.
    e = embed_in_itself(grid_polygons(4, 1, false), 1, true);
    e.layout.face_offsets.pop_back();
    e.layout.corners.resize(e.layout.face_offsets.back());
    EXPECT_EQ(e.codes().count("topologyMismatch"), 1U) << describe(e.check());
}

TEST(Checker, refuses_two_neighbours_exchanged_in_a_cyclic_order)
{
    // Four ways from pole to pole; in the layout, two neighbouring ones change places. The chains
    // are those of the one as well as of the other.
    const auto layout = [](const std::array<Index, 4>& order) {
        PolygonMesh mesh;
        mesh.positions = zoo::octahedron().positions;
        for (int i = 0; i < 4; ++i) {
            mesh.add_face(std::array<Index, 4>{4, order[i], 5, order[(i + 1) % 4]});
        }
        return mesh;
    };
    const ClaimedEmbedding valid = embed_in_itself(layout({0, 1, 2, 3}), 2, true);
    EXPECT_TRUE(valid.check().valid()) << describe(valid.check());
    for (Index i = 0; i < 4; ++i) {
        std::array<Index, 4> order{0, 1, 2, 3};
        std::swap(order[i], order[(i + 1) % 4]);
        ClaimedEmbedding e = valid;
        e.layout = layout(order);
        std::size_t poles = 0;
        for (const Violation& violation : e.check().violations) {
            poles += violation.code == "cyclicOrder" ? 1 : 0;
        }
        EXPECT_EQ(poles, 2U) << describe(e.check());
    }
}

}  // namespace
}  // namespace layout_embedding
