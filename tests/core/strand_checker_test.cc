#include "surface/strand_checker.hh"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <set>

#include "embedding_instances.hh"

namespace layout_embedding {
namespace {

using instances::Instance;

const std::vector<Instance>& all_instances()
{
    static const std::vector<Instance> instances = instances::random_instances(5, 1);
    return instances;
}

std::set<std::string> codes(const Instance& instance, const WeakEmbedding& weak)
{
    std::set<std::string> result;
    for (const StrandViolation& v : check_strands(instance.problem, instance.graph, weak)) {
        result.insert(v.code);
    }
    return result;
}

TEST(StrandChecker, accepts_inserted_strands_and_any_part_of_them)
{
    for (const Instance& instance : all_instances()) {
        WeakEmbedding weak = instance.weak;
        for (const StrandViolation& v :
             check_strands(instance.problem, instance.graph, instance.weak)) {
            ADD_FAILURE() << instance.name << ": " << v.code << ", " << v.message;
        }
        // Without one path, the lanes right of it close up.
        WeakPath removed = std::move(weak.paths[0]);
        weak.paths[0] = {};
        for (std::size_t i = 0; i < removed.darts.size(); ++i) {
            for (std::size_t p = 1; p < weak.paths.size(); ++p) {
                WeakPath& path = weak.paths[p];
                for (std::size_t k = 0; k < path.darts.size(); ++k) {
                    const Index dart = path.darts[k];
                    if (dart == removed.darts[i]) {
                        path.lanes[k] -=
                            instance.weak.paths[0].lanes[i] < instance.weak.paths[p].lanes[k] ? 1
                                                                                              : 0;
                    } else if (instance.graph.twin(dart) == removed.darts[i]) {
                        Index count = 0;
                        for (const WeakPath& other : instance.weak.paths) {
                            for (const Index d : other.darts) {
                                count += d == dart || instance.graph.twin(d) == dart ? 1 : 0;
                            }
                        }
                        path.lanes[k] -= count - 1 - instance.weak.paths[0].lanes[i] <
                                                 instance.weak.paths[p].lanes[k]
                                             ? 1
                                             : 0;
                    }
                }
            }
        }
        EXPECT_EQ(codes(instance, weak), std::set<std::string>{}) << instance.name;
    }
}

TEST(StrandChecker, refuses_two_neighbouring_strands_exchanged_on_one_edge)
{
    std::size_t tried = 0;
    for (const Instance& instance : all_instances()) {
        std::set<Index> landmark_nodes;
        for (const Index v : instance.problem.landmarks) {
            landmark_nodes.insert(instance.graph.node_of_vertex(v));
        }
        for (Index p = 0; p < instance.weak.paths.size(); ++p) {
            for (Index q = 0; q < p; ++q) {
                const WeakPath& a = instance.weak.paths[p];
                const WeakPath& b = instance.weak.paths[q];
                for (std::size_t i = 0; i < a.darts.size(); ++i) {
                    const Index d = a.darts[i];
                    const auto k = std::find(b.darts.begin(), b.darts.end(), d) - b.darts.begin();
                    if (static_cast<std::size_t>(k) == b.darts.size() ||
                        (a.lanes[i] != b.lanes[k] + 1 && b.lanes[k] != a.lanes[i] + 1) ||
                        (landmark_nodes.count(instance.graph.tail(d)) == 1 &&
                         landmark_nodes.count(instance.graph.head(d)) == 1)) {
                        continue;
                    }
                    WeakEmbedding weak = instance.weak;
                    std::swap(weak.paths[p].lanes[i], weak.paths[q].lanes[k]);
                    EXPECT_EQ(codes(instance, weak).count("strandsCross"), 1U) << instance.name;
                    ++tried;
                }
            }
        }
    }
    EXPECT_GT(tried, 100U);
}

TEST(StrandChecker, refuses_everything_else_by_its_name)
{
    std::map<std::string, int> seen;
    for (const Instance& instance : all_instances()) {
        const auto expect = [&](const WeakEmbedding& weak, const std::string& code) {
            EXPECT_EQ(codes(instance, weak), std::set<std::string>{code}) << instance.name;
            ++seen[code];
        };
        WeakEmbedding weak = instance.weak;
        weak.paths.pop_back();
        expect(weak, "strandSize");
        weak = instance.weak;
        weak.paths[0].lanes.pop_back();
        expect(weak, "strandSize");
        weak = instance.weak;
        weak.paths[0].darts[0] = kNone;
        expect(weak, "strandBroken");
        weak = instance.weak;
        weak.paths[0].lanes[0] = 1000;
        expect(weak, "strandLanes");
        weak = instance.weak;
        WeakPath& path = weak.paths[0];
        if (path.darts.size() > 2) {
            path.darts.erase(path.darts.begin() + 1);
            path.lanes.pop_back();
            expect(weak, "strandBroken");
        }
        weak = instance.weak;
        path.darts.pop_back();
        path.lanes.pop_back();
        if (!path.darts.empty()) {
            expect(weak, "strandEnds");
        }
        weak = instance.weak;
        const Index first = path.darts[0];
        const std::array<Index, 2> back{first, instance.graph.twin(first)};
        path.darts.insert(path.darts.begin(), back.begin(), back.end());
        path.lanes.insert(path.lanes.begin(), 2, 0);
        expect(weak, "strandThroughLandmark");
    }
    EXPECT_EQ(seen.size(), 5U);
}

TEST(StrandChecker, refuses_strands_against_the_order_of_the_layout)
{
    // The layout is mirrored, the strands stay as they are.
    const PolygonMesh mesh = instances::icosahedron();
    std::vector<Index> landmarks(mesh.vertex_count());
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        landmarks[v] = v;
    }
    PolygonMesh mirrored = mesh;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        std::swap(mirrored.corners[3 * f + 1], mirrored.corners[3 * f + 2]);
    }
    const EmbeddingProblem problem = instances::problem(mesh, mesh, landmarks);
    const EmbeddingProblem wrong = instances::problem(mirrored, mesh, landmarks);
    const PathGraph graph = PathGraph::barycentric(*problem.target);
    Random random(1);
    const auto weak = instances::insert_in_random_order(problem, graph, random);
    ASSERT_TRUE(weak.has_value());
    EXPECT_TRUE(check_strands(problem, graph, *weak).empty());
    WeakEmbedding renumbered;
    for (Index e = 0; e < wrong.layout->edge_count(); ++e) {
        for (Index f = 0; f < problem.layout->edge_count(); ++f) {
            WeakPath path = weak->paths[f];
            if (problem.layout->tail(2 * f) == wrong.layout->head(2 * e) &&
                problem.layout->head(2 * f) == wrong.layout->tail(2 * e)) {
                // Every path is alone on its edges.
                std::reverse(path.darts.begin(), path.darts.end());
                for (Index& d : path.darts) {
                    d = graph.twin(d);
                }
                renumbered.paths.push_back(path);
            } else if (problem.layout->tail(2 * f) == wrong.layout->tail(2 * e) &&
                       problem.layout->head(2 * f) == wrong.layout->head(2 * e)) {
                renumbered.paths.push_back(path);
            }
        }
    }
    const auto violations = check_strands(wrong, graph, renumbered);
    EXPECT_EQ(violations.size(), 12U);
    for (const StrandViolation& v : violations) {
        EXPECT_EQ(v.code, "strandOrder") << v.message;
    }
}

}  // namespace
}  // namespace layout_embedding
