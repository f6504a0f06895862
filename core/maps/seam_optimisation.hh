#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "embedding/normal_form.hh"
#include "layout/layout.hh"
#include "maps/map_optimisation.hh"
#include "maps/moving_patch.hh"
#include "maps/placed_target.hh"

namespace layout_embedding {

/// Lowers the energy of the map between two targets by moving the paths of both: the two patches
/// beside a layout edge are united on either target, both unions mapped onto one convex domain, the
/// map between them optimised there without regard to the paths inside, and the paths of both
/// targets traced anew as the same straight line of that domain. So a point that lay on a path need
/// no longer be mapped to one.
///
/// The unions are disks without a landmark inside: paths stay in their homotopy classes, and both
/// targets stay cut along embeddings of the layout. New paths are kept where the exact energy of
/// their two patches (once these were optimised) has become smaller. Paths that share no patch are
/// traced at the same time. Edges with the same layout face on both sides, or with none on one,
/// keep their paths. Deterministic.
class SeamOptimisation {
public:
    /// All must outlive this.
    SeamOptimisation(const Layout& layout, PlacedTarget& a, PlacedTarget& b, MapEnergy judged_by);

    /// One pass: tries all edges once, those with the largest energies beside them first. Does some
    /// work; false once the pass is over. Until then the targets hold the paths that have been kept
    /// so far.
    bool step();
    /// How many edges have got new paths.
    Index kept() const { return kept_; }
    /// Share of the pass that is done, about, in [0, 1].
    double progress() const;

private:
    /// An element of a path: a vertex of the target, or a crossing as in NormalForm::Element, with
    /// its share of the layout edge.
    struct Place {
        Index vertex = kNone;
        Index halfedge = kNone;
        double parameter = 0;
        std::int64_t share = 0;
    };
    using Path = std::vector<Place>;

    /// New paths of an edge on both targets, and where they come from.
    struct Trace {
        Index edge;
        std::array<Path, 2> paths;
        /// The domains of the faces left and right of the edge.
        std::array<Domain, 2> halves;
        /// The unions that they were traced in.
        std::array<PlacedPatch, 2> unions;
    };

    enum class Stage : std::uint8_t { measure, choose, trace, place, improve, judge, over };

    void measure();
    void choose();
    void trace();
    void place();
    void improve();
    void judge();

    std::vector<Path> paths_of(std::size_t side) const;
    bool begin_trace(Index edge);
    void improve_union(std::size_t side);
    bool end_trace();
    std::optional<Path> traced_path(std::size_t side, const PlacedPatch& united, Index start,
                                    const Domain& domain) const;
    /// The target with the new paths of `traces`; patches beside them begin as their parts of the
    /// unions were. Nothing if the paths do not fit.
    std::optional<PlacedTarget> retraced(std::size_t side, const std::vector<Path>& paths,
                                         const std::vector<Trace>& traces) const;
    /// A target with the new paths of `traces`; nothing if they do not fit.
    std::optional<PlacedTarget> attempt(std::size_t side, const std::vector<Trace>& traces) const;
    bool narrow_to(const std::vector<Trace>& traces);
    double energy_beside(Index edge) const;

    const Layout& layout_;
    std::array<PlacedTarget*, 2> targets_;
    double scale_;
    MapEnergy judged_by_;
    Stage stage_ = Stage::measure;
    Index kept_ = 0;
    std::vector<double> energies_;  // per layout face
    Index edge_count_ = 0;          // of those that may move
    std::vector<Index> waiting_;    // edges
    // Of the batch that is being traced: paths that share no patch.
    std::vector<Index> batch_;  // the next one last
    std::vector<Trace> traces_;
    // Of the edge that is being traced.
    std::optional<Trace> trace_;
    Domain union_domain_;
    std::array<std::vector<Vec3>, 2> union_positions_;
    int union_steps_ = 0;
    // Of traces that are being judged: those that wait, the next ones last, and both targets.
    std::vector<std::vector<Trace>> attempts_;
    std::vector<PlacedTarget> moved_;
    std::unique_ptr<MapOptimisation> optimisation_;
    int patch_rounds_ = 0;
};

}  // namespace layout_embedding
