#include "embedding/checker.hh"

#include <algorithm>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <map>

#include "claimed_embedding.hh"

namespace layout_embedding {
namespace {

using Codes = std::set<std::string>;

struct Example {
    std::string name;
    ClaimedEmbedding embedding;
};

/// Valid embeddings: spheres, disks, annuli and tori, closed and with holes, chains along target
/// edges and through faces.
std::vector<Example> examples()
{
    std::vector<Example> result;
    const auto add = [&](const std::string& name, const PolygonMesh& polygons, int subdivisions,
                         const std::set<Index>& dropped = {}) {
        result.push_back(
            {name + " as it is", embed_in_itself(polygons, subdivisions, false, 1, dropped)});
        result.push_back(
            {name + " refined", embed_in_itself(polygons, subdivisions, true, 2, dropped)});
        Example shaken = result.back();
        shaken.name = name + " shaken";
        shake(shaken.embedding, 5000, 3);
        result.push_back(shaken);
    };
    add("tetrahedron", tetrahedron_polygons(), 2);
    add("cube", cube_polygons(), 1);
    add("octahedron", octahedron_polygons(), 2);
    add("icosahedron", icosahedron_polygons(), 1);
    add("torus", grid_polygons(3, 4, true), 1);
    add("annulus", grid_polygons(4, 2, false), 1);
    add("annulus with all landmarks on the boundary", grid_polygons(5, 1, false), 2);
    add("disk", polygon_mesh({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}),
        2);
    add("disk in a sphere", octahedron_polygons(), 2, {4});
    add("annulus in a sphere", cube_polygons(), 1, {0, 1});
    return result;
}

std::string describe(const CheckReport& report)
{
    std::string text;
    for (const Violation& violation : report.violations) {
        text += violation.code + ": " + violation.message + "\n";
    }
    return text;
}

/// A shortest walk along the edges of triangles, without vertices that are `forbidden` but for its
/// ends.
std::vector<Index> shortest_walk(const std::vector<Index>& corners, Index from, Index to,
                                 const std::set<Index>& forbidden)
{
    std::map<Index, std::set<Index>> neighbors;
    for (std::size_t c = 0; c < corners.size(); ++c) {
        const Index next = corners[c % 3 == 2 ? c - 2 : c + 1];
        neighbors[corners[c]].insert(next);
        neighbors[next].insert(corners[c]);
    }
    std::map<Index, Index> parents{{to, to}};
    std::vector<Index> queue{to};
    for (std::size_t k = 0; k < queue.size() && parents.count(from) == 0; ++k) {
        for (const Index v : neighbors[queue[k]]) {
            if ((v == from || forbidden.count(v) == 0) && parents.emplace(v, queue[k]).second) {
                queue.push_back(v);
            }
        }
    }
    std::vector<Index> walk{from};
    while (walk.back() != to) {
        walk.push_back(parents.at(walk.back()));
    }
    return walk;
}

Index chain_of(const ClaimedEmbedding& embedding, Index a, Index b)
{
    for (Index c = 0; c < embedding.layout_edges.size(); ++c) {
        const auto [tail, head] = embedding.layout_edges[c];
        if ((tail == a && head == b) || (tail == b && head == a)) {
            return c;
        }
    }
    ADD_FAILURE() << "no chain for " << a << "-" << b;
    return 0;
}

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
    ClaimedEmbedding e = embed_in_itself(octahedron_polygons(), 2, true);
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
    ClaimedEmbedding e = embed_in_itself(cube_polygons(), 2, false, 1, {1});
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
    wrong.layout.positions = cube_polygons().positions;
    for (const Index f : {1U, 2U, 3U, 4U, 5U}) {
        wrong.layout.add_face(cube_polygons().face(f));
    }
    for (Index& patch : wrong.refined.triangle_patches) {
        patch = patch == 0 ? kNone : patch == kNone ? 0 : patch;
    }
    EXPECT_EQ(wrong.codes(), (Codes{"holeInPatch", "holeCount"})) << describe(wrong.check());
}

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
    ClaimedEmbedding e = embed_in_itself(octahedron_polygons(), 1, true);
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
        polygon_mesh({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}), 2,
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
    const ClaimedEmbedding sphere = embed_in_itself(cube_polygons(), 1, true);
    ClaimedEmbedding e = sphere;
    e.layout = grid_polygons(3, 3, true);
    EXPECT_EQ(e.codes().count("topologyMismatch"), 1U) << describe(e.check());

    // An annulus has two holes, a disk layout only one boundary loop.
    e = embed_in_itself(grid_polygons(4, 1, false), 1, true);
    e.layout.face_offsets.pop_back();
    e.layout.corners.resize(e.layout.face_offsets.back());
    EXPECT_EQ(e.codes().count("topologyMismatch"), 1U) << describe(e.check());
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
         tetrahedron_polygons(),
         2,
         {{0, 2}, {0, 3}, {1, 3}, {1, 2}}},
        {"octahedron, an edge and the rest",
         octahedron_polygons(),
         2,
         {{0, 3}, {0, 4}, {1, 4}, {1, 2}, {1, 5}, {0, 5}}},
        {"octahedron, a face and its opposite",
         octahedron_polygons(),
         2,
         {{0, 3}, {3, 4}, {2, 4}, {1, 2}, {1, 5}, {0, 5}}},
        {"cube, bottom and top", cube_polygons(), 2, {{0, 4}, {1, 5}, {2, 6}, {3, 7}}},
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
        {"tetrahedron, around a vertex", tetrahedron_polygons(), 2, {{0, 1}, {0, 2}, {0, 3}}},
        {"octahedron, around a vertex", octahedron_polygons(), 2, {{0, 1}, {0, 4}, {0, 3}, {0, 5}}},
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
    ClaimedEmbedding e = embed_in_itself(icosahedron_polygons(), 2, true);
    const PolygonMesh polygons = icosahedron_polygons();
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
    ClaimedEmbedding e = embed_in_itself(cube_polygons(), 2, true);
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

TEST(Checker, refuses_two_neighbours_exchanged_in_a_cyclic_order)
{
    // Four ways from pole to pole; in the layout, two neighbouring ones change places. The chains
    // are those of the one as well as of the other.
    const auto layout = [](const std::array<Index, 4>& order) {
        PolygonMesh mesh;
        mesh.positions = octahedron_polygons().positions;
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

TEST(Checker, lists_at_most_ten_violations_of_a_kind)
{
    ClaimedEmbedding e = embed_in_itself(icosahedron_polygons(), 2, true);
    for (Vec3& p : e.refined.positions) {
        p *= 2;
    }
    std::map<std::string, std::size_t> counts;
    for (const Violation& violation : e.check().violations) {
        ++counts[violation.code];
    }
    EXPECT_EQ(counts,
              (std::map<std::string, std::size_t>{{"inputVertexMoved", kMaxViolationsPerCode},
                                                  {"vertexMisplaced", kMaxViolationsPerCode}}));
}

TEST(Checker, refuses_every_single_wrong_id)
{
    Random random(7);
    for (const Example& example : examples()) {
        for (int trial = 0; trial < 40; ++trial) {
            ClaimedEmbedding e = example.embedding;
            const auto spoil = [&](std::vector<Index>& ids) {
                Index& id = ids[random.below(ids.size())];
                const Index before = id;
                const std::uint64_t kind = random.below(8);
                id = kind == 0 ? kNone : kind == 1 ? 1U << 31 : ids[random.below(ids.size())];
                return id != before;
            };
            const std::uint64_t part = random.below(6);
            const bool changed =
                part == 0   ? spoil(e.refined.corners)
                : part == 1 ? spoil(e.refined.triangle_faces)
                : part == 2 ? spoil(e.refined.triangle_patches)
                : part == 3 ? spoil(e.refined.chains[random.below(e.refined.chains.size())])
                : part == 4 ? spoil(e.layout.corners)
                            : spoil(e.landmarks);
            EXPECT_EQ(changed, !e.check().valid())
                << example.name << ", trial " << trial << ", part " << part;
        }
    }
}

TEST(Checker, survives_garbage)
{
    Random random(11);
    const std::vector<Example> bases = examples();
    std::size_t refused = 0;
    constexpr std::size_t trials = 3000;
    for (std::size_t trial = 0; trial < trials; ++trial) {
        ClaimedEmbedding e = bases[random.below(bases.size())].embedding;
        const auto number = [&]() -> Index {
            const std::uint64_t kind = random.below(6);
            return kind == 0   ? kNone
                   : kind == 1 ? static_cast<Index>(random.bits())
                               : static_cast<Index>(random.below(200));
        };
        const auto spoil = [&](std::vector<Index>& ids) {
            const std::uint64_t kind = random.below(5);
            if (kind == 0) {
                ids.resize(random.below(2 * ids.size() + 2), number());
            } else if (!ids.empty()) {
                for (std::uint64_t n = random.below(4); n-- > 0;) {
                    ids[random.below(ids.size())] = number();
                }
            }
        };
        const auto real = [&] {
            constexpr std::array<double, 7> values{
                0, 1, -1, 1e300, -1e-300, 0.5, std::numeric_limits<double>::quiet_NaN()};
            return values[random.below(values.size())];
        };
        for (std::uint64_t n = 1 + random.below(3); n-- > 0;) {
            switch (random.below(12)) {
                case 0:
                    spoil(e.refined.corners);
                    break;
                case 1:
                    spoil(e.refined.triangle_faces);
                    break;
                case 2:
                    spoil(e.refined.triangle_patches);
                    break;
                case 3:
                    spoil(e.refined.vertex_faces);
                    break;
                case 4:
                    spoil(e.refined.chains[random.below(e.refined.chains.size())]);
                    break;
                case 5:
                    spoil(e.layout.corners);
                    break;
                case 6:
                    spoil(e.layout.face_offsets);
                    break;
                case 7:
                    spoil(e.target.corners);
                    break;
                case 8:
                    spoil(e.target.face_offsets);
                    break;
                case 9:
                    spoil(e.landmarks);
                    break;
                case 10:
                    if (!e.refined.vertex_barycentrics.empty()) {
                        e.refined.vertex_barycentrics[random.below(
                            e.refined.vertex_barycentrics.size())] = {real(), real(), real()};
                    }
                    break;
                default: {
                    std::vector<WeakPoint>& path = e.weak_paths[random.below(e.weak_paths.size())];
                    path[random.below(path.size())] = {number(), number(), number()};
                    break;
                }
            }
        }
        refused += e.check().valid() ? 0 : 1;
    }
    EXPECT_GT(refused, trials / 2);
}

}  // namespace
}  // namespace layout_embedding
