#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <set>

#include "embedding/realisation.hh"
#include "embedding_checks.hh"
#include "formats/patch_colours.hh"
#include "formats/reference_files.hh"
#include "formats/refined_glb.hh"
#include "formats/refined_ply.hh"
#include "formats/refined_svg.hh"
#include "formats/refined_vtp.hh"
#include "instances.hh"
#include "mesh/mesh_reader.hh"
#include "search_ground.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

struct Example {
    std::string name;
    EmbeddingProblem problem;
    RefinedMesh refined;
};

/// An embedding on a sphere, one on a torus, and one in a disk with triangles outside all patches.
const std::vector<Example>& examples()
{
    static const std::vector<Example> all = [] {
        std::vector<Example> list;
        Random random(5);
        const auto add = [&](const std::string& name, const PolygonMesh& layout,
                             const PolygonMesh& target, const std::vector<Index>& landmarks) {
            const EmbeddingProblem problem = test::problem_of(layout, target, landmarks);
            const PathGraph graph = PathGraph::barycentric(*problem.target);
            for (int attempt = 0; attempt < 20; ++attempt) {
                const auto weak = test::insert_in_random_order(problem, graph, random);
                if (!weak) {
                    continue;
                }
                const auto refined = realise(problem, graph, *weak);
                EXPECT_TRUE(refined.ok());
                test::expect_valid(problem, graph, *weak, *refined);
                list.push_back({name, problem, *refined});
                return;
            }
            ADD_FAILURE() << name << " was not embedded";
        };
        const PolygonMesh sphere = zoo::icosphere(2);
        add("cube", zoo::cube(), sphere, zoo::displaced_landmarks(zoo::cube(), sphere, 0.3, 3));
        const PolygonMesh torus = zoo::torus(9, 7);
        const PolygonMesh coarse = zoo::quad_torus(3, 3);
        add("torus", coarse, torus, zoo::displaced_landmarks(coarse, torus, 0, 3));
        add("polygon", zoo::polygon(4), sphere, zoo::random_landmarks(sphere, 4, 3));
        return list;
    }();
    return all;
}

void expect_same_mesh(const PolygonMesh& mesh, const RefinedMesh& refined)
{
    EXPECT_EQ(mesh.positions, refined.positions);
    EXPECT_EQ(mesh.corners, refined.corners);
}

TEST(PatchColours, differ_between_neighbours)
{
    for (const Example& example : examples()) {
        const RefinedMesh& refined = example.refined;
        const std::vector<Index> colours = triangle_colours(refined);
        ASSERT_EQ(colours.size(), refined.triangle_patches.size());
        std::map<std::pair<Index, Index>, std::vector<std::size_t>> edges;
        for (std::size_t h = 0; h < refined.corners.size(); ++h) {
            edges[std::minmax(refined.corners[h], refined.corners[h % 3 == 2 ? h - 2 : h + 1])]
                .push_back(h / 3);
        }
        for (const auto& [edge, triangles] : edges) {
            if (triangles.size() == 2) {
                EXPECT_EQ(colours[triangles[0]] == colours[triangles[1]],
                          refined.triangle_patches[triangles[0]] ==
                              refined.triangle_patches[triangles[1]]);
            }
        }
    }
}

TEST(RefinedPly, reads_back_as_the_same_mesh)
{
    for (const Example& example : examples()) {
        const auto mesh = read_mesh(write_refined_ply(example.refined), MeshFormat::ply, "it");
        ASSERT_TRUE(mesh.ok()) << mesh.error().message;
        expect_same_mesh(*mesh, example.refined);
    }
}

TEST(RefinedGlb, reads_back_as_the_same_surface)
{
    for (const Example& example : examples()) {
        const RefinedMesh& refined = example.refined;
        const auto mesh = read_mesh(write_refined_glb(refined), MeshFormat::glb, "it");
        ASSERT_TRUE(mesh.ok()) << mesh.error().message;
        // Patches first, sorted by patch, then tubes and balls; positions in single precision.
        std::vector<std::size_t> order(refined.triangle_patches.size());
        for (std::size_t t = 0; t < order.size(); ++t) {
            order[t] = t;
        }
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return refined.triangle_patches[a] < refined.triangle_patches[b];
        });
        ASSERT_GT(mesh->face_count(), order.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 read = mesh->positions[mesh->corners[3 * i + k]];
                const Vec3 written = refined.positions[refined.corners[3 * order[i] + k]];
                EXPECT_LT((read - written).norm(), 1e-6);
            }
        }
    }
}

TEST(RefinedVtp, holds_as_many_numbers_as_it_says)
{
    const RefinedMesh& refined = examples()[2].refined;
    const std::string vtp = write_refined_vtp(refined);
    const auto numbers = [&](const std::string& name) {
        const std::size_t tag = vtp.find("Name=\"" + name + "\"");
        const std::size_t begin = vtp.find('>', tag) + 1;
        std::istringstream text(vtp.substr(begin, vtp.find('<', begin) - begin));
        std::vector<double> values;
        for (double value = 0; text >> value;) {
            values.push_back(value);
        }
        return values;
    };
    const std::size_t cells = refined.chains.size() + refined.triangle_patches.size();
    const std::vector<double> patches = numbers("patch");
    ASSERT_EQ(patches.size(), cells);
    for (std::size_t t = 0; t < refined.triangle_patches.size(); ++t) {
        const Index patch = refined.triangle_patches[t];
        EXPECT_EQ(patches[refined.chains.size() + t], patch == kNone ? -1.0 : patch);
    }
    const std::vector<double> edges = numbers("layout_edge");
    ASSERT_EQ(edges.size(), cells);
    EXPECT_EQ(edges[1], 1);
    EXPECT_EQ(edges[refined.chains.size()], -1);
    const std::vector<double> points = numbers("Points");
    ASSERT_EQ(points.size(), 3 * refined.positions.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        EXPECT_EQ(points[i], refined.positions[i / 3][static_cast<int>(i % 3)]);
    }
    EXPECT_NE(vtp.find("NumberOfPolys=\"" + std::to_string(refined.triangle_patches.size())),
              std::string::npos);
}

TEST(RefinedSvg, shows_what_is_turned_towards_the_eye)
{
    const RefinedMesh& refined = examples()[0].refined;
    for (const Vec3& direction : {Vec3(0, 0, 1), Vec3(0, -2, 0), Vec3(1, 1, 1)}) {
        View view;
        view.direction = direction;
        const auto svg = write_refined_svg(refined, view);
        ASSERT_TRUE(svg.ok());
        std::size_t front = 0;
        for (std::size_t t = 0; t < refined.triangle_patches.size(); ++t) {
            const Index* c = &refined.corners[3 * t];
            const Vec3& a = refined.positions[c[0]];
            front +=
                (refined.positions[c[1]] - a).cross(refined.positions[c[2]] - a).dot(direction) > 0
                    ? 1
                    : 0;
        }
        const auto closed = std::count(svg->begin(), svg->end(), 'Z');
        EXPECT_NEAR(static_cast<double>(closed), static_cast<double>(front), 4);
        EXPECT_NE(svg->find("stroke-width=\"2\""), std::string::npos);
        EXPECT_EQ(svg->find("nan"), std::string::npos);
    }
    View nowhere;
    nowhere.direction = Vec3(0, 0, 0);
    EXPECT_EQ(write_refined_svg(refined, nowhere).error().code, ErrorCode::invalidOption);
}

TEST(ReferenceFiles, read_back_as_they_were_written)
{
    const Example& example = examples()[0];
    const Layout& layout = *example.problem.layout;
    ReferenceInput input{"a layout.obj", "target.obj", {}};
    for (Index v = 0; v < layout.vertex_count(); ++v) {
        input.matches.push_back({v, example.problem.landmarks[v]});
    }
    const auto input_again = read_reference_input(write_reference_input(input), "it");
    ASSERT_TRUE(input_again.ok()) << input_again.error().message;
    EXPECT_EQ(input_again->layout_file, "a layout.obj");
    EXPECT_EQ(input_again->target_file, "target.obj");
    EXPECT_EQ(landmarks_of(*input_again, layout.vertex_count(), "it").value(),
              example.problem.landmarks);

    ReferenceEmbedding embedding{"x.inp", "x_target.obj", {}};
    for (Index e = 0; e < layout.edge_count(); ++e) {
        embedding.edges.push_back(
            {{layout.tail(2 * e), layout.head(2 * e)}, example.refined.chains[e]});
    }
    const auto again = read_reference_embedding(write_reference_embedding(embedding), "it");
    ASSERT_TRUE(again.ok()) << again.error().message;
    EXPECT_EQ(again->input_file, "x.inp");
    ASSERT_EQ(again->edges.size(), 2 * embedding.edges.size());
    for (std::size_t e = 0; e < embedding.edges.size(); ++e) {
        EXPECT_EQ(again->edges[2 * e].layout_edge, embedding.edges[e].layout_edge);
        EXPECT_EQ(again->edges[2 * e].chain, embedding.edges[e].chain);
        EXPECT_EQ(again->edges[2 * e + 1].chain.front(), embedding.edges[e].chain.back());
    }
}

TEST(ReferenceFiles, say_what_is_wrong_and_where)
{
    const auto input_error = [](const std::string& text) {
        const auto read = read_reference_input(text, "it");
        return read.ok() ? Error{} : read.error();
    };
    EXPECT_EQ(input_error("").code, ErrorCode::fileEmpty);
    EXPECT_EQ(input_error("lf a\ntif b\nmv 1\n").code, ErrorCode::landmarkOutOfRange);
    EXPECT_EQ(input_error("lf a\ntif b\nmv 1\n").details[0].second, 3);
    EXPECT_EQ(input_error("lf a\nmv 1 -2\n").code, ErrorCode::landmarkOutOfRange);
    EXPECT_EQ(input_error("lf a\nvf b\n").code, ErrorCode::syntaxError);
    const auto read = read_reference_input("# x\nlf a\r\ntif b\nmv 0 5\nmv 0 6", "it");
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(landmarks_of(*read, 2, "it").error().code, ErrorCode::landmarkCount);
    EXPECT_EQ(landmarks_of(*read, 0, "it").error().code, ErrorCode::landmarkCount);
    const auto embedding_error = [](const std::string& text) {
        const auto again = read_reference_embedding(text, "it");
        return again.ok() ? ErrorCode::none : again.error().code;
    };
    EXPECT_EQ(embedding_error("inp a\n"), ErrorCode::fileEmpty);
    EXPECT_EQ(embedding_error("inp a\ntf b\nee 0 1 : 2 3\n"), ErrorCode::none);
    EXPECT_EQ(embedding_error("inp a\ntf b\nee 0 1 2 3\n"), ErrorCode::syntaxError);
    EXPECT_EQ(embedding_error("inp a\ntf b\nee 0 1 : 2 x\n"), ErrorCode::indexOutOfRange);
}

}  // namespace
}  // namespace layout_embedding
