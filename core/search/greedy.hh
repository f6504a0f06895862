#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "base/types.hh"
#include "layout/embedding_problem.hh"
#include "search/repulsive_guide.hh"
#include "search/side_test.hh"
#include "search/swirl_test.hh"
#include "surface/cut_surface_search.hh"
#include "surface/hole_guard.hh"
#include "surface/strands.hh"

namespace layout_embedding {

/// What a greedy heuristic goes by when it looks for the edge to insert next (paper, Sec. 5).
struct GreedyRule {
    /// Until a spanning tree of the layout is embedded, only edges that join two different
    /// components of the embedded layout graph are admitted; then all.
    bool spanning_tree_first = false;
    /// Paths are searched, and compared, in a metric that keeps them away from other landmarks
    /// (RepulsiveGuide). The order found is then inserted again with plain shortest paths.
    bool repulsive_guide = false;
    /// Paths suspected of a swirl count double (SwirlTest).
    bool swirl_test = false;
    /// Edges that would close a cycle are refused where they part landmarks in the wrong way
    /// (SideTest).
    bool side_test = false;
    /// Edges between two extremal vertices come before all others. Extremal are the V / 4 (rounded
    /// down) layout vertices with the largest average, over their layout edges, of the
    /// unconstrained path length; ties by index.
    bool extremal_first = false;

    static constexpr GreedyRule plain() { return {.spanning_tree_first = true}; }
    /// [PSS01]
    static constexpr GreedyRule praun()
    {
        return {.spanning_tree_first = true, .repulsive_guide = true, .swirl_test = true};
    }
    /// [KSG03, KS04]
    static constexpr GreedyRule kraevoy() { return {.side_test = true}; }
    /// [SAPH04]
    static constexpr GreedyRule schreiner()
    {
        return {.spanning_tree_first = true, .swirl_test = true, .extremal_first = true};
    }
};

/// Greedy insertion by one of the rules above: of all edges not yet embedded that the rule admits,
/// the one with the shortest admissible path goes next, ties by edge index.
///
/// First the unconstrained path of every edge is computed; the sum of their lengths bounds every
/// embedding from below (paper, Sec. 4.3, at the root state). Inserting a strand only removes
/// walks, so an old candidate's length stays a lower bound, and only the cheapest one has to be
/// exact: the sequence is the one that looking at every edge in every round would give.
class GreedySearch {
public:
    enum class Outcome {
        running,
        /// lower_bound() has just become complete.
        bounded,
        /// One more edge is embedded, more are to come.
        inserted,
        /// All edges are embedded.
        complete,
        /// No admissible edge is left; some are embedded. Or, with lower_bound() infinite, an edge
        /// has no path at all.
        failed,
        /// Equal lengths: start again with other perturbations.
        tied,
    };

    /// Keeps references; `strands` is empty and receives the paths.
    GreedySearch(const EmbeddingProblem& problem, Strands& strands, CutSurfaceSearch& search,
                 const GreedyRule& rule = GreedyRule::plain());

    /// Continues for at most `max_expansions` node expansions. Tests and the guide's harmonic
    /// functions are not interrupted.
    Outcome run(std::uint64_t max_expansions = UINT64_MAX);

    /// The sum of what the unconstrained paths known so far cost; kInfiniteLength if an edge has
    /// none.
    Length lower_bound() const { return lower_bound_; }
    /// Whether lower_bound() has all edges in it.
    bool has_root_bound() const { return next_root_ == edge_count_; }
    /// After `bounded`: the unconstrained path of a layout edge.
    const std::vector<Index>& candidate(Index layout_edge) const
    {
        return (plain_.empty() ? candidates_ : plain_)[layout_edge].darts;
    }
    /// What the embedded paths cost.
    Length embedded_cost() const { return embedded_cost_; }
    /// Share of the insertions that are done, in [0, 1].
    double progress() const;

private:
    enum class Stage { bounding, inserting, inserting_again };
    struct Candidate {
        /// Lower bound on the shortest path in the rule's metric, exact if `is_current`.
        Length cost = 0;
        /// The path of that cost when it was found.
        std::vector<Index> darts;
        /// Whether `darts` is the shortest path in the present state.
        bool is_current = false;
        /// Whether `darts` went through the swirl test, and what came of it: the strands have no
        /// say in it.
        bool is_judged = false;
        bool is_suspect = false;
        /// Whether the side test refused `darts` for good.
        bool is_misparting = false;
        /// Not to be inserted in the present state.
        bool is_refused = false;
    };
    /// What the next edge is chosen by: the smallest one.
    struct Rank {
        bool is_late;
        Length score;
        friend bool operator<(const Rank& a, const Rank& b)
        {
            return a.is_late != b.is_late ? b.is_late : a.score < b.score;
        }
    };

    Outcome finish_search(bool found);
    Outcome begin_inserting();
    Outcome advance();
    Outcome insert_next();
    Outcome insert_next_again();
    Outcome keep_inserted(Index layout_edge);
    void begin_search(Index layout_edge);
    void make_current(Index layout_edge);
    bool parts_rightly(Index layout_edge);
    Index component(Index layout_vertex);
    bool closes_cycle(Index layout_edge);
    bool is_admitted(Index layout_edge);
    Rank rank(Index layout_edge) const;
    Index best_admitted();
    void find_extremal_vertices();
    Length length(const std::vector<Index>& darts) const;

    const EmbeddingProblem& problem_;
    Strands& strands_;
    CutSurfaceSearch& search_;
    GreedyRule rule_;
    HoleGuard hole_guard_;
    std::unique_ptr<RepulsiveGuide> guide_;
    std::unique_ptr<SwirlTest> swirl_test_;
    std::unique_ptr<SideTest> side_test_;
    bool on_sphere_;

    Index edge_count_;
    Stage stage_ = Stage::bounding;
    Index next_root_ = 0;
    Index searching_ = kNone;  // the edge whose search is under way
    Length lower_bound_ = 0;
    Length embedded_cost_ = 0;
    Index insertion_count_ = 0;  // of both insertions, where there are two
    std::vector<Candidate> candidates_;
    std::vector<bool> extremal_;    // per layout vertex; empty unless asked for
    std::vector<Index> parents_;    // union-find over layout vertices
    std::vector<Index> order_;      // to be inserted again
    std::vector<Candidate> plain_;  // then: candidates in the plain metric
    Index component_count_;
};

}  // namespace layout_embedding
