#pragma once

#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "base/quad_heap.hh"
#include "base/types.hh"
#include "surface/cut_system.hh"
#include "surface/distance_field.hh"
#include "surface/strands.hh"

namespace layout_embedding {

/// The homotopy classes of arcs for one layout edge, on the target punctured at all landmarks, by
/// the length of their shortest walks (design, Sec. 3): best-first search in the universal cover,
/// whose states are a node and the word of cuts crossed on the way. Stepped, and resumed for as
/// many classes as are needed.
///
/// Arcs may turn freely about their own ends. Classes that are not simple come up too; see
/// walk_crosses_itself().
class ClassEnumeration {
public:
    enum class Outcome {
        running,
        /// darts() and cost() are the shortest walk of the next class.
        found,
        /// All classes shorter than the limit have come up.
        exceeded,
        /// Two walks of equal length in one class: draw other perturbations.
        tied,
    };

    /// Keeps references. Neither end of the edge is the root of `cuts`. What is embedded in
    /// `strands` does not matter.
    ClassEnumeration(const Strands& strands, DistanceFields& fields, const CutSystem& cuts,
                     Index layout_edge);

    /// Continues for at most `max_expansions` expansions, up to the next class of a cost below
    /// `limit`, which may be higher in a later call.
    Outcome run(Length limit, std::uint64_t max_expansions = UINT64_MAX);

    /// The walk from tail(2e) to head(2e), after `found`.
    const std::vector<Index>& darts() const { return darts_; }
    Length cost() const { return cost_; }
    /// Every class that has not come up is at least this long.
    Length frontier() const;

private:
    struct State {
        Index node;
        Index word;
        Length distance;
        Index parent;  // state, kNone at the start
        Index parent_dart;
        bool is_closed;
        bool is_tied;
    };
    struct QueueItem {
        Length estimate;
        Index state;
        friend bool operator<(const QueueItem& a, const QueueItem& b)
        {
            return a.estimate != b.estimate ? a.estimate < b.estimate : a.state < b.state;
        }
    };

    void relax(Index from_state, Index dart);
    Index goal_class(Index word);
    bool collect_walk(Index state);

    const Strands& strands_;
    DistanceFields& fields_;
    const CutSystem& cuts_;
    Index start_vertex_;  // layout vertices
    Index goal_vertex_;
    Index start_;  // nodes
    Index goal_;
    const DistanceField* field_ = nullptr;
    Words words_;
    std::vector<State> states_;
    std::unordered_map<std::uint64_t, Index> states_by_key_;  // looked up, never iterated
    std::unordered_set<Index> classes_;                       // words; likewise
    QuadHeap<QueueItem> queue_;
    std::vector<Index> darts_;
    Length cost_ = 0;
};

/// Whether two passes of a walk cross: a stretch that both share, perhaps one node, is entered and
/// left on opposite sides. A shortest walk of its class crosses itself exactly if the class is not
/// simple (proof.md, Sec. 3). O(length + pairs of visits of one node).
bool walk_crosses_itself(const PathGraph& graph, const std::vector<Index>& darts);

}  // namespace layout_embedding
