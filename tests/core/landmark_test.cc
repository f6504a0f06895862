#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>
#include <set>

#include "base/random.hh"
#include "layout/landmark_json.hh"
#include "layout/landmark_reader.hh"
#include "layout/nearest_points.hh"
#include "layout/proximity.hh"
#include "mesh/mesh_reader.hh"
#include "test_data.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

void expect_error(const std::string& text, ErrorCode code, const std::string& words)
{
    const auto landmarks = read_landmarks(text, "the landmarks");
    ASSERT_FALSE(landmarks.ok()) << text;
    EXPECT_EQ(error_info(landmarks.error().code).name, error_info(code).name);
    EXPECT_NE(landmarks.error().message.find(words), std::string::npos)
        << landmarks.error().message;
}

double total_cost(const std::vector<Vec3>& points, const std::vector<Vec3>& sites,
                  const std::vector<Index>& assignment)
{
    double sum = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        sum += (points[i] - sites[assignment[i]]).squaredNorm();
    }
    return sum;
}

/// The least total cost over all injective assignments.
double brute_force(const std::vector<Vec3>& points, const std::vector<Vec3>& sites,
                   const std::vector<std::vector<bool>>& allowed, std::size_t row,
                   std::vector<bool>& used)
{
    if (row == points.size()) {
        return 0;
    }
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t s = 0; s < sites.size(); ++s) {
        if (!used[s] && allowed[row][s]) {
            used[s] = true;
            best = std::min(best, (points[row] - sites[s]).squaredNorm() +
                                      brute_force(points, sites, allowed, row + 1, used));
            used[s] = false;
        }
    }
    return best;
}

Layout make_layout(const PolygonMesh& mesh)
{
    return std::move(Layout::from_polygons(mesh, "the layout").value());
}

TEST(LandmarkReader, reads_ids_and_ids_with_positions)
{
    const auto plain = read_landmarks("# spot\r\n3\r\n\r\n 17 # the nose\r\n0", "the landmarks");
    ASSERT_TRUE(plain.ok()) << plain.error().message;
    EXPECT_EQ(plain->vertices, (std::vector<Index>{3, 17, 0}));
    EXPECT_TRUE(plain->notes.empty());
    EXPECT_EQ(read_landmarks(write_landmarks(plain->vertices), "again")->vertices, plain->vertices);

    const std::vector<Vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const auto vts = read_landmarks("2 0 1.00001 0\n1 1 0 0.5\n0 nan 0 0\n", "the file", positions);
    ASSERT_TRUE(vts.ok()) << vts.error().message;
    EXPECT_EQ(vts->vertices, (std::vector<Index>{2, 1, 0}));
    ASSERT_EQ(vts->notes.size(), 1U);
    EXPECT_NE(vts->notes[0].find("2 of its vertex ids, first in line 2 (vertex 1)"),
              std::string::npos)
        << vts->notes[0];
}

TEST(LandmarkReader, errors_name_the_line)
{
    expect_error("", ErrorCode::fileEmpty, "no landmark");
    expect_error("# nothing\n", ErrorCode::fileEmpty, "no landmark");
    expect_error("1\n\nx\n", ErrorCode::syntaxError, "line 3");
    expect_error("1\n2.5\n", ErrorCode::syntaxError, "line 2");
    expect_error("1\n2 3\n", ErrorCode::syntaxError, "line 2");
    expect_error("1 0 0 0 0\n", ErrorCode::syntaxError, "line 1");
    expect_error("1\n-2\n", ErrorCode::landmarkOutOfRange, "id -2 in line 2");
    expect_error("4294967295\n", ErrorCode::landmarkOutOfRange, "line 1");
    expect_error("99999999999999999999\n", ErrorCode::syntaxError, "line 1");
}

TEST(LandmarkReader, reads_json_with_names)
{
    const PolygonMesh cube = zoo::cube();
    const std::vector<Index> ids{5, 0, 3};
    const std::vector<std::string> names{"nose", "", "\"tail\""};
    for (const std::span<const Vec3> positions :
         {std::span<const Vec3>(), std::span<const Vec3>(cube.positions)}) {
        const auto read =
            read_landmarks(write_landmark_json(ids, names, positions), "it", positions);
        ASSERT_TRUE(read.ok()) << read.error().message;
        EXPECT_EQ(read->vertices, ids);
        EXPECT_EQ(read->names, names);
        EXPECT_TRUE(read->notes.empty());
    }
    EXPECT_EQ(read_landmarks(" [7, 1, 2]", "it")->vertices, (std::vector<Index>{7, 1, 2}));
    // A position stands in for a vertex.
    const std::string text = R"({"landmarks":[{"name":"a","position":[1,1,0.9]},{"vertex":0}]})";
    EXPECT_EQ(read_landmarks(text, "it").error().code, ErrorCode::landmarkNeedsTarget);
    const auto placed = read_landmarks(text, "it", cube.positions);
    ASSERT_TRUE(placed.ok());
    EXPECT_GT(cube.positions[placed->vertices[0]].minCoeff(), 0);
    EXPECT_EQ(placed->vertices[1], 0U);
    for (const std::string wrong :
         {"{}", "[]", "[-1]", "[0.5]", "[{}]", "{\"landmarks\":3}", "["}) {
        EXPECT_FALSE(read_landmarks(wrong, "it", cube.positions).ok()) << wrong;
    }
}

TEST(LandmarkReader, reads_picked_points_of_meshlab)
{
    const PolygonMesh mesh = zoo::icosphere(2);
    std::string text =
        "<!DOCTYPE PickedPoints>\n<PickedPoints>\n <DocumentData>\n"
        "  <templateName name=\"x\"/>\n </DocumentData>\n";
    for (const Index v : {17U, 3U, 99U}) {
        const Vec3 p = mesh.positions[v] * 1.01;
        text += " <point x=\"" + std::to_string(p.x()) + "\" active=\"1\" y=\"" +
                std::to_string(p.y()) + "\" z='" + std::to_string(p.z()) + "' name=\"a &amp; " +
                std::to_string(v) + "\"/>\n";
    }
    text += " <point x=\"0\" y=\"0\" z=\"0\" active=\"0\" name=\"off\"/>\n</PickedPoints>\n";
    const auto read = read_landmarks(text, "it", mesh.positions);
    ASSERT_TRUE(read.ok()) << read.error().message;
    EXPECT_EQ(read->vertices, (std::vector<Index>{17, 3, 99}));
    EXPECT_EQ(read->names[1], "a & 3");
    EXPECT_TRUE(read->notes.empty());
    EXPECT_EQ(read_landmarks(text, "it").error().code, ErrorCode::landmarkNeedsTarget);
    const auto error = [&](const std::string& wrong) {
        return read_landmarks(wrong, "it", mesh.positions).error().code;
    };
    EXPECT_EQ(error("<PickedPoints></PickedPoints>"), ErrorCode::fileEmpty);
    EXPECT_EQ(error("<point x=\"1\" y=\"2\"/>"), ErrorCode::syntaxError);
    EXPECT_EQ(error("<point x=\"1\" y=\"2\" z=\"a\"/>"), ErrorCode::syntaxError);
    EXPECT_EQ(error("<point x=\"1\" y=\"2"), ErrorCode::syntaxError);
}

TEST(LandmarkReader, reads_markups_of_slicer_in_either_convention)
{
    const PolygonMesh mesh = zoo::bumpy_sphere(2, 4);
    const std::vector<Index> ids{20, 4, 77, 33};
    for (const double sign : {1.0, -1.0}) {
        std::string text = R"({"markups":[{"type":"Fiducial","coordinateSystem":"LPS",)"
                           R"("controlPoints":[{"label":"none","positionStatus":"undefined",)"
                           R"("position":[0,0,0]})";
        for (const Index v : ids) {
            const Vec3& p = mesh.positions[v];
            text += R"(,{"id":"1","label":"F-)" + std::to_string(v) + R"(","position":[)" +
                    std::to_string(sign * p.x()) + "," + std::to_string(sign * p.y()) + "," +
                    std::to_string(p.z()) + R"(],"positionStatus":"defined"})";
        }
        text += "]}]}";
        const auto read = read_landmarks(text, "it", mesh.positions);
        ASSERT_TRUE(read.ok()) << read.error().message;
        EXPECT_EQ(read->vertices, ids);
        EXPECT_EQ(read->names[0], "F-20");
        EXPECT_EQ(read->notes.size(), sign < 0 ? 1U : 0U);
    }
}

TEST(LandmarkReader, two_points_never_share_a_vertex_and_far_ones_are_noted)
{
    const PolygonMesh mesh = zoo::icosphere(1);
    std::string text = R"({"landmarks":[)";
    for (int i = 0; i < 12; ++i) {
        text += std::string(i == 0 ? "" : ",") + R"({"position":[0,0,5]})";
    }
    const auto read = read_landmarks(text + "]}", "it", mesh.positions);
    ASSERT_TRUE(read.ok());
    std::vector<Index> sorted = read->vertices;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(std::unique(sorted.begin(), sorted.end()), sorted.end());
    EXPECT_EQ(read->notes.size(), 1U);
}

TEST(NearestPoints, agree_with_sorting_all_distances)
{
    Random random(1);
    for (int trial = 0; trial < 30; ++trial) {
        // Few different coordinates, so that there are many ties.
        std::vector<Vec3> positions;
        std::vector<Index> ids;
        for (Index i = 0; i < 200; ++i) {
            positions.emplace_back(static_cast<double>(random.below(6)),
                                   static_cast<double>(random.below(6)),
                                   trial % 2 == 0 ? 0.0 : random.unit());
            if (random.below(3) != 0) {
                ids.push_back(i);
            }
        }
        const NearestPoints tree(positions, ids);
        const Vec3 query(6 * random.unit(), static_cast<double>(random.below(6)), 0);
        std::vector<NearestPoints::Neighbour> all;
        for (const Index id : ids) {
            all.push_back({(positions[id] - query).squaredNorm(), id});
        }
        std::sort(all.begin(), all.end());
        for (const std::size_t count : {0, 1, 7, 50, 1000}) {
            const auto found = tree.nearest(query, count);
            ASSERT_EQ(found.size(), std::min<std::size_t>(count, ids.size()));
            for (std::size_t i = 0; i < found.size(); ++i) {
                ASSERT_EQ(found[i].id, all[i].id);
                ASSERT_EQ(found[i].squared_distance, all[i].squared_distance);
            }
        }
    }
}

TEST(Proximity, has_the_least_total_cost_of_all_assignments)
{
    Random random(5);
    const auto random_point = [&](double size) {
        const double x = size * random.unit();
        const double y = size * random.unit();
        return Vec3(x, y, size * random.unit());
    };
    for (int trial = 0; trial < 60; ++trial) {
        // A wheel of up to 6 vertices on a disk with inner vertices and a boundary; all layout
        // vertices crowd in one corner, so that they compete.
        const PolygonMesh layout_mesh = zoo::wheel(3 + trial % 3);
        const Layout layout = make_layout(layout_mesh);
        PolygonMesh target_mesh = zoo::grid_disk(3, 2);
        for (Vec3& p : target_mesh.positions) {
            p = random_point(1);
        }
        const TriangleMesh target(target_mesh);
        std::vector<Vec3> points;
        std::vector<std::vector<bool>> allowed;
        for (Index v = 0; v < layout.vertex_count(); ++v) {
            points.push_back(random_point(trial % 2 == 0 ? 0.2 : 1));
            allowed.emplace_back();
            for (Index s = 0; s < target.vertex_count(); ++s) {
                allowed.back().push_back(layout.is_boundary_vertex(v) ||
                                         !target.is_boundary_vertex(s));
            }
        }
        const auto landmarks = landmarks_by_proximity(layout, points, target);
        ASSERT_TRUE(landmarks.ok()) << landmarks.error().message;
        EXPECT_EQ(std::set<Index>(landmarks->begin(), landmarks->end()).size(), points.size());
        for (Index v = 0; v < layout.vertex_count(); ++v) {
            EXPECT_TRUE(allowed[v][(*landmarks)[v]]);
        }
        std::vector<bool> used(target.vertex_count(), false);
        EXPECT_NEAR(total_cost(points, target.positions(), *landmarks),
                    brute_force(points, target.positions(), allowed, 0, used), 1e-12);
    }
}

TEST(Proximity, puts_a_layout_on_its_own_vertices)
{
    const PolygonMesh mesh = zoo::bumpy_sphere(2, 4);
    const auto landmarks =
        landmarks_by_proximity(make_layout(mesh), mesh.positions, TriangleMesh(mesh));
    ASSERT_TRUE(landmarks.ok());
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        EXPECT_EQ((*landmarks)[v], v);
    }
}

TEST(Proximity, resolves_a_crowd_on_one_vertex)
{
    // All layout vertices at the same point: the nearest target vertices, each once.
    const PolygonMesh layout = zoo::icosphere(1);
    const std::vector<Vec3> points(layout.vertex_count(), Vec3(1.2, 0.3, 0.1));
    const TriangleMesh target(zoo::icosphere(3));
    const auto landmarks = landmarks_by_proximity(make_layout(layout), points, target);
    ASSERT_TRUE(landmarks.ok());
    std::vector<Index> ids(target.vertex_count());
    std::iota(ids.begin(), ids.end(), 0);
    const auto nearest = NearestPoints(target.positions(), ids).nearest(points[0], points.size());
    std::set<Index> expected;
    for (const auto& neighbour : nearest) {
        expected.insert(neighbour.id);
    }
    EXPECT_EQ(std::set<Index>(landmarks->begin(), landmarks->end()), expected);
}

TEST(Proximity, refuses_what_cannot_be_assigned)
{
    const PolygonMesh cube = zoo::cube();
    const TriangleMesh target(zoo::icosphere(1));
    auto error =
        landmarks_by_proximity(make_layout(zoo::icosphere(2)), zoo::icosphere(2).positions, target);
    ASSERT_FALSE(error.ok());
    EXPECT_EQ(error.error().code, ErrorCode::landmarkCount);
    std::vector<Vec3> positions = cube.positions;
    positions[3].y() = std::numeric_limits<double>::quiet_NaN();
    error = landmarks_by_proximity(make_layout(cube), positions, target);
    ASSERT_FALSE(error.ok());
    EXPECT_EQ(error.error().code, ErrorCode::nonFinitePosition);
    EXPECT_NE(error.error().message.find("vertex 3"), std::string::npos);
    positions[3].y() = 1e200;
    error = landmarks_by_proximity(make_layout(cube), positions, target);
    ASSERT_FALSE(error.ok());
    EXPECT_EQ(error.error().code, ErrorCode::coordinateTooLarge);
}

TEST(Proximity, control_meshes_find_their_places_on_the_real_meshes)
{
    LAYOUT_EMBEDDING_NEED_DATA("data");
    for (const std::string name : {"spot", "penguin"}) {
        const auto read = [&](const std::string& file) {
            return read_mesh(read_bytes(test_data_path("data/" + file + ".obj")), MeshFormat::obj,
                             file);
        };
        const auto layout = read(name + "_control_mesh");
        const auto target = read(name);
        ASSERT_TRUE(layout.ok() && target.ok());
        const TriangleMesh mesh(*target);
        const auto landmarks =
            landmarks_by_proximity(make_layout(*layout), layout->positions, mesh);
        ASSERT_TRUE(landmarks.ok()) << landmarks.error().message;
        EXPECT_EQ(std::set<Index>(landmarks->begin(), landmarks->end()).size(),
                  layout->positions.size());
        // No exchange of two landmarks, and no move to a free vertex nearby, is cheaper.
        const double cost = total_cost(layout->positions, mesh.positions(), *landmarks);
        for (std::size_t i = 0; i < landmarks->size(); ++i) {
            for (std::size_t k = 0; k < i; ++k) {
                std::vector<Index> other = *landmarks;
                std::swap(other[i], other[k]);
                ASSERT_GE(total_cost(layout->positions, mesh.positions(), other), cost);
            }
        }
    }
}

}  // namespace
}  // namespace layout_embedding
