// Jobs: created, stepped from outside, asked for events and results, cancelled, destroyed.
#include <algorithm>
#include <limits>

#include "apps/embed_job.hh"
#include "boundary/boundary.hh"
#include "embedding/check_input.hh"
#include "embedding/refined_obj.hh"

namespace layout_embedding::boundary {

namespace {

/// WebAssembly addresses 4 GiB; some of it is stack, fragments and the inputs themselves.
constexpr std::uint64_t kAddressableBytes = 3'800'000'000;

JobObject& job_object(std::uint32_t handle)
{
    return handles<JobObject>().get(handle);
}

std::vector<double> as_numbers(const EmbedEvent& event)
{
    return {static_cast<double>(event.kind),
            static_cast<double>(event.phase),
            event.seconds,
            static_cast<double>(event.work),
            event.cost,
            event.lower_bound,
            event.progress};
}

/// Offsets of a list of lists.
template <typename T>
std::vector<Index> offsets_of(const std::vector<std::vector<T>>& lists)
{
    std::vector<Index> offsets{0};
    for (const auto& list : lists) {
        offsets.push_back(offsets.back() + static_cast<Index>(list.size()));
    }
    return offsets;
}

template <typename T>
std::vector<T> flattened(const std::vector<std::vector<T>>& lists)
{
    std::vector<T> flat;
    for (const auto& list : lists) {
        flat.insert(flat.end(), list.begin(), list.end());
    }
    return flat;
}

std::vector<std::vector<WeakPoint>> weak_paths(const EmbedJob& job)
{
    const PathGraph* graph = job.graph();
    if (graph == nullptr) {
        return {};
    }
    return weak_points(*job.problem().target, *graph, job.result().weak);
}

/// Runs `body` on the refined mesh; false, with no error set, where there is none.
template <typename Body>
std::uint32_t with_refined(std::uint32_t handle, Body body)
{
    return guarded(0U, [&] {
        const auto& refined = job_object(handle).job.result().refined;
        if (!refined) {
            return 0U;
        }
        body(*refined);
        return 1U;
    });
}

}  // namespace

/// Makes a job from a layout, a target and `landmark_count` target vertex ids; they are checked
/// together. `vertex_costs` and `feature_discount` as in PathMetric, the former with 0 or as many
/// numbers as target vertices; `boundary_is_followed` as in EmbedOptions. `constraint_count`
/// constraints on paths: the layout edge, 1 to keep or 0 to avoid, and a path as
/// boundary_job_weak_points() gives them. `edge_weights`: 0 or as many as layout edges.
/// `excluded_count` embeddings that are not to be found: how many paths each has, and all these
/// paths. `given_count` paths of an embedding that is to be taken as it is, or 0. Returns its
/// handle.
BOUNDARY_EXPORT(boundary_job_create)
std::uint32_t boundary_job_create(
    std::uint32_t layout, std::uint32_t target, const Index* landmarks, std::size_t landmark_count,
    std::uint32_t algorithm, double gap, std::uint64_t seed, double time_limit,
    std::uint64_t work_limit, double memory_limit, std::uint32_t shape,
    std::uint32_t look_for_doubts, std::uint32_t boundary_is_followed, const double* vertex_costs,
    std::size_t vertex_cost_count, double feature_discount, const Index* constrained_edges,
    const std::uint32_t* are_kept, const WeakPoint* path_points, const Index* path_offsets,
    std::size_t constraint_count, const double* edge_weights, std::size_t edge_weight_count,
    const std::uint32_t* excluded_sizes, const WeakPoint* excluded_points,
    const Index* excluded_offsets, std::size_t excluded_count, const WeakPoint* given_points,
    const Index* given_offsets, std::size_t given_count)
{
    return guarded(0U, [&] {
        auto problem = make_problem(handles<LayoutObject>().get(layout).layout,
                                    handles<TargetObject>().get(target).target,
                                    {landmarks, landmarks + landmark_count});
        if (!problem) {
            set_error(problem.error());
            return 0U;
        }
        EmbedOptions options;
        options.algorithm = static_cast<Algorithm>(algorithm);
        options.gap = gap;
        options.seed = seed;
        options.time_limit = time_limit;
        if (work_limit != UINT64_MAX) {
            options.work_limit = work_limit;
        }
        options.shape = static_cast<PathShape>(shape);
        options.look_for_doubts = look_for_doubts != 0;
        options.boundary_is_followed = boundary_is_followed != 0;
        options.memory_limit = memory_limit < static_cast<double>(kAddressableBytes)
                                   ? static_cast<std::uint64_t>(std::max(0.0, memory_limit))
                                   : kAddressableBytes;
        options.metric = {{vertex_costs, vertex_costs + vertex_cost_count}, feature_discount};
        auto paths = unflattened(path_points, path_offsets, constraint_count);
        for (std::size_t i = 0; i < constraint_count; ++i) {
            options.constraints.push_back(
                {constrained_edges[i], are_kept[i] != 0, std::move(paths[i])});
        }
        options.edge_weights.assign(edge_weights, edge_weights + edge_weight_count);
        const Index* offsets = excluded_offsets;
        for (std::size_t i = 0; i < excluded_count; ++i) {
            options.excluded.push_back(unflattened(excluded_points, offsets, excluded_sizes[i]));
            offsets += excluded_sizes[i];
        }
        options.given = unflattened(given_points, given_offsets, given_count);
        return handles<JobObject>().add(
            std::make_unique<JobObject>(JobObject{EmbedJob(std::move(*problem), std::move(options)),
                                                  handles<TargetObject>().get(target).attributes}));
    });
}

/// Works for at most so many milliseconds and units of work: 1 while there is more to do, 0 once
/// the job has ended, kFailed where it could not be stepped.
BOUNDARY_EXPORT(boundary_job_step)
std::int32_t boundary_job_step(std::uint32_t job, double milliseconds, std::uint64_t work)
{
    return guarded(kFailed, [&] {
        const bool more = job_object(job).job.step({milliseconds, work});
        return static_cast<std::int32_t>(more);
    });
}

/// Ends the search at the next step; the best embedding so far is still realised.
BOUNDARY_EXPORT(boundary_job_cancel) std::uint32_t boundary_job_cancel(std::uint32_t job)
{
    return guarded(0U, [&] {
        job_object(job).job.cancel();
        return 1U;
    });
}

/// Gives the paths of a job that has ended with an embedding another shape, to be stepped again; 0,
/// with no error set, where there is no embedding.
BOUNDARY_EXPORT(boundary_job_reshape)
std::uint32_t boundary_job_reshape(std::uint32_t job, std::uint32_t shape)
{
    return guarded(0U, [&] {
        return static_cast<std::uint32_t>(
            job_object(job).job.reshape(static_cast<PathShape>(shape)));
    });
}

/// Views the events from place `first` on as 7 doubles each: kind, phase, seconds, work, cost,
/// lower bound, progress.
BOUNDARY_EXPORT(boundary_job_events)
std::uint32_t boundary_job_events(std::uint32_t job, std::uint32_t first)
{
    return guarded(0U, [&] {
        const std::vector<EmbedEvent>& events = job_object(job).job.events();
        std::vector<double> numbers;
        for (std::size_t i = first; i < events.size(); ++i) {
            const std::vector<double> row = as_numbers(events[i]);
            numbers.insert(numbers.end(), row.begin(), row.end());
        }
        set_owned_view(numbers);
        return 1U;
    });
}

/// Views the state as 21 doubles: status, bound scope, cost, lower bound, gap, seconds, CPU
/// seconds, work, searches, expansions, field nodes, insertions, remembered answers, states
/// created, expanded, pruned and redundant, dead ends, ties, smallest angle and area.
BOUNDARY_EXPORT(boundary_job_state) std::uint32_t boundary_job_state(std::uint32_t job)
{
    return guarded(0U, [&] {
        const EmbedResult& result = job_object(job).job.result();
        const EmbedCounters& counters = result.counters;
        set_owned_view(std::vector<double>{static_cast<double>(result.status),
                                           static_cast<double>(result.bound_scope),
                                           result.cost,
                                           result.lower_bound,
                                           result.gap,
                                           result.seconds,
                                           result.cpu_seconds,
                                           static_cast<double>(counters.work),
                                           static_cast<double>(counters.searches),
                                           static_cast<double>(counters.expansions),
                                           static_cast<double>(counters.field_nodes),
                                           static_cast<double>(counters.insertions),
                                           static_cast<double>(counters.remembered),
                                           static_cast<double>(counters.states_created),
                                           static_cast<double>(counters.states_expanded),
                                           static_cast<double>(counters.states_pruned),
                                           static_cast<double>(counters.states_redundant),
                                           static_cast<double>(counters.dead_ends),
                                           static_cast<double>(counters.ties),
                                           result.quality.smallest_angle,
                                           result.quality.smallest_area});
        return 1U;
    });
}

/// Views the exact cost and lower bound as two 64-bit integers; all bits set: no embedding.
BOUNDARY_EXPORT(boundary_job_exact) std::uint32_t boundary_job_exact(std::uint32_t job)
{
    return guarded(0U, [&] {
        const EmbedResult& result = job_object(job).job.result();
        set_owned_view(std::vector<Length>{result.exact_cost, result.exact_lower_bound});
        return 1U;
    });
}

/// Views the doubts about the input as 4 doubles each: kind, two layout vertices (kNone where there
/// are none), cost.
BOUNDARY_EXPORT(boundary_job_doubts) std::uint32_t boundary_job_doubts(std::uint32_t job)
{
    return guarded(0U, [&] {
        std::vector<double> numbers;
        for (const LandmarkDoubt& doubt : job_object(job).job.result().doubts) {
            numbers.insert(numbers.end(),
                           {static_cast<double>(doubt.kind), static_cast<double>(doubt.a),
                            static_cast<double>(doubt.b), doubt.cost});
        }
        set_owned_view(numbers);
        return 1U;
    });
}

/// Views the sentence about a doubt.
BOUNDARY_EXPORT(boundary_job_doubt_message)
std::uint32_t boundary_job_doubt_message(std::uint32_t job, std::size_t place)
{
    return guarded(0U, [&] {
        set_view(std::string_view(job_object(job).job.result().doubts.at(place).message));
        return 1U;
    });
}

/// Makes the job's own error the last one; only for a job that failed or ran out of memory.
BOUNDARY_EXPORT(boundary_job_error) std::uint32_t boundary_job_error(std::uint32_t job)
{
    return guarded(0U, [&] {
        set_error(job_object(job).job.error());
        return 1U;
    });
}

/// Views the layout edges in the order in which they were embedded.
BOUNDARY_EXPORT(boundary_job_insertion_order)
std::uint32_t boundary_job_insertion_order(std::uint32_t job)
{
    return guarded(0U, [&] {
        set_view(job_object(job).job.result().insertion_order);
        return 1U;
    });
}

/// The job's paths are to be drawn (paths.cc).
BOUNDARY_EXPORT(boundary_job_paths) std::uint32_t boundary_job_paths(std::uint32_t job)
{
    return guarded(0U, [&] {
        drawn_paths() = job_object(job).job.paths();
        return 1U;
    });
}

/// The weak paths, in two views: points (3 target vertex ids each, unused places all bits set) and
/// the first point of each path.
BOUNDARY_EXPORT(boundary_job_weak_points) std::uint32_t boundary_job_weak_points(std::uint32_t job)
{
    return guarded(0U, [&] {
        set_owned_view(flattened(weak_paths(job_object(job).job)));
        return 1U;
    });
}

BOUNDARY_EXPORT(boundary_job_weak_offsets)
std::uint32_t boundary_job_weak_offsets(std::uint32_t job)
{
    return guarded(0U, [&] {
        set_owned_view(offsets_of(weak_paths(job_object(job).job)));
        return 1U;
    });
}

/// Views the share of each layout edge in the cost; empty without an embedding.
BOUNDARY_EXPORT(boundary_job_edge_costs) std::uint32_t boundary_job_edge_costs(std::uint32_t job)
{
    return guarded(0U, [&] {
        set_view(job_object(job).job.result().edge_costs);
        return 1U;
    });
}

/// Views the lengths of the chains in the shape `even`; empty without an embedding.
BOUNDARY_EXPORT(boundary_job_even_lengths)
std::uint32_t boundary_job_even_lengths(std::uint32_t job)
{
    return guarded(0U, [&] {
        set_view(job_object(job).job.result().even_lengths);
        return 1U;
    });
}

/// The refined mesh, array by array; each function returns 0 where there is none.
BOUNDARY_EXPORT(boundary_job_refined_positions)
std::uint32_t boundary_job_refined_positions(std::uint32_t job)
{
    return with_refined(job, [](const RefinedMesh& mesh) { set_view(mesh.positions); });
}

BOUNDARY_EXPORT(boundary_job_refined_corners)
std::uint32_t boundary_job_refined_corners(std::uint32_t job)
{
    return with_refined(job, [](const RefinedMesh& mesh) { set_view(mesh.corners); });
}

BOUNDARY_EXPORT(boundary_job_refined_vertex_faces)
std::uint32_t boundary_job_refined_vertex_faces(std::uint32_t job)
{
    return with_refined(job, [](const RefinedMesh& mesh) { set_view(mesh.vertex_faces); });
}

BOUNDARY_EXPORT(boundary_job_refined_vertex_barycentrics)
std::uint32_t boundary_job_refined_vertex_barycentrics(std::uint32_t job)
{
    return with_refined(job, [](const RefinedMesh& mesh) { set_view(mesh.vertex_barycentrics); });
}

BOUNDARY_EXPORT(boundary_job_refined_triangle_faces)
std::uint32_t boundary_job_refined_triangle_faces(std::uint32_t job)
{
    return with_refined(job, [](const RefinedMesh& mesh) { set_view(mesh.triangle_faces); });
}

BOUNDARY_EXPORT(boundary_job_refined_triangle_patches)
std::uint32_t boundary_job_refined_triangle_patches(std::uint32_t job)
{
    return with_refined(job, [](const RefinedMesh& mesh) { set_view(mesh.triangle_patches); });
}

/// Views the refined mesh as OBJ, with patches as groups and chains as lines, and nothing else.
BOUNDARY_EXPORT(boundary_job_write_obj) std::uint32_t boundary_job_write_obj(std::uint32_t job)
{
    return with_refined(job,
                        [](const RefinedMesh& mesh) { set_owned_view(write_refined_obj(mesh)); });
}

BOUNDARY_EXPORT(boundary_job_chain_vertices)
std::uint32_t boundary_job_chain_vertices(std::uint32_t job)
{
    return with_refined(job,
                        [](const RefinedMesh& mesh) { set_owned_view(flattened(mesh.chains)); });
}

BOUNDARY_EXPORT(boundary_job_chain_offsets)
std::uint32_t boundary_job_chain_offsets(std::uint32_t job)
{
    return with_refined(job,
                        [](const RefinedMesh& mesh) { set_owned_view(offsets_of(mesh.chains)); });
}

}  // namespace layout_embedding::boundary
