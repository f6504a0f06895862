#pragma once

#include <cstdint>
#include <unordered_set>
#include <vector>

#include "base/quad_heap.hh"
#include "base/types.hh"
#include "surface/cut_system.hh"
#include "surface/distance_field.hh"
#include "surface/strands.hh"

namespace layout_embedding {

/// The homotopy classes of arcs for one layout edge, on the target punctured at all landmarks and
/// cut open along the embedded strands, by the length of their shortest walks (design, Sec. 3):
/// best-first search in the universal cover, whose states are a state of the cut surface and the
/// word of cuts crossed on the way. Stepped.
///
/// Arcs may turn freely about their own ends. All simple classes come up; of the others, those
/// whose walks cross themselves before they reach the goal do not.
class ClassEnumeration {
public:
    enum class Outcome {
        running,
        /// darts() and cost() are the shortest walk of the next simple class.
        found,
        /// All simple classes shorter than the limit have come up.
        exceeded,
        /// Two walks of equal length in one class: draw other perturbations.
        tied,
    };

    /// Keeps references.
    ClassEnumeration(const Strands& strands, DistanceFields& fields);

    /// Starts to enumerate for an edge that is not embedded. Neither end of it is the root of
    /// `cuts`, which has to live as long as the enumeration. The strands must not change meanwhile.
    void begin(const CutSystem& cuts, Index layout_edge, Length limit = kInfiniteLength);

    /// Continues, up to the next class, until so many expansions or so much work is done.
    Outcome run(std::uint64_t max_expansions = UINT64_MAX, std::uint64_t max_work = UINT64_MAX);

    /// The walk from tail(2e) to head(2e), after `found`.
    const std::vector<Index>& darts() const { return darts_; }
    Length cost() const { return cost_; }
    /// Every simple class that has not come up is at least this long, or the limit.
    Length frontier() const;
    /// Embedded edges whose strands alone keep classes that have not come up from being shorter
    /// than frontier(). Sorted.
    std::vector<Index> blockers() const;
    /// States expanded by all enumerations of this object.
    std::uint64_t expansion_count() const { return expansion_count_; }
    /// The work of all enumerations of this object, in expansions in the cut surface.
    std::uint64_t work_count() const;

private:
    /// What is known of a state of the cut surface with a word. Half a cache line: much of the time
    /// goes by until labels come from memory.
    struct alignas(32) Label {
        Length distance;
        Index state;
        Index word;
        Index parent;  // label, kNone at the start
        Index next;    // label of the same bucket
        Index entry;   // the first label on the way whose word and all later ones are this one's
        Index parent_dart : 30;  // more would not fit into memory
        Index is_closed : 1;
        Index is_tied : 1;
    };
    /// Of a closed label: a label some way back, for is_on_the_way(), and how many are before it.
    struct Jump {
        Index to;
        Index depth;
    };
    /// A label that is being expanded; kNone and zeros where the edge begins.
    struct Origin {
        Index label = kNone;
        Length distance = 0;
        Index word = Words::kEmpty;
        Index entry = kNone;
    };
    struct QueueItem {
        Length estimate;
        Index label;
        Index node;
        friend bool operator<(const QueueItem& a, const QueueItem& b)
        {
            return a.estimate != b.estimate ? a.estimate < b.estimate : a.label < b.label;
        }
    };

    void relax(const Origin& from, Index dart, Index slot, Index strand_count);
    std::size_t bucket(Index state, Index word) const;
    Index find(std::size_t bucket, Index state, Index word);
    void grow_buckets();
    void close(Index label);
    bool is_on_the_way(Index label, Index to);
    bool crosses_itself(Index label);
    bool collect_walk(Index label);

    const Strands& strands_;
    DistanceFields& fields_;
    const CutSystem* cuts_ = nullptr;
    Index layout_edge_ = kNone;
    Index start_vertex_ = kNone;  // layout vertices
    Index goal_vertex_ = kNone;
    Index start_ = kNone;  // nodes
    Index goal_ = kNone;
    Index goal_sector_ = 0;
    Length limit_ = kInfiniteLength;
    const DistanceField* field_ = nullptr;
    Words words_;
    std::vector<Label> labels_;
    std::vector<Jump> jumps_;            // per label
    std::vector<Index> buckets_;         // a power of two: the first label of each
    std::vector<Index> label_counts_;    // per state of the cut surface
    std::vector<Index> used_states_;     // those with a label
    std::unordered_set<Index> classes_;  // words; looked up, never iterated
    QuadHeap<QueueItem> queue_;
    std::vector<Index> darts_;
    std::vector<Index> reversed_;
    std::vector<Index> met_;  // embedded edges
    std::vector<bool> is_met_;
    std::vector<Index> bordering_;
    Length cost_ = 0;
    std::uint64_t expansion_count_ = 0;
    std::uint64_t label_count_ = 0;  // looked at on the way to others
};

/// Whether two passes of a walk cross: a stretch that both share, perhaps one node, is entered and
/// left on opposite sides. A shortest walk of its class crosses itself exactly if the class is not
/// simple (proof.md, Sec. 3). O(length + pairs of visits of one node).
bool walk_crosses_itself(const PathGraph& graph, const std::vector<Index>& darts);

}  // namespace layout_embedding
