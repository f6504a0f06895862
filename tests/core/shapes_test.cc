#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <string>
#include <vector>

#include "apps/embed_job.hh"
#include "apps/template_layout.hh"
#include "embedding_checks.hh"
#include "instances.hh"
#include "mesh/mesh_writer.hh"
#include "mesh/triangle_mesh.hh"
#include "mesh/validation.hh"
#include "shapes/editable_mesh.hh"
#include "shapes/extraction.hh"
#include "shapes/frame.hh"
#include "shapes/shape.hh"
#include "shapes/statistics.hh"

namespace layout_embedding::shapes {
namespace {

/// Few, so that all members together take seconds.
constexpr Index kVertices = 1200;

/// A class with all of its members.
struct Collection {
    const ShapeClass& shape_class;
    std::vector<Figure> figures;
    std::vector<Shape> shapes;
};

double smallest_angle(const TriangleMesh& mesh)
{
    double least = 180.0;
    for (Index h = 0; h < mesh.halfedge_count(); ++h) {
        const Vec3& corner = mesh.position(mesh.tail(h));
        const Vec3 a = mesh.position(mesh.head(h)) - corner;
        const Vec3 b = mesh.position(mesh.tail(TriangleMesh::previous(h))) - corner;
        least = std::min(least, std::atan2(a.cross(b).norm(), a.dot(b)) * 57.29577951308232);
    }
    return least;
}

void expect_topology_of_the_class(const Collection& collection)
{
    const ShapeClass& shape_class = collection.shape_class;
    for (const Shape& shape : collection.shapes) {
        const Status valid = check_surface(shape.mesh, SurfaceKind::target, "the shape");
        ASSERT_TRUE(valid) << valid.error().message;
        const TriangleMesh mesh(shape.mesh);
        EXPECT_EQ(mesh.boundary_loop_count(), static_cast<Index>(shape_class.boundary_loops));
        EXPECT_EQ(mesh.euler_characteristic(),
                  2 - 2 * shape_class.genus - shape_class.boundary_loops);
    }
}

void expect_vertices_asked_for_and_no_needles(const Collection& collection)
{
    for (Index m = 0; m < collection.shapes.size(); ++m) {
        SCOPED_TRACE(collection.shape_class.members[m]);
        const TriangleMesh mesh(collection.shapes[m].mesh);
        EXPECT_GT(mesh.vertex_count(), 0.9 * kVertices);
        EXPECT_LT(mesh.vertex_count(), 1.15 * kVertices);
        EXPECT_GT(smallest_angle(mesh), 0.5);
    }
}

void expect_corresponding_distinct_landmarks(const Collection& collection)
{
    const std::vector<std::string>& names = collection.shapes.front().landmark_names;
    EXPECT_GE(names.size(), 7U);
    EXPECT_LE(names.size(), 40U);
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
    for (const Shape& shape : collection.shapes) {
        EXPECT_EQ(shape.landmark_names, names);
        ASSERT_EQ(shape.landmarks.size(), names.size());
        const std::set<Index> different(shape.landmarks.begin(), shape.landmarks.end());
        EXPECT_EQ(different.size(), names.size());
        EXPECT_LT(*different.rbegin(), shape.mesh.vertex_count());
    }
}

/// On the surface, on their rays, and on the boundary if and only if they are meant to be.
void expect_landmarks_on_their_rays(const Collection& collection)
{
    for (Index m = 0; m < collection.shapes.size(); ++m) {
        SCOPED_TRACE(collection.shape_class.members[m]);
        const Figure& figure = collection.figures[m];
        const Shape& shape = collection.shapes[m];
        const TriangleMesh mesh(shape.mesh);
        ASSERT_EQ(shape.landmarks.size(), figure.landmarks.size());
        for (std::size_t i = 0; i < figure.landmarks.size(); ++i) {
            SCOPED_TRACE(figure.landmarks[i].name);
            const Vec3& p = shape.mesh.positions[shape.landmarks[i]];
            const Vec3 way = p - figure.landmarks[i].inside;
            const Vec3 ray = figure.landmarks[i].direction.normalized();
            // Noise moves vertices by a fraction of their shortest edge.
            const double tolerance = 0.01 * figure.solid.size();
            EXPECT_LT((way - way.dot(ray) * ray).norm(), tolerance);
            EXPECT_GT(way.dot(ray), -tolerance);
            EXPECT_LT(std::abs(figure.solid.distance(p)), tolerance);
            EXPECT_EQ(mesh.is_boundary_vertex(shape.landmarks[i]), figure.landmarks[i].on_boundary);
        }
    }
}

void expect_left_landmarks_left_of_right_ones(const Collection& collection)
{
    const std::vector<std::string>& names = collection.shapes.front().landmark_names;
    for (std::size_t left = 0; left < names.size(); ++left) {
        if (!names[left].starts_with("left")) {
            continue;
        }
        const std::string partner = "right" + names[left].substr(4);
        const auto right = static_cast<std::size_t>(std::find(names.begin(), names.end(), partner) -
                                                    names.begin());
        ASSERT_LT(right, names.size()) << names[left] << " has no partner";
        for (Index m = 0; m < collection.shapes.size(); ++m) {
            const Shape& shape = collection.shapes[m];
            EXPECT_GT(shape.mesh.positions[shape.landmarks[left]].x(),
                      shape.mesh.positions[shape.landmarks[right]].x())
                << collection.shape_class.members[m] << " " << names[left];
        }
    }
}

class ShapesOfClass : public testing::TestWithParam<std::string> {};

// One test per class, since making its members is what takes time.
TEST_P(ShapesOfClass, have_the_declared_topology_and_corresponding_landmarks)
{
    Collection collection{*find_shape_class(GetParam()), {}, {}};
    for (Index m = 0; m < collection.shape_class.member_count(); ++m) {
        auto shape = make_shape(collection.shape_class, m, {.vertices = kVertices});
        ASSERT_TRUE(shape) << shape.error().message;
        collection.shapes.push_back(std::move(*shape));
        collection.figures.push_back(collection.shape_class.build(m));
    }
    expect_topology_of_the_class(collection);
    expect_vertices_asked_for_and_no_needles(collection);
    expect_corresponding_distinct_landmarks(collection);
    expect_landmarks_on_their_rays(collection);
    expect_left_landmarks_left_of_right_ones(collection);
}

TEST_P(ShapesOfClass,
       have_a_template_whose_embedding_in_another_member_is_proved_and_valid_in_shapes)
{
    const ShapeClass& shape_class = *find_shape_class(GetParam());
    const auto source = make_shape(shape_class, 0, {.vertices = kVertices});
    const auto target = make_shape(shape_class, 1, {.vertices = kVertices});
    ASSERT_TRUE(source && target);
    const auto made = template_layout(TriangleMesh(source->mesh), source->landmarks);
    ASSERT_TRUE(made) << made.error().message;
    EmbedOptions options;
    options.gap = 0;
    EmbedJob job(test::problem_of(made->mesh, target->mesh, target->landmarks), options);
    while (job.step()) {
    }
    const EmbedResult& result = job.result();
    ASSERT_TRUE(result.refined) << job.error().message;
    test::expect_strands(job.problem(), *job.graph(), result.weak);
    EXPECT_EQ(result.doubts.size(), 0U);
    // With two or three handles there are more classes than the default limit lets it look at.
    if (shape_class.genus < 2) {
        EXPECT_EQ(result.status, EmbedStatus::optimal);
    } else {
        EXPECT_LT(result.gap, 0.1);
    }
    for (const PathShape path_shape : {PathShape::shortened, PathShape::even, PathShape::fair}) {
        if (path_shape != PathShape::shortened) {
            ASSERT_TRUE(job.reshape(path_shape));
            while (job.step()) {
            }
        }
        ASSERT_TRUE(result.refined) << job.error().message;
        test::expect_valid(job.problem(), *job.graph(), result.weak, *result.refined);
        EXPECT_GT(result.quality.smallest_area, 0);
    }
}

TEST(Shapes, the_same_seed_makes_the_same_mesh_and_another_seed_another)
{
    for (const char* const name : {"fish", "cut_hand"}) {
        const ShapeClass& shape_class = *find_shape_class(name);
        const auto one = make_shape(shape_class, 1, {.vertices = kVertices});
        const auto again = make_shape(shape_class, 1, {.vertices = kVertices});
        const auto other = make_shape(shape_class, 1, {.vertices = kVertices, .seed = 1});
        ASSERT_TRUE(one && again && other);
        EXPECT_EQ(write_obj(one->mesh), write_obj(again->mesh));
        EXPECT_EQ(one->landmarks, again->landmarks);
        EXPECT_NE(write_obj(one->mesh), write_obj(other->mesh));
        EXPECT_EQ(one->landmark_names, other->landmark_names);
    }
}

std::vector<std::string> class_names()
{
    std::vector<std::string> names;
    for (const ShapeClass& shape_class : shape_classes()) {
        names.push_back(shape_class.name);
    }
    return names;
}

INSTANTIATE_TEST_SUITE_P(Classes, ShapesOfClass, testing::ValuesIn(class_names()),
                         [](const auto& test) { return test.param; });

TEST(Shapes, there_are_ten_closed_classes_of_genus_zero_with_eight_members_each)
{
    int spheres = 0;
    std::set<std::string> names;
    std::set<int> genera;
    int disks = 0;
    for (const ShapeClass& shape_class : shape_classes()) {
        EXPECT_GE(shape_class.member_count(), 8U) << shape_class.name;
        EXPECT_EQ(
            std::set<std::string>(shape_class.members.begin(), shape_class.members.end()).size(),
            shape_class.members.size());
        names.insert(shape_class.name);
        genera.insert(shape_class.genus);
        spheres += shape_class.euler_characteristic() == 2 ? 1 : 0;
        disks += shape_class.euler_characteristic() == 1 ? 1 : 0;
    }
    EXPECT_GE(spheres, 10);
    EXPECT_GE(disks, 2);
    EXPECT_EQ(genera, (std::set<int>{0, 1, 2, 3}));
    EXPECT_EQ(names.size(), shape_classes().size());
}

TEST(Shapes, impossible_requests_are_refused)
{
    const ShapeClass& hand = *find_shape_class("hand");
    EXPECT_EQ(make_shape(hand, hand.member_count()).error().code, ErrorCode::invalidOption);
    EXPECT_EQ(make_shape(hand, 0, {.vertices = 10}).error().code, ErrorCode::invalidOption);
    EXPECT_EQ(find_shape_class("teapot"), nullptr);
}

TEST(Shapes, triangulations_are_irregular)
{
    // On grids and evenly remeshed surfaces nearly all vertices have valence six.
    const auto shape = make_shape(*find_shape_class("human"), 0, {.vertices = 3000});
    ASSERT_TRUE(shape);
    const MeshStatistics statistics = mesh_statistics(TriangleMesh(shape->mesh));
    EXPECT_LT(statistics.valence_share[2], 60.0);
    EXPECT_GT(statistics.length_variation, 0.25);
}

TEST(Frame, sine_and_cosine_agree_with_the_standard_library)
{
    for (double degrees = -800.0; degrees < 800.0; degrees += 3.7) {
        EXPECT_NEAR(sine(degrees), std::sin(degrees * 0.017453292519943295), 1e-13);
        EXPECT_NEAR(cosine(degrees), std::cos(degrees * 0.017453292519943295), 1e-13);
    }
}

TEST(Solid, distances_and_normals_of_a_ball_are_exact)
{
    Solid solid;
    solid.sweep({{{1, 2, 3}, 0.5}}, {});
    const Solid::Value value = solid.value({1, 2, 5});
    EXPECT_NEAR(value.distance, 1.5, 1e-12);
    EXPECT_NEAR((value.normal - Vec3(0, 0, 1)).norm(), 0.0, 1e-12);
    EXPECT_NEAR(solid.distance({1, 2, 3}), -0.5, 1e-12);
    const auto exit = solid.exit({1, 2, 3}, {0, 2, 0}, 3.0, 0.01);
    ASSERT_TRUE(exit);
    EXPECT_NEAR((*exit - Vec3(1, 2.5, 3)).norm(), 0.0, 1e-12);
    EXPECT_FALSE(solid.exit({4, 4, 4}, {0, 1, 0}, 3.0, 0.01));
}

TEST(Solid, a_fading_blend_leaves_far_parts_apart)
{
    // Two parallel rods that almost touch, joined at one end.
    const std::vector<Knot> left{{{-0.12, 0, 0}, 0.1}, {{-0.12, 3, 0}, 0.1}};
    const std::vector<Knot> right{{{0.12, 0, 0}, 0.1}, {{0.12, 3, 0}, 0.1}};
    Solid everywhere;
    everywhere.sweep(left, {});
    everywhere.sweep(right, {0.4});
    Solid fading;
    fading.sweep(left, {});
    fading.sweep(right, {0.4, {0, 0, 0}, 0.5});
    EXPECT_LT(everywhere.distance({0, 2, 0}), 0.0);
    EXPECT_GT(fading.distance({0, 2, 0}), 0.0);
    EXPECT_LT(fading.distance({0, 0.1, 0}), 0.0);
}

TEST(EditableMesh, edits_keep_the_surface_valid_and_its_topology)
{
    Solid solid;
    solid.sweep({{{0, 0, 0}, 0.5}}, {});
    const RawSurface raw = extract_surface(solid, {0.5, 0, 0}, 0.2);
    EditableMesh mesh(raw.positions, raw.corners);
    // Every seventh halfedge is split, every fifth collapsed, every third flipped.
    const Index count = mesh.halfedge_count();
    for (Index h = 0; h < count; h += 7) {
        mesh.split_edge(h, 0.5 * (mesh.positions[mesh.tail(h)] + mesh.positions[mesh.head(h)]));
    }
    int collapses = 0;
    int flips = 0;
    for (Index h = 0; h < mesh.halfedge_count(); ++h) {
        if (h % 5 == 0 && mesh.has_halfedge(h) && mesh.can_collapse(h)) {
            mesh.collapse(h);
            ++collapses;
        } else if (h % 3 == 0 && mesh.has_halfedge(h) && mesh.can_flip(h)) {
            mesh.flip(h);
            ++flips;
        }
    }
    EXPECT_GT(collapses, 10);
    EXPECT_GT(flips, 10);
    mesh.compact();
    // As a layout, since positions are no longer of use.
    const Status valid = check_surface(mesh.polygon_mesh(), SurfaceKind::layout, "the mesh");
    ASSERT_TRUE(valid) << valid.error().message;
    const TriangleMesh result(mesh.polygon_mesh());
    EXPECT_EQ(result.euler_characteristic(), 2);
    EXPECT_EQ(result.boundary_loop_count(), 0U);
}

}  // namespace
}  // namespace layout_embedding::shapes
