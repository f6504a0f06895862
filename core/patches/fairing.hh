#pragma once

#include <optional>
#include <span>
#include <vector>

#include "embedding/crossing_room.hh"
#include "embedding/edge_balancing.hh"
#include "embedding/normal_form.hh"
#include "embedding/refined_mesh.hh"
#include "embedding/wanted_angles.hh"
#include "layout/layout.hh"
#include "patches/patch.hh"

namespace layout_embedding {

struct FairingOptions {
    /// As in StraighteningOptions::spacing.
    double spacing = 0.25;
    /// How often a path may be traced anew at most.
    Index rounds = 3;
    /// As in StraighteningOptions::edge_costs: paths that run along an edge of lower cost stay as
    /// they are. Not copied.
    std::span<const double> edge_costs = {};
};

/// Makes patches rounder at the price of longer paths (PathShape::fair; [PSS01], Sec. 4.2: Praun,
/// Sweldens, Schroeder, "Consistent mesh parameterizations", 2001): each path is traced anew as the
/// straight line in a parametrisation of the two patches beside it as one disk, by mean-value
/// coordinates over a polygon inscribed in a circle. The disk holds no landmark but on its rim, so
/// a path stays in its homotopy class; paths that do not share a patch do not touch each other and
/// are traced at the same time.
///
/// Traced are paths beside a patch of an isoperimetric quotient below 0.3. A trace is kept if it
/// raises the smaller quotient of its two patches, by more than a hundredth, and the smallest of
/// all does not sink. It ends by itself: a path is tried again only once one of its patches has
/// changed. Patches that stay thin because they lie between many paths over the same edges then get
/// wider gaps there, where that helps much, and at the end a few sweeps take the jags out of the
/// traces that come from the triangles they run through. Paths with the same layout face on both
/// sides, or with none on one side, stay as they are; so do those that run along edges of lower
/// cost, and those whose disk cannot be mapped without flips in double precision.
///
/// Plain doubles, in a fixed order: the same bits on every platform, however the steps are cut into
/// slices.
class Fairing {
public:
    /// `form` is a complete one of the layout's edges; `layout` must outlive this.
    Fairing(const Layout& layout, NormalForm form, FairingOptions options = {});
    // Members refer to each other.
    Fairing(const Fairing&) = delete;
    Fairing& operator=(const Fairing&) = delete;

    /// Does a bounded amount of work: traces one path, or cuts the mesh; false once done.
    bool step();
    /// Ends it early, in a sound state.
    void finish();
    /// In [0, 1], never decreasing.
    double progress() const { return progress_; }
    /// How many traces were kept so far.
    Index kept() const { return kept_; }

    /// The form with the new paths, compact; only once done.
    NormalForm take();

private:
    enum class Stage { choose, trace, compare, widen, smooth, done };

    bool runs_along_cheap_edge(Index strand) const;

    /// An element of a strand: a vertex of the target, or a crossing as in NormalForm::Element.
    struct Place {
        Index vertex = kNone;
        Index halfedge = kNone;
        double parameter = 0;
    };
    using Path = std::vector<Place>;

    /// An embedding and its patches.
    struct State {
        std::vector<Path> paths;
        NormalForm form;
        RefinedMesh refined;
        std::vector<Patch> patches;
        std::vector<double> quotients;  // per layout face
    };

    /// Cuts the mesh, after making room between crossings if asked to; nothing if paths meet.
    std::optional<State> state_of(std::vector<Path> paths, bool make_room) const;
    /// Chooses paths that share no patch, those with the worst patches first.
    void choose();
    void trace(Index edge);
    std::optional<Path> straightened(Index edge) const;
    /// Keeps the new paths that make their patches better.
    void compare();
    /// The smaller quotient of the two patches beside an edge.
    double quotient_beside(const State& state, Index edge) const;
    /// Widens the gaps in which the worst patches lie.
    void widen();
    /// Takes the jags out of all paths, a little.
    void smooth();
    void conclude();

    const Layout& layout_;
    FairingOptions options_;
    NormalForm original_;
    WantedAngles angles_;
    CrossingGaps gaps_;
    std::optional<State> state_;
    Stage stage_ = Stage::choose;
    std::vector<bool> waiting_;    // per edge
    std::vector<Index> attempts_;  // per edge
    std::vector<Index> batch_;     // edges
    std::vector<Path> traces_;     // per edge of the batch; empty without one
    Index kept_ = 0;
    EdgeBalancing balancing_;
    bool changed_ = false;
    int rounds_ = 0;  // of widening
    int sweeps_ = 0;  // of smoothing
    double first_quotient_ = 0;
    double least_quotient_ = 0;  // while smoothing
    double progress_ = 0;
};

}  // namespace layout_embedding
