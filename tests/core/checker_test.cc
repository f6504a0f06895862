#include "embedding/checker.hh"

#include <algorithm>
#include <gtest/gtest.h>

#include "checker_examples.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

TEST(Checker, accepts_valid_embeddings)
{
    for (const Example& example : examples()) {
        const CheckReport report = example.embedding.check();
        EXPECT_TRUE(report.valid()) << example.name << "\n" << describe(report);
    }
}

TEST(Checker, shaken_examples_really_leave_the_edges_of_the_target)
{
    for (const Example& example : examples()) {
        if (example.name.find("shaken") == std::string::npos) {
            continue;
        }
        std::size_t inside = 0;
        for (const std::vector<Index>& chain : example.embedding.refined.chains) {
            for (const Index v : chain) {
                if (v >= example.embedding.target.vertex_count()) {
                    const auto& b =
                        example.embedding.refined
                            .vertex_barycentrics[v - example.embedding.target.vertex_count()];
                    inside += b[0] > 0 && b[1] > 0 && b[2] > 0 ? 1 : 0;
                }
            }
        }
        EXPECT_GT(inside, 2U) << example.name;
    }
}

TEST(Checker, accepts_chains_and_weak_paths_given_from_the_other_end)
{
    for (Example& example : examples()) {
        ClaimedEmbedding& e = example.embedding;
        std::swap(e.layout_edges[1][0], e.layout_edges[1][1]);
        std::reverse(e.refined.chains[1].begin(), e.refined.chains[1].end());
        std::reverse(e.weak_paths[1].begin(), e.weak_paths[1].end());
        EXPECT_TRUE(e.check().valid()) << example.name << "\n" << describe(e.check());
    }
}

TEST(Checker, accepts_weak_paths_through_centroids_and_along_detours)
{
    ClaimedEmbedding e = embed_in_itself(zoo::octahedron(), 2, true);
    for (std::vector<WeakPoint>& path : e.weak_paths) {
        // Around the middle vertex in two faces: vertex, midpoint, centroid, midpoint, and back.
        const Index v = path[path.size() / 2][0];
        std::vector<WeakPoint> detour;
        for (Index f = 0; f < e.target.face_count(); ++f) {
            const auto face = e.target.face(f);
            if (std::count(face.begin(), face.end(), v) == 1) {
                detour = {{v, kNone, kNone},           {face[0], face[1], kNone},
                          {face[2], face[0], face[1]}, {face[1], face[2], kNone},
                          {face[0], face[1], face[2]}, {v, kNone, kNone}};
                if (face[2] != v) {
                    break;
                }
            }
        }
        if (detour[1][0] != v && detour[1][1] != v) {
            detour.erase(detour.begin() + 1);
        }
        path.insert(path.begin() + static_cast<std::ptrdiff_t>(path.size() / 2) + 1,
                    detour.begin() + 1, detour.end());
    }
    EXPECT_TRUE(e.check().valid()) << describe(e.check());
}

TEST(Checker, accepts_a_hole_inside_the_outside_patch)
{
    // A disk layout; its outside holds a hole that touches no chain.
    ClaimedEmbedding e = embed_in_itself(zoo::cube(), 2, false, 1, {1});
    const Index center = 9;  // of face 1
    PolygonMesh target;
    target.positions = e.target.positions;
    RefinedMesh& refined = e.refined;
    refined.corners.clear();
    refined.triangle_faces.clear();
    std::vector<Index> patches;
    std::vector<Index> ids(target.positions.size(), kNone);
    // The centre itself goes, and with it the triangles around it.
    for (Index v = 0; v < target.vertex_count(); ++v) {
        ids[v] = v < center ? v : v - 1;
    }
    for (Index f = 0; f < e.target.face_count(); ++f) {
        const auto face = e.target.face(f);
        if (std::find(face.begin(), face.end(), center) == face.end()) {
            target.add_face(std::array<Index, 3>{ids[face[0]], ids[face[1]], ids[face[2]]});
            refined.triangle_faces.push_back(static_cast<Index>(patches.size()));
            patches.push_back(refined.triangle_patches[f]);
        }
    }
    target.positions.erase(target.positions.begin() + center);
    refined.positions = target.positions;
    refined.corners = target.corners;
    refined.triangle_patches = patches;
    e.target = target;
    for (std::size_t c = 0; c < refined.chains.size(); ++c) {
        for (Index& v : refined.chains[c]) {
            v = ids[v];
        }
        e.weak_paths[c] = weak_path_along(refined.chains[c]);
    }
    EXPECT_TRUE(e.check().valid()) << describe(e.check());

    // The same mesh with another face left out of the layout: the hole is in an inner patch now,
    // and the outside patch has none.
    ClaimedEmbedding wrong = e;
    wrong.layout = PolygonMesh();
    wrong.layout.positions = zoo::cube().positions;
    for (const Index f : {1U, 2U, 3U, 4U, 5U}) {
        wrong.layout.add_face(zoo::cube().face(f));
    }
    for (Index& patch : wrong.refined.triangle_patches) {
        patch = patch == 0 ? kNone : patch == kNone ? 0 : patch;
    }
    EXPECT_EQ(wrong.codes(), (Codes{"holeInPatch", "holeCount"})) << describe(wrong.check());
}

}  // namespace
}  // namespace layout_embedding
