#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <set>

#include "embedded_forms.hh"
#include "embedding/angle_refinement.hh"
#include "embedding/angle_widening.hh"
#include "embedding/wanted_angles.hh"
#include "embedding_checks.hh"
#include "instances.hh"
#include "patches/patch_shape.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

using Instance = test::EmbeddedInstance;
using test::all_embedded_instances;
using test::cut;
using test::even_form;

NormalForm open_form(const Instance& instance)
{
    NormalForm form = even_form(instance);
    open_angles(form, instance.problem.landmarks, 0.25);
    return form;
}

double degrees(double tangent)
{
    return std::atan(tangent) * 180 / std::acos(-1.0);
}

/// Angles of a refined mesh, as tangents: between two edges that stay whatever the triangulation,
/// and all others; each relative to what is wanted there.
struct Angles {
    double least_fixed = std::numeric_limits<double>::infinity();
    double least_free = std::numeric_limits<double>::infinity();
};

Angles angles_of(const TriangleMesh& target, const RefinedMesh& refined)
{
    const WantedAngles wanted(target);
    std::set<std::pair<Index, Index>> staying;
    for (const std::vector<Index>& chain : refined.chains) {
        for (std::size_t i = 1; i < chain.size(); ++i) {
            staying.insert(std::minmax(chain[i - 1], chain[i]));
        }
    }
    std::map<std::pair<Index, Index>, Index> faces;
    for (Index h = 0; h < refined.corners.size(); ++h) {
        const Index head = refined.corners[TriangleMesh::next(h)];
        const auto ends = std::minmax(refined.corners[h], head);
        const auto [place, fresh] = faces.try_emplace(ends, refined.triangle_faces[h / 3]);
        if (!fresh && place->second != refined.triangle_faces[h / 3]) {
            staying.insert(ends);
        } else if (!fresh) {
            place->second = kNone;  // inside of a face
        }
    }
    for (const auto& [ends, face] : faces) {
        if (face != kNone) {
            staying.insert(ends);  // the boundary, too
        }
    }
    Angles angles;
    for (Index h = 0; h < refined.corners.size(); ++h) {
        const Index a = refined.corners[h];
        const Index b = refined.corners[TriangleMesh::next(h)];
        const Index c = refined.corners[TriangleMesh::previous(h)];
        const double share = tangent_between(refined.positions[b] - refined.positions[a],
                                             refined.positions[c] - refined.positions[a]) /
                             wanted.tangent_in(refined.triangle_faces[h / 3]);
        const bool fixed =
            staying.count(std::minmax(a, b)) > 0 && staying.count(std::minmax(a, c)) > 0;
        double& least = fixed ? angles.least_fixed : angles.least_free;
        least = std::min(least, share);
    }
    return angles;
}

TEST(WantedAngles, are_a_third_of_the_least_one)
{
    for (const PolygonMesh& mesh : {zoo::tetrahedron(), zoo::grid_disk(3, 3), zoo::icosphere(2)}) {
        const TriangleMesh target(mesh);
        double least = std::numeric_limits<double>::infinity();
        for (Index h = 0; h < target.halfedge_count(); ++h) {
            const Vec3& a = target.position(target.tail(h));
            const Vec3& b = target.position(target.head(h));
            const Vec3& c = target.position(target.tail(TriangleMesh::previous(h)));
            least = std::min(least, degrees(tangent_between(b - a, c - a)));
        }
        EXPECT_NEAR(degrees(WantedAngles(target).tangent_in(0)), least / 3, 1e-9);
    }
}

TEST(WantedAngles, a_sliver_does_not_spoil_other_faces)
{
    PolygonMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, 0.9, 0}, {0.5, -0.01, 0}};
    mesh.add_face(std::array<Index, 3>{0, 1, 2});
    mesh.add_face(std::array<Index, 3>{1, 0, 3});
    const TriangleMesh target(mesh);
    const WantedAngles wanted(target);
    EXPECT_NEAR(degrees(wanted.tangent_in(0)), 3, 1e-9);
    EXPECT_NEAR(degrees(wanted.tangent_in(1)), std::atan(0.02) * 60 / std::acos(-1.0), 1e-9);
}

TEST(Angles, opening_them_keeps_every_embedding_valid_and_makes_few_smaller)
{
    int better = 0;
    int worse = 0;
    for (const Instance& instance : all_embedded_instances()) {
        SCOPED_TRACE(instance.name);
        const RefinedMesh before = cut(instance, even_form(instance));
        const RefinedMesh after = cut(instance, open_form(instance));
        test::expect_valid(instance.problem, instance.graph, instance.weak, after);
        const TriangleMesh& target = *instance.problem.target;
        const double least = angles_of(target, before).least_fixed;
        const double opened = angles_of(target, after).least_fixed;
        better += opened > least ? 1 : 0;
        worse += opened < std::min(1.0, least) * (1 - 1e-6) ? 1 : 0;
    }
    EXPECT_GT(better, 5 * worse);
}

TEST(Angles, refinement_keeps_every_embedding_valid_and_all_paths_as_they_are)
{
    for (const Instance& instance : all_embedded_instances()) {
        SCOPED_TRACE(instance.name);
        const TriangleMesh& target = *instance.problem.target;
        const Layout& layout = *instance.problem.layout;
        const RefinedMesh before = cut(instance, open_form(instance));
        RefinedMesh after = before;
        const Index count = refine_thin_triangles(target, after);
        EXPECT_EQ(after.positions.size(), before.positions.size() + count);
        EXPECT_LE(count, before.vertex_faces.size());
        test::expect_valid(instance.problem, instance.graph, instance.weak, after);
        for (std::size_t e = 0; e < before.chains.size(); ++e) {
            EXPECT_NEAR(
                chain_length(after, after.chains[e]) / chain_length(before, before.chains[e]), 1,
                1e-12);
            EXPECT_TRUE(std::includes(
                after.chains[e].begin(), after.chains[e].end(), before.chains[e].begin(),
                before.chains[e].end(), [&](Index a, Index b) {
                    const auto place = [&](Index v) {
                        return std::find(after.chains[e].begin(), after.chains[e].end(), v);
                    };
                    return place(a) < place(b);
                }));
        }
        const auto shapes_before = patch_shapes(layout, before);
        const auto shapes_after = patch_shapes(layout, after);
        for (std::size_t f = 0; f < shapes_before.size(); ++f) {
            EXPECT_NEAR(shapes_after[f].area / shapes_before[f].area, 1, 1e-9);
        }
    }
}

TEST(Angles, refinement_leaves_small_ones_only_between_edges_that_stay)
{
    int thin = 0;
    int mended = 0;
    for (const Instance& instance : all_embedded_instances()) {
        SCOPED_TRACE(instance.name);
        const TriangleMesh& target = *instance.problem.target;
        RefinedMesh refined = cut(instance, open_form(instance));
        const Angles before = angles_of(target, refined);
        const Index count = refine_thin_triangles(target, refined);
        const Angles after = angles_of(target, refined);
        // A new vertex on an edge that stays makes no smaller angle between such edges.
        EXPECT_GE(after.least_fixed, before.least_fixed * (1 - 1e-6));
        if (before.least_free < 1 - 1e-6) {
            EXPECT_GT(count, 0U);
            ++thin;
            // Where dozens of paths crowd, there are not to be more new vertices than that.
            const bool ended = count == refined.vertex_faces.size() - count;
            EXPECT_TRUE(ended || after.least_free >= 1 - 1e-6) << after.least_free;
            mended += ended ? 0 : 1;
        } else {
            EXPECT_EQ(count, 0U);
        }
    }
    EXPECT_GT(thin, 20);
    EXPECT_GT(mended, 0.75 * thin);
}

TEST(Angles, the_size_of_the_target_does_not_matter)
{
    for (std::size_t i = 0; i < all_embedded_instances().size(); i += 8) {
        const Instance& instance = all_embedded_instances()[i];
        SCOPED_TRACE(instance.name);
        RefinedMesh refined = cut(instance, open_form(instance));
        refine_thin_triangles(*instance.problem.target, refined);
        for (const double scale : {0x1p-30, 0x1p40}) {
            const Instance scaled = test::scaled(instance, scale);
            RefinedMesh other = cut(scaled, open_form(scaled));
            refine_thin_triangles(*scaled.problem.target, other);
            EXPECT_EQ(other.corners, refined.corners);
            EXPECT_EQ(other.vertex_barycentrics, refined.vertex_barycentrics);
            EXPECT_EQ(other.chains, refined.chains);
        }
    }
}

}  // namespace
}  // namespace layout_embedding
