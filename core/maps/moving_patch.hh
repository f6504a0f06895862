#pragma once

#include <vector>

#include "maps/map_distortion.hh"
#include "maps/placed_target.hh"
#include "patches/point_location.hh"

namespace layout_embedding {

/// A patch's map onto a domain while its vertices are moved, over another target's map onto the
/// same domain that stays: judges places of vertices by the energy of the map between the two
/// targets (MapDistortion::mean_energy), which is taken at four sample points per triangle.
class MovingPatch {
public:
    /// Positions are those of the maps' vertices on the targets; `scale` multiplies squared lengths
    /// of the target that stays. The energy is an integral over the moving target if `moves_a`,
    /// else over the other one. Both patches must outlive this.
    MovingPatch(const PlacedPatch& moving, const std::vector<Vec3>& moving_positions,
                const PlacedPatch& fixed, const std::vector<Vec3>& fixed_positions, double scale,
                bool moves_a);

    const std::vector<PlanePoint>& points() const { return points_; }
    PlanePoint& point(Index v) { return points_[v]; }

    /// Whether the triangles around a vertex are positively oriented, exactly.
    bool is_positive_around(Index v) const;
    /// The energy around a vertex; infinite where a triangle is not positively oriented.
    double energy_around(Index v);
    /// Takes the other target's metric at the samples around a vertex, for energy_as_seen().
    void look_around(Index v);
    /// The energy around a vertex with the metrics of the last look_around() at it.
    double energy_as_seen(Index v) const;

    /// Moves an inner vertex by a Newton step, cut back until it lowers the energy around it and
    /// keeps its triangles positively oriented; or not at all.
    void improve(Index v);
    /// Moves all inner vertices.
    void improve_all();

private:
    /// A metric on the domain: lengths are squared as x^T M x.
    struct Metric {
        double xx = 0;
        double xy = 0;
        double yy = 0;
        double determinant = 0;
    };

    template <typename Action>
    bool for_star(Index v, const Action& action) const;
    double least_height_around(Index v) const;

    const PlacedPatch& placed_;
    std::vector<PlanePoint> points_;
    PointLocation location_;
    bool moves_a_;
    std::vector<Matrix2> frames_;  // per triangle of the moving map
    std::vector<double> areas_;    // per triangle of the moving map
    std::vector<Metric> metrics_;  // per triangle of the fixed map
    std::vector<Metric> seen_;
};

}  // namespace layout_embedding
