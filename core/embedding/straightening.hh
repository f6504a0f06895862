#pragma once

#include <span>
#include <vector>

#include "embedding/crossing_room.hh"
#include "embedding/edge_balancing.hh"
#include "embedding/normal_form.hh"
#include "embedding/strand_tightening.hh"
#include "embedding/vertex_moves.hh"

namespace layout_embedding {

struct StraighteningOptions {
    /// The share of each edge that is divided among the gaps between its crossings and ends, in
    /// (0, 1). The smaller, the shorter the paths and the thinner the triangles.
    double spacing = 0.25;
    /// Whether strands also make the wanted angles where they leave vertices and cross edges
    /// (embedding/angle_widening.hh), at the price of some length.
    bool open_angles = true;
    /// Per target edge, what a unit of length along it costs, at most 1 (as in PathMetric); empty
    /// for 1. Strands that run along edges are measured so; all else is plain length. Not copied.
    std::span<const double> edge_costs = {};
};

/// Makes all strands of a normal form as short as they get in their homotopy classes (design,
/// Sec. 4). Every step is an isotopy that fixes the landmarks, and the form is sound after each.
///
/// First with tiny gaps: one strand after the other is pulled tight between its neighbours (an
/// exact funnel), put on free vertices where it wraps around them, and moved off where one side has
/// an angle below pi. Locally shortest paths of disjoint classes do not cross, so strands that are
/// in each other's way get out of it; what remains is longer by a share of the gaps. Then the
/// wanted gaps are made, and the paths shortened again under them: for fixed vertices this is a
/// convex problem, solved by descent over strands and over edges in turn. There is no cycling: each
/// move over a vertex shortens its strand by more than a fixed share.
///
/// Strands that run along edges of lower cost (StraighteningOptions::edge_costs) stay on them, as
/// far as that costs less.
///
/// The total length never exceeds that of the form given. Plain doubles, in a fixed order: the same
/// bits on every platform, however the steps are cut into slices.
class Straightening {
public:
    /// `form` has its vertex elements at landmarks and on edges of lower cost only, as
    /// normal_form_of() puts them, and keeps the gaps of `options.spacing`, for instance after
    /// NormalForm::spread_evenly().
    Straightening(NormalForm form, const std::vector<Index>& landmarks,
                  StraighteningOptions options = {});
    // Members refer to each other.
    Straightening(const Straightening&) = delete;
    Straightening& operator=(const Straightening&) = delete;

    /// Does a bounded amount of work, about one pass over a strand; false once done.
    bool step();
    /// Ends it early, in a sound and well spaced state.
    void finish();
    /// In [0, 1], never decreasing.
    double progress() const { return progress_; }

    const NormalForm& form() const { return form_; }
    /// The straightened form, compact; only once done.
    NormalForm take();

private:
    enum class Stage { tiny_gaps, strands, edges, done };

    void tighten_next();
    void mark(Index strand);
    void mark_neighbours(Index strand);
    void mark_around(Index vertex);
    void open_gaps();
    void begin_sweep();
    void sweep_strand();
    void balance_edges();
    /// Puts strands on the vertices that their gaps press them against; false if there are none.
    bool snap_strands();
    void conclude();

    WantedAngles angles_;
    CrossingGaps gaps_;
    StraighteningOptions options_;
    NormalForm original_;
    double original_length_;
    NormalForm form_;
    VertexMoves moves_;
    StrandTightening tightening_;
    EdgeBalancing balancing_;
    Stage stage_ = Stage::tiny_gaps;

    // Tiny gaps: the strands to look at, in turn.
    std::vector<bool> waiting_;
    Index waiting_count_;
    Index current_ = 0;
    double turn_length_ = -1;  // of the current strand when its turn began, negative before
    std::uint64_t passes_ = 0;

    // Wanted gaps.
    std::vector<Index> crowded_;  // edges with two crossings or more
    double sweep_length_ = 0;
    int sweeps_ = 0;
    /// Not to leave the vertices and faces of the original.
    bool fixed_ = false;
    double progress_ = 0;
};

}  // namespace layout_embedding
