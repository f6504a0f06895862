#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "layout/embedding_problem.hh"
#include "search/sequence_solver.hh"
#include "search/work_budget.hh"
#include "surface/path_graph.hh"

namespace layout_embedding {

/// A small change of the input that makes the embedding far shorter, or possible at all: most
/// likely the input is not what was meant.
struct LandmarkDoubt {
    enum class Kind : std::uint32_t {
        /// The mirror image of the layout fits: layout or target are inside out.
        mirrored,
        /// The layout vertices a and b fit with their landmarks exchanged.
        exchanged,
    };
    Kind kind;
    Index a = kNone;
    Index b = kNone;
    /// The cost of an embedding after the change, in target units and the path-graph metric.
    double cost;
    /// One sentence: what, where, what to do.
    std::string message;
};

/// Looks for such a change once an embedding was found, or none: each candidate that could help is
/// embedded itself, quickly, so that what is said is a fact about two embeddings.
///
/// "Far shorter" is kFarShorter times the cost or less. No embedding is shorter than the sum of
/// its unconstrained paths, which mirroring leaves as it is and exchanging changes in a way that
/// is estimated along mesh edges: most inputs need no second look, and get none.
class LandmarkDoubts {
public:
    static constexpr double kFarShorter = 0.75;

    /// Of the search for an embedding, when it has ended.
    struct Found {
        /// kInfiniteLength where no embedding was found.
        Length cost;
        /// The sum of unconstrained shortest paths.
        Length root_bound;
        /// What it took to find the first embedding, or to find none.
        std::uint64_t work;
    };

    /// Keeps a reference to the graph.
    LandmarkDoubts(const EmbeddingProblem& problem, const PathGraph& graph,
                   std::uint64_t field_bytes, const Found& found);

    /// Continues until the budget is spent; false once there is nothing left to be compared.
    bool run(WorkBudget& budget);

    /// At most one of each kind; an exchange is not looked for where the mirror image fits.
    const std::vector<LandmarkDoubt>& doubts() const { return doubts_; }

private:
    struct Candidate {
        LandmarkDoubt::Kind kind;
        Index a;
        Index b;
    };
    void propose_exchanges(Length root_bound);
    void begin();
    void take_down(Length cost);

    EmbeddingProblem problem_;
    const PathGraph& graph_;
    std::uint64_t field_bytes_;
    Length cost_;
    /// An embedding that costs no more is worth telling of.
    Length threshold_;
    std::uint64_t work_limit_;  // per candidate
    std::vector<Candidate> candidates_;
    std::size_t next_ = 0;
    std::unique_ptr<EmbeddingProblem> changed_;
    std::unique_ptr<SequenceSolver> solver_;
    std::uint64_t work_ = 0;  // on the present candidate
    std::vector<LandmarkDoubt> doubts_;
};

}  // namespace layout_embedding
