#pragma once

#include <span>
#include <utility>
#include <vector>

#include "base/types.hh"
#include "search/partial_embedding.hh"
#include "search/path_oracle.hh"
#include "search/second_class.hh"
#include "search/work_budget.hh"
#include "surface/cut_systems.hh"
#include "surface/distance_field.hh"

namespace layout_embedding {

/// What two layout edges cost together at least, in every embedding (design, Sec. 2; proof.md,
/// Sec. 7).
///
/// Where the unconstrained paths of edges a and b are in conflict, no embedding has both edges in
/// the classes of these paths. If a keeps its class, b is as long as its shortest path beside a's,
/// and as its second shortest class; likewise the other way round; or both leave their classes.
class PairwiseBound {
public:
    enum class Outcome { running, finished, tied };

    /// Keeps references.
    PairwiseBound(PartialEmbedding& embedding, PathOracle& oracle, DistanceFields& fields);

    /// Starts with the unconstrained path of each layout edge; nothing is embedded.
    void begin(std::span<const Index> root_walks);
    /// Continues until the bounds of all pairs are known, with nothing embedded then.
    Outcome run(WorkBudget& budget);

    /// Where every embedding in question has costs of at least `costs`, per layout edge: how much
    /// more than their sum it costs at least, from pairs of which no two share an edge;
    /// kInfiniteLength where there is no embedding.
    Length surplus(std::span<const Length> costs);
    Index pair_count() const { return static_cast<Index>(pairs_.size()); }
    /// States expanded by enumerations of classes.
    std::uint64_t expansion_count() const { return second_.expansion_count(); }

private:
    struct Pair {
        Index a;
        Index b;
        Length a_beside_b = 0;
        Length b_beside_a = 0;
        Length together = 0;
    };

    /// What a pair adds to the costs in question.
    struct Addition {
        Length surplus;
        Index pair;
        friend bool operator<(const Addition& x, const Addition& y)
        {
            return x.surplus != y.surplus ? x.surplus > y.surplus : x.pair < y.pair;
        }
    };

    Outcome find_second(Index edge, WorkBudget& budget);
    void combine();

    PartialEmbedding& embedding_;
    PathOracle& oracle_;
    CutSystems cuts_;
    SecondClass second_;
    std::vector<Index> root_walks_;
    std::vector<Pair> pairs_;
    std::vector<Length> seconds_;  // per layout edge: its second shortest class costs at least this
    std::vector<Index> edges_;     // those in pairs
    Index next_edge_ = 0;
    Index next_side_ = 0;  // two per pair: b beside a, a beside b
    std::vector<Addition> additions_;
    std::vector<std::uint8_t> is_matched_;  // per layout edge
};

}  // namespace layout_embedding
