#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <tuple>

#include "apps/embed_job.hh"
#include "base/random.hh"
#include "embedded_forms.hh"
#include "embedding/triangle_quality.hh"
#include "instances.hh"
#include "mesh/validation.hh"
#include "random_draws.hh"
#include "zoo.hh"

// Embeddings on inputs that leave paths and triangles hardly any room, in every shape.

namespace layout_embedding {
namespace {

using test::embedded;
using test::EmbeddedInstance;
using test::expect_valid_in_every_shape;

/// `count` inner vertices around one of them, by edges from vertex to vertex, in random order.
std::vector<Index> cluster(const TriangleMesh& mesh, Index centre, Index count, Random& random)
{
    std::vector<Index> found;
    std::vector<bool> seen(mesh.vertex_count(), false);
    const auto visit = [&](Index v) {
        if (!seen[v] && !mesh.is_boundary_vertex(v)) {
            found.push_back(v);
        }
        seen[v] = true;
    };
    visit(centre);
    for (std::size_t i = 0; i < found.size() && found.size() < count; ++i) {
        const Index start = mesh.outgoing(found[i]);
        Index h = start;
        do {
            visit(mesh.head(h));
            h = mesh.rotated_ccw(h);
        } while (h != start && found.size() < count);
    }
    test::shuffle(found, random);
    return found;
}

/// Embedded by the exact method, where insertion in random order hardly ever gets to an end.
EmbeddedInstance solved(const std::string& name, const PolygonMesh& layout,
                        const PolygonMesh& target, const std::vector<Index>& landmarks)
{
    EmbedJob job(test::problem_of(layout, target, landmarks), {});
    while (job.step()) {
    }
    EXPECT_TRUE(job.result().refined.has_value()) << name << ": " << job.error().message;
    return {name, job.problem(), *job.graph(), job.result().weak};
}

TEST(HardEmbeddings, landmarks_on_neighbouring_vertices)
{
    struct Ground {
        std::string name;
        PolygonMesh target;
        std::vector<PolygonMesh> layouts;
    };
    const std::vector<PolygonMesh> closed{zoo::tetrahedron(), zoo::cube(), zoo::octahedron(),
                                          zoo::prism(5), zoo::icosahedron()};
    Random random(1);
    std::size_t neighbours = 0;
    for (const auto& [name, target, layouts] : {
             Ground{"icosphere", zoo::icosphere(3), closed},
             Ground{"bumpy sphere", zoo::bumpy_sphere(3, 1), closed},
             Ground{"crumpled sphere", zoo::crumpled_sphere(2, 4), closed},
             Ground{"disk", zoo::grid_disk(12, 9), {zoo::wheel(4), zoo::quad_grid(2, 1)}},
         }) {
        const TriangleMesh mesh(target);
        for (const PolygonMesh& layout : layouts) {
            for (std::uint64_t seed = 1; seed <= 2; ++seed) {
                const Index centre = zoo::random_landmarks(target, 1, random.bits())[0];
                const std::vector<Index> landmarks =
                    cluster(mesh, centre, layout.vertex_count(), random);
                const std::string full_name =
                    name + " with " + std::to_string(layout.vertex_count()) + " landmarks";
                expect_valid_in_every_shape(
                    mesh.boundary_loop_count() > 0
                        ? solved(full_name, layout, target, landmarks)
                        : embedded(full_name, layout, target, landmarks, seed));
                const std::set<Index> chosen(landmarks.begin(), landmarks.end());
                for (Index h = 0; h < mesh.halfedge_count(); ++h) {
                    neighbours += chosen.count(mesh.tail(h)) * chosen.count(mesh.head(h));
                }
            }
        }
    }
    EXPECT_GT(neighbours, 300U);
}

/// The share of the length of a prism's upright edges that several of them have in common.
double shared_length(const EmbeddedInstance& instance)
{
    const Layout& layout = *instance.problem.layout;
    const Index sides = layout.vertex_count() / 2;
    std::map<Index, int> passes;
    for (Index e = 0; e < layout.edge_count(); ++e) {
        if ((layout.tail(2 * e) < sides) == (layout.head(2 * e) < sides)) {
            continue;
        }
        for (const Index dart : instance.weak.paths[e].darts) {
            ++passes[std::min(dart, instance.graph.twin(dart))];
        }
    }
    double all = 0;
    double shared = 0;
    for (const auto& [dart, count] : passes) {
        const double length = instance.graph.to_units(instance.graph.dart(dart).length);
        all += count * length;
        shared += count > 1 ? count * length : 0;
    }
    return shared / all;
}

TEST(HardEmbeddings, paths_that_share_most_of_their_length)
{
    const auto expect_shared = [](const EmbeddedInstance& instance) {
        SCOPED_TRACE(instance.name);
        EXPECT_GT(shared_length(instance), 0.5);
        expect_valid_in_every_shape(instance);
    };
    // Down a long neck.
    expect_shared(test::forty_strands_around_a_neck(40, false));
    // And where it is not clear which one goes where.
    constexpr Index kSides = 8;
    const PolygonMesh target = zoo::hourglass(kSides, 30);
    std::vector<Index> rim(kSides);
    Random random(2);
    for (int i = 0; i < 3; ++i) {
        std::vector<Index> landmarks;
        for (const Index first : {2 + kSides, Index{2}}) {
            std::iota(rim.begin(), rim.end(), first);
            test::shuffle(rim, random);
            landmarks.insert(landmarks.end(), rim.begin(), rim.end());
        }
        expect_shared(embedded("tangled neck", zoo::prism(kSides), target, landmarks, 1));
    }
}

TEST(HardEmbeddings, the_layouts_own_triangulation_stays_as_it_is_in_every_shape)
{
    int count = 0;
    for (const auto& [name, layout] : zoo::layouts()) {
        const PolygonMesh target = zoo::triangulated(layout);
        if (!check_surface(target, SurfaceKind::target, name)) {
            continue;  // faces whose fan has an edge twice
        }
        std::vector<Index> landmarks(target.vertex_count());
        std::iota(landmarks.begin(), landmarks.end(), Index{0});
        const EmbeddedInstance instance = embedded(name, layout, target, landmarks, 1);
        expect_valid_in_every_shape(instance);
        const NormalForm straight = test::straight_form(instance);
        for (const NormalForm& form :
             {test::even_form(instance), straight, test::fair_form(instance, straight)}) {
            EXPECT_EQ(form.element_count(), 2 * form.strand_count()) << name;
        }
        ++count;
    }
    EXPECT_GE(count, 14);
}

TEST(HardEmbeddings, every_vertex_a_landmark_and_none_where_it_belongs)
{
    Random random(5);
    for (const auto& [name, layout] : zoo::layouts()) {
        const PolygonMesh target = zoo::triangulated(layout);
        if (!check_surface(target, SurfaceKind::target, name) ||
            TriangleMesh(target).boundary_loop_count() > 0 || target.vertex_count() > 12) {
            continue;
        }
        std::vector<Index> landmarks(target.vertex_count());
        std::iota(landmarks.begin(), landmarks.end(), Index{0});
        test::shuffle(landmarks, random);
        expect_valid_in_every_shape(embedded(name, layout, target, landmarks, 1));
    }
}

constexpr Index kRungs = 40;

/// A ladder: rails of kRungs vertices left (0 .. ) and right (kRungs ..), and faces between rungs,
/// from top to bottom.
PolygonMesh ladder()
{
    PolygonMesh mesh;
    for (const double x : {-1.0, 1.0}) {
        for (Index i = 0; i < kRungs; ++i) {
            mesh.positions.emplace_back(x, 1 - 2.0 * i / (kRungs - 1), 0);
        }
    }
    for (Index i = 0; i + 1 < kRungs; ++i) {
        mesh.add_face(std::array<Index, 4>{i, i + 1, kRungs + i + 1, kRungs + i});
    }
    return mesh;
}

/// Where the rails' landmarks are in the two targets below: counter-clockwise around the boundary,
/// the right one upwards from vertex `first`, one vertex, then the left one downwards.
std::vector<Index> rails(Index first)
{
    std::vector<Index> landmarks;
    for (Index i = 0; i < kRungs; ++i) {
        landmarks.push_back(first + kRungs + 1 + i);
    }
    for (Index i = 0; i < kRungs; ++i) {
        landmarks.push_back(first + kRungs - 1 - i);
    }
    return landmarks;
}

/// The positions of the rails and of the two vertices above and below, at (0, +-height).
void add_rim(PolygonMesh& mesh, double height)
{
    const auto place = [](Index i) { return -1 + 2.0 * i / (kRungs - 1); };
    for (Index i = 0; i < kRungs; ++i) {
        mesh.positions.emplace_back(1, place(i), 0);
    }
    mesh.positions.emplace_back(0, height, 0);
    for (Index i = 0; i < kRungs; ++i) {
        mesh.positions.emplace_back(-1, -place(i), 0);
    }
    mesh.positions.emplace_back(0, -height, 0);
}

/// Triangles around one vertex, vertex 0, where the disk has its waist: every rung has to pass it.
PolygonMesh bow_tie()
{
    PolygonMesh mesh;
    mesh.positions.emplace_back(0, 0, 0);
    add_rim(mesh, 0.05);
    constexpr Index kRim = 2 * kRungs + 2;
    for (Index i = 0; i < kRim; ++i) {
        mesh.add_face(std::array<Index, 3>{0, 1 + i, 1 + (i + 1) % kRim});
    }
    return mesh;
}

/// How many strands cross an edge at the vertex or run over it.
Index strands_at(const NormalForm& form, Index vertex)
{
    const TriangleMesh& mesh = form.mesh();
    Index count = 0;
    for (Index strand = 0; strand < form.strand_count(); ++strand) {
        for (Index id = form.first(strand); id != kNone; id = form.element(id).next) {
            const NormalForm::Element& e = form.element(id);
            if (e.vertex == vertex || (e.is_crossing() && (mesh.tail(e.halfedge) == vertex ||
                                                           mesh.head(e.halfedge) == vertex))) {
                ++count;
                break;
            }
        }
    }
    return count;
}

TEST(HardEmbeddings, forty_strands_around_one_vertex)
{
    PolygonMesh target = bow_tie();
    for (const char* const name : {"bow tie", "finer bow tie"}) {
        const EmbeddedInstance instance = embedded(name, ladder(), target, rails(1), 1);
        EXPECT_GE(strands_at(test::even_form(instance), 0), kRungs - 4);
        expect_valid_in_every_shape(instance);
        target = zoo::subdivided(target);
    }
}

TEST(HardEmbeddings, forty_strands_around_a_neck_of_three_vertices)
{
    for (const bool upside_down : {false, true}) {
        expect_valid_in_every_shape(test::forty_strands_around_a_neck(1, upside_down));
    }
}

TEST(HardEmbeddings, forty_strands_over_one_short_edge)
{
    // Two hubs, landmarks in the uppermost and the lowest rung, joined by an edge that all others
    // have to cross.
    constexpr Index kRim = 2 * kRungs + 2;
    constexpr Index kMiddle = kRungs / 2;
    PolygonMesh target;
    target.positions = {{0, 1e-3, 0}, {0, -1e-3, 0}};
    add_rim(target, 1.5);
    const Index right = 2 + kMiddle;
    const Index left = 2 + kRungs + 1 + kMiddle;
    for (Index i = 0; i < kRim; ++i) {
        const Index a = 2 + i;
        const Index b = 2 + (i + 1) % kRim;
        target.add_face(std::array<Index, 3>{a >= right && a < left ? 0U : 1U, a, b});
    }
    target.add_face(std::array<Index, 3>{0, 1, right});
    target.add_face(std::array<Index, 3>{1, 0, left});
    PolygonMesh layout;
    layout.positions = ladder().positions;
    layout.positions.insert(layout.positions.end(), {{0, 1, 0}, {0, -1, 0}});
    constexpr Index kUpper = 2 * kRungs;
    for (Index i = 0; i + 1 < kRungs; ++i) {
        std::vector<Index> face{i, i + 1, kRungs + i + 1, kRungs + i};
        if (i == 0) {
            face.push_back(kUpper);
        } else if (i + 2 == kRungs) {
            face.insert(face.begin() + 2, kUpper + 1);
        }
        layout.add_face(face);
    }
    std::vector<Index> landmarks = rails(2);
    landmarks.insert(landmarks.end(), {0, 1});
    const EmbeddedInstance instance = embedded("two hubs", layout, target, landmarks, 1);
    const NormalForm form = test::even_form(instance);
    Index hub_edge = 0;
    while (form.mesh().tail(form.mesh().halfedge(hub_edge)) +
               form.mesh().head(form.mesh().halfedge(hub_edge)) !=
           1) {
        ++hub_edge;
    }
    EXPECT_GE(form.crossing_count(hub_edge), kRungs - 2);
    expect_valid_in_every_shape(instance);
}

TEST(HardEmbeddings, slivers_and_coordinates_of_every_size)
{
    struct Case {
        double scale;
        double offset;
    };
    PolygonMesh sheared = zoo::grid_disk(6, 6);
    for (Vec3& p : sheared.positions) {
        p.x() += 1000 * p.y();
    }
    const PolygonMesh flat = zoo::stretched_sphere(3, {1, 0.001, 1});
    const PolygonMesh needle = zoo::stretched_sphere(3, {1, 0.001, 0.001});
    // Corners and side midpoints of the grid, and its middle.
    const std::vector<Index> corners{0, 3, 6, 21, 24, 27, 42, 45, 48};
    for (const auto& [name, layout, mesh, landmarks] :
         {std::tuple{"flat sphere", zoo::cube(), flat, zoo::random_landmarks(flat, 8, 6)},
          std::tuple{"needle", zoo::octahedron(), needle, zoo::random_landmarks(needle, 6, 7)},
          std::tuple{"sheared grid", zoo::quad_grid(2, 2), sheared, corners}}) {
        for (const Case& c :
             {Case{1, 0}, Case{1e6, 0}, Case{1e-6, 0}, Case{1, 1e6}, Case{1e6, 1e6}}) {
            SCOPED_TRACE(std::to_string(c.scale) + " at " + std::to_string(c.offset));
            PolygonMesh target = mesh;
            for (Vec3& p : target.positions) {
                p = c.scale * p + Vec3::Constant(c.offset);
            }
            EXPECT_LT(triangle_quality(target.positions, target.corners).smallest_angle, 0.1);
            expect_valid_in_every_shape(embedded(name, layout, target, landmarks, 7));
        }
    }
}

}  // namespace
}  // namespace layout_embedding
