#include "embedding/realisation.hh"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <numeric>
#include <set>

#include "embedded_forms.hh"
#include "embedding/weak_to_normal_form.hh"
#include "embedding_checks.hh"
#include "instances.hh"
#include "search_ground.hh"
#include "surface/strands.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

using Instance = test::EmbeddedInstance;
using test::all_embedded_instances;

/// What the comments of NormalForm promise, and that there are no bigons.
void expect_sound(const NormalForm& form, const EmbeddingProblem& problem)
{
    const TriangleMesh& mesh = form.mesh();
    const Layout& layout = *problem.layout;
    std::set<Index> seen;
    for (Index strand = 0; strand < form.strand_count(); ++strand) {
        ASSERT_NE(form.first(strand), kNone);
        EXPECT_EQ(form.element(form.first(strand)).vertex,
                  problem.landmarks[layout.tail(2 * strand)]);
        EXPECT_EQ(form.element(form.last(strand)).vertex,
                  problem.landmarks[layout.head(2 * strand)]);
        Index previous = kNone;
        for (Index id = form.first(strand); id != kNone; id = form.element(id).next) {
            const NormalForm::Element& e = form.element(id);
            EXPECT_TRUE(seen.insert(id).second);
            EXPECT_EQ(e.previous, previous);
            EXPECT_EQ(e.is_crossing(), id != form.first(strand) && id != form.last(strand));
            previous = id;
            if (e.is_crossing()) {
                ASSERT_FALSE(mesh.is_boundary_edge(form.edge(id)));
            }
            if (e.next == kNone) {
                continue;
            }
            const NormalForm::Element& n = form.element(e.next);
            if (!e.is_crossing() && !n.is_crossing()) {
                EXPECT_NE(form.segment_edge(id), kNone);
                continue;
            }
            // The segment has both ends in its face, and not on the same edge.
            const Index face = form.segment_face(id);
            const auto corners = mesh.face(face);
            if (e.is_crossing()) {
                EXPECT_EQ(TriangleMesh::face_of(mesh.opposite(e.halfedge)), face);
            } else {
                EXPECT_EQ(std::count(corners.begin(), corners.end(), e.vertex), 1);
                EXPECT_NE(mesh.tail(n.halfedge), e.vertex);
                EXPECT_NE(mesh.head(n.halfedge), e.vertex);
            }
            if (n.is_crossing()) {
                EXPECT_EQ(TriangleMesh::face_of(n.halfedge), face);
            } else {
                EXPECT_EQ(std::count(corners.begin(), corners.end(), n.vertex), 1);
                EXPECT_NE(mesh.tail(e.halfedge), n.vertex);
                EXPECT_NE(mesh.head(e.halfedge), n.vertex);
            }
            if (e.is_crossing() && n.is_crossing()) {
                EXPECT_NE(form.edge(id), form.edge(e.next));
            }
        }
        EXPECT_EQ(form.last(strand), previous);
    }
    EXPECT_EQ(seen.size(), form.element_count());
    std::size_t on_edges = 0;
    for (Index edge = 0; edge < mesh.edge_count(); ++edge) {
        Index previous = kNone;
        double parameter = 0;
        for (Index id = form.first_on_edge(edge); id != kNone; id = form.element(id).edge_next) {
            EXPECT_EQ(form.edge(id), edge);
            EXPECT_EQ(form.element(id).edge_previous, previous);
            EXPECT_GT(form.element(id).parameter, parameter);
            parameter = form.element(id).parameter;
            previous = id;
            ++on_edges;
        }
        EXPECT_LT(parameter, 1);
        EXPECT_EQ(form.last_on_edge(edge), previous);
    }
    EXPECT_EQ(on_edges + 2 * form.strand_count(), form.element_count());
}

double area(const Vec3& a, const Vec3& b, const Vec3& c)
{
    return 0.5 * (b - a).cross(c - a).norm();
}

bool equal(const RefinedMesh& a, const RefinedMesh& b)
{
    return a.positions == b.positions && a.corners == b.corners &&
           a.vertex_faces == b.vertex_faces && a.vertex_barycentrics == b.vertex_barycentrics &&
           a.triangle_faces == b.triangle_faces && a.triangle_patches == b.triangle_patches &&
           a.chains == b.chains;
}

TEST(Realisation, instances_cover_every_kind_of_surface_and_crowded_edges)
{
    std::map<std::string, int> counts;
    Index most = 0;
    for (const Instance& instance : all_embedded_instances()) {
        for (const char* kind : {"torus on torus", "genus 2 on slab of genus 2", "ring on annulus",
                                 "grid on grid disk", "wheel on hemisphere", "dangling",
                                 "boundary landmarks", "polygon on icosphere", "random", "bumpy"}) {
            counts[kind] += instance.name.find(kind) != std::string::npos ? 1 : 0;
        }
        std::map<Index, Index> passes;
        for (const WeakPath& path : instance.weak.paths) {
            for (const Index d : path.darts) {
                most = std::max(most, ++passes[std::min(d, instance.graph.twin(d))]);
            }
        }
    }
    for (const auto& [kind, count] : counts) {
        EXPECT_GE(count, 1) << kind;
    }
    EXPECT_GE(all_embedded_instances().size(), 300U);
    EXPECT_GE(most, 12U);
}

TEST(Realisation, normal_forms_are_sound_and_free_of_bigons)
{
    for (const Instance& instance : all_embedded_instances()) {
        SCOPED_TRACE(instance.name);
        const auto form = normal_form_of(instance.problem, instance.graph, instance.weak);
        ASSERT_TRUE(form.ok()) << form.error().message;
        expect_sound(*form, instance.problem);
    }
}

TEST(Realisation, passing_a_vertex_crosses_at_most_half_of_its_edges)
{
    // The vertex is put where it has at least half of its edges on its own side of every pass, and
    // bigons only make it fewer. A midpoint costs a crossing of its edge at most.
    for (const Instance& instance : all_embedded_instances()) {
        SCOPED_TRACE(instance.name);
        const TriangleMesh& mesh = *instance.problem.target;
        if (mesh.boundary_loop_count() > 0) {
            continue;
        }
        std::vector<Index> degrees(mesh.vertex_count(), 0);
        for (Index h = 0; h < mesh.halfedge_count(); ++h) {
            ++degrees[mesh.tail(h)];
        }
        const auto form = normal_form_of(instance.problem, instance.graph, instance.weak);
        ASSERT_TRUE(form.ok());
        for (Index strand = 0; strand < form->strand_count(); ++strand) {
            const std::vector<Index>& darts = instance.weak.paths[strand].darts;
            Index most = 0;
            for (std::size_t i = 0; i + 1 < darts.size(); ++i) {
                const NodeElement element = instance.graph.element(instance.graph.head(darts[i]));
                most += element.kind == NodeKind::vertex          ? degrees[element.id] / 2
                        : element.kind == NodeKind::edge_midpoint ? 1
                                                                  : 0;
            }
            Index crossings = 0;
            for (Index id = form->first(strand); id != kNone; id = form->element(id).next) {
                crossings += form->element(id).is_crossing() ? 1 : 0;
            }
            EXPECT_LE(crossings, most);
        }
    }
}

TEST(Realisation, every_embedding_passes_the_checker)
{
    for (const Instance& instance : all_embedded_instances()) {
        SCOPED_TRACE(instance.name);
        const auto refined = realise(instance.problem, instance.graph, instance.weak);
        ASSERT_TRUE(refined.ok()) << refined.error().message;
        test::expect_valid(instance.problem, instance.graph, instance.weak, *refined);
    }
}

TEST(Realisation, triangles_of_a_face_have_its_area_and_none_is_degenerate)
{
    for (const Instance& instance : all_embedded_instances()) {
        SCOPED_TRACE(instance.name);
        const TriangleMesh& mesh = *instance.problem.target;
        const auto refined = realise(instance.problem, instance.graph, instance.weak);
        ASSERT_TRUE(refined.ok()) << refined.error().message;
        const auto corner = [&](std::size_t i) { return refined->positions[refined->corners[i]]; };
        std::vector<double> areas(mesh.face_count(), 0);
        for (std::size_t t = 0; t < refined->triangle_faces.size(); ++t) {
            const double size = area(corner(3 * t), corner(3 * t + 1), corner(3 * t + 2));
            const Index face = refined->triangle_faces[t];
            const auto [a, b, c] = mesh.face(face);
            const double whole = area(mesh.position(a), mesh.position(b), mesh.position(c));
            EXPECT_GT(size, 1e-5 * whole);
            areas[face] += size / whole;
        }
        for (const double share : areas) {
            EXPECT_NEAR(share, 1, 1e-9);
        }
    }
}

TEST(Realisation, new_vertices_are_just_the_crossings)
{
    for (const Instance& instance : all_embedded_instances()) {
        SCOPED_TRACE(instance.name);
        const TriangleMesh& mesh = *instance.problem.target;
        const auto form = normal_form_of(instance.problem, instance.graph, instance.weak);
        const auto refined = realise(instance.problem, instance.graph, instance.weak);
        ASSERT_TRUE(form.ok() && refined.ok());
        const Index crossings = form->element_count() - 2 * form->strand_count();
        EXPECT_EQ(refined->positions.size(), mesh.vertex_count() + crossings);
        EXPECT_EQ(refined->vertex_faces.size(), crossings);
        EXPECT_EQ(refined->triangle_faces.size(), mesh.face_count() + 2 * crossings);
        for (Index i = 0; i < crossings; ++i) {
            // On an edge of its face: one coordinate is exactly zero.
            const auto& b = refined->vertex_barycentrics[i];
            EXPECT_EQ(std::count(b.begin(), b.end(), 0.0), 1);
            Vec3 p = Vec3::Zero();
            for (Index k = 0; k < 3; ++k) {
                p += b[k] * mesh.position(mesh.face(refined->vertex_faces[i])[k]);
            }
            EXPECT_LT((p - refined->positions[mesh.vertex_count() + i]).norm(), 1e-14 * 10);
        }
    }
}

TEST(Realisation, faces_that_no_chain_enters_stay_as_they_are)
{
    for (const Instance& instance : all_embedded_instances()) {
        SCOPED_TRACE(instance.name);
        const TriangleMesh& mesh = *instance.problem.target;
        const auto refined = realise(instance.problem, instance.graph, instance.weak);
        ASSERT_TRUE(refined.ok());
        std::vector<std::vector<std::size_t>> triangles(mesh.face_count());
        for (std::size_t t = 0; t < refined->triangle_faces.size(); ++t) {
            triangles[refined->triangle_faces[t]].push_back(t);
        }
        for (Index f = 0; f < mesh.face_count(); ++f) {
            ASSERT_FALSE(triangles[f].empty());
            if (triangles[f].size() == 1) {
                const auto begin = refined->corners.begin() + 3 * triangles[f][0];
                EXPECT_TRUE(std::equal(begin, begin + 3, mesh.corners().begin() + 3 * f));
            }
        }
    }
}

TEST(Realisation, the_order_of_insertion_leaves_no_trace)
{
    // The same walks inserted in other orders, wherever these trace, are the same embedding.
    Random random(11);
    int reordered = 0;
    for (const Instance& instance : all_embedded_instances()) {
        SCOPED_TRACE(instance.name);
        std::vector<Index> order(instance.weak.paths.size());
        std::iota(order.begin(), order.end(), Index{0});
        for (Index i = 0; i < order.size(); ++i) {
            std::swap(order[i], order[i + random.below(order.size() - i)]);
        }
        Strands strands(instance.problem, instance.graph);
        const bool inserted = std::all_of(order.begin(), order.end(), [&](Index e) {
            return strands.insert(e, instance.weak.paths[e].darts);
        });
        if (!inserted) {
            continue;
        }
        ++reordered;
        const auto a = realise(instance.problem, instance.graph, instance.weak);
        const auto b = realise(instance.problem, instance.graph, strands.weak_embedding());
        ASSERT_TRUE(a.ok() && b.ok());
        EXPECT_TRUE(equal(*a, *b));
    }
    EXPECT_GT(reordered, 50);
}

TEST(Realisation, size_and_place_of_the_target_do_not_matter)
{
    for (const Instance& instance : all_embedded_instances()) {
        SCOPED_TRACE(instance.name);
        for (const double scale : {0x1p-30, 0x1p40}) {
            const Instance other = test::scaled(instance, scale);
            // Lengths do not matter any more, the darts are the same.
            const auto a = realise(instance.problem, instance.graph, instance.weak);
            const auto b = realise(other.problem, instance.graph, instance.weak);
            ASSERT_TRUE(a.ok() && b.ok());
            EXPECT_EQ(a->corners, b->corners);
            EXPECT_EQ(a->vertex_barycentrics, b->vertex_barycentrics);
            EXPECT_EQ(a->triangle_patches, b->triangle_patches);
        }
    }
}

TEST(Realisation, a_layout_equal_to_its_target_changes_nothing)
{
    for (const PolygonMesh& mesh :
         {zoo::tetrahedron(), zoo::octahedron(), zoo::icosahedron(), zoo::torus(4, 3)}) {
        std::vector<Index> landmarks(mesh.vertex_count());
        std::iota(landmarks.begin(), landmarks.end(), Index{0});
        const auto made = make_problem(
            std::make_shared<Layout>(Layout::from_polygons(mesh, "the layout").value()),
            std::make_shared<TriangleMesh>(mesh), landmarks);
        ASSERT_TRUE(made.ok());
        const EmbeddingProblem& problem = *made;
        const PathGraph graph = PathGraph::barycentric(*problem.target);
        Random random(3);
        const auto weak = test::insert_in_random_order(problem, graph, random);
        ASSERT_TRUE(weak.has_value());
        const auto refined = realise(problem, graph, *weak);
        ASSERT_TRUE(refined.ok()) << refined.error().message;
        EXPECT_EQ(refined->positions, mesh.positions);
        EXPECT_EQ(refined->corners, mesh.corners);
        std::vector<Index> faces(mesh.face_count());
        std::iota(faces.begin(), faces.end(), Index{0});
        EXPECT_EQ(refined->triangle_patches, faces);
    }
}

TEST(Realisation, strands_in_exchanged_lanes_are_refused_or_cross_for_nobody)
{
    // Exchanging two lanes of one edge makes the two strands cross twice, at the edge's ends. Where
    // both crossings lie in one face they can be pulled apart again; no other case may pass.
    int refused = 0;
    for (const Instance& instance : all_embedded_instances()) {
        SCOPED_TRACE(instance.name);
        int tried = 0;
        std::map<Index, std::pair<Index, Index>> first_passes;  // of each dart
        for (Index p = 0; p < instance.weak.paths.size(); ++p) {
            const WeakPath& path = instance.weak.paths[p];
            for (Index i = 1; i + 1 < path.darts.size() && tried < 3; ++i) {
                const auto [place, fresh] =
                    first_passes.try_emplace(path.darts[i], std::pair{p, i});
                const auto [q, j] = place->second;
                if (fresh || q == p) {
                    continue;
                }
                ++tried;
                WeakEmbedding swapped = instance.weak;
                std::swap(swapped.paths[p].lanes[i], swapped.paths[q].lanes[j]);
                const auto refined = realise(instance.problem, instance.graph, swapped);
                if (refined.ok()) {
                    test::expect_valid(instance.problem, instance.graph, instance.weak, *refined);
                } else {
                    EXPECT_EQ(refined.error().code, ErrorCode::realisationFailed);
                    EXPECT_FALSE(refined.error().details.empty());
                    ++refused;
                }
            }
        }
    }
    EXPECT_GT(refused, 100);
}

TEST(Realisation, incomplete_and_torn_paths_are_refused)
{
    const Instance& instance = all_embedded_instances().front();
    const auto refuses = [&](const auto& damage) {
        WeakEmbedding weak = instance.weak;
        damage(weak);
        const auto refined = realise(instance.problem, instance.graph, weak);
        return !refined.ok() && refined.error().code == ErrorCode::realisationFailed;
    };
    const auto identity = [](WeakEmbedding&) {};
    EXPECT_FALSE(refuses(identity));
    EXPECT_TRUE(refuses([](WeakEmbedding& weak) { weak.paths.pop_back(); }));
    EXPECT_TRUE(refuses([](WeakEmbedding& weak) { weak.paths[0] = {}; }));
    EXPECT_TRUE(refuses([](WeakEmbedding& weak) { weak.paths[0].lanes.pop_back(); }));
    EXPECT_TRUE(refuses([](WeakEmbedding& weak) { weak.paths[0].lanes[1] = 1000; }));
    EXPECT_TRUE(refuses([](WeakEmbedding& weak) { weak.paths[0].darts[1] = kNone; }));
    EXPECT_TRUE(refuses([](WeakEmbedding& weak) { std::swap(weak.paths[0], weak.paths[1]); }));
    EXPECT_TRUE(refuses([](WeakEmbedding& weak) {
        weak.paths[0].darts.pop_back();
        weak.paths[0].lanes.pop_back();
    }));
}

}  // namespace
}  // namespace layout_embedding
