#pragma once

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

    /// Moves all vertices of target b, then all of target a; those inside of a patch only if that
    /// lowers its exact energy (patch_energy()).
    void round()
    {
        move(std::vector<bool>(layout_.face_count(), true),
             std::vector<bool>(layout_.edge_count(), true), true);
    }
    /// The same in some layout faces, and on some edges, all of whose sides are in such faces,
    /// whatever becomes of exact energies: from bad maps the way may lead over worse ones.
    void round(const std::vector<bool>& faces, const std::vector<bool>& edges)
    {
        move(faces, edges, false);
    }

private:
    void move(const std::vector<bool>& faces, const std::vector<bool>& edges, bool is_exact);

    const Layout& layout_;
    std::array<PlacedTarget*, 2> targets_;
    double scale_;
    MapEnergy judged_by_;
};

/// The ratio of the areas of all patches of two targets.
double area_ratio(const PlacedTarget& a, const PlacedTarget& b);

}  // namespace layout_embedding
