#pragma once

#include <optional>
#include <vector>

#include "embedding/normal_form.hh"
#include "layout/layout.hh"
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

    /// Tries all edges once, those with the largest energies beside them first. Returns how many
    /// edges got new paths.
    Index pass();

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

    std::vector<Path> paths_of(std::size_t side) const;
    std::optional<Trace> trace(Index edge) const;
    std::optional<Path> traced_path(std::size_t side, const PlacedPatch& united, Index start,
                                    const Domain& domain) const;
    /// The target with the new paths of `traces`; patches beside them begin as their parts of the
    /// unions were. Nothing if the paths do not fit.
    std::optional<PlacedTarget> retraced(std::size_t side, const std::vector<Path>& paths,
                                         const std::vector<Trace>& traces) const;
    /// Keeps those of the batch that lower the energy of their patches.
    Index compare(const std::vector<Trace>& traces);
    double energy_beside(Index edge) const;

    const Layout& layout_;
    std::array<PlacedTarget*, 2> targets_;
    double scale_;
    MapEnergy judged_by_;
    std::vector<double> energies_;  // per layout face
};

}  // namespace layout_embedding
