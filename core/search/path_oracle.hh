#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/types.hh"
#include "search/class_constraints.hh"
#include "search/partial_embedding.hh"
#include "search/work_budget.hh"
#include "surface/class_enumeration.hh"
#include "surface/cut_surface_search.hh"

namespace layout_embedding {

/// Answers "what is the shortest path of this edge here?" for states of a search, and remembers why
/// (design, Sec. 2): every finished search leaves its explanation, the strands that kept the path
/// from being shorter. In any state that contains those strands its cost is a lower bound, and the
/// answer if its walk still traces. Few questions need a new search.
class PathOracle {
public:
    enum class Outcome {
        /// The budget ran out; ask again in the same state to go on.
        running,
        /// `walk` is the shortest.
        found,
        /// No path exists; `bound` is kInfiniteLength.
        blocked,
        /// Every path costs at least `bound`, which is at least the limit asked for.
        exceeded,
        /// Of the edge's shorter classes none is one that it may take, and more were not looked at;
        /// every path costs at least `bound`.
        given_up,
        /// Two shortest walks of equal length.
        tied,
    };
    struct Answer {
        Outcome outcome = Outcome::running;
        Index walk = kNone;
        Length bound = 0;
    };

    /// Keeps references. Without `remember`, every question is a search.
    PathOracle(PartialEmbedding& embedding, CutSurfaceSearch& search, bool remember = true);

    /// From now on only paths of classes that the edges may take count. Keeps references. An edge
    /// that is kept in a class is to be asked for without a limit before others are embedded.
    void constrain(const ClassConstraints& constraints, CutSystems& cuts, DistanceFields& fields);

    /// The shortest path of an edge that is not embedded, in the present state. Paths that cost
    /// `limit` or more do not matter. Charges the budget for the states it expands.
    Answer find(Index layout_edge, Length limit, WorkBudget& budget);

    /// The best lower bound on the paths of an edge in the present state that is known without a
    /// search.
    Length known_bound(Index layout_edge) const;

    /// Takes note of an edge's shortest path with nothing embedded.
    void learn_unconstrained(Index walk);

    /// Why the paths of an edge are no shorter in the states that contain certain walks.
    struct Explanation {
        Index layout_edge;
        /// Lower bound; kInfiniteLength if there is no path at all.
        Length bound;
        /// The shortest path, of cost `bound`, where it still fits; kNone where only the bound is
        /// known.
        Index walk;
        std::vector<Index> blockers;  // walks
    };
    /// All that were found so far, oldest first.
    const std::vector<Explanation>& explanations() const { return explanations_; }

    /// States expanded by enumerations of classes.
    std::uint64_t enumerated_count() const
    {
        return enumeration_ ? enumeration_->expansion_count() : 0;
    }
    /// Questions answered without a search.
    std::uint64_t remembered_count() const { return remembered_count_; }

private:
    bool applies(const Explanation& explanation) const;
    void remember(Explanation explanation);
    Answer recall(Index layout_edge, Length limit) const;
    Answer search(Index layout_edge, WorkBudget& budget);
    void begin_enumeration(Index layout_edge);
    Answer enumerate(Index layout_edge, WorkBudget& budget);
    const EdgeWeights& weights() const { return embedding_.strands().weights(); }
    bool keeps(Index layout_edge) const
    {
        return constraints_ != nullptr && constraints_->keeps(layout_edge);
    }

    PartialEmbedding& embedding_;
    CutSurfaceSearch& search_;
    bool remembers_;
    const ClassConstraints* constraints_ = nullptr;
    CutSystems* cuts_ = nullptr;
    std::unique_ptr<ClassEnumeration> enumeration_;
    // The question that is being answered, and how.
    Index searching_ = kNone;
    Length limit_ = 0;
    bool is_enumerating_ = false;
    std::uint64_t enumeration_left_ = 0;
    std::vector<Explanation> explanations_;
    /// Per layout edge: its explanations, the largest bound first, of equal ones those with a walk.
    std::vector<std::vector<Index>> by_bound_;
    std::uint64_t remembered_count_ = 0;
};

}  // namespace layout_embedding
