#pragma once

#include <cstdint>
#include <vector>

#include "base/types.hh"
#include "surface/cut_surface_search.hh"
#include "surface/hole_guard.hh"
#include "surface/strands.hh"

namespace layout_embedding {

/// Plain greedy insertion: until a spanning tree of the layout is embedded, only edges that join
/// two different components of the embedded layout graph; then all. The edge with the shortest path
/// goes first, ties by edge index.
///
/// First the unconstrained path of every edge is computed; the sum of their lengths bounds every
/// embedding from below (paper, Sec. 4.3, at the root state). Inserting a strand only removes
/// walks, so an old candidate's length stays a lower bound, and only the cheapest one has to be
/// exact.
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
        /// No admissible edge is left; some are embedded.
        failed,
        /// Equal lengths: start again with other perturbations.
        tied,
    };

    /// Keeps references; `strands` is empty and receives the paths.
    GreedySearch(Strands& strands, CutSurfaceSearch& search);

    /// Continues for at most `max_expansions` node expansions.
    Outcome run(std::uint64_t max_expansions = UINT64_MAX);

    /// The sum of the unconstrained path lengths known so far; kInfiniteLength if an edge has none.
    Length lower_bound() const { return lower_bound_; }
    /// Whether lower_bound() has all edges in it.
    bool has_root_bound() const { return next_root_ == edge_count_; }
    /// The length of the embedded paths.
    Length embedded_cost() const { return embedded_cost_; }

private:
    struct Candidate {
        Length cost = 0;
        std::vector<Index> darts;
    };

    Index component(Index layout_vertex);
    bool is_admitted(Index layout_edge);
    Index cheapest_admitted();
    Outcome finish_search(CutSurfaceSearch::Outcome outcome);
    Outcome keep_inserted(Index layout_edge);

    Strands& strands_;
    CutSurfaceSearch& search_;
    HoleGuard hole_guard_;
    Index edge_count_;
    Index next_root_ = 0;
    Index searching_ = kNone;  // the edge whose search is under way
    Length lower_bound_ = 0;
    Length embedded_cost_ = 0;
    std::vector<Candidate> candidates_;
    std::vector<bool> refused_;   // in the present state, by the hole guard
    std::vector<Index> parents_;  // union-find over layout vertices
    Index component_count_;
};

}  // namespace layout_embedding
