#include "apps/embed_job.hh"

#include <algorithm>
#include <gtest/gtest.h>

#include "embedding/checker.hh"
#include "embedding_checks.hh"
#include "instances.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

constexpr std::uint64_t kUnlimited = UINT64_MAX;

/// What goes in, as it is read from files.
struct Input {
    std::string name;
    PolygonMesh layout;
    PolygonMesh target;
    std::vector<Index> landmarks;

    EmbeddingProblem problem() const { return test::problem_of(layout, target, landmarks); }
};

std::vector<Input> all_inputs()
{
    std::vector<Input> inputs;
    std::uint64_t seed = 80;
    for (const auto& target :
         {zoo::bumpy_sphere(2, 1), zoo::icosphere(1), zoo::stretched_sphere(2, {1, 0.2, 3})}) {
        for (const auto& layout : {zoo::cube(), zoo::icosahedron(), zoo::hull(9, 3),
                                   zoo::polygon_hull(12, 4), zoo::quad_grid(2, 2)}) {
            const auto count = static_cast<Index>(layout.positions.size());
            inputs.push_back({"sphere " + std::to_string(seed), layout, target,
                              zoo::random_landmarks(target, count, seed)});
            ++seed;
        }
    }
    for (const auto& layout : {zoo::wheel(5), zoo::quad_grid(2, 2)}) {
        const PolygonMesh target = zoo::grid_disk(9, 8);
        inputs.push_back(
            {"disk", layout, target, zoo::displaced_landmarks(layout, target, 0, ++seed)});
    }
    return inputs;
}

/// Runs a job to its end in slices of `work` expansions.
void finish(EmbedJob& job, std::uint64_t work = kUnlimited)
{
    while (job.step({std::numeric_limits<double>::infinity(), work})) {
    }
}

EmbedOptions with_seed(std::uint64_t seed, Algorithm algorithm = Algorithm::branch_and_bound)
{
    EmbedOptions options;
    options.algorithm = algorithm;
    options.seed = seed;
    options.work_limit = 300000;
    // Landmarks at random are doubtful; what is made of that has tests of its own.
    options.look_for_doubts = false;
    return options;
}

constexpr Algorithm kAllKinds[] = {Algorithm::greedy, Algorithm::branch_and_bound,
                                   Algorithm::exact};

void expect_same_events(const std::vector<EmbedEvent>& a, const std::vector<EmbedEvent>& b)
{
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].kind, b[i].kind);
        EXPECT_EQ(a[i].phase, b[i].phase);
        EXPECT_EQ(a[i].work, b[i].work);
        EXPECT_EQ(a[i].cost, b[i].cost);
        EXPECT_EQ(a[i].lower_bound, b[i].lower_bound);
        EXPECT_EQ(a[i].progress, b[i].progress);
    }
}

void expect_same_results(const EmbedResult& a, const EmbedResult& b)
{
    EXPECT_EQ(a.status, b.status);
    EXPECT_EQ(a.bound_scope, b.bound_scope);
    EXPECT_EQ(a.cost, b.cost);
    EXPECT_EQ(a.lower_bound, b.lower_bound);
    EXPECT_EQ(a.exact_cost, b.exact_cost);
    EXPECT_EQ(a.exact_lower_bound, b.exact_lower_bound);
    EXPECT_EQ(a.gap, b.gap);
    EXPECT_EQ(a.insertion_order, b.insertion_order);
    ASSERT_EQ(a.weak.paths.size(), b.weak.paths.size());
    for (std::size_t e = 0; e < a.weak.paths.size(); ++e) {
        EXPECT_EQ(a.weak.paths[e].darts, b.weak.paths[e].darts);
        EXPECT_EQ(a.weak.paths[e].lanes, b.weak.paths[e].lanes);
    }
    EXPECT_EQ(a.counters.searches, b.counters.searches);
    EXPECT_EQ(a.counters.expansions, b.counters.expansions);
    EXPECT_EQ(a.counters.field_nodes, b.counters.field_nodes);
    EXPECT_EQ(a.counters.insertions, b.counters.insertions);
    EXPECT_EQ(a.counters.remembered, b.counters.remembered);
    EXPECT_EQ(a.counters.states_created, b.counters.states_created);
    EXPECT_EQ(a.counters.states_pruned, b.counters.states_pruned);
    EXPECT_EQ(a.counters.work, b.counters.work);
    EXPECT_EQ(a.counters.ties, b.counters.ties);
    ASSERT_EQ(a.refined.has_value(), b.refined.has_value());
    if (a.refined) {
        EXPECT_EQ(a.refined->positions, b.refined->positions);
        EXPECT_EQ(a.refined->corners, b.refined->corners);
        EXPECT_EQ(a.refined->chains, b.refined->chains);
        EXPECT_EQ(a.refined->triangle_patches, b.refined->triangle_patches);
    }
}

void expect_monotone(const std::vector<EmbedEvent>& events)
{
    ASSERT_FALSE(events.empty());
    EXPECT_EQ(events.front().phase, EmbedPhase::prepare);
    EXPECT_EQ(events.back().phase, EmbedPhase::done);
    for (std::size_t i = 1; i < events.size(); ++i) {
        EXPECT_GE(events[i].phase, events[i - 1].phase);
        EXPECT_GE(events[i].seconds, events[i - 1].seconds);
        EXPECT_GE(events[i].work, events[i - 1].work);
        EXPECT_LE(events[i].cost, events[i - 1].cost);
        EXPECT_GE(events[i].lower_bound, events[i - 1].lower_bound);
        EXPECT_LE(events[i].lower_bound, events[i].cost);
        EXPECT_EQ(events[i].kind == EventKind::phase, events[i].phase != events[i - 1].phase);
        if (events[i].phase == events[i - 1].phase && events[i].kind != EventKind::bound) {
            EXPECT_GE(events[i].progress, events[i - 1].progress);
        }
    }
}

/// The polylines lead from landmark to landmark.
void expect_sound_paths(const EmbedJob& job)
{
    const Polylines lines = job.paths();
    const Layout& layout = *job.problem().layout;
    const auto position = [&](Index v) {
        return job.problem().target->position(job.problem().landmarks[v]);
    };
    ASSERT_EQ(lines.offsets.size(), lines.layout_edges.size() + 1);
    EXPECT_EQ(lines.offsets.back(), lines.points.size());
    for (std::size_t i = 0; i < lines.layout_edges.size(); ++i) {
        const Index e = lines.layout_edges[i];
        EXPECT_GE(lines.offsets[i + 1] - lines.offsets[i], 2U);
        EXPECT_EQ(lines.points[lines.offsets[i]], position(layout.tail(2 * e)));
        EXPECT_EQ(lines.points[lines.offsets[i + 1] - 1], position(layout.head(2 * e)));
    }
}

TEST(EmbedJob, results_are_consistent_and_pass_an_independent_check)
{
    int complete = 0;
    for (const Input& input : all_inputs()) {
        SCOPED_TRACE(input.name);
        const Algorithm algorithm = kAllKinds[complete % 2];
        EmbedJob job(input.problem(), with_seed(1, algorithm));
        finish(job);
        EXPECT_FALSE(job.step());
        expect_monotone(job.events());
        expect_sound_paths(job);
        const EmbedResult& result = job.result();
        if (algorithm == Algorithm::greedy) {
            EXPECT_EQ(result.bound_scope, BoundScope::embeddings);
        }
        EXPECT_GT(result.counters.expansions, 0U);
        EXPECT_GE(result.counters.searches, input.problem().layout->edge_count());
        EXPECT_EQ(result.counters.ties, 0U);
        EXPECT_GE(result.seconds, 0);
        if (result.status == EmbedStatus::none_found) {
            EXPECT_FALSE(result.refined.has_value());
            EXPECT_EQ(result.gap, 1);
            continue;
        }
        ++complete;
        const PathGraph& graph = *job.graph();
        EXPECT_EQ(result.exact_cost, test::total_length(graph, result.weak));
        EXPECT_LE(result.exact_lower_bound, result.exact_cost);
        EXPECT_EQ(result.cost, graph.to_units(result.exact_cost));
        EXPECT_EQ(result.lower_bound, graph.to_units(result.exact_lower_bound));
        EXPECT_NEAR(result.gap, (result.cost - result.lower_bound) / result.cost, 1e-12);
        EXPECT_EQ(result.status, result.exact_cost == result.exact_lower_bound
                                     ? EmbedStatus::optimal
                                 : result.gap <= job.options().gap ? EmbedStatus::gap_reached
                                 : result.counters.work >= job.options().work_limit.value()
                                     ? EmbedStatus::work_limit
                                     : EmbedStatus::feasible);
        EXPECT_GE(result.counters.insertions, result.weak.paths.size());
        auto order = result.insertion_order;
        std::sort(order.begin(), order.end());
        for (Index e = 0; e < order.size(); ++e) {
            EXPECT_EQ(order[e], e);
        }
        EXPECT_EQ(order.size(), result.weak.paths.size());
        EXPECT_EQ(job.paths().layout_edges.size(), result.weak.paths.size());
        test::expect_strands(job.problem(), graph, result.weak);

        // Nothing of the problem's classes goes into this check but the numbers of elements.
        ASSERT_TRUE(result.refined.has_value());
        std::vector<std::array<Index, 2>> edges;
        for (const auto& chain : result.refined->chains) {
            const auto vertex = [&](Index landmark) {
                return static_cast<Index>(
                    std::find(input.landmarks.begin(), input.landmarks.end(), landmark) -
                    input.landmarks.begin());
            };
            edges.push_back({vertex(chain.front()), vertex(chain.back())});
        }
        const TriangleMesh target(input.target);
        std::vector<std::vector<WeakPoint>> points;
        for (const WeakPath& path : result.weak.paths) {
            points.emplace_back();
            for (std::size_t i = 0; i <= path.darts.size(); ++i) {
                const NodeElement at = graph.element(i == 0 ? graph.tail(path.darts[0])
                                                            : graph.head(path.darts[i - 1]));
                const Index h = at.kind == NodeKind::edge_midpoint ? target.halfedge(at.id) : 0;
                points.back().push_back(at.kind == NodeKind::vertex ? WeakPoint{at.id, kNone, kNone}
                                        : at.kind == NodeKind::edge_midpoint
                                            ? WeakPoint{target.tail(h), target.head(h), kNone}
                                            : target.face(at.id));
            }
        }
        const CheckReport report = check_embedding(
            {input.layout, input.target, input.landmarks, *result.refined, edges, points});
        for (const Violation& violation : report.violations) {
            ADD_FAILURE() << violation.code << ": " << violation.message;
        }
    }
    EXPECT_GE(complete, 15);
}

TEST(EmbedJob, slices_change_nothing_but_seconds)
{
    const auto inputs = all_inputs();
    for (std::size_t i = 0; i < inputs.size(); i += 3) {
        SCOPED_TRACE(inputs[i].name);
        EmbedOptions options = with_seed(2, kAllKinds[i % 2]);
        options.work_limit = 20000;
        EmbedJob whole(inputs[i].problem(), options);
        finish(whole);
        for (const std::uint64_t work : {std::uint64_t{1}, std::uint64_t{7}, std::uint64_t{1000}}) {
            EmbedJob sliced(inputs[i].problem(), options);
            std::uint64_t done = 0;
            while (sliced.step({std::numeric_limits<double>::infinity(), work})) {
                // Uninterrupted operations are small.
                EXPECT_LE(sliced.result().counters.work, done + work + 100);
                done = sliced.result().counters.work;
                if (work == 1000) {
                    expect_sound_paths(sliced);
                }
            }
            expect_same_events(sliced.events(), whole.events());
            expect_same_results(sliced.result(), whole.result());
        }
        // A slice of no time at all still makes progress.
        EmbedJob timed(inputs[i].problem(), options);
        while (timed.step({0, kUnlimited})) {
        }
        expect_same_events(timed.events(), whole.events());
        expect_same_results(timed.result(), whole.result());
    }
}

TEST(EmbedJob, a_seed_gives_the_same_result_again_and_another_one_the_same_up_to_its_perturbation)
{
    for (const test::Instance& instance : test::random_instances(81, 15)) {
        SCOPED_TRACE(instance.name);
        EmbedJob first(instance.problem, with_seed(3));
        EmbedJob again(instance.problem, with_seed(3));
        EmbedJob other(instance.problem, with_seed(4));
        finish(first);
        finish(again);
        finish(other);
        expect_same_events(first.events(), again.events());
        expect_same_results(first.result(), again.result());
        const EmbedResult& a = first.result();
        const EmbedResult& b = other.result();
        EXPECT_NE(a.exact_cost, b.exact_cost);
        // Every dart has 32 random low bits.
        std::uint64_t darts = 0;
        for (const EmbedResult* result : {&a, &b}) {
            for (const WeakPath& path : result->weak.paths) {
                darts += path.darts.size();
            }
        }
        const double tolerance = static_cast<double>(darts) * 0x1p32 * first.graph()->unit();
        EXPECT_NEAR(a.cost, b.cost, tolerance);
        EXPECT_NEAR(a.lower_bound, b.lower_bound, tolerance);
    }
}

TEST(EmbedJob, a_work_limit_stops_at_the_same_place_however_the_job_is_sliced)
{
    const Input input = all_inputs()[0];
    for (const Algorithm algorithm : kAllKinds) {
        EmbedOptions options = with_seed(5, algorithm);
        EmbedJob whole(input.problem(), options);
        finish(whole);
        const std::uint64_t needed = whole.result().counters.work;
        ASSERT_LT(needed, options.work_limit.value());
        ASSERT_GT(needed, 1000U);
        int with_incumbent = 0;
        for (const std::uint64_t limit :
             {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{17}, needed / 2, needed - 50}) {
            options.work_limit = limit;
            EmbedJob job(input.problem(), options);
            EmbedJob sliced(input.problem(), options);
            finish(job);
            finish(sliced, 5);
            const EmbedResult& result = job.result();
            EXPECT_EQ(result.status, EmbedStatus::work_limit);
            EXPECT_GE(result.counters.work, limit);
            EXPECT_LE(result.counters.work, limit + 100);
            // What was found until then is kept.
            EXPECT_EQ(result.refined.has_value(), result.exact_cost != kInfiniteLength);
            with_incumbent += result.refined ? 1 : 0;
            EXPECT_LE(result.lower_bound, whole.result().lower_bound);
            EXPECT_GE(result.cost, whole.result().cost);
            expect_monotone(job.events());
            expect_same_results(sliced.result(), result);
            expect_same_events(sliced.events(), job.events());
        }
        EXPECT_EQ(with_incumbent > 0, algorithm != Algorithm::greedy);
        options.work_limit = needed;
        EmbedJob job(input.problem(), options);
        finish(job);
        expect_same_results(job.result(), whole.result());
    }
}

TEST(EmbedJob, can_be_cancelled_at_any_moment_and_keeps_what_it_has)
{
    const Input input = all_inputs()[0];
    {
        EmbedJob never_started(input.problem(), with_seed(6));
        never_started.cancel();
        never_started.cancel();
        finish(never_started);
        EXPECT_EQ(never_started.result().status, EmbedStatus::cancelled);
        EXPECT_EQ(never_started.result().counters.expansions, 0U);
        expect_monotone(never_started.events());
    }
    EmbedOptions options = with_seed(6);
    EmbedJob whole(input.problem(), options);
    finish(whole);
    const std::uint64_t slice = whole.result().counters.work / 400;
    int kept = 0;
    int empty = 0;
    for (int slices = 1; slices < 390; slices += 1 + slices / 4) {
        EmbedJob job(input.problem(), options);
        for (int i = 0; i < slices; ++i) {
            ASSERT_TRUE(job.step({std::numeric_limits<double>::infinity(), slice}));
        }
        const std::uint64_t work = job.result().counters.work;
        job.cancel();
        finish(job);
        EXPECT_FALSE(job.step());
        const EmbedResult& result = job.result();
        EXPECT_EQ(result.status, EmbedStatus::cancelled);
        EXPECT_EQ(result.counters.work, work);
        expect_monotone(job.events());
        if (result.exact_cost == kInfiniteLength) {
            ++empty;
            EXPECT_FALSE(result.refined.has_value());
            EXPECT_TRUE(job.paths().layout_edges.empty());
        } else {
            ++kept;
            ASSERT_TRUE(result.refined.has_value());
            test::expect_valid(job.problem(), *job.graph(), result.weak, *result.refined);
            EXPECT_EQ(result.insertion_order.size(), result.weak.paths.size());
        }
    }
    EXPECT_GT(kept, 3);
    EXPECT_GT(empty, 0);
    // Destroyed in the middle, and moved while running.
    EmbedJob job(input.problem(), with_seed(6));
    ASSERT_TRUE(job.step({std::numeric_limits<double>::infinity(), 50}));
    EmbedJob moved = std::move(job);
    finish(moved);
    EXPECT_TRUE(moved.result().refined.has_value());
    EmbedJob dropped(input.problem(), with_seed(6));
    ASSERT_TRUE(dropped.step({std::numeric_limits<double>::infinity(), 50}));
}

TEST(EmbedJob, paths_can_get_another_shape_without_a_new_search)
{
    for (const Input& input : all_inputs()) {
        SCOPED_TRACE(input.name);
        EmbedOptions options = with_seed(1, Algorithm::greedy);
        EmbedJob job(input.problem(), options);
        EXPECT_FALSE(job.reshape(PathShape::even));
        finish(job);
        if (!job.result().refined) {
            EXPECT_FALSE(job.reshape(PathShape::even));
            continue;
        }
        options.shape = PathShape::even;
        EmbedJob even(input.problem(), options);
        finish(even);
        const EmbedResult before = job.result();
        ASSERT_TRUE(job.reshape(PathShape::even));
        finish(job, 1);
        EXPECT_EQ(job.result().status, before.status);
        expect_same_results(job.result(), even.result());
        ASSERT_TRUE(job.reshape(PathShape::shortened));
        finish(job, 1);
        expect_same_results(job.result(), before);
        EXPECT_EQ(job.result().even_lengths, before.even_lengths);
        double cost = 0;
        for (const double share : before.edge_costs) {
            cost += share;
        }
        EXPECT_NEAR(cost, before.cost, 1e-9 * cost);
    }
}

TEST(EmbedJob, a_shape_can_be_cancelled_and_keeps_paths_as_far_as_they_are)
{
    int cancelled = 0;
    for (const Input& input : all_inputs()) {
        SCOPED_TRACE(input.name);
        EmbedJob job(input.problem(), with_seed(1, Algorithm::greedy));
        finish(job);
        if (!job.result().refined) {
            continue;
        }
        const EmbedResult whole = job.result();
        ASSERT_TRUE(job.reshape(PathShape::shortened));
        for (int steps = 0; steps < 5; ++steps) {
            ASSERT_TRUE(job.step({0, kUnlimited}));
        }
        job.cancel();
        finish(job);
        ASSERT_TRUE(job.result().refined.has_value());
        test::expect_valid(job.problem(), *job.graph(), job.result().weak, *job.result().refined);
        EXPECT_EQ(job.result().exact_cost, whole.exact_cost);
        cancelled += job.result().status == EmbedStatus::cancelled ? 1 : 0;
        // Nothing of it stays.
        ASSERT_TRUE(job.reshape(PathShape::shortened));
        finish(job);
        expect_same_results(job.result(), whole);
    }
    EXPECT_GT(cancelled, 1);
}

TEST(EmbedJob, no_time_at_all_ends_at_the_time_limit)
{
    EmbedOptions options = with_seed(1);
    options.time_limit = 0;
    EmbedJob job(all_inputs()[0].problem(), options);
    finish(job);
    EXPECT_EQ(job.result().status, EmbedStatus::time_limit);
    EXPECT_FALSE(job.result().refined.has_value());
}

TEST(EmbedJob, too_little_memory_is_refused_before_any_work)
{
    const Input input = all_inputs()[0];
    EmbedOptions options = with_seed(1);
    options.memory_limit = 10000;
    EmbedJob job(input.problem(), options);
    finish(job);
    EXPECT_EQ(job.result().status, EmbedStatus::memory_limit);
    EXPECT_EQ(job.error().code, ErrorCode::memoryLimit);
    EXPECT_NE(job.error().message.find(std::to_string(input.target.face_count()) + " triangles"),
              std::string::npos);
    EXPECT_EQ(job.graph(), nullptr);
    EXPECT_EQ(job.result().counters.expansions, 0U);
    EXPECT_TRUE(job.paths().points.empty());
    // With a distance field at a time the result is the same as with all of them.
    EmbedJob whole(input.problem(), with_seed(1));
    finish(whole);
    for (options.memory_limit *= 2; job.result().status == EmbedStatus::memory_limit;
         options.memory_limit += 50000) {
        job = EmbedJob(input.problem(), options);
        finish(job);
    }
    EXPECT_EQ(job.result().exact_cost, whole.result().exact_cost);
    EXPECT_EQ(job.result().insertion_order, whole.result().insertion_order);
}

/// A path graph all of whose edges are equally long in the first `bad_attempts` attempts.
PathGraphMaker tying(std::uint32_t bad_attempts)
{
    return [=](const TriangleMesh& target, const PathGraph::Options& options) {
        PathGraph graph = PathGraph::barycentric(target, options);
        if (options.attempt < bad_attempts) {
            graph.set_lengths(std::vector<Length>(graph.dart_count(), Length{1} << 40U));
        }
        return graph;
    };
}

TEST(EmbedJob, after_a_tie_other_lengths_are_drawn)
{
    const Input input = all_inputs()[0];
    for (const std::uint32_t bad_attempts : {1U, 3U}) {
        EmbedJob job(input.problem(), with_seed(7), tying(bad_attempts));
        finish(job);
        ASSERT_TRUE(job.result().refined.has_value());
        EXPECT_EQ(job.result().counters.ties, bad_attempts);
        EXPECT_EQ(test::total_length(*job.graph(), job.result().weak), job.result().exact_cost);
        // Work done under all perturbations counts.
        std::uint64_t work = 0;
        for (const EmbedEvent& event : job.events()) {
            EXPECT_GE(event.work, work);
            work = event.work;
        }
    }
}

TEST(EmbedJob, ties_under_every_perturbation_are_an_error)
{
    EmbedJob job(all_inputs()[0].problem(), with_seed(7), tying(UINT32_MAX));
    finish(job);
    EXPECT_EQ(job.result().status, EmbedStatus::failed);
    EXPECT_EQ(job.error().code, ErrorCode::unresolvedTie);
    EXPECT_FALSE(job.result().refined.has_value());
}

}  // namespace
}  // namespace layout_embedding
