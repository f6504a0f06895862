#include "apps/quad_mesh.hh"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <optional>
#include <set>

#include "apps/base_complex.hh"
#include "apps/embed_job.hh"
#include "apps/template_layout.hh"
#include "embedding_checks.hh"
#include "instances.hh"
#include "mesh/mesh_reader.hh"
#include "mesh/validation.hh"
#include "shapes/shape.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

struct Embedded {
    EmbeddingProblem problem;
    RefinedMesh refined;
};

/// A checked embedding, by default not necessarily a short one; nothing where the search finds
/// none.
std::optional<Embedded> embed(const EmbeddingProblem& problem,
                              Algorithm algorithm = Algorithm::praun)
{
    EmbedOptions options;
    options.algorithm = algorithm;
    EmbedJob job(problem, options);
    while (job.step()) {
    }
    if (!job.result().refined) {
        return std::nullopt;
    }
    test::expect_valid(problem, *job.graph(), job.result().weak, *job.result().refined);
    return Embedded{problem, *job.result().refined};
}

PolygonMesh polygons(const QuadMesh& quads)
{
    PolygonMesh mesh;
    mesh.positions = quads.positions;
    for (const auto& quad : quads.quads) {
        mesh.add_face(quad);
    }
    return mesh;
}

/// Fails the test unless the quads are a conforming mesh of the layout's surface, on the target,
/// with the layout as base complex and its connectivity.
void expect_sound(const Embedded& embedded, const QuadMesh& quads)
{
    const Layout& layout = *embedded.problem.layout;
    const TriangleMesh& target = *embedded.problem.target;
    const auto made = Layout::from_polygons(polygons(quads), "the quads");
    ASSERT_TRUE(made.ok()) << made.error().message;
    EXPECT_EQ(made->euler_characteristic(), layout.euler_characteristic());
    EXPECT_EQ(made->boundary_loops().size(), layout.boundary_loops().size());
    ASSERT_EQ(quads.points.size(), quads.positions.size());
    for (std::size_t v = 0; v < quads.points.size(); ++v) {
        const auto& [face, b] = quads.points[v];
        ASSERT_LT(face, target.face_count());
        EXPECT_NEAR(b[0] + b[1] + b[2], 1, 1e-12);
        EXPECT_GE(std::min({b[0], b[1], b[2]}), -1e-12);
        EXPECT_LT((position_of(target, quads.points[v]) - quads.positions[v]).norm(), 1e-9);
    }
    for (Index v = 0; v < layout.vertex_count(); ++v) {
        EXPECT_EQ(quads.positions[v], target.position(embedded.problem.landmarks[v]));
    }
    // Chains run along edges of quads, which separate the faces that they separate in the layout.
    std::map<std::pair<Index, Index>, Index> face_left_of;
    for (std::size_t q = 0; q < quads.quads.size(); ++q) {
        for (std::size_t i = 0; i < 4; ++i) {
            face_left_of[{quads.quads[q][i], quads.quads[q][(i + 1) % 4]}] = quads.quad_faces[q];
        }
    }
    std::map<Index, double> areas;
    for (Index e = 0; e < layout.edge_count(); ++e) {
        const std::vector<Index>& chain = quads.chains[e];
        EXPECT_EQ(chain.front(), layout.tail(2 * e));
        EXPECT_EQ(chain.back(), layout.head(2 * e));
        for (std::size_t i = 1; i < chain.size(); ++i) {
            for (const Index side : {0U, 1U}) {
                const auto found = face_left_of.find(side == 0 ? std::pair{chain[i - 1], chain[i]}
                                                               : std::pair{chain[i], chain[i - 1]});
                const Index face = layout.face(2 * e + side);
                ASSERT_EQ(found == face_left_of.end(), face == kNone);
                if (face != kNone) {
                    EXPECT_EQ(found->second, face);
                }
            }
        }
    }
    // All inner vertices of patches have four quads, but for the centres of a subdivision.
    std::vector<int> degrees(quads.positions.size(), 0);
    for (const auto& quad : quads.quads) {
        for (const Index v : quad) {
            ++degrees[v];
        }
    }
    std::set<Index> on_chains;
    for (const auto& chain : quads.chains) {
        on_chains.insert(chain.begin(), chain.end());
    }
    for (Index v = 0; v < degrees.size(); ++v) {
        if (!on_chains.contains(v)) {
            EXPECT_EQ(degrees[v], 4);
        }
    }
}

TEST(BaseComplex, loops_join_opposite_sides)
{
    for (const zoo::NamedMesh& named : zoo::layouts()) {
        SCOPED_TRACE(named.name);
        const auto layout = Layout::from_polygons(named.mesh, "it");
        ASSERT_TRUE(layout.ok());
        const BaseComplex base(*layout);
        std::size_t corners = 0;
        bool all_quads = true;
        for (Index face = 0; face < layout->face_count(); ++face) {
            corners += layout->face_halfedges(face).size();
            all_quads = all_quads && layout->face_halfedges(face).size() == 4;
        }
        EXPECT_EQ(base.is_subdivided(), !all_quads);
        EXPECT_EQ(base.quads().size(), all_quads ? layout->face_count() : corners);
        std::set<Index> loops;
        for (const BaseComplex::Quad& quad : base.quads()) {
            for (const std::size_t side : {0U, 1U}) {
                EXPECT_EQ(base.loops()[quad.sides[side].edge],
                          base.loops()[quad.sides[side + 2].edge]);
            }
        }
        loops.insert(base.loops().begin(), base.loops().end());
        EXPECT_EQ(loops.size(), base.loop_count());
    }
    // A cube has three loops, each of the four edges of one direction.
    const auto cube = Layout::from_polygons(zoo::cube(), "it");
    EXPECT_EQ(BaseComplex(*cube).loop_count(), 3U);
}

TEST(BaseComplex, segments_follow_lengths_unless_prescribed)
{
    const auto cube = Layout::from_polygons(zoo::cube(), "it");
    const BaseComplex base(*cube);
    const std::vector<double> lengths(12, 2.0);
    const auto choose = [&](double length, std::vector<std::pair<Index, Index>> given = {}) {
        return choose_segments(base, *cube, lengths, length, given);
    };
    EXPECT_EQ(choose(0.5).value(), std::vector<Index>(12, 4));
    EXPECT_EQ(choose(100).value(), std::vector<Index>(12, 1));
    const auto given = choose(0.5, {{3, 7}});
    ASSERT_TRUE(given.ok());
    EXPECT_EQ(std::count(given->begin(), given->end(), 7U), 4);
    EXPECT_EQ((*given)[3], 7U);
    EXPECT_EQ(choose(0).error().code, ErrorCode::invalidOption);
    EXPECT_EQ(choose(-1).error().code, ErrorCode::invalidOption);
    EXPECT_EQ(choose(1, {{12, 1}}).error().code, ErrorCode::invalidOption);
    EXPECT_EQ(choose(1, {{0, 0}}).error().code, ErrorCode::invalidOption);
    Index other = 1;
    while (base.loops()[other] != base.loops()[0]) {
        ++other;
    }
    EXPECT_TRUE(choose(1, {{0, 2}, {other, 2}}).ok());
    EXPECT_EQ(choose(1, {{0, 2}, {other, 3}}).error().code, ErrorCode::invalidOption);
    const auto tetrahedron = Layout::from_polygons(zoo::tetrahedron(), "it");
    const std::vector<std::pair<Index, Index>> odd{{0, 3}};
    EXPECT_EQ(
        choose_segments(BaseComplex(*tetrahedron), *tetrahedron, lengths, 1, odd).error().code,
        ErrorCode::invalidOption);
}

TEST(QuadStatistics, know_a_square_from_a_flipped_one)
{
    const std::array<Vec3, 4> square{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 2, 0), Vec3(0, 2, 0)};
    EXPECT_DOUBLE_EQ(scaled_jacobian(square, Vec3(0, 0, 1)), 1);
    EXPECT_DOUBLE_EQ(scaled_jacobian(square, Vec3(0, 0, -1)), -1);
    const std::array<Vec3, 4> dart{Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0.2, 0.2, 0), Vec3(0, 2, 0)};
    EXPECT_LT(scaled_jacobian(dart, Vec3(0, 0, 1)), 0);
    const std::vector<std::array<Index, 4>> quads{{0, 1, 2, 3}};
    const std::vector<Vec3> ups{Vec3(0, 0, 1)};
    const QuadStatistics statistics = quad_statistics(square, quads, ups);
    EXPECT_EQ(statistics.flipped, 0U);
    EXPECT_NEAR(statistics.least_angle, 90, 1e-9);
    EXPECT_NEAR(statistics.angle_deviation, 0, 1e-9);
    EXPECT_DOUBLE_EQ(statistics.mean_edge, 2);
}

TEST(SurfacePoint, walks_to_the_nearest_point_of_a_sphere)
{
    const TriangleMesh sphere(zoo::icosphere(3));
    Random random(4);
    for (int i = 0; i < 200; ++i) {
        Vec3 place;
        for (int axis = 0; axis < 3; ++axis) {
            place[axis] = 2 * random.unit() - 1;
        }
        if (place.norm() < 0.3) {
            continue;
        }
        const SurfacePoint start{static_cast<Index>(random.below(sphere.face_count())), {1, 0, 0}};
        const Vec3 found = position_of(sphere, walk_to_nearest(sphere, start, place));
        double least = 10;
        for (const Vec3& p : sphere.positions()) {
            least = std::min(least, (p - place).norm());
        }
        EXPECT_LE((found - place).norm(), least + 1e-12);
        EXPECT_LT((found - place.normalized()).norm(), 0.1);
    }
}

TEST(QuadMesh, conforms_on_every_kind_of_surface)
{
    const PolygonMesh sphere = zoo::icosphere(3);
    const PolygonMesh torus = zoo::torus(16, 12);
    const PolygonMesh coarse = zoo::quad_torus(4, 4);
    const auto problem = [](const PolygonMesh& layout, const PolygonMesh& target) {
        return test::problem_of(layout, target, zoo::displaced_landmarks(layout, target, 0, 3));
    };
    const std::vector<EmbeddingProblem> problems{
        problem(zoo::cube(), sphere),
        problem(zoo::tetrahedron(), sphere),
        problem(zoo::prism(5), sphere),
        problem(zoo::icosahedron(), sphere),
        problem(coarse, torus),
        test::problem_of(zoo::polygon(5), sphere, zoo::random_landmarks(sphere, 5, 3))};
    for (std::size_t i = 0; i < problems.size(); ++i) {
        SCOPED_TRACE(i);
        const auto embedded = embed(problems[i]);
        ASSERT_TRUE(embedded.has_value());
        for (const double length : {0.15, 10.0}) {
            SCOPED_TRACE(length);
            QuadOptions options;
            options.edge_length = length;
            const auto quads = make_quad_mesh(*embedded->problem.layout, *embedded->problem.target,
                                              embedded->refined, options);
            ASSERT_TRUE(quads.ok()) << quads.error().message;
            expect_sound(*embedded, *quads);
            if (length < 1 && i < 5) {
                EXPECT_EQ(quads->statistics.flipped, 0U);
            }
            // The OBJ holds the same quads.
            const auto again = read_mesh(write_quad_obj(*quads), MeshFormat::obj, "it");
            ASSERT_TRUE(again.ok());
            EXPECT_EQ(again->corners, polygons(*quads).corners);
            EXPECT_EQ(again->positions, quads->positions);
        }
    }
}

TEST(QuadMesh, has_about_four_thousand_quads_where_nothing_is_said)
{
    // Paths of very different lengths: the area alone would say little.
    const PolygonMesh sphere = zoo::stretched_sphere(3, Vec3(1, 1, 4));
    for (const PolygonMesh& layout : {zoo::cube(), zoo::prism(5), zoo::icosahedron()}) {
        const auto embedded = embed(
            test::problem_of(layout, sphere, zoo::displaced_landmarks(layout, sphere, 0.4, 3)));
        ASSERT_TRUE(embedded.has_value());
        const Layout& made_layout = *embedded->problem.layout;
        QuadOptions options;
        options.relaxation_rounds = 0;
        const auto quads =
            make_quad_mesh(made_layout, *embedded->problem.target, embedded->refined, options);
        ASSERT_TRUE(quads.ok()) << quads.error().message;
        expect_sound(*embedded, *quads);
        const auto off = [](std::size_t count) {
            return std::abs(std::log(static_cast<double>(count) / 4000));
        };
        EXPECT_LT(off(quads->quads.size()), 0.2);
        // No other length comes nearer.
        for (int i = -4; i <= 4; ++i) {
            options.edge_length = quads->default_edge_length * std::exp2(i / 16.0);
            const auto other =
                make_quad_mesh(made_layout, *embedded->problem.target, embedded->refined, options);
            ASSERT_TRUE(other.ok()) << other.error().message;
            EXPECT_GE(off(other->quads.size()), off(quads->quads.size()) - 1e-12);
            EXPECT_EQ(other->default_edge_length, quads->default_edge_length);
        }
    }
}

TEST(QuadMesh, takes_over_the_numbers_of_segments_of_another_mesh_of_the_layout)
{
    // Triangles: every edge has two loops, whose numbers differ on the first target.
    const PolygonMesh layout = zoo::icosahedron();
    std::vector<QuadMesh> made;
    for (const PolygonMesh& target :
         {zoo::stretched_sphere(2, Vec3(1, 1, 3)), zoo::bumpy_sphere(2, 2)}) {
        const auto embedded = embed(
            test::problem_of(layout, target, zoo::displaced_landmarks(layout, target, 0.1, 3)));
        ASSERT_TRUE(embedded.has_value());
        QuadOptions options;
        options.edge_length = 0.2;
        if (!made.empty()) {
            options.segments_as = made[0].segments;
        }
        auto quads = make_quad_mesh(*embedded->problem.layout, *embedded->problem.target,
                                    embedded->refined, options);
        ASSERT_TRUE(quads.ok()) << quads.error().message;
        made.push_back(std::move(*quads));
        ++options.segments_as.emplace_back();
        const auto refused = make_quad_mesh(*embedded->problem.layout, *embedded->problem.target,
                                            embedded->refined, options);
        ASSERT_FALSE(refused.ok());
        EXPECT_EQ(refused.error().code, ErrorCode::invalidOption);
    }
    EXPECT_EQ(made[1].quads, made[0].quads);
    const auto& loops = made[0].loops;
    EXPECT_TRUE(std::any_of(loops.begin(), loops.end(),
                            [](const auto& both) { return both[0] != both[1]; }));
}

TEST(QuadMesh, relaxation_makes_quads_better)
{
    const PolygonMesh sphere = zoo::bumpy_sphere(3, 2);
    const auto embedded = embed(test::problem_of(
        zoo::cube(), sphere, zoo::displaced_landmarks(zoo::cube(), sphere, 0.2, 3)));
    ASSERT_TRUE(embedded.has_value());
    QuadOptions options;
    options.edge_length = 0.15;
    options.relaxation_rounds = 0;
    const auto plain = make_quad_mesh(*embedded->problem.layout, *embedded->problem.target,
                                      embedded->refined, options);
    options.relaxation_rounds = 30;
    const auto relaxed = make_quad_mesh(*embedded->problem.layout, *embedded->problem.target,
                                        embedded->refined, options);
    ASSERT_TRUE(plain.ok() && relaxed.ok());
    EXPECT_EQ(plain->quads, relaxed->quads);
    EXPECT_LT(relaxed->statistics.angle_deviation, plain->statistics.angle_deviation);
    EXPECT_GT(relaxed->statistics.mean_jacobian, plain->statistics.mean_jacobian);
    EXPECT_EQ(relaxed->statistics.flipped, 0U);
}

class QuadsOfShapes : public testing::TestWithParam<std::string> {};

TEST_P(QuadsOfShapes, have_no_flipped_quads_and_the_same_connectivity_for_all_members)
{
    const shapes::ShapeClass& shape_class = *shapes::find_shape_class(GetParam());
    std::shared_ptr<const Layout> layout;
    std::vector<std::pair<Index, Index>> segments;
    std::vector<std::array<Index, 4>> first;
    for (const Index member : {2U, 0U}) {
        SCOPED_TRACE(member);
        const auto shape = shapes::make_shape(shape_class, member, {1500, 0});
        ASSERT_TRUE(shape.ok()) << shape.error().message;
        const auto target = std::make_shared<const TriangleMesh>(shape->mesh);
        if (!layout) {
            const auto made = template_layout(*target, shape->landmarks, {.quads = true});
            ASSERT_TRUE(made.ok()) << made.error().message;
            layout = std::make_shared<const Layout>(
                Layout::from_polygons(made->mesh, "the template").value());
            for (Index e = 0; e < layout->edge_count(); ++e) {
                segments.emplace_back(e, 8);
            }
        }
        const auto problem = make_problem(layout, target, shape->landmarks);
        ASSERT_TRUE(problem.ok()) << problem.error().message;
        const auto embedded = embed(*problem, Algorithm::exact);
        ASSERT_TRUE(embedded.has_value());
        QuadOptions options;
        options.segments = segments;
        const auto quads = make_quad_mesh(*layout, *target, embedded->refined, options);
        ASSERT_TRUE(quads.ok()) << quads.error().message;
        expect_sound(*embedded, *quads);
        EXPECT_EQ(quads->statistics.flipped, 0U);
        EXPECT_GT(quads->statistics.least_jacobian, 0.03);
        EXPECT_GT(quads->statistics.mean_jacobian, 0.6);
        if (first.empty()) {
            first = quads->quads;
        }
        EXPECT_EQ(quads->quads, first);
    }
}

INSTANTIATE_TEST_SUITE_P(Classes, QuadsOfShapes,
                         testing::Values("quadruped", "hand", "bust", "machine_part", "cut_hand",
                                         "fish", "bird", "face", "cup"),
                         [](const auto& parameter) { return parameter.param; });

struct Pair {
    std::string shape_class;
    Index other;
};
class DefaultQuadsOfShapes : public testing::TestWithParam<Pair> {};

TEST_P(DefaultQuadsOfShapes, are_none_of_them_flipped_or_nearly_flat)
{
    // Templates that leave thin patches, with as many quads as there are by default.
    const auto& [name, other] = GetParam();
    const shapes::ShapeClass& shape_class = *shapes::find_shape_class(name);
    std::shared_ptr<const Layout> layout;
    QuadOptions options;
    std::vector<std::array<Index, 4>> first;
    for (const Index member : {0U, other}) {
        SCOPED_TRACE(member);
        const auto shape = shapes::make_shape(shape_class, member, {2000, 0});
        ASSERT_TRUE(shape.ok()) << shape.error().message;
        const auto target = std::make_shared<const TriangleMesh>(shape->mesh);
        if (!layout) {
            const auto made = template_layout(*target, shape->landmarks, {.quads = true});
            ASSERT_TRUE(made.ok()) << made.error().message;
            layout = std::make_shared<const Layout>(
                Layout::from_polygons(made->mesh, "the template").value());
        }
        const auto problem = make_problem(layout, target, shape->landmarks);
        ASSERT_TRUE(problem.ok()) << problem.error().message;
        const auto embedded = embed(*problem, Algorithm::exact);
        ASSERT_TRUE(embedded.has_value());
        const auto quads = make_quad_mesh(*layout, *target, embedded->refined, options);
        ASSERT_TRUE(quads.ok()) << quads.error().message;
        expect_sound(*embedded, *quads);
        EXPECT_EQ(quads->statistics.flipped, 0U);
        EXPECT_GT(quads->statistics.least_jacobian, 0.03);
        if (options.segments_as.empty()) {
            options.segments_as = quads->segments;
            first = quads->quads;
        }
        EXPECT_EQ(quads->quads, first);
    }
}

INSTANTIATE_TEST_SUITE_P(Classes, DefaultQuadsOfShapes,
                         testing::Values(Pair{"quadruped", 2}, Pair{"plane", 1}, Pair{"vase", 1},
                                         Pair{"pretzel", 1}, Pair{"bird", 8},
                                         Pair{"machine_part", 5}),
                         [](const auto& parameter) { return parameter.param.shape_class; });

}  // namespace
}  // namespace layout_embedding
