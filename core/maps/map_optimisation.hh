#pragma once

#include <array>
#include <memory>
#include <vector>

#include "layout/layout.hh"
#include "maps/moving_patch.hh"
#include "maps/placed_target.hh"

namespace layout_embedding {

/// Lowers the symmetric Dirichlet energy (MapDistortion::mean_energy) of the map between two
/// targets that are placed on the same domains: vertices of either target's maps are moved one
/// after the other, those on chains along their side of the domains, in both patches beside it.
/// Landmarks stay, chains of one target stay on those of the other one.
///
/// Every move is a Newton step cut back until it lowers the energy of the triangles around the
/// vertex (MovingPatch) and keeps all of them positively oriented, exactly: the map is
/// one-to-one at any time. Deterministic, in scalar operations of a fixed order. O(#vertices) per
/// round.
class MapOptimisation {
public:
    /// All must outlive this.
    MapOptimisation(const Layout& layout, PlacedTarget& a, PlacedTarget& b, MapEnergy judged_by);

    ~MapOptimisation();

    /// Begins a round: all vertices of target b will be moved, then all of target a; those inside
    /// of a patch only if that lowers its exact energy (patch_energy()).
    void begin_round();
    /// The same in some layout faces, and on some edges, all of whose sides are in such faces,
    /// whatever becomes of exact energies: from bad maps the way may lead over worse ones.
    void begin_round(std::vector<bool> faces, std::vector<bool> edges);
    /// Works on one face or edge of the round; false once the round is over. Until then the targets
    /// are in between.
    bool step();
    /// Share of the round that is done, in [0, 1].
    double progress() const;

private:
    class MovingTarget;

    const Layout& layout_;
    std::array<PlacedTarget*, 2> targets_;
    double scale_;
    MapEnergy judged_by_;
    std::vector<bool> faces_;
    std::vector<bool> edges_;
    bool is_exact_ = false;
    std::size_t sides_left_ = 0;
    std::unique_ptr<MovingTarget> moving_;
};

/// The ratio of the areas of all patches of two targets.
double area_ratio(const PlacedTarget& a, const PlacedTarget& b);

}  // namespace layout_embedding
