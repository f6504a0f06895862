#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/quad_heap.hh"
#include "base/types.hh"
#include "surface/distance_field.hh"
#include "surface/strands.hh"
#include "surface/weighted_length.hh"

namespace layout_embedding {

/// The shortest walk for a layout edge in the surface cut open along the embedded strands: the
/// paper's p(M, e) (Sec. 3.1) in the limit of strands of zero width. A* over the states of Strands,
/// guided by the goal landmark's distance field; stepped, so that long searches can be interrupted.
///
/// The result is the unique shortest walk, or a tie is reported: equal sums of perturbed lengths
/// are detected wherever they could have led to another walk of the same length. Scratch memory of
/// 16 bytes per state is kept between searches.
class CutSurfaceSearch {
public:
    enum class Outcome {
        running,
        /// darts() and cost() hold the shortest walk.
        found,
        /// No walk exists: other strands are in the way.
        blocked,
        /// Every walk is at least as long as the limit: see lower_bound().
        exceeded,
        /// Two shortest walks of equal length: draw other perturbations (PathGraph::Options).
        tied,
    };

    /// Keeps references to both.
    CutSurfaceSearch(const Strands& strands, DistanceFields& fields);

    /// Starts to search for an edge that is not embedded. The strands must not change until the
    /// search is over. Walks of length `limit` or more do not matter.
    void begin(Index layout_edge, Length limit = kInfiniteLength);

    /// Likewise from the other end: the same walk, guided by the distance field of tail(2e).
    void begin_backwards(Index layout_edge);

    /// Likewise for the walk that is shortest in a metric of its own: see weighted_length().
    /// `weights` has one weight per node and stays as it is until the search is over. Without a
    /// distance field to guide it.
    void begin_weighted(Index layout_edge, std::span<const NodeWeight> weights);

    /// Continues for at most `max_expansions` expansions.
    Outcome run(std::uint64_t max_expansions = UINT64_MAX);

    /// The walk from tail(2e) to head(2e), after `found`.
    const std::vector<Index>& darts() const { return darts_; }
    /// Its length, in the metric of the search; kInfiniteLength if it is blocked.
    Length cost() const { return goal_distance_; }
    /// Every walk for the edge is at least this long; grows while the search runs.
    Length lower_bound() const { return lower_bound_; }
    /// The explanation of the outcome: embedded edges whose strands alone keep every walk from
    /// being shorter than lower_bound() (design, Sec. 2). Sorted.
    std::vector<Index> blockers() const;
    /// Searches begun by this object.
    std::uint64_t search_count() const { return search_count_; }
    /// States expanded by all of them.
    std::uint64_t expansion_count() const { return expansion_count_; }

private:
    struct Label {
        Length distance;
        Index parent_dart;
        std::uint32_t mark;  // search number, then one bit each for closed and tied
    };
    struct QueueItem {
        Length estimate;
        Index state;
        friend bool operator<(const QueueItem& a, const QueueItem& b)
        {
            return a.estimate != b.estimate ? a.estimate < b.estimate : a.state < b.state;
        }
    };

    /// From tail(h) to head(h).
    void start(Index layout_halfedge, Length limit);
    template <bool kWeighted>
    void expand(Index state);
    template <bool kWeighted>
    void relax(Index from_state, Index tail, Index dart, Index slot, Index strand_count,
               Length distance);
    void collect_walk();

    const Strands& strands_;
    DistanceFields& fields_;
    const DistanceField* field_ = nullptr;  // of the goal, null in weighted searches
    std::span<const NodeWeight> weights_;   // empty in plain searches
    Index start_ = kNone;
    Index goal_ = kNone;
    Index goal_sector_ = 0;
    Length goal_distance_ = kInfiniteLength;
    Index goal_dart_ = kNone;
    Index goal_state_ = kNone;  // the state before the goal, kNone for the start
    bool goal_tied_ = false;
    Length lower_bound_ = 0;
    Length limit_ = kInfiniteLength;
    Length skipped_ = kInfiniteLength;  // smallest estimate at or above the limit
    Index layout_halfedge_ = kNone;
    std::vector<Index> met_;                  // embedded edges that border expanded regions
    std::vector<std::uint32_t> met_numbers_;  // per layout edge: the search that met it last
    std::vector<Index> bordering_;            // scratch
    std::uint32_t number_ = 0;
    std::uint64_t search_count_ = 0;
    std::uint64_t expansion_count_ = 0;
    std::vector<Label> labels_;  // per state
    QuadHeap<QueueItem> queue_;
    std::vector<Index> darts_;
    bool tied_ = false;
};

}  // namespace layout_embedding
