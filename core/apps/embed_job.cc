#include "apps/embed_job.hh"

#include <algorithm>
#include <chrono>
#include <ctime>

#include "apps/boundary_paths.hh"
#include "apps/path_shaping.hh"
#include "embedding/angle_refinement.hh"
#include "embedding/angle_widening.hh"
#include "embedding/check_input.hh"
#include "embedding/checker.hh"
#include "embedding/realisation.hh"
#include "embedding/straightening.hh"
#include "embedding/weak_to_normal_form.hh"
#include "search/exact_solver.hh"
#include "search/given_solver.hh"
#include "search/greedy_solver.hh"
#include "search/sequence_solver.hh"
#ifdef LAYOUT_EMBEDDING_DEBUG_CHECKS
#include "surface/strand_checker.hh"
#endif

namespace layout_embedding {

namespace {

// Units of work between two looks at the clock; about a millisecond.
constexpr std::uint64_t kWorkPerSlice = 4096;
// Distance fields beyond this are dropped and computed again.
constexpr std::uint64_t kMaxFieldBytes = std::uint64_t{256} << 20U;
// Perturbations drawn before a tie is reported.
constexpr std::uint32_t kMaxAttempts = 8;
// Progress of the paths' shape between two events.
constexpr double kProgressStep = 0.1;

GreedyRule rule_of(Algorithm algorithm)
{
    switch (algorithm) {
        case Algorithm::praun:
            return GreedyRule::praun();
        case Algorithm::kraevoy:
            return GreedyRule::kraevoy();
        case Algorithm::schreiner:
            return GreedyRule::schreiner();
        default:
            return GreedyRule::plain();
    }
}

bool is_heuristic(Algorithm algorithm)
{
    return algorithm == Algorithm::greedy || algorithm == Algorithm::praun ||
           algorithm == Algorithm::kraevoy || algorithm == Algorithm::schreiner;
}

std::unique_ptr<Solver> make_solver(const EmbeddingProblem& problem, const PathGraph& graph,
                                    std::uint64_t field_bytes, const EmbedOptions& options,
                                    std::vector<ClassConstraint> constraints,
                                    std::vector<DartPaths> excluded)
{
    if (options.algorithm == Algorithm::exact) {
        ExactSolverOptions exact;
        exact.gap = options.gap;
        exact.constraints = std::move(constraints);
        exact.excluded = std::move(excluded);
        return std::make_unique<ExactSolver>(problem, graph, field_bytes, exact);
    }
    if (options.algorithm == Algorithm::branch_and_bound) {
        SequenceSolverOptions sequences;
        sequences.branch_and_bound.gap = options.gap;
        return std::make_unique<SequenceSolver>(problem, graph, field_bytes, sequences);
    }
    return std::make_unique<GreedySolver>(problem, graph, field_bytes, rule_of(options.algorithm));
}

/// Bytes that a solver takes for the nodes of the path graph: labels and queue of the search,
/// records, and one distance field.
std::uint64_t estimate_solver_bytes(std::uint64_t nodes)
{
    return nodes * (16 + 16 + 4 + 4);
}

}  // namespace

struct EmbedJob::Implementation {
    using Clock = std::chrono::steady_clock;

    Implementation(EmbeddingProblem problem_in, EmbedOptions options_in, PathGraphMaker maker)
        : problem(std::move(problem_in)),
          options(std::move(options_in)),
          make_graph(std::move(maker))
    {}

    EmbeddingProblem problem;
    EmbedOptions options;
    PathGraphMaker make_graph;
    EmbedPhase phase = EmbedPhase::prepare;
    std::vector<EmbedEvent> events;
    EmbedResult result;
    Error error;
    bool started = false;
    bool cancel_requested = false;
    std::uint32_t attempt = 0;
    Clock::time_point start_time;
    double search_start = 0;
    double cpu_seconds = 0;
    std::uint64_t field_bytes = kMaxFieldBytes;
    /// Of length along target edges, in the metric; empty for 1.
    std::vector<double> edge_costs;
    std::unique_ptr<PathGraph> graph;
    std::unique_ptr<Solver> solver;
    EmbedCounters earlier_attempts;
    std::uint64_t work = 0;
    std::uint64_t first_embedding_work = UINT64_MAX;
    EmbedStatus final_status = EmbedStatus::running;  // once an incumbent is to be realised
    EmbedStatus search_status = EmbedStatus::running;
    std::unique_ptr<PathShaping> shaping;  // while paths get their shape
    double shown_progress = 0;
    Length root_bound = 0;
    std::vector<BoundaryPath> boundary;  // that paths are to follow
    /// What they cost more than the shortest paths of their classes, as far as that is known.
    std::int64_t extra_cost = 0;
    std::unique_ptr<LandmarkDoubts> doubts;  // while alternatives are compared
    bool compared = false;

    double seconds() const
    {
        return std::chrono::duration<double>(Clock::now() - start_time).count();
    }

    void emit(EventKind kind, double progress)
    {
        events.push_back({kind, phase, seconds(), work, result.cost, result.lower_bound, progress});
    }

    void enter(EmbedPhase next)
    {
        phase = next;
        emit(EventKind::phase, next == EmbedPhase::done ? 1 : 0);
    }

    void end(EmbedStatus status)
    {
        result.status = status;
        solver.reset();
        enter(EmbedPhase::done);
    }

    /// Ends the job after a look at what else the input could have meant.
    void end_after_comparison(EmbedStatus status)
    {
        final_status = status;
        const bool stopped = status == EmbedStatus::cancelled || status == EmbedStatus::time_limit;
        // What a heuristic finds may be long for no other reason than the heuristic, what is asked
        // of paths makes others longer, and weights belong to the layout as it is.
        const bool comparable = options.look_for_doubts && !is_heuristic(options.algorithm) &&
                                options.constraints.empty() && options.excluded.empty() &&
                                options.given.empty() && options.edge_weights.empty() &&
                                boundary.empty();
        if (stopped || compared || !comparable) {
            end(status);
            return;
        }
        compared = true;
        solver.reset();
        doubts = std::make_unique<LandmarkDoubts>(
            problem, *graph, field_bytes,
            LandmarkDoubts::Found{result.exact_cost, root_bound,
                                  std::min(work, first_embedding_work)});
    }

    /// Part of the check phase.
    void compare(std::uint64_t max_work)
    {
        WorkBudget budget(max_work);
        const bool over = cancel_requested || seconds() - search_start > options.time_limit;
        const bool more = !over && doubts->run(budget);
        work += budget.spent();
        if (more) {
            return;
        }
        result.doubts = doubts->doubts();
        doubts.reset();
        end(final_status);
    }

    void fail(EmbedStatus status, Error reason)
    {
        error = std::move(reason);
        end(status);
    }

    /// Ends the search: what it has found is realised and checked before the job ends.
    void conclude(EmbedStatus reason)
    {
        if (result.exact_cost == kInfiniteLength) {
            end_after_comparison(reason);
            return;
        }
        final_status = search_status = reason;
        set_lower_bound(solver->lower_bound(), solver->bound_scope());
        result.insertion_order = solver->incumbent_order();
        solver.reset();
        enter(EmbedPhase::realise);
    }

    void update_counters()
    {
        result.counters = earlier_attempts;
        result.counters += solver->counters();
        result.counters.work = work;
    }

    void set_lower_bound(Length bound, BoundScope scope)
    {
        if (bound != kInfiniteLength) {
            bound += static_cast<Length>(extra_cost);
        }
        result.bound_scope = scope;
        result.exact_lower_bound = bound;
        result.lower_bound = to_units(bound);
        set_gap();
    }

    /// A cost in the target's units.
    double to_units(Length cost) const { return graph->to_units(cost) * problem.weights.unit(); }

    void set_gap()
    {
        // Both are exact: equal integers are a gap of exactly zero.
        if (result.exact_cost != kInfiniteLength) {
            result.gap = static_cast<double>(result.exact_cost - result.exact_lower_bound) /
                         static_cast<double>(result.exact_cost);
        }
    }

    void prepare()
    {
        const TriangleMesh& target = *problem.target;
        const std::uint64_t nodes =
            std::uint64_t{target.vertex_count()} + target.edge_count() + target.face_count();
        const std::uint64_t needed =
            PathGraph::estimate_bytes(target.vertex_count(), target.edge_count(),
                                      target.face_count()) +
            estimate_solver_bytes(nodes) +
            (rule_of(options.algorithm).repulsive_guide
                 ? RepulsiveGuide::estimate_bytes(target.vertex_count(),
                                                  problem.layout->vertex_count())
                 : 0);
        if (const Status possible = check_options(options, problem); !possible) {
            fail(EmbedStatus::failed, possible.error());
            return;
        }
        problem.weights = EdgeWeights(options.edge_weights);
        if (needed > options.memory_limit) {
            fail(EmbedStatus::memory_limit,
                 make_error(ErrorCode::memoryLimit,
                            "a target with " + std::to_string(target.face_count()) +
                                " triangles needs about " + std::to_string((needed >> 20U) + 1) +
                                " MB, more than the limit of " +
                                std::to_string(options.memory_limit >> 20U) + " MB"));
            return;
        }
        field_bytes = std::min(kMaxFieldBytes, options.memory_limit - needed);
        if (build_solver()) {
            search_start = seconds();
            enter(EmbedPhase::search);
        }
    }

    /// False if that ended the job.
    bool build_solver()
    {
        solver.reset();
        const PathMetric& metric = options.metric;
        edge_costs = metric.feature_discount > 0
                         ? feature_costs(*problem.target, metric.feature_discount)
                         : std::vector<double>{};
        graph = std::make_unique<PathGraph>(make_graph(
            *problem.target,
            {options.seed, attempt, metric.vertex_costs, edge_costs, problem.weights.largest()}));
        auto constraints = class_constraints(problem, *graph, options.constraints);
        if (!constraints) {
            fail(EmbedStatus::failed, constraints.error());
            return false;
        }
        auto excluded = embedding_darts(problem, *graph, options.excluded);
        if (!excluded) {
            fail(EmbedStatus::failed, excluded.error());
            return false;
        }
        boundary.clear();
        extra_cost = 0;
        if (options.boundary_is_followed) {
            auto paths = boundary_paths(problem, *graph);
            if (!paths) {
                fail(EmbedStatus::failed, paths.error());
                return false;
            }
            boundary = std::move(*paths);
            for (const BoundaryPath& path : boundary) {
                constraints->push_back({path.layout_edge, true, path.darts});
            }
        }
        if (!options.given.empty()) {
            auto given = embedding_darts(problem, *graph, {options.given});
            if (!given) {
                fail(EmbedStatus::failed, given.error());
                return false;
            }
            solver = std::make_unique<GivenSolver>(problem, *graph, std::move(given->front()));
            return true;
        }
        solver = make_solver(problem, *graph, field_bytes, options, std::move(*constraints),
                             std::move(*excluded));
        return true;
    }

    std::uint64_t work_limit() const
    {
        if (options.work_limit) {
            return *options.work_limit;
        }
        if (options.algorithm != Algorithm::branch_and_bound &&
            options.algorithm != Algorithm::exact) {
            return UINT64_MAX;  // ends by itself
        }
        // Until there is an embedding, what two searches of the whole graph per layout edge take.
        const std::uint64_t first =
            first_embedding_work != UINT64_MAX
                ? first_embedding_work
                : std::uint64_t{2} * problem.layout->edge_count() * graph->node_count();
        return first + kDefaultPatience;
    }

    /// Searches for a bounded amount of work.
    void search(std::uint64_t max_work)
    {
        WorkBudget budget(std::min(max_work, work_limit() - std::min(work, work_limit())));
        const auto outcome = solver->run(budget);
        work += budget.spent();
        update_counters();
        switch (outcome) {
            case Solver::Outcome::running:
                if (work >= work_limit()) {
                    conclude(EmbedStatus::work_limit);
                }
                break;
            case Solver::Outcome::bounded:
                // The first bound of all is that of the root: the sum of unconstrained paths.
                root_bound = root_bound == 0 ? solver->lower_bound() : root_bound;
                set_lower_bound(solver->lower_bound(), solver->bound_scope());
                emit(EventKind::bound, solver->progress());
                break;
            case Solver::Outcome::advanced:
                emit(EventKind::progress, solver->progress());
                break;
            case Solver::Outcome::improved:
                accept_incumbent();
                break;
            case Solver::Outcome::finished:
                finish_search();
                break;
            case Solver::Outcome::tied:
                draw_again();
                break;
        }
    }

    void finish_search()
    {
        const bool found = result.exact_cost != kInfiniteLength;
        const Length bound =
            solver->lower_bound() + (found ? static_cast<Length>(extra_cost) : Length{0});
        if (found) {
            const double gap = static_cast<double>(result.exact_cost - bound) /
                               static_cast<double>(result.exact_cost);
            conclude(result.exact_cost == bound ? EmbedStatus::optimal
                     : gap <= options.gap       ? EmbedStatus::gap_reached
                                                : EmbedStatus::feasible);
        } else {
            end_after_comparison(bound == kInfiniteLength &&
                                         solver->bound_scope() == BoundScope::embeddings
                                     ? EmbedStatus::infeasible
                                     : EmbedStatus::none_found);
        }
    }

    void draw_again()
    {
        if (++attempt == kMaxAttempts) {
            fail(EmbedStatus::failed,
                 make_error(ErrorCode::unresolvedTie,
                            "paths of equal length appeared under each of " +
                                std::to_string(kMaxAttempts) + " perturbations"));
            return;
        }
        // Bounds in the old lengths say nothing about the new ones.
        result.exact_lower_bound = 0;
        result.lower_bound = 0;
        result.exact_cost = kInfiniteLength;
        result.cost = std::numeric_limits<double>::infinity();
        result.gap = 1;
        result.weak = {};
        first_embedding_work = UINT64_MAX;
        root_bound = 0;
        earlier_attempts = result.counters;
        ++earlier_attempts.ties;
        result.counters = earlier_attempts;
        build_solver();
    }

    void accept_incumbent()
    {
#ifdef LAYOUT_EMBEDDING_DEBUG_CHECKS
        // Every incumbent passes the checker that shares nothing with the search.
        const auto violations = check_strands(problem, *graph, solver->incumbent());
        if (!violations.empty()) {
            fail(EmbedStatus::failed,
                 make_error(ErrorCode::internal, "the search went wrong (" + violations[0].code +
                                                     ": " + violations[0].message + ")"));
            return;
        }
#endif
        WeakEmbedding incumbent = solver->incumbent();
        std::int64_t extra = 0;
        if (!boundary.empty()) {
            // The class of these edges is given, only their paths change: what all others cost, and
            // the bound for it, stay as they are.
            auto moved = with_boundary_paths(problem, *graph, incumbent, boundary);
            if (!moved) {
                fail(EmbedStatus::failed,
                     make_error(ErrorCode::internal,
                                "a path is in the way of one along the target's boundary"));
                return;
            }
            for (const BoundaryPath& path : boundary) {
                const Index e = path.layout_edge;
                extra += static_cast<std::int64_t>(problem.weights.cost(e, path.length));
                extra -= static_cast<std::int64_t>(cost_of(incumbent, e));
            }
            incumbent = std::move(*moved);
        }
        first_embedding_work = std::min(first_embedding_work, work);
        result.weak = std::move(incumbent);
        result.exact_cost = solver->incumbent_cost() + static_cast<Length>(extra);
        if (extra > extra_cost) {
            extra_cost = extra;
            set_lower_bound(solver->lower_bound(), solver->bound_scope());
        }
        result.cost = to_units(result.exact_cost);
        set_gap();
        emit(EventKind::incumbent, solver->progress());
    }

    /// One step on the way from the incumbent to the refined mesh.
    void realise_embedding()
    {
        const std::clock_t cpu_start = std::clock();
        if (!shaping) {
            result.shape_seconds = 0;
            auto form = normal_form_of(problem, *graph, result.weak, edge_costs);
            if (!form) {
                fail(EmbedStatus::failed, form.error());
                return;
            }
            run_along_boundary(*form, boundary);
            NormalForm even = *form;
            open_angles(even, problem.landmarks, StraighteningOptions{}.spacing, edge_costs);
            measure_edges(even);
            if (options.shape == PathShape::even) {
                cut(even);
                return;
            }
            shaping =
                std::make_unique<PathShaping>(*problem.layout, std::move(*form), problem.landmarks,
                                              edge_costs, options.shape == PathShape::fair);
            shown_progress = 0;
        } else if (shaping->step()) {
            show_shape_progress();
        } else {
            cut(shaping->take());
            shaping.reset();
            return;
        }
        result.shape_seconds += static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;
    }

    void show_shape_progress()
    {
        const double progress = shaping->progress();
        if (progress > shown_progress + kProgressStep) {
            shown_progress = progress;
            emit(EventKind::progress, progress);
        }
    }

    Length cost_of(const WeakEmbedding& embedding, Index layout_edge) const
    {
        Length length = 0;
        for (const Index dart : embedding.paths[layout_edge].darts) {
            length += graph->dart(dart).length;
        }
        return problem.weights.cost(layout_edge, length);
    }

    void measure_edges(const NormalForm& even)
    {
        result.edge_costs.clear();
        result.even_lengths.clear();
        for (Index edge = 0; edge < even.strand_count(); ++edge) {
            result.edge_costs.push_back(to_units(cost_of(result.weak, edge)));
            result.even_lengths.push_back(even.length(edge));
        }
    }

    void cut(const NormalForm& form)
    {
        const std::clock_t cpu_start = std::clock();
        auto refined = cut_along(*problem.layout, form);
        if (!refined) {
            fail(EmbedStatus::failed, refined.error());
            return;
        }
        refine_thin_triangles(*problem.target, *refined);
        result.refined = std::move(*refined);
        result.quality = triangle_quality(result.refined->positions, result.refined->corners);
        result.cut_seconds = static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;
        enter(EmbedPhase::check);
    }

    /// Leaves the paths as far as they are.
    void end_shape()
    {
        if (phase == EmbedPhase::realise && shaping) {
            shaping->finish();
            final_status = EmbedStatus::cancelled;
        }
    }

    void check()
    {
        const PolygonMesh layout = to_polygons(*problem.layout);
        const PolygonMesh target = to_polygons(*problem.target);
        const auto edges = layout_edges(*problem.layout);
        const auto points = weak_points(*problem.target, *graph, result.weak);
        const CheckReport report =
            check_embedding({layout, target, problem.landmarks, *result.refined, edges, points});
        if (!report.valid()) {
            result.refined.reset();
            fail(EmbedStatus::failed,
                 make_error(ErrorCode::realisationFailed, "the checker refuses the embedding (" +
                                                              report.violations[0].code + ": " +
                                                              report.violations[0].message + ")"));
            return;
        }
        end_after_comparison(final_status);
    }

    void step(const StepBudget& budget)
    {
        const auto slice_start = Clock::now();
        const std::uint64_t work_end = work + std::min(budget.work, UINT64_MAX - work);
        const auto milliseconds = [&] {
            return std::chrono::duration<double, std::milli>(Clock::now() - slice_start).count();
        };
        const auto seen = static_cast<std::ptrdiff_t>(events.size());
        const auto has_improved = [&] {
            return std::any_of(events.begin() + seen, events.end(), [](const EmbedEvent& event) {
                return event.kind == EventKind::incumbent;
            });
        };
        do {
            switch (phase) {
                case EmbedPhase::prepare:
                    prepare();
                    break;
                case EmbedPhase::search:
                    if (doubts) {
                        compare(std::min(kWorkPerSlice, work_end - work));
                    } else if (cancel_requested) {
                        conclude(EmbedStatus::cancelled);
                    } else if (seconds() - search_start > options.time_limit) {
                        conclude(EmbedStatus::time_limit);
                    } else {
                        search(std::min(kWorkPerSlice, work_end - work));
                    }
                    break;
                case EmbedPhase::realise:
                    realise_embedding();
                    break;
                case EmbedPhase::check:
                    if (doubts) {
                        compare(std::min(kWorkPerSlice, work_end - work));
                    } else {
                        check();
                    }
                    break;
                case EmbedPhase::done:
                    return;
            }
        } while (milliseconds() < budget.milliseconds && work < work_end && !has_improved());
    }
};

EmbedJob::EmbedJob(EmbeddingProblem problem, EmbedOptions options)
    : EmbedJob(std::move(problem), std::move(options),
               [](const TriangleMesh& target, const PathGraph::Options& graph_options) {
                   return PathGraph::barycentric(target, graph_options);
               })
{}
EmbedJob::EmbedJob(EmbeddingProblem problem, EmbedOptions options, PathGraphMaker make_graph)
    : implementation_(std::make_unique<Implementation>(std::move(problem), std::move(options),
                                                       std::move(make_graph)))
{}
EmbedJob::~EmbedJob() = default;
EmbedJob::EmbedJob(EmbedJob&&) noexcept = default;
EmbedJob& EmbedJob::operator=(EmbedJob&&) noexcept = default;

bool EmbedJob::step(const StepBudget& budget)
{
    Implementation& job = *implementation_;
    if (job.phase == EmbedPhase::done) {
        return false;
    }
    const std::clock_t cpu_start = std::clock();
    if (!job.started) {
        job.started = true;
        job.start_time = Implementation::Clock::now();
        job.emit(EventKind::phase, 0);
    }
    job.step(budget);
    job.cpu_seconds += static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC;
    job.result.cpu_seconds = job.cpu_seconds;
    job.result.seconds = job.seconds();
    return job.phase != EmbedPhase::done;
}

void EmbedJob::cancel()
{
    implementation_->cancel_requested = true;
    implementation_->end_shape();
}

bool EmbedJob::reshape(PathShape shape)
{
    Implementation& job = *implementation_;
    if (job.phase != EmbedPhase::done || !job.result.refined) {
        return false;
    }
    job.options.shape = shape;
    job.final_status = job.search_status;
    job.result.status = EmbedStatus::running;
    job.result.refined.reset();
    job.enter(EmbedPhase::realise);
    return true;
}

const EmbeddingProblem& EmbedJob::problem() const
{
    return implementation_->problem;
}
const EmbedOptions& EmbedJob::options() const
{
    return implementation_->options;
}
const std::vector<EmbedEvent>& EmbedJob::events() const
{
    return implementation_->events;
}
const EmbedResult& EmbedJob::result() const
{
    return implementation_->result;
}
const Error& EmbedJob::error() const
{
    return implementation_->error;
}
const PathGraph* EmbedJob::graph() const
{
    return implementation_->graph.get();
}
std::span<const double> EmbedJob::edge_costs() const
{
    return implementation_->edge_costs;
}

Polylines EmbedJob::paths() const
{
    const Implementation& job = *implementation_;
    Polylines lines;
    if (!job.graph) {
        return lines;
    }
    const PathGraph& graph = *job.graph;
    for (Index e = 0; e < job.problem.layout->edge_count(); ++e) {
        const std::vector<Index>* darts = nullptr;
        if (!job.result.weak.paths.empty()) {
            darts = &job.result.weak.paths[e].darts;
        } else if (job.solver) {
            darts = &job.solver->current_path(e);
        }
        if (darts == nullptr || darts->empty()) {
            continue;
        }
        lines.add(graph, e, *darts);
    }
    return lines;
}

}  // namespace layout_embedding
