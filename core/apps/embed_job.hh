#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "apps/embed_options.hh"
#include "apps/landmark_doubts.hh"
#include "base/error.hh"
#include "embedding/path_shape.hh"
#include "embedding/refined_mesh.hh"
#include "embedding/triangle_quality.hh"
#include "layout/embedding_problem.hh"
#include "search/solver.hh"
#include "surface/path_graph.hh"
#include "surface/path_metric.hh"
#include "surface/polylines.hh"
#include "surface/weak_embedding.hh"

namespace layout_embedding {

/// Why a job ended.
enum class EmbedStatus : std::uint32_t {
    /// The job has not ended.
    running,
    /// gap 0 in the stated scope.
    optimal,
    /// The gap is at most the one asked for.
    gap_reached,
    /// The algorithm came to its end with an embedding, without proving the gap asked for.
    feasible,
    time_limit,
    work_limit,
    memory_limit,
    cancelled,
    /// Proved: no embedding exists.
    infeasible,
    /// The algorithm came to its end without an embedding.
    none_found,
    /// An error stopped the job; see EmbedJob::error().
    failed,
};

enum class EmbedPhase : std::uint32_t { prepare, search, realise, check, done };

enum class EventKind : std::uint32_t {
    /// Another phase began.
    phase,
    /// The incumbent improved: a complete embedding of cost `cost`.
    incumbent,
    /// The lower bound rose.
    bound,
    /// One more path was embedded, nothing is complete yet; or paths were made shorter.
    progress,
};

/// Something that happened, with the state after it.
struct EmbedEvent {
    EventKind kind = EventKind::phase;
    EmbedPhase phase = EmbedPhase::prepare;
    /// Seconds since the job started.
    double seconds = 0;
    /// Units of work since the job started.
    std::uint64_t work = 0;
    /// In target units; infinity while there is no embedding.
    double cost = std::numeric_limits<double>::infinity();
    double lower_bound = 0;
    /// Share of the phase that is done, in [0, 1].
    double progress = 0;
};

/// Machine-independent counts, of all attempts together.
struct EmbedCounters : SearchCounters {
    /// Units of work (WorkBudget).
    std::uint64_t work = 0;
    /// How often a tie made the job draw new perturbations.
    std::uint64_t ties = 0;
};

struct EmbedResult {
    EmbedStatus status = EmbedStatus::running;
    BoundScope bound_scope = BoundScope::embeddings;
    /// In target units and the path-graph metric; infinity without an embedding.
    double cost = std::numeric_limits<double>::infinity();
    double lower_bound = 0;
    /// The same as exact integers of the path graph.
    Length exact_cost = kInfiniteLength;
    Length exact_lower_bound = 0;
    /// (cost - lower bound) / cost, 1 without an embedding.
    double gap = 1;
    /// One path per layout edge; empty without an embedding.
    WeakEmbedding weak;
    /// Present once an embedding was realised and passed the checker.
    std::optional<RefinedMesh> refined;
    /// Per layout edge: what it contributes to `cost`.
    std::vector<double> edge_costs;
    /// Per layout edge: the length on the surface of its chain in the shape `even`, for comparison.
    std::vector<double> even_lengths;
    /// Of the refined mesh.
    TriangleQuality quality;
    /// CPU seconds that the paths' shape took, and cutting the target along them.
    double shape_seconds = 0;
    double cut_seconds = 0;
    /// Layout edges in the order in which they were embedded.
    std::vector<Index> insertion_order;
    EmbedCounters counters;
    /// Changes of the input that make the embedding far shorter, or possible. Not looked for after
    /// a heuristic, a cancelled job, or a time limit; work limits do not count this work.
    std::vector<LandmarkDoubt> doubts;
    double seconds = 0;
    double cpu_seconds = 0;
};

/// How far one call of EmbedJob::step may go; it returns at the first limit it meets.
struct StepBudget {
    double milliseconds = std::numeric_limits<double>::infinity();
    /// Units of work.
    std::uint64_t work = std::numeric_limits<std::uint64_t>::max();
};

/// Makes the path graph that a job searches: the barycentric subdivision, with any lengths (see
/// PathGraph::set_lengths). Called again after a tie, with options.attempt raised.
using PathGraphMaker = std::function<PathGraph(const TriangleMesh&, const PathGraph::Options&)>;

/// Embeds a layout: prepares the path graph, searches, realises the best embedding found and sends
/// it through the checker. Stepped from outside, so that a caller can show progress, poll events
/// and cancel between slices; the same object serves command line, worker and tests.
///
/// Given the same problem and options without a time limit, results, counters and events (but for
/// their seconds) are identical on every platform, however the job is sliced.
class EmbedJob {
public:
    /// In the metric of the options.
    EmbedJob(EmbeddingProblem problem, EmbedOptions options);
    EmbedJob(EmbeddingProblem problem, EmbedOptions options, PathGraphMaker make_graph);
    ~EmbedJob();
    EmbedJob(EmbedJob&&) noexcept;
    EmbedJob& operator=(EmbedJob&&) noexcept;

    /// Does some work, until a better embedding is found at most, so that each can be shown; false
    /// once the job has ended. Preparing, cutting and checking are not interrupted, and only the
    /// search counts as work.
    bool step(const StepBudget& budget = {});

    /// Ends the search at the next step(); an incumbent is still realised, in its shape, and
    /// checked. Called while paths get their shape, it leaves them as far as they are. Idempotent.
    void cancel();

    /// Gives the paths of a job that has ended with an embedding another shape, without a new
    /// search: to be stepped to its end again. False if there is no embedding.
    bool reshape(PathShape shape);

    const EmbeddingProblem& problem() const;
    const EmbedOptions& options() const;
    /// All events so far, oldest first.
    const std::vector<EmbedEvent>& events() const;
    /// The best state so far; final once step() has returned false.
    const EmbedResult& result() const;
    /// What went wrong, when the status is `failed` or `memory_limit`.
    const Error& error() const;
    /// The incumbent's paths, or those embedded so far while there is none.
    Polylines paths() const;
    /// Null before the prepare phase is over.
    const PathGraph* graph() const;
    /// As in StraighteningOptions: empty unless paths are drawn to sharp edges. Lives with the
    /// graph.
    std::span<const double> edge_costs() const;

private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace layout_embedding
