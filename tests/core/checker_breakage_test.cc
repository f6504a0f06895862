#include <algorithm>
#include <functional>
#include <gtest/gtest.h>
#include <limits>

#include "checker_examples.hh"
#include "embedding/checker.hh"

namespace layout_embedding {
namespace {

/// A way to spoil an embedding, and the violation it must lead to. `spoil` returns false where it
/// does not apply.
struct Breakage {
    std::string name;
    std::string code;
    std::function<bool(ClaimedEmbedding&)> spoil;
};

/// A new vertex of the refined mesh inside a face, kNone if there is none.
Index new_vertex_inside(const ClaimedEmbedding& e)
{
    for (Index k = 0; k < e.refined.vertex_faces.size(); ++k) {
        const auto& b = e.refined.vertex_barycentrics[k];
        if (b[0] > 0 && b[1] > 0 && b[2] > 0) {
            return e.target.vertex_count() + k;
        }
    }
    return kNone;
}

/// Puts a new vertex somewhere else in its face.
void move_to(ClaimedEmbedding& e, Index vertex, const std::array<double, 3>& b)
{
    const Index k = vertex - e.target.vertex_count();
    const auto face = e.target.face(e.refined.vertex_faces[k]);
    e.refined.vertex_barycentrics[k] = b;
    e.refined.positions[vertex] = b[0] * e.target.positions[face[0]] +
                                  b[1] * e.target.positions[face[1]] +
                                  b[2] * e.target.positions[face[2]];
}

std::size_t edge_count(const std::vector<Index>& corners)
{
    std::set<std::pair<Index, Index>> edges;
    for (std::size_t c = 0; c < corners.size(); ++c) {
        edges.insert(std::minmax(corners[c], corners[c % 3 == 2 ? c - 2 : c + 1]));
    }
    return edges.size();
}

std::vector<Breakage> breakages()
{
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    return {
        // The subdivision.
        {"input vertex moved", "inputVertexMoved",
         [](ClaimedEmbedding& e) {
             e.refined.positions[1].x() += 1e-15;
             return true;
         }},
        {"new vertex moved", "vertexMisplaced",
         [](ClaimedEmbedding& e) {
             e.refined.positions.back().x() += 1e-6;
             return e.refined.vertex_faces.size() > 0;
         }},
        {"position not a number", "nonFinitePosition",
         [=](ClaimedEmbedding& e) {
             e.refined.positions.back().y() = nan;
             return true;
         }},
        {"coordinates not numbers", "barycentricOutOfRange",
         [=](ClaimedEmbedding& e) {
             if (!e.refined.vertex_barycentrics.empty()) {
                 e.refined.vertex_barycentrics[0] = {nan, nan, nan};
             }
             return !e.refined.vertex_barycentrics.empty();
         }},
        {"coordinates negative", "barycentricOutOfRange",
         [](ClaimedEmbedding& e) {
             if (!e.refined.vertex_barycentrics.empty()) {
                 e.refined.vertex_barycentrics[0] = {-0.1, 0.5, 0.6};
             }
             return !e.refined.vertex_barycentrics.empty();
         }},
        {"new vertex on a corner", "newVertexOnVertex",
         [](ClaimedEmbedding& e) {
             const Index v = new_vertex_inside(e);
             if (v != kNone) {
                 move_to(e, v, {1, 0, 0});
             }
             return v != kNone;
         }},
        {"new vertex moved over an edge", "triangleFlipped",
         [](ClaimedEmbedding& e) {
             // The centre of the part at one corner of the face goes to another part: triangles
             // fold over, the signed areas still add up to one.
             const Index v = new_vertex_inside(e);
             if (v == kNone) {
                 return false;
             }
             move_to(e, v, {0.3, 0.35, 0.35});
             EXPECT_EQ(e.codes(), Codes{"triangleFlipped"}) << describe(e.check());
             return true;
         }},
        {"new vertex moved onto an edge", "triangleDegenerate",
         [](ClaimedEmbedding& e) {
             // Centres of the parts at the corners of the face, with the corner's coordinate 2/3.
             const Index v = new_vertex_inside(e);
             if (v == kNone) {
                 return false;
             }
             const Index k = v - e.target.vertex_count();
             const bool first = e.refined.vertex_barycentrics[k][0] > 0.5;
             move_to(e, v, {0.9, 0.1, 0});
             return first;
         }},
        {"triangle turned over", "refinedNotSurface",
         [](ClaimedEmbedding& e) {
             std::swap(e.refined.corners[0], e.refined.corners[1]);
             return true;
         }},
        {"all triangles turned over", "triangleFlipped",
         [](ClaimedEmbedding& e) {
             for (Index t = 0; t < e.triangle_count(); ++t) {
                 std::swap(e.refined.corners[3 * t], e.refined.corners[3 * t + 1]);
             }
             return true;
         }},
        {"triangle missing", "areaMismatch",
         [](ClaimedEmbedding& e) {
             e.refined.corners.erase(e.refined.corners.begin(), e.refined.corners.begin() + 3);
             e.refined.triangle_faces.erase(e.refined.triangle_faces.begin());
             e.refined.triangle_patches.erase(e.refined.triangle_patches.begin());
             return true;
         }},
        {"triangle twice", "refinedNotSurface",
         [](ClaimedEmbedding& e) {
             for (int i = 0; i < 3; ++i) {
                 e.refined.corners.push_back(e.refined.corners[i]);
             }
             e.refined.triangle_faces.push_back(e.refined.triangle_faces[0]);
             e.refined.triangle_patches.push_back(e.refined.triangle_patches[0]);
             return true;
         }},
        {"triangle in another face", "triangleOutsideFace",
         [](ClaimedEmbedding& e) {
             e.refined.triangle_faces[0] = e.refined.triangle_faces.back();
             return true;
         }},
        {"crack along an edge", "boundaryMismatch",
         [](ClaimedEmbedding& e) {
             // A second copy of a vertex on an edge for the triangles of one of its faces. (Where
             // the target has a boundary, the crack could reach it, which is another violation.)
             if (e.target.corners.size() != 2 * edge_count(e.target.corners)) {
                 return false;
             }
             for (Index k = 0; k < e.refined.vertex_faces.size(); ++k) {
                 const auto& b = e.refined.vertex_barycentrics[k];
                 const Index v = e.target.vertex_count() + k;
                 const Index face = e.refined.vertex_faces[k];
                 std::set<Index> faces;
                 for (Index c = 0; c < e.refined.corners.size(); ++c) {
                     if (e.refined.corners[c] == v) {
                         faces.insert(e.refined.triangle_faces[c / 3]);
                     }
                 }
                 if (faces.size() < 2 || (b[0] > 0 && b[1] > 0 && b[2] > 0)) {
                     continue;
                 }
                 const Index copy = static_cast<Index>(e.refined.positions.size());
                 for (Index c = 0; c < e.refined.corners.size(); ++c) {
                     if (e.refined.corners[c] == v && e.refined.triangle_faces[c / 3] == face) {
                         e.refined.corners[c] = copy;
                     }
                 }
                 e.refined.positions.push_back(Vec3(e.refined.positions[v]));
                 e.refined.vertex_faces.push_back(face);
                 e.refined.vertex_barycentrics.push_back(std::array<double, 3>(b));
                 return true;
             }
             return false;
         }},
        {"vertex without triangles", "refinedNotSurface",
         [](ClaimedEmbedding& e) {
             e.refined.vertex_faces.push_back(0);
             e.refined.vertex_barycentrics.push_back({0.25, 0.25, 0.5});
             e.refined.positions.emplace_back(0, 0, 0);
             move_to(e, static_cast<Index>(e.refined.positions.size() - 1), {0.25, 0.25, 0.5});
             return true;
         }},
        {"target vertex dropped from the refined mesh", "sizeMismatch",
         [](ClaimedEmbedding& e) {
             e.refined.positions.resize(e.target.positions.size() - 1);
             return true;
         }},
        {"too few coordinates", "sizeMismatch",
         [](ClaimedEmbedding& e) {
             e.refined.vertex_barycentrics.resize(e.refined.vertex_faces.size() + 1);
             return true;
         }},
        {"too few triangle faces", "sizeMismatch",
         [](ClaimedEmbedding& e) {
             e.refined.triangle_faces.pop_back();
             return true;
         }},
        {"too few patches", "sizeMismatch",
         [](ClaimedEmbedding& e) {
             e.refined.triangle_patches.clear();
             return true;
         }},
        {"corners not a multiple of three", "sizeMismatch",
         [](ClaimedEmbedding& e) {
             e.refined.corners.push_back(0);
             return true;
         }},
        {"corner out of range", "indexOutOfRange",
         [](ClaimedEmbedding& e) {
             e.refined.corners[5] = static_cast<Index>(e.refined.positions.size());
             return true;
         }},
        {"triangle face out of range", "indexOutOfRange",
         [](ClaimedEmbedding& e) {
             e.refined.triangle_faces[5] = kNone;
             return true;
         }},
        {"vertex face out of range", "indexOutOfRange",
         [](ClaimedEmbedding& e) {
             if (!e.refined.vertex_faces.empty()) {
                 e.refined.vertex_faces[0] = e.target.face_count();
             }
             return !e.refined.vertex_faces.empty();
         }},
        // Target, layout, landmarks.
        {"target scaled", "inputVertexMoved",
         [](ClaimedEmbedding& e) {
             for (Vec3& p : e.target.positions) {
                 p *= 1.25;
             }
             return true;
         }},
        {"target with its faces in another order", "triangleOutsideFace",
         [](ClaimedEmbedding& e) {
             std::rotate(e.target.corners.begin(), e.target.corners.begin() + 3,
                         e.target.corners.end());
             return true;
         }},
        {"target not finite", "targetNotSurface",
         [=](ClaimedEmbedding& e) {
             e.target.positions[3].z() = nan;
             return true;
         }},
        {"target corner out of range", "targetNotSurface",
         [](ClaimedEmbedding& e) {
             e.target.corners[4] = e.target.vertex_count();
             return true;
         }},
        {"target offsets broken", "targetNotSurface",
         [](ClaimedEmbedding& e) {
             e.target.face_offsets[1] = kNone;
             return true;
         }},
        {"target empty", "targetNotSurface",
         [](ClaimedEmbedding& e) {
             e.target = PolygonMesh();
             e.target.face_offsets.clear();
             return true;
         }},
        {"layout face with a repeated corner", "layoutNotSurface",
         [](ClaimedEmbedding& e) {
             e.layout.corners[1] = e.layout.corners[0];
             return true;
         }},
        {"layout face turned over", "layoutNotSurface",
         [](ClaimedEmbedding& e) {
             std::reverse(e.layout.corners.begin(),
                          e.layout.corners.begin() + e.layout.face_offsets[1]);
             return e.layout.face_count() > 1;
         }},
        {"layout vertex without faces", "layoutNotSurface",
         [](ClaimedEmbedding& e) {
             e.layout.positions.emplace_back(0, 0, 0);
             return true;
         }},
        {"landmark missing", "landmarkCount",
         [](ClaimedEmbedding& e) {
             e.landmarks.pop_back();
             return true;
         }},
        {"landmark out of range", "landmarkOutOfRange",
         [](ClaimedEmbedding& e) {
             e.landmarks[2] = e.target.vertex_count();
             return true;
         }},
        {"landmark twice", "duplicateLandmark",
         [](ClaimedEmbedding& e) {
             e.landmarks[2] = e.landmarks[0];
             return true;
         }},
        {"landmark moved", "chainWrongEnd",
         [](ClaimedEmbedding& e) {
             e.landmarks[2] = e.refined.chains[0][1] < e.target.vertex_count()
                                  ? e.refined.chains[0][1]
                                  : e.refined.chains[0][2];
             return e.landmarks[2] < e.target.vertex_count();
         }},
        // Chains.
        {"chain off the mesh", "chainOffMesh",
         [](ClaimedEmbedding& e) {
             e.refined.chains[0] = {e.refined.chains[0].front(), e.refined.chains[0].back()};
             return true;
         }},
        {"chain repeats a vertex at once", "chainOffMesh",
         [](ClaimedEmbedding& e) {
             std::vector<Index>& chain = e.refined.chains[0];
             const Index second = chain[1];
             chain.insert(chain.begin() + 1, second);
             return true;
         }},
        {"chain missing", "chainMissing",
         [](ClaimedEmbedding& e) {
             e.refined.chains.pop_back();
             e.layout_edges.pop_back();
             e.weak_paths.pop_back();
             return true;
         }},
        {"no chains", "chainMissing",
         [](ClaimedEmbedding& e) {
             e.refined.chains.clear();
             e.layout_edges.clear();
             e.weak_paths.clear();
             return true;
         }},
        {"chain twice", "chainDuplicate",
         [](ClaimedEmbedding& e) {
             e.refined.chains.push_back(std::vector<Index>(e.refined.chains[0]));
             e.layout_edges.push_back(std::array<Index, 2>(e.layout_edges[0]));
             e.weak_paths.push_back(std::vector<WeakPoint>(e.weak_paths[0]));
             return true;
         }},
        {"chain for no layout edge", "layoutEdgeUnknown",
         [](ClaimedEmbedding& e) {
             e.layout_edges[0] = {0, 0};
             return true;
         }},
        {"layout edge out of range", "layoutEdgeUnknown",
         [](ClaimedEmbedding& e) {
             e.layout_edges[0][1] = kNone;
             return true;
         }},
        {"more layout edges than chains", "sizeMismatch",
         [](ClaimedEmbedding& e) {
             e.layout_edges.push_back({0, 1});
             return true;
         }},
        {"chain backwards", "chainWrongEnd",
         [](ClaimedEmbedding& e) {
             std::reverse(e.refined.chains[0].begin(), e.refined.chains[0].end());
             return true;
         }},
        {"chain too short", "chainWrongEnd",
         [](ClaimedEmbedding& e) {
             e.refined.chains[0].pop_back();
             return true;
         }},
        {"chain empty", "chainWrongEnd",
         [](ClaimedEmbedding& e) {
             e.refined.chains[0].clear();
             return true;
         }},
        {"chain vertex out of range", "indexOutOfRange",
         [](ClaimedEmbedding& e) {
             e.refined.chains[0][1] = kNone;
             return true;
         }},
        {"chain goes back and forth", "chainTouchesItself",
         [](ClaimedEmbedding& e) {
             // From the landmark to a, b, a, b and on.
             std::vector<Index>& chain = e.refined.chains[0];
             if (chain.size() < 4) {
                 return false;
             }
             const std::array<Index, 2> again{chain[1], chain[2]};
             chain.insert(chain.begin() + 3, again.begin(), again.end());
             return true;
         }},
        {"chain through another landmark", "chainThroughLandmark",
         [](ClaimedEmbedding& e) {
             // Out to a neighbour landmark and back before it goes its own way.
             std::vector<Index> out;
             for (std::size_t c = 1; c < e.layout_edges.size() && out.empty(); ++c) {
                 if (e.layout_edges[c][0] == e.layout_edges[0][0]) {
                     out = e.refined.chains[c];
                 } else if (e.layout_edges[c][1] == e.layout_edges[0][0]) {
                     out.assign(e.refined.chains[c].rbegin(), e.refined.chains[c].rend());
                 }
             }
             std::vector<Index>& chain = e.refined.chains[0];
             out.insert(out.end(), chain.begin() + 1, chain.end());
             chain = out;
             return true;
         }},
        {"two chains swapped", "chainWrongEnd",
         [](ClaimedEmbedding& e) {
             std::swap(e.refined.chains[0], e.refined.chains[1]);
             return true;
         }},
        // Patches.
        {"patch ids permuted", "patchIds",
         [](ClaimedEmbedding& e) {
             for (Index& patch : e.refined.triangle_patches) {
                 patch = patch == 0 ? 1 : patch == 1 ? 0 : patch;
             }
             return true;
         }},
        {"one patch id out of range", "patchIds",
         [](ClaimedEmbedding& e) {
             e.refined.triangle_patches[0] = e.layout.face_count();
             return true;
         }},
        {"triangle without a patch", "patchIds",
         [](ClaimedEmbedding& e) {
             for (Index& patch : e.refined.triangle_patches) {
                 if (patch != kNone) {
                     patch = kNone;
                     break;
                 }
             }
             return true;
         }},
        // Weak paths.
        {"weak path missing", "weakPathCount",
         [](ClaimedEmbedding& e) {
             e.weak_paths.pop_back();
             return true;
         }},
        {"weak path empty", "weakPathEnds",
         [](ClaimedEmbedding& e) {
             e.weak_paths[0].clear();
             return true;
         }},
        {"weak path backwards", "weakPathEnds",
         [](ClaimedEmbedding& e) {
             std::reverse(e.weak_paths[0].begin(), e.weak_paths[0].end());
             return true;
         }},
        {"weak path out of range", "weakPathPoint",
         [](ClaimedEmbedding& e) {
             e.weak_paths[0][1] = {e.target.vertex_count(), kNone, kNone};
             return true;
         }},
        {"weak path through the middle of nothing", "weakPathPoint",
         [](ClaimedEmbedding& e) {
             e.weak_paths[0][1] = {0, 0, kNone};
             return true;
         }},
        {"weak point with a gap", "weakPathPoint",
         [](ClaimedEmbedding& e) {
             e.weak_paths[0][1] = {0, kNone, 1};
             return true;
         }},
        {"weak path leaps", "weakPathStep",
         [](ClaimedEmbedding& e) {
             e.weak_paths[0].erase(e.weak_paths[0].begin() + 1);
             return true;
         }},
        {"weak path through a landmark", "weakPathThroughLandmark",
         [](ClaimedEmbedding& e) {
             std::vector<WeakPoint>& path = e.weak_paths[0];
             // Back to its start after the first step.
             const std::array<WeakPoint, 2> again{path[1], path[0]};
             path.insert(path.begin() + 1, again.begin(), again.end());
             return true;
         }},
    };
}

TEST(Checker, refuses_every_breakage_for_its_own_reason)
{
    const std::vector<Example> bases = examples();
    std::size_t refused = 0;
    for (const Breakage& breakage : breakages()) {
        std::size_t applied = 0;
        for (const Example& base : bases) {
            ClaimedEmbedding e = base.embedding;
            if (!breakage.spoil(e)) {
                continue;
            }
            ++applied;
            EXPECT_EQ(e.codes().count(breakage.code), 1U)
                << breakage.name << " on " << base.name << "\n"
                << describe(e.check());
        }
        EXPECT_GT(applied, 0U) << breakage.name;
        refused += applied;
    }
    EXPECT_GT(refused, 500U);
}

}  // namespace
}  // namespace layout_embedding
