#include <algorithm>
#include <gtest/gtest.h>
#include <map>

#include "embedding_checks.hh"
#include "instances.hh"
#include "search_ground.hh"
#include "surface/strand_checker.hh"
#include "zoo.hh"

// The shortest walk in the cut surface against its definition: all walks of darts up to a length
// are enumerated, each with all lanes it could take among the strands that are there, and the
// strand checker decides which of them are strands. Nothing of Strands or the search is used.

namespace layout_embedding {
namespace {

using Outcome = CutSurfaceSearch::Outcome;

class WalkEnumeration {
public:
    /// A limit on walks with lanes: beyond it the enumeration is given up.
    static constexpr int kMaxTrials = 3000;

    WalkEnumeration(const EmbeddingProblem& problem, const PathGraph& graph,
                    const WeakEmbedding& embedded, Index layout_edge, Length max_length)
        : problem_(problem),
          graph_(graph),
          weak_(embedded),
          edge_(layout_edge),
          is_landmark_(graph.node_count(), false)
    {
        for (const Index landmark : problem.landmarks) {
            is_landmark_[graph.node_of_vertex(landmark)] = true;
        }
        start_ = landmark_node(problem.layout->tail(2 * layout_edge));
        goal_ = landmark_node(problem.layout->head(2 * layout_edge));
        compute_distances();
        collect_rows();
        extend(start_, max_length);
    }

    bool complete() const { return trials_ < kMaxTrials; }
    int walk_count() const { return walks_; }
    int trial_count() const { return trials_; }
    /// The walks that the strand checker accepts with some lanes.
    const std::vector<std::vector<Index>>& accepted() const { return accepted_; }

private:
    using Pass = std::pair<Index, Index>;  // path, place of the dart in it

    Index landmark_node(Index v) const { return graph_.node_of_vertex(problem_.landmarks[v]); }

    // The distances of all nodes to the goal, by relaxing all darts until nothing changes.
    void compute_distances()
    {
        distances_.assign(graph_.node_count(), kInfiniteLength);
        distances_[goal_] = 0;
        for (bool changed = true; changed;) {
            changed = false;
            for (Index d = 0; d < graph_.dart_count(); ++d) {
                const Length there = distances_[graph_.head(d)];
                const Index tail = graph_.tail(d);
                const bool open = graph_.head(d) == goal_ || !is_landmark_[graph_.head(d)];
                if (open && there != kInfiniteLength &&
                    there + graph_.dart(d).length < distances_[tail]) {
                    distances_[tail] = there + graph_.dart(d).length;
                    changed = true;
                }
            }
        }
    }

    Index smaller(Index dart) const { return std::min(dart, graph_.twin(dart)); }

    // The passes over each edge of the path graph, from right to left of its smaller dart.
    void collect_rows()
    {
        for (const WeakPath& path : weak_.paths) {
            for (const Index d : path.darts) {
                rows_[smaller(d)].emplace_back();
            }
        }
        for (Index p = 0; p < weak_.paths.size(); ++p) {
            const auto& [darts, lanes] = weak_.paths[p];
            for (Index i = 0; i < darts.size(); ++i) {
                auto& row = rows_[smaller(darts[i])];
                const bool forward = darts[i] == smaller(darts[i]);
                row[forward ? lanes[i] : row.size() - 1 - lanes[i]] = {p, i};
            }
        }
    }

    void extend(Index node, Length left)
    {
        for (Index d = graph_.first_dart(node); d < graph_.first_dart(node + 1); ++d) {
            const Length length = graph_.dart(d).length;
            const Index head = graph_.head(d);
            if (length > left || distances_[head] > left - length ||
                (is_landmark_[head] && head != goal_)) {
                continue;
            }
            walk_.push_back(d);
            if (head == goal_) {
                ++walks_;
                was_accepted_ = false;
                choose_lanes(0);
                if (was_accepted_) {
                    accepted_.push_back(walk_);
                }
            } else {
                extend(head, left - length);
            }
            walk_.pop_back();
            if (!complete()) {
                return;
            }
        }
    }

    void choose_lanes(Index place)
    {
        if (!complete()) {
            return;
        }
        if (place == walk_.size()) {
            try_walk();
            return;
        }
        auto& row = rows_[smaller(walk_[place])];
        for (std::size_t lane = 0; lane <= row.size(); ++lane) {
            row.insert(row.begin() + static_cast<long>(lane), Pass{edge_, place});
            choose_lanes(place + 1);
            row.erase(row.begin() + static_cast<long>(lane));
        }
    }

    void try_walk()
    {
        ++trials_;
        WeakEmbedding trial = weak_;
        trial.paths[edge_].darts = walk_;
        trial.paths[edge_].lanes.resize(walk_.size());
        for (const auto& [dart, row] : rows_) {
            for (std::size_t lane = 0; lane < row.size(); ++lane) {
                auto& path = trial.paths[row[lane].first];
                const Index place = row[lane].second;
                const bool forward = path.darts[place] == dart;
                path.lanes[place] = static_cast<Index>(forward ? lane : row.size() - 1 - lane);
            }
        }
        was_accepted_ = was_accepted_ || check_strands(problem_, graph_, trial).empty();
    }

    const EmbeddingProblem& problem_;
    const PathGraph& graph_;
    WeakEmbedding weak_;
    Index edge_;
    Index start_ = 0;
    Index goal_ = 0;
    std::vector<bool> is_landmark_;
    std::vector<Length> distances_;
    std::map<Index, std::vector<Pass>> rows_;
    std::vector<Index> walk_;
    bool was_accepted_ = false;
    int walks_ = 0;
    int trials_ = 0;
    std::vector<std::vector<Index>> accepted_;
};

EmbeddingProblem tiny_problem(Random& random)
{
    PolygonMesh square;
    square.positions.assign(4, Vec3::Zero());
    square.add_face(std::vector<Index>{0, 1, 2});
    square.add_face(std::vector<Index>{0, 2, 3});
    const std::vector<PolygonMesh> layouts{zoo::tetrahedron(), square, zoo::pyramid(4),
                                           zoo::prism(3)};
    const std::vector<PolygonMesh> targets{zoo::octahedron(), zoo::bipyramid(5), zoo::bipyramid(4)};
    const PolygonMesh& layout = layouts[random.below(layouts.size())];
    PolygonMesh target = targets[random.below(targets.size())];
    for (Vec3& p : target.positions) {
        p = p * (0.5 + random.unit()) + 0.3 * Vec3(random.unit(), random.unit(), random.unit());
    }
    return test::problem_of(layout, target,
                            zoo::random_landmarks(target, layout.vertex_count(), random.bits()));
}

TEST(ShortestWalk, no_shorter_walk_is_a_strand_with_any_lanes)
{
    Random random(51);
    int detours = 0;
    int plain = 0;
    int given_up = 0;
    int refused_walks = 0;
    int trials = 0;
    for (int round = 0; round < 150; ++round) {
        const EmbeddingProblem problem = tiny_problem(random);
        test::SearchGround ground(problem, random.bits());
        const Index edges = problem.layout->edge_count();
        const auto order = test::random_order(edges, random);
        const auto inserted = 1 + random.below(edges - 1);
        for (std::size_t i = 0; i < inserted; ++i) {
            ground.search.begin(order[i]);
            if (ground.search.run() == Outcome::found) {
                ASSERT_TRUE(ground.strands.insert(order[i], ground.search.darts()));
            }
        }
        const WeakEmbedding embedded = ground.strands.weak_embedding();
        test::expect_strands(problem, ground.graph, embedded);
        const Strands empty(problem, ground.graph);
        CutSurfaceSearch unconstrained(empty, ground.fields);
        for (Index e = 0; e < edges; ++e) {
            if (ground.strands.is_embedded(e)) {
                continue;
            }
            unconstrained.begin(e);
            ASSERT_NE(unconstrained.run(), Outcome::tied);
            ground.search.begin(e);
            const Outcome outcome = ground.search.run();
            ASSERT_NE(outcome, Outcome::tied);
            if (outcome != Outcome::found) {
                continue;  // a bound on the length of all walks has to come from elsewhere
            }
            const WalkEnumeration all(problem, ground.graph, embedded, e, ground.search.cost());
            trials += all.trial_count();
            if (!all.complete()) {
                ++given_up;
                continue;
            }
            // The walk found is the only one of its length or less.
            ASSERT_EQ(all.accepted().size(), 1U);
            EXPECT_EQ(all.accepted().front(), ground.search.darts());
            const bool detour = ground.search.cost() > unconstrained.cost();
            detours += detour ? 1 : 0;
            plain += detour ? 0 : 1;
            refused_walks += all.walk_count() - 1;
        }
    }
    RecordProperty("detours", detours);
    RecordProperty("given_up", given_up);
    RecordProperty("trials", trials);
    EXPECT_GT(plain, 40);
    EXPECT_GT(detours, 30);
    EXPECT_GT(refused_walks, 1000);
}

TEST(ShortestWalk, is_the_same_from_either_end)
{
    Random random(53);
    int found = 0;
    int blocked = 0;
    for (int round = 0; round < 100; ++round) {
        const EmbeddingProblem problem = tiny_problem(random);
        test::SearchGround ground(problem, random.bits());
        for (const Index e : test::random_order(problem.layout->edge_count(), random)) {
            ground.search.begin(e);
            const Outcome outcome = ground.search.run();
            const std::vector<Index> darts = ground.search.darts();
            const Length cost = ground.search.cost();
            ground.search.begin_backwards(e);
            ASSERT_EQ(ground.search.run(), outcome);
            EXPECT_EQ(ground.search.darts(), darts);
            EXPECT_EQ(ground.search.cost(), cost);
            ++(outcome == Outcome::found ? found : blocked);
            if (outcome == Outcome::found) {
                ASSERT_TRUE(ground.strands.insert(e, darts));
            }
        }
    }
    EXPECT_GT(found, 300);
    EXPECT_GT(blocked, 20);
}

TEST(ShortestWalk, a_blocked_edge_has_no_strand_of_a_length_far_beyond_the_unconstrained_one)
{
    Random random(52);
    int blocked = 0;
    for (int round = 0; round < 200; ++round) {
        const EmbeddingProblem problem = tiny_problem(random);
        test::SearchGround ground(problem, random.bits());
        const Index edges = problem.layout->edge_count();
        for (const Index e : test::random_order(edges, random)) {
            ground.search.begin(e);
            if (ground.search.run() == Outcome::found) {
                ASSERT_TRUE(ground.strands.insert(e, ground.search.darts()));
                continue;
            }
            const Strands empty(problem, ground.graph);
            CutSurfaceSearch unconstrained(empty, ground.fields);
            unconstrained.begin(e);
            ASSERT_EQ(unconstrained.run(), Outcome::found);
            const WalkEnumeration all(problem, ground.graph, ground.strands.weak_embedding(), e,
                                      unconstrained.cost() + (Length{1} << 52U));
            EXPECT_TRUE(all.accepted().empty());
            blocked += all.trial_count() > 10 ? 1 : 0;
            break;
        }
    }
    EXPECT_GT(blocked, 5);
}

}  // namespace
}  // namespace layout_embedding
