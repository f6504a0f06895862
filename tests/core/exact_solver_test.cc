#include "search/exact_solver.hh"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "all_selections.hh"
#include "embedding_checks.hh"
#include "instances.hh"
#include "search/sequence_solver.hh"
#include "surface/path_metric.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

using test::Instance;

constexpr std::uint64_t kFieldBytes = std::uint64_t{1} << 30U;

/// A solver run to its end, or until `max_work` is spent, whose bounds and incumbents are looked at
/// on the way.
template <typename Solver, typename Options>
struct Run {
    Run(const EmbeddingProblem& problem, const Options& options, std::uint64_t slice = UINT64_MAX,
        std::uint64_t max_work = UINT64_MAX, const PathGraph::Options& graph_options = {})
        : graph(PathGraph::barycentric(*problem.target, graph_options)),
          solver(problem, graph, kFieldBytes, options)
    {
        Length bound = 0;
        Length cost = kInfiniteLength;
        while (work < max_work) {
            WorkBudget budget(slice);
            const auto outcome = solver.run(budget);
            work += budget.spent();
            EXPECT_NE(outcome, Solver::Outcome::tied);
            EXPECT_GE(solver.lower_bound(), bound);
            EXPECT_LE(solver.incumbent_cost(), cost);
            EXPECT_LE(solver.lower_bound(), solver.incumbent_cost());
            bound = solver.lower_bound();
            if (solver.incumbent_cost() < cost) {
                cost = solver.incumbent_cost();
                test::expect_strands(problem, graph, solver.incumbent());
                EXPECT_EQ(test::total_cost(problem, graph, solver.incumbent()), cost);
            }
            if (outcome != Solver::Outcome::running) {
                happened.emplace_back(outcome, work);
            }
            if (outcome == Solver::Outcome::finished || outcome == Solver::Outcome::tied) {
                has_finished = true;
                return;
            }
        }
    }

    PathGraph graph;
    Solver solver;
    std::uint64_t work = 0;
    bool has_finished = false;
    std::vector<std::pair<layout_embedding::Solver::Outcome, std::uint64_t>> happened;
};

using ExactRun = Run<ExactSolver, ExactSolverOptions>;

/// Branch and bound alone proves the same where clauses, or both, proved this.
void expect_same_by_branch_and_bound(const EmbeddingProblem& problem, const ExactRun& proved,
                                     ExactSolverOptions options = {},
                                     const PathGraph::Options& graph_options = {})
{
    options.patience = 0;
    const ExactRun run(problem, options, 5000, 400'000, graph_options);
    if (run.has_finished) {
        EXPECT_EQ(run.solver.lower_bound(), run.solver.incumbent_cost());
        EXPECT_EQ(run.solver.incumbent_cost(), proved.solver.incumbent_cost());
    }
    EXPECT_LE(run.solver.lower_bound(), proved.solver.incumbent_cost());
}

using SequenceRun = Run<SequenceSolver, SequenceSolverOptions>;

SequenceSolverOptions best_sequence()
{
    SequenceSolverOptions options;
    options.branch_and_bound.gap = 0;
    return options;
}

/// Those of random_instances() with few layout edges: others take long to be proved.
std::vector<Instance> small_instances(std::uint64_t seed, int count)
{
    std::vector<Instance> instances = test::random_instances(seed, count);
    std::erase_if(instances, [](const Instance& instance) {
        return instance.problem.layout->edge_count() > 12;
    });
    return instances;
}

TEST(ExactSolver, finds_the_best_of_all_selections)
{
    int above_root = 0;
    int looked_into = 0;
    for (const Instance& instance : test::tiny_instances(201, 90)) {
        SCOPED_TRACE(instance.name);
        const ExactRun run(instance.problem, {});
        ASSERT_EQ(run.solver.lower_bound(), run.solver.incumbent_cost());
        const test::AllSelections all(instance.problem, run.solver.incumbent_cost() + 1);
        EXPECT_EQ(run.solver.incumbent_cost(), all.best());
        expect_same_by_branch_and_bound(instance.problem, run);
        above_root += run.solver.counters().states_created > 0 ? 1 : 0;
        looked_into += run.solver.counters().states_expanded > 0 ? 1 : 0;
    }
    EXPECT_GT(above_root, 30);
    EXPECT_GT(looked_into, 10);
}

TEST(ExactSolver, finds_the_best_of_all_selections_in_any_metric)
{
    Random random(213);
    int other = 0;
    for (const Instance& instance : test::tiny_instances(212, 40)) {
        SCOPED_TRACE(instance.name);
        const TriangleMesh& target = *instance.problem.target;
        std::vector<double> vertex_costs;
        for (Index v = 0; v < target.vertex_count(); ++v) {
            vertex_costs.push_back(std::exp2(2 * random.unit() - 1));
        }
        const std::vector<double> edge_costs = feature_costs(target, 0.5);
        const PathGraph::Options metric{1, 0, vertex_costs, edge_costs};
        const ExactRun run(instance.problem, {}, UINT64_MAX, UINT64_MAX, metric);
        ASSERT_EQ(run.solver.lower_bound(), run.solver.incumbent_cost());
        const test::AllSelections all(instance.problem, run.solver.incumbent_cost() + 1,
                                      {.graph = metric});
        EXPECT_EQ(run.solver.incumbent_cost(), all.best());
        expect_same_by_branch_and_bound(instance.problem, run, {}, metric);
        const ExactRun euclidean(instance.problem, {});
        other += run.solver.incumbent_order() != euclidean.solver.incumbent_order() ||
                         test::total_length(euclidean.graph, run.solver.incumbent()) >
                             euclidean.solver.incumbent_cost()
                     ? 1
                     : 0;
    }
    EXPECT_GT(other, 20);
}

/// Layouts with boundary on disks, the landmarks drawn among the inner vertices: holes
/// tend to get into the wrong face.
std::vector<Instance> instances_with_holes(std::uint64_t seed, int count)
{
    struct Ground {
        std::string name;
        PolygonMesh layout;
        PolygonMesh target;
    };
    const std::vector<Ground> grounds{
        {"wheel on a disk", zoo::wheel(3), zoo::grid_disk(6, 6)},
        {"square on a disk", zoo::polygon(4), zoo::grid_disk(5, 5)},
        {"two squares on a disk", zoo::quad_grid(2, 1), zoo::grid_disk(6, 5)}};
    Random random(seed);
    std::vector<Instance> instances;
    while (instances.size() < static_cast<std::size_t>(count)) {
        const Ground& ground = grounds[instances.size() % grounds.size()];
        const TriangleMesh mesh(ground.target);
        std::vector<Index> inner;
        for (Index v = 0; v < mesh.vertex_count(); ++v) {
            if (!mesh.is_boundary_vertex(v)) {
                inner.push_back(v);
            }
        }
        std::vector<Index> landmarks;
        for (Index v = 0; v < ground.layout.vertex_count(); ++v) {
            const std::size_t place = random.below(inner.size());
            landmarks.push_back(inner[place]);
            inner.erase(inner.begin() + static_cast<std::ptrdiff_t>(place));
        }
        instances.push_back({ground.name + " " + std::to_string(instances.size()),
                             test::problem_of(ground.layout, ground.target, landmarks)});
    }
    return instances;
}

TEST(ExactSolver, finds_the_best_of_all_selections_that_leave_the_holes_where_they_belong)
{
    int without_start = 0;
    for (const Instance& instance : instances_with_holes(207, 18)) {
        SCOPED_TRACE(instance.name);
        const ExactRun run(instance.problem, {});
        ASSERT_NE(run.solver.incumbent_cost(), kInfiniteLength);
        ASSERT_EQ(run.solver.lower_bound(), run.solver.incumbent_cost());
        const test::AllSelections all(instance.problem, run.solver.incumbent_cost() + 1);
        EXPECT_EQ(run.solver.incumbent_cost(), all.best());
        expect_same_by_branch_and_bound(instance.problem, run);
        SequenceSolverOptions greedy_only = best_sequence();
        greedy_only.branch_and_bound.max_states = 1;
        const SequenceRun sequences(instance.problem, greedy_only);
        without_start += sequences.solver.incumbent_cost() == kInfiniteLength ? 1 : 0;
    }
    EXPECT_GT(without_start, 2);
}

TEST(ExactSolver, finds_the_best_of_all_selections_that_comply_with_constraints)
{
    int dearer = 0;
    int others_follow = 0;
    int count = 0;
    Random random(208);
    std::vector<Instance> instances = test::tiny_instances(209, 24);
    for (Instance& instance : instances_with_holes(210, 3)) {
        instances.push_back(std::move(instance));
    }
    for (const Instance& instance : instances) {
        SCOPED_TRACE(instance.name);
        const Layout& layout = *instance.problem.layout;
        const ExactRun free(instance.problem, {});
        ASSERT_NE(free.solver.incumbent_cost(), kInfiniteLength);
        const auto edge = static_cast<Index>(random.below(layout.edge_count()));
        const auto before = free.solver.incumbent().paths[edge].darts;

        ExactSolverOptions options;
        options.constraints = {{edge, false, before}};
        const ExactRun avoiding(instance.problem, options, 5000, 200'000);
        if (!avoiding.has_finished) {
            continue;  // on such coarse targets the next route can be very long
        }
        const Length cost = avoiding.solver.incumbent_cost();
        ASSERT_NE(cost, kInfiniteLength);
        EXPECT_EQ(avoiding.solver.lower_bound(), cost);
        EXPECT_GE(cost, free.solver.incumbent_cost());
        const test::AllSelections others(
            instance.problem, cost + 1,
            {.admits = [&](Index e, const auto& darts) { return e != edge || darts != before; }});
        EXPECT_EQ(cost, others.best());
        const auto after = avoiding.solver.incumbent().paths[edge].darts;
        EXPECT_NE(after, before);

        // Kept along a walk of the same class that goes there and back on its way.
        auto detour = after;
        const PathGraph& graph = avoiding.graph;
        const Index aside = graph.first_dart(graph.head(after[0]));
        const bool is_free = graph.head(aside) != graph.tail(after[0]) &&
                             graph.element(graph.head(aside)).kind != NodeKind::vertex;
        if (is_free) {
            detour.insert(detour.begin() + 1, {aside, graph.twin(aside)});
        }
        options.constraints = {{edge, true, detour}};
        const ExactRun keeping(instance.problem, options);
        EXPECT_EQ(keeping.solver.incumbent_cost(), cost);
        EXPECT_EQ(keeping.solver.lower_bound(), cost);
        EXPECT_EQ(keeping.solver.incumbent().paths[edge].darts, after);

        // Kept as before, and an edge that is not may be where it was.
        options.constraints = {{edge, true, before}};
        const ExactRun again(instance.problem, options);
        EXPECT_EQ(again.solver.incumbent_cost(), free.solver.incumbent_cost());

        ++count;
        dearer += cost > free.solver.incumbent_cost() ? 1 : 0;
        for (Index e = 0; e < layout.edge_count(); ++e) {
            if (e != edge && avoiding.solver.incumbent().paths[e].darts !=
                                 free.solver.incumbent().paths[e].darts) {
                ++others_follow;
                break;
            }
        }
    }
    EXPECT_EQ(dearer, count);
    EXPECT_GT(count, 6);
    EXPECT_GT(others_follow, 3);
}

TEST(ExactSolver, finds_the_next_best_embeddings_in_order)
{
    constexpr std::size_t kCount = 4;
    int several_edges = 0;
    int chains = 0;
    std::vector<Instance> instances = test::tiny_instances(214, 18);
    for (Instance& instance : instances_with_holes(215, 3)) {
        instances.push_back(std::move(instance));
    }
    for (const Instance& instance : instances) {
        SCOPED_TRACE(instance.name);
        ExactSolverOptions options;
        std::vector<Length> costs;
        while (costs.size() < kCount) {
            const ExactRun run(instance.problem, options, 5000, 400'000);
            if (!run.has_finished) {
                break;  // on such coarse targets the next one can be very long
            }
            ASSERT_EQ(run.solver.lower_bound(), run.solver.incumbent_cost());
            expect_same_by_branch_and_bound(instance.problem, run, options);
            costs.push_back(run.solver.incumbent_cost());
            options.excluded.emplace_back();
            for (const WeakPath& path : run.solver.incumbent().paths) {
                options.excluded.back().push_back(path.darts);
            }
        }
        if (costs.empty()) {
            continue;
        }
        const test::AllSelections all(instance.problem, costs.back() + 1, {.count = costs.size()});
        EXPECT_EQ(costs, all.costs());
        chains += costs.size() == kCount ? 1 : 0;
        for (std::size_t i = 1; i < options.excluded.size(); ++i) {
            int different = 0;
            for (std::size_t e = 0; e < options.excluded[i].size(); ++e) {
                different += options.excluded[i][e] != options.excluded[0][e] ? 1 : 0;
            }
            several_edges += different > 1 ? 1 : 0;
        }
    }
    EXPECT_GT(chains, 10);
    EXPECT_GT(several_edges, 10);
}

TEST(ExactSolver, finds_the_best_of_all_selections_with_weighted_edges)
{
    Random random(216);
    int other = 0;
    for (Instance& instance : test::tiny_instances(217, 60)) {
        SCOPED_TRACE(instance.name);
        std::vector<double> weights;
        for (Index e = 0; e < instance.problem.layout->edge_count(); ++e) {
            weights.push_back(std::exp2(4 * random.unit() - 2));
        }
        EmbeddingProblem weighted = instance.problem;
        weighted.weights = EdgeWeights(weights);
        const PathGraph::Options graph{.headroom = weighted.weights.largest()};
        const ExactRun run(weighted, {}, UINT64_MAX, UINT64_MAX, graph);
        ASSERT_EQ(run.solver.lower_bound(), run.solver.incumbent_cost());
        const test::AllSelections all(weighted, run.solver.incumbent_cost() + 1, {.graph = graph});
        EXPECT_EQ(run.solver.incumbent_cost(), all.best());
        expect_same_by_branch_and_bound(weighted, run, {}, graph);
        const SequenceRun sequences(weighted, best_sequence(), UINT64_MAX, UINT64_MAX, graph);
        EXPECT_GE(sequences.solver.incumbent_cost(), run.solver.incumbent_cost());
        EXPECT_EQ(sequences.solver.lower_bound(), sequences.solver.incumbent_cost());

        // The embedding that is best without weights costs more in them, or is the same.
        const ExactRun plain(instance.problem, {}, UINT64_MAX, UINT64_MAX, graph);
        const Length cost = test::total_cost(weighted, run.graph, plain.solver.incumbent());
        EXPECT_LE(run.solver.incumbent_cost(), cost);
        other += run.solver.incumbent_cost() < cost ? 1 : 0;
    }
    EXPECT_GT(other, 5);
}

TEST(ExactSolver, says_so_where_no_embedding_complies_with_constraints)
{
    const Instance instance = test::tiny_instances(211, 1)[0];
    const ExactRun free(instance.problem, {});
    const auto& darts = free.solver.incumbent().paths[0].darts;
    ExactSolverOptions options;
    options.constraints = {{0, true, darts}, {0, false, darts}};
    const ExactRun none(instance.problem, options);
    EXPECT_EQ(none.solver.incumbent_cost(), kInfiniteLength);
    EXPECT_EQ(none.solver.lower_bound(), kInfiniteLength);
}

TEST(ExactSolver, is_never_worse_than_the_best_insertion_sequence_nor_bounds_what_is_better)
{
    int equal = 0;
    int count = 0;
    std::vector<Instance> instances = test::tiny_instances(202, 120);
    for (Instance& instance : small_instances(203, 12)) {
        instances.push_back(std::move(instance));
    }
    for (const Instance& instance : instances) {
        SCOPED_TRACE(instance.name);
        const ExactRun exact(instance.problem, {});
        const SequenceRun sequences(instance.problem, best_sequence());
        EXPECT_EQ(exact.solver.lower_bound(), exact.solver.incumbent_cost());
        EXPECT_LE(exact.solver.incumbent_cost(), sequences.solver.incumbent_cost());
        ++count;
        equal += exact.solver.incumbent_cost() == sequences.solver.incumbent_cost() ? 1 : 0;
    }
    // There are instances where no insertion sequence is best; they are rare.
    EXPECT_GT(equal, 9 * count / 10);
}

TEST(ExactSolver, is_better_than_every_insertion_sequence_where_paths_block_each_other_in_a_circle)
{
    const auto& [name, problem] = test::smallest_counterexample();
    const ExactRun exact(problem, {});
    const SequenceRun sequences(problem, best_sequence());
    ASSERT_EQ(exact.solver.lower_bound(), exact.solver.incumbent_cost());
    ASSERT_EQ(sequences.solver.lower_bound(), sequences.solver.incumbent_cost());
    EXPECT_EQ(sequences.solver.bound_scope(), BoundScope::insertion_sequences);
    const test::AllSelections all(problem, sequences.solver.incumbent_cost());
    EXPECT_EQ(exact.solver.incumbent_cost(), all.best());
    EXPECT_GT(static_cast<double>(sequences.solver.incumbent_cost()),
              1.005 * static_cast<double>(all.best()));
}

TEST(ExactSolver, slices_change_neither_what_happens_nor_when)
{
    for (const Instance& instance : small_instances(204, 10)) {
        SCOPED_TRACE(instance.name);
        for (const std::uint64_t patience : {200'000U, 2000U, 0U}) {
            ExactSolverOptions options;
            options.patience = patience;
            const ExactRun whole(instance.problem, options, UINT64_MAX, 1'000'000);
            for (const std::uint64_t slice : {7U, 500U}) {
                const ExactRun sliced(instance.problem, options, slice, 1'000'000);
                if (!whole.has_finished || !sliced.has_finished) {
                    continue;
                }
                EXPECT_EQ(sliced.happened, whole.happened);
                EXPECT_EQ(sliced.solver.incumbent_cost(), whole.solver.incumbent_cost());
                EXPECT_EQ(sliced.solver.incumbent_order(), whole.solver.incumbent_order());
                EXPECT_EQ(sliced.solver.counters().expansions, whole.solver.counters().expansions);
            }
        }
    }
}

TEST(ExactSolver, stops_at_the_gap_asked_for)
{
    int stopped = 0;
    for (const Instance& instance : small_instances(205, 14)) {
        SCOPED_TRACE(instance.name);
        const ExactRun whole(instance.problem, {});
        const ExactRun rough(instance.problem, {.gap = 0.1, .constraints = {}, .excluded = {}});
        const Length cost = rough.solver.incumbent_cost();
        EXPECT_GE(rough.solver.lower_bound(), cost - cost / 10);
        EXPECT_LE(rough.solver.lower_bound(), whole.solver.incumbent_cost());
        stopped += rough.work < whole.work ? 1 : 0;
    }
    EXPECT_GT(stopped, 3);
}

TEST(ExactSolver, proves_embeddings_on_surfaces_of_higher_genus)
{
    Random random(206);
    int count = 0;
    std::uint64_t selections = 0;
    const auto solve = [&](const std::string& name, const PolygonMesh& layout,
                           const PolygonMesh& target, const std::vector<Index>& landmarks) {
        SCOPED_TRACE(name);
        const auto problem = test::problem_of(layout, target, landmarks);
        const ExactRun run(problem, {});
        EXPECT_NE(run.solver.incumbent_cost(), kInfiniteLength);
        EXPECT_EQ(run.solver.lower_bound(), run.solver.incumbent_cost());
        ExactSolverOptions options;
        options.faces = false;
        const ExactRun without_faces(problem, options);
        EXPECT_EQ(without_faces.solver.incumbent_cost(), run.solver.incumbent_cost());
        selections += run.solver.counters().states_created;
        ++count;
    };
    const PolygonMesh ring = zoo::torus(9, 6);
    for (int i = 0; i < 4; ++i) {
        solve("torus", zoo::quad_torus(3, 3), ring,
              zoo::displaced_landmarks(zoo::quad_torus(3, 3), ring, 0.2, random.bits()));
    }
    for (int i = 0; i < 4; ++i) {
        solve("torus of triangles", zoo::torus(3, 3), zoo::torus(8, 8),
              zoo::displaced_landmarks(zoo::torus(3, 3), zoo::torus(8, 8), 0.3, random.bits()));
        solve("two handles", zoo::slab(2, 0), zoo::slab(2, 1),
              zoo::displaced_landmarks(zoo::slab(2, 0), zoo::slab(2, 1), 0.2, random.bits()));
    }
    EXPECT_EQ(count, 12);
    EXPECT_GT(selections, 12U);
}

TEST(ExactSolver, no_part_changes_the_optimum)
{
    // Without exploration some instances take very long.
    constexpr std::uint64_t kMaxWork = 1'000'000;
    int finished = 0;
    std::uint64_t work[3] = {};
    for (const Instance& instance : small_instances(431, 24)) {
        SCOPED_TRACE(instance.name);
        const ExactRun whole(instance.problem, {});
        const Length optimum = whole.solver.incumbent_cost();
        ExactSolverOptions options;
        options.local_search = false;
        const ExactRun without_local_search(instance.problem, options);
        EXPECT_EQ(without_local_search.solver.incumbent_cost(), optimum);
        options = {};
        options.exploration = false;
        const ExactRun without_exploration(instance.problem, options, kMaxWork / 100, kMaxWork);
        EXPECT_LE(without_exploration.solver.lower_bound(), optimum);
        if (without_exploration.has_finished) {
            ++finished;
            EXPECT_EQ(without_exploration.solver.incumbent_cost(), optimum);
        }
        options = {};
        options.faces = false;
        const ExactRun without_faces(instance.problem, options);
        EXPECT_EQ(without_faces.solver.incumbent_cost(), optimum);
        work[0] += whole.work;
        work[1] += without_local_search.work;
        work[2] += without_faces.work;
    }
    EXPECT_GT(finished, 5);
    EXPECT_NE(work[1], work[0]);
    EXPECT_NE(work[2], work[0]);
}

}  // namespace
}  // namespace layout_embedding
