#pragma once

#include <cstdint>
#include <vector>

#include "base/types.hh"
#include "search/work_budget.hh"
#include "surface/weak_embedding.hh"

namespace layout_embedding {

/// What a lower bound bounds: every embedding, or only those that insert paths one by one, each as
/// the shortest that is left.
enum class BoundScope : std::uint32_t { embeddings, insertion_sequences };

/// Machine-independent counts of a search.
struct SearchCounters {
    /// Shortest-path searches in the cut surface.
    std::uint64_t searches = 0;
    /// States of the cut surface expanded by them.
    std::uint64_t expansions = 0;
    /// Nodes settled by the distance fields that guide them.
    std::uint64_t field_nodes = 0;
    /// Paths inserted into embeddings.
    std::uint64_t insertions = 0;
    /// Questions for a shortest path that were answered from memory.
    std::uint64_t remembered = 0;
    /// States of a branch and bound: given to the queue, branched, dropped by their bound, met
    /// before, and without any path left for some edge.
    std::uint64_t states_created = 0;
    std::uint64_t states_expanded = 0;
    std::uint64_t states_pruned = 0;
    std::uint64_t states_redundant = 0;
    std::uint64_t dead_ends = 0;

    SearchCounters& operator+=(const SearchCounters& other)
    {
        searches += other.searches;
        expansions += other.expansions;
        field_nodes += other.field_nodes;
        insertions += other.insertions;
        remembered += other.remembered;
        states_created += other.states_created;
        states_expanded += other.states_expanded;
        states_pruned += other.states_pruned;
        states_redundant += other.states_redundant;
        dead_ends += other.dead_ends;
        return *this;
    }
};

/// A search for a good embedding, run in slices.
class Solver {
public:
    enum class Outcome {
        running,
        /// lower_bound() has risen noticeably.
        bounded,
        /// progress() has changed noticeably.
        advanced,
        /// The incumbent has improved.
        improved,
        /// Nothing is left to be done, or the gap asked for is reached.
        finished,
        /// Equal lengths: start again with other perturbations.
        tied,
    };

    virtual ~Solver() = default;

    /// Continues until something happens or the budget is spent. What happens, and in what order,
    /// does not depend on how the search is sliced.
    virtual Outcome run(WorkBudget& budget) = 0;

    virtual Length lower_bound() const = 0;
    virtual BoundScope bound_scope() const = 0;
    /// kInfiniteLength without an incumbent.
    virtual Length incumbent_cost() const = 0;
    virtual const WeakEmbedding& incumbent() const = 0;
    /// Layout edges in an order in which the incumbent's paths can be inserted.
    virtual std::vector<Index> incumbent_order() const = 0;
    /// While there is no incumbent: the path of a layout edge in the embedding that is being built,
    /// empty if it has none yet.
    virtual const std::vector<Index>& current_path(Index layout_edge) const = 0;
    /// Share of the work that is known to lie ahead, in [0, 1].
    virtual double progress() const = 0;
    virtual SearchCounters counters() const = 0;
};

}  // namespace layout_embedding
