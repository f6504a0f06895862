#include "surface/strand_checker.hh"

#include <algorithm>
#include <gtest/gtest.h>
#include <map>
#include <set>

#include "embedding_checks.hh"
#include "instances.hh"
#include "search_ground.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

using Instance = test::EmbeddedInstance;

const std::vector<Instance>& all_instances()
{
    static const std::vector<Instance> instances = test::embedded_instances(41);
    return instances;
}

std::set<std::string> codes(const Instance& instance, const WeakEmbedding& weak)
{
    std::set<std::string> codes;
    for (const auto& violation : check_strands(instance.problem, instance.graph, weak)) {
        EXPECT_FALSE(violation.message.empty());
        codes.insert(violation.code);
    }
    return codes;
}

using Codes = std::set<std::string>;

constexpr int kTrialsPerInstance = 10;

/// Passes over the edges of the path graph: by the smaller dart, from its right to its left, which
/// path and which of its darts.
std::map<Index, std::vector<std::pair<Index, Index>>> passes_of(const Instance& instance,
                                                                const WeakEmbedding& weak)
{
    std::map<Index, std::vector<std::pair<Index, Index>>> passes;
    for (Index p = 0; p < weak.paths.size(); ++p) {
        for (const Index d : weak.paths[p].darts) {
            passes[std::min(d, instance.graph.twin(d))].emplace_back();
        }
    }
    for (Index p = 0; p < weak.paths.size(); ++p) {
        const auto& [darts, lanes] = weak.paths[p];
        for (Index i = 0; i < darts.size(); ++i) {
            auto& row = passes[std::min(darts[i], instance.graph.twin(darts[i]))];
            const bool forward = darts[i] < instance.graph.twin(darts[i]);
            row[forward ? lanes[i] : row.size() - 1 - lanes[i]] = {p, i};
        }
    }
    return passes;
}

/// The path along the same darts from its other end.
WeakPath reversed(const Instance& instance, const WeakEmbedding& weak, Index p)
{
    WeakPath path = weak.paths[p];
    const auto passes = passes_of(instance, weak);
    for (std::size_t i = 0; i < path.darts.size(); ++i) {
        const Index twin = instance.graph.twin(path.darts[i]);
        const auto& row = passes.at(std::min(path.darts[i], twin));
        path.lanes[i] = static_cast<Index>(row.size()) - 1 - path.lanes[i];
        path.darts[i] = twin;
    }
    std::reverse(path.darts.begin(), path.darts.end());
    std::reverse(path.lanes.begin(), path.lanes.end());
    return path;
}

/// The same strands for another layout on the same vertices, as far as it has the same edges.
Instance moved_to(const Instance& instance, const PolygonMesh& mesh)
{
    Instance moved = instance;
    moved.problem.layout =
        std::make_shared<Layout>(Layout::from_polygons(mesh, "the layout").value());
    const Layout& from = *instance.problem.layout;
    const Layout& to = *moved.problem.layout;
    moved.weak.paths.assign(to.edge_count(), {});
    for (Index e = 0; e < to.edge_count(); ++e) {
        for (Index h = 0; h < 2 * from.edge_count(); ++h) {
            if (from.tail(h) == to.tail(2 * e) && from.head(h) == to.head(2 * e)) {
                moved.weak.paths[e] = h % 2 == 0
                                          ? instance.weak.paths[Layout::edge(h)]
                                          : reversed(instance, instance.weak, Layout::edge(h));
            }
        }
    }
    return moved;
}

TEST(StrandChecker, accepts_what_insertion_in_any_order_makes_complete_or_partial)
{
    Index shared = 0;
    for (const Instance& instance : all_instances()) {
        SCOPED_TRACE(instance.name);
        test::expect_strands(instance.problem, instance.graph, instance.weak);
        for (const auto& [dart, row] : passes_of(instance, instance.weak)) {
            shared += row.size() > 1 ? 1 : 0;
        }
    }
    EXPECT_GT(shared, 200U);

    Random random(42);
    for (const test::Instance& instance : test::random_instances(42, 30)) {
        SCOPED_TRACE(instance.name);
        test::SearchGround ground(instance.problem, 1);
        for (const Index e : test::random_order(ground.strands.layout().edge_count(), random)) {
            ground.search.begin(e);
            if (ground.search.run() == CutSurfaceSearch::Outcome::found) {
                ASSERT_TRUE(ground.strands.insert(e, ground.search.darts()));
                test::expect_strands(instance.problem, ground.graph,
                                     ground.strands.weak_embedding());
            }
        }
    }
}

TEST(StrandChecker, two_paths_in_exchanged_lanes_cross)
{
    Random random(43);
    int crossing = 0;
    int at_landmarks = 0;
    for (const Instance& instance : all_instances()) {
        SCOPED_TRACE(instance.name);
        int tried = 0;
        for (const auto& [dart, row] : passes_of(instance, instance.weak)) {
            for (std::size_t lane = 1; lane < row.size(); ++lane) {
                const auto [p, i] = row[lane - 1];
                const auto [q, j] = row[lane];
                if (p == q || ++tried > kTrialsPerInstance) {
                    continue;
                }
                WeakEmbedding broken = instance.weak;
                broken.paths[p].lanes[i] += broken.paths[p].darts[i] == dart ? 1 : -1;
                broken.paths[q].lanes[j] -= broken.paths[q].darts[j] == dart ? 1 : -1;
                const auto found = codes(instance, broken);
                // With just two ends around a landmark, the cyclic order is not hurt there; the
                // other end of the edge is hurt in any case.
                ASSERT_FALSE(found.empty());
                EXPECT_TRUE(found.count("strandsCross") + found.count("strandOrder") ==
                            found.size());
                crossing += static_cast<int>(found.count("strandsCross"));
                at_landmarks += static_cast<int>(found.count("strandOrder"));
            }
        }
    }
    EXPECT_GT(crossing, 200);
    EXPECT_GT(at_landmarks, 20);
}

TEST(StrandChecker, a_lane_taken_twice_or_beyond_the_edge_is_refused)
{
    for (const Instance& instance : all_instances()) {
        SCOPED_TRACE(instance.name);
        int shared = 0;
        int tried = 0;
        for (const auto& [dart, row] : passes_of(instance, instance.weak)) {
            if (++tried > kTrialsPerInstance) {
                break;
            }
            WeakEmbedding broken = instance.weak;
            const auto [p, i] = row[0];
            broken.paths[p].lanes[i] = static_cast<Index>(row.size());
            EXPECT_EQ(codes(instance, broken), Codes{"strandLanes"});
            broken.paths[p].lanes[i] = kNone;
            EXPECT_EQ(codes(instance, broken), Codes{"strandLanes"});
            if (row.size() > 1 && shared++ < 5) {
                const auto size = static_cast<Index>(row.size());
                broken.paths[p].lanes[i] = size - 1 - instance.weak.paths[p].lanes[i];
                EXPECT_EQ(codes(instance, broken), Codes{"strandLanes"});
            }
        }
    }
}

TEST(StrandChecker, walks_between_other_landmarks_are_refused)
{
    for (const Instance& instance : all_instances()) {
        SCOPED_TRACE(instance.name);
        // Another edge's path.
        WeakEmbedding broken = instance.weak;
        std::swap(broken.paths[0], broken.paths[1]);
        EXPECT_EQ(codes(instance, broken), Codes{"strandEnds"});
        // The right path backwards.
        broken = instance.weak;
        broken.paths[0] = reversed(instance, instance.weak, 0);
        EXPECT_EQ(codes(instance, broken), Codes{"strandEnds"});
        // The last dart is missing.
        broken = instance.weak;
        broken.paths[0].darts.pop_back();
        broken.paths[0].lanes.pop_back();
        EXPECT_EQ(codes(instance, broken), Codes{"strandEnds"});
        // Two landmarks exchanged.
        Instance exchanged = instance;
        std::swap(exchanged.problem.landmarks[0], exchanged.problem.landmarks[1]);
        EXPECT_EQ(codes(exchanged, instance.weak), Codes{"strandEnds"});
    }
}

TEST(StrandChecker, a_gap_in_a_walk_is_refused)
{
    for (const Instance& instance : all_instances()) {
        SCOPED_TRACE(instance.name);
        for (std::size_t p = 0; p < instance.weak.paths.size(); ++p) {
            if (instance.weak.paths[p].darts.size() > 2) {
                WeakEmbedding broken = instance.weak;
                broken.paths[p].darts.erase(broken.paths[p].darts.begin() + 1);
                broken.paths[p].lanes.erase(broken.paths[p].lanes.begin() + 1);
                EXPECT_EQ(codes(instance, broken), Codes{"strandBroken"});
            }
        }
    }
}

TEST(StrandChecker, a_walk_through_a_landmark_is_refused)
{
    int walks = 0;
    for (const Instance& instance : all_instances()) {
        SCOPED_TRACE(instance.name);
        const Layout& layout = *instance.problem.layout;
        // For a layout triangle a, b, c: the path of ab replaced by that of ac, then that of cb.
        for (Index f = 0; f < layout.face_count(); ++f) {
            const auto face = layout.face_halfedges(f);
            if (face.size() != 3) {
                continue;
            }
            WeakEmbedding broken = instance.weak;
            std::vector<Index> way{Layout::twin(face[2]), Layout::twin(face[1])};
            if (face[0] % 2 == 1) {
                way = {face[1], face[2]};
            }
            auto& path = broken.paths[Layout::edge(face[0])];
            path = {};
            for (const Index h : way) {
                const Index e = Layout::edge(h);
                const WeakPath part =
                    h % 2 == 0 ? instance.weak.paths[e] : reversed(instance, instance.weak, e);
                path.darts.insert(path.darts.end(), part.darts.begin(), part.darts.end());
            }
            path.lanes.assign(path.darts.size(), 0);
            EXPECT_EQ(codes(instance, broken), Codes{"strandThroughLandmark"});
            ++walks;
        }
    }
    EXPECT_GT(walks, 50);
}

TEST(StrandChecker, the_mirrored_order_is_refused_at_landmarks_of_degree_three)
{
    // The same strands for the mirrored layout: nothing crosses, only the orders are wrong.
    int refused = 0;
    for (const Instance& instance : all_instances()) {
        SCOPED_TRACE(instance.name);
        const Layout& layout = *instance.problem.layout;
        PolygonMesh mirrored;
        mirrored.positions.assign(layout.vertex_count(), Vec3::Zero());
        for (Index f = 0; f < layout.face_count(); ++f) {
            std::vector<Index> corners;
            for (const Index h : layout.face_halfedges(f)) {
                corners.insert(corners.begin(), layout.tail(h));
            }
            mirrored.add_face(corners);
        }
        // Of two strands around an inner point any order is right.
        bool has_order = false;
        for (Index v = 0; v < layout.vertex_count(); ++v) {
            has_order = has_order || layout.outgoing(v).size() > 2;
        }
        if (!has_order) {
            continue;
        }
        const Instance other = moved_to(instance, mirrored);
        EXPECT_EQ(codes(other, other.weak), Codes{"strandOrder"});
        ++refused;
    }
    EXPECT_GT(refused, 30);
}

TEST(StrandChecker, on_the_boundary_the_order_is_linear)
{
    // Three edges leave vertex 0 of both layouts, in the same cyclic order, but the gap is between
    // others.
    PolygonMesh fan;
    fan.positions.assign(4, Vec3::Zero());
    PolygonMesh rotated = fan;
    fan.add_face(std::vector<Index>{0, 1, 2});
    fan.add_face(std::vector<Index>{0, 2, 3});
    rotated.add_face(std::vector<Index>{0, 2, 3});
    rotated.add_face(std::vector<Index>{0, 3, 1});
    const PolygonMesh target = zoo::grid_disk(6, 6);
    for (const Index center : {3U, 24U}) {
        const EmbeddingProblem problem = test::problem_of(fan, target, {center, 16, 38, 30});
        test::SearchGround ground(problem, 1);
        for (Index e = 0; e < problem.layout->edge_count(); ++e) {
            if (problem.layout->tail(2 * e) == 0 || problem.layout->head(2 * e) == 0) {
                ground.search.begin(e);
                ASSERT_EQ(ground.search.run(), CutSurfaceSearch::Outcome::found);
                ASSERT_TRUE(ground.strands.insert(e, ground.search.darts()));
            }
        }
        const Instance instance{"fan", problem, ground.graph, ground.strands.weak_embedding()};
        EXPECT_EQ(codes(instance, instance.weak), Codes{});
        const Instance moved = moved_to(instance, rotated);
        const bool on_boundary = ground.graph.is_boundary(ground.graph.node_of_vertex(center));
        EXPECT_EQ(on_boundary, center == 3);
        EXPECT_EQ(codes(moved, moved.weak), on_boundary ? Codes{"strandOrder"} : Codes{});
    }
}

TEST(StrandChecker, numbers_out_of_range_are_refused)
{
    const Instance& instance = all_instances().front();
    const auto after = [&](const auto& damage) {
        WeakEmbedding weak = instance.weak;
        damage(weak);
        return codes(instance, weak);
    };
    EXPECT_EQ(after([](WeakEmbedding& w) { w.paths.pop_back(); }), Codes{"strandSize"});
    EXPECT_EQ(after([](WeakEmbedding& w) { w.paths.emplace_back(); }), Codes{"strandSize"});
    EXPECT_EQ(after([](WeakEmbedding& w) { w.paths[0].lanes.pop_back(); }), Codes{"strandSize"});
    EXPECT_EQ(after([](WeakEmbedding& w) { w.paths[0].darts[0] = kNone; }), Codes{"strandBroken"});
}

}  // namespace
}  // namespace layout_embedding
