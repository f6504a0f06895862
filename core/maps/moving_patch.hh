#pragma once

#include <vector>

#include "maps/map_distortion.hh"
#include "maps/placed_target.hh"
#include "patches/point_location.hh"

namespace layout_embedding {

/// How MovingPatch judges places of vertices.
enum class MapEnergy {
    /// By places alone: from bad maps this leads to better ones, though not where much is stretched
    /// between places.
    places,
    places_and_samples,
    /// Finds a way on where the others find none, on coarse meshes above all.
    samples,
};

/// A patch's map onto a domain while its vertices are moved, over another target's map onto the
/// same domain that stays: judges places of vertices by the energy of the map between the two
/// targets (MapDistortion::mean_energy), in one way or in two that are added. By samples: the
/// linear map of each triangle at the middles of its four quarters, which sees what is stretched
/// far inside of a triangle. By places: of each quarter, the map to the flat triangle between the
/// places of its corners on the target that stays; these are continuous, so vertices do not move to
/// where samples happen to be good.
class MovingPatch {
public:
    /// Positions are those of the maps' vertices on the targets; `scale` multiplies squared lengths
    /// of the target that stays. The energy is an integral over the moving target if `moves_a`,
    /// else over the other one. Both patches must outlive this.
    MovingPatch(const PlacedPatch& moving, const std::vector<Vec3>& moving_positions,
                const PlacedPatch& fixed, const std::vector<Vec3>& fixed_positions, double scale,
                bool moves_a, MapEnergy judged_by);

    const std::vector<PlanePoint>& points() const { return points_; }
    PlanePoint& point(Index v) { return points_[v]; }
    void set_points(std::vector<PlanePoint> points) { points_ = std::move(points); }

    /// Whether the triangles around a vertex are positively oriented, exactly.
    bool is_positive_around(Index v) const;
    /// The energy around a vertex; infinite where a triangle is not positively oriented.
    double energy_around(Index v);

    /// Moves an inner vertex by a Newton step, cut back until it lowers the energy around it and
    /// keeps its triangles positively oriented; or not at all.
    void improve(Index v);
    /// Moves all inner vertices.
    void improve_all();

private:
    /// A triangle on the target that moves: its area, and the inverse of its metric in the basis of
    /// its first two edges.
    struct Shape {
        double area;
        double xx;
        double xy;
        double yy;
    };
    /// A metric on the domain: lengths are squared as x^T M x.
    struct Metric {
        double xx = 0;
        double xy = 0;
        double yy = 0;
        double determinant = 0;
    };
    /// Of a triangle at the vertex that moves: which corner that is, and the places of the other
    /// two and of their middle, in the order around the triangle.
    struct Opposite {
        Index triangle;
        std::size_t corner;
        std::array<Vec3, 3> places;
        std::array<Metric, 4> metrics;
    };

    Vec3 lifted(const PlanePoint& point) const;
    double energy(double squares, double ratio) const;
    double sampled_energy(const Opposite& opposite) const;
    /// Finds what energy_as_seen() needs and stays while the vertex moves.
    void look_around(Index v);
    double energy_as_seen(Index v) const;
    template <typename Action>
    bool for_star(Index v, const Action& action) const;
    double least_height_around(Index v) const;

    const PlacedPatch& placed_;
    std::vector<PlanePoint> points_;
    PointLocation location_;
    bool moves_a_;
    MapEnergy judged_by_;
    const PlacedPatch& fixed_;
    std::vector<Vec3> fixed_positions_;
    double scale_;
    std::vector<Shape> shapes_;    // per triangle of the moving map
    std::vector<Matrix2> frames_;  // per triangle of the moving map
    std::vector<Metric> metrics_;  // per triangle of the fixed map
    std::vector<Opposite> seen_;
};

}  // namespace layout_embedding
