#include "maps/map_optimisation.hh"

#include <algorithm>
#include <cmath>
#include <optional>

#include "maps/map_distortion.hh"
#include "maps/moving_patch.hh"

namespace layout_embedding {
namespace {

/// Shares of neighbours on a chain differ by this much at least.
constexpr std::int64_t kLeastStep = 64;
constexpr int kShareHalvings = 8;

/// One target's maps while they are moved over those of the other one.
class MovingTarget {
public:
    MovingTarget(const Layout& layout, PlacedTarget& moving, const PlacedTarget& fixed,
                 double scale, bool moves_a, MapEnergy judged_by, const std::vector<bool>& faces)
        : layout_(layout),
          moving_(moving),
          fixed_(fixed),
          scale_(scale),
          moves_a_(moves_a),
          patches_(layout.face_count())
    {
        for (Index face = 0; face < layout.face_count(); ++face) {
            if (faces[face]) {
                patches_[face].emplace(moving.patches()[face], moving.positions(face),
                                       fixed.patches()[face], fixed.positions(face), scale, moves_a,
                                       judged_by);
            }
        }
    }

    /// What lowers the energy as MovingPatch sees it need not lower the exact one: where it does
    /// not, a patch stays if `is_exact`.
    void improve_inside(bool is_exact)
    {
        for (Index face = 0; face < layout_.face_count(); ++face) {
            if (!patches_[face]) {
                continue;
            }
            if (!is_exact) {
                patches_[face]->improve_all();
                continue;
            }
            const std::vector<PlanePoint> before = patches_[face]->points();
            const double energy = exact_energy(face);
            patches_[face]->improve_all();
            moving_.set_points(face, patches_[face]->points());
            if (!(exact_energy(face) < energy)) {
                moving_.set_points(face, before);
                patches_[face]->set_points(before);
            }
        }
    }

    void improve_chains(const std::vector<bool>& edges)
    {
        for (Index edge = 0; edge < layout_.edge_count(); ++edge) {
            if (!edges[edge]) {
                continue;
            }
            find_beside(edge);
            shares_ = moving_.shares()[edge];
            for (std::size_t i = 1; i + 1 < shares_.size(); ++i) {
                improve(i);
            }
            moving_.set_shares(edge, shares_);
        }
    }

    /// Of all patches, as they were last set.
    double exact_energy() const
    {
        double sum = 0;
        for (Index face = 0; face < layout_.face_count(); ++face) {
            sum += patches_[face] ? exact_energy(face) : 0;
        }
        return sum;
    }

    void finish()
    {
        for (Index face = 0; face < layout_.face_count(); ++face) {
            if (patches_[face]) {
                moving_.set_points(face, patches_[face]->points());
            }
        }
    }

private:
    /// A side of a patch that the chain is.
    struct Beside {
        Index face;
        /// The boundary vertex where it begins.
        Index begin;
        bool forward;
        std::array<std::int64_t, 2> from;
        std::array<std::int64_t, 2> step;
    };

    double exact_energy(Index face) const
    {
        const PlacedTarget& a = moves_a_ ? moving_ : fixed_;
        const PlacedTarget& b = moves_a_ ? fixed_ : moving_;
        return patch_energy(a.patches()[face], a.positions(face), b.patches()[face],
                            b.positions(face), moves_a_ ? scale_ : 1 / scale_);
    }

    /// Finds the sides that an edge is.
    void find_beside(Index edge)
    {
        beside_.clear();
        for (const Index h : {2 * edge, 2 * edge + 1}) {
            const Index face = layout_.face(h);
            if (face == kNone) {
                continue;
            }
            const auto halfedges = layout_.face_halfedges(face);
            const auto side = static_cast<std::size_t>(
                std::find(halfedges.begin(), halfedges.end(), h) - halfedges.begin());
            const Domain& domain = moving_.domains()[face];
            const auto from = corner_steps(domain, side);
            const auto to = corner_steps(domain, side + 1);
            beside_.push_back({face,
                               moving_.patches()[face].patch.sides[side],
                               h % 2 == 0,
                               from,
                               {to[0] - from[0], to[1] - from[1]}});
        }
    }

    Index vertex(const Beside& side, std::size_t place) const
    {
        return side.begin + static_cast<Index>(side.forward ? place : shares_.size() - 1 - place);
    }

    void put(std::size_t place, std::int64_t share)
    {
        for (const Beside& side : beside_) {
            const std::int64_t along = side.forward ? share : kWholeShare - share;
            patches_[side.face]->point(vertex(side, place)) =
                to_plane({side.from[0] * kWholeShare + along * side.step[0],
                          side.from[1] * kWholeShare + along * side.step[1]});
        }
    }

    double energy(std::size_t place)
    {
        double sum = 0;
        for (const Beside& side : beside_) {
            sum += patches_[side.face]->energy_around(vertex(side, place));
        }
        return sum;
    }

    bool is_positive(std::size_t place) const
    {
        return std::all_of(beside_.begin(), beside_.end(), [&](const Beside& side) {
            return patches_[side.face]->is_positive_around(vertex(side, place));
        });
    }

    /// Moves a vertex of the chain along it. A patch that is on both sides of the chain would need
    /// the metrics around two vertices at a time: there, each value takes its own.
    void improve(std::size_t place)
    {
        const std::int64_t start = shares_[place];
        const std::int64_t below = start - shares_[place - 1];
        const std::int64_t above = shares_[place + 1] - start;
        const std::int64_t offset = std::min(below, above) / 64;
        const double before = energy(place);
        if (offset < 1 || !std::isfinite(before)) {
            return;
        }
        put(place, start + offset);
        const double ahead = energy(place);
        put(place, start - offset);
        const double behind = energy(place);
        const double slope = (ahead - behind) / 2;
        const double curvature = ahead + behind - 2 * before;
        const auto unit = static_cast<double>(offset);
        double step = curvature > 0 ? -slope / curvature * unit
                      : slope > 0   ? -16 * unit
                                    : 16 * unit;
        const double most = static_cast<double>(slope > 0 ? below : above);
        step = std::clamp(step, -most, most);
        for (int halving = 0; std::isfinite(step) && halving < kShareHalvings;
             ++halving, step /= 2) {
            const std::int64_t share = start + static_cast<std::int64_t>(std::round(step));
            if (share - shares_[place - 1] < kLeastStep ||
                shares_[place + 1] - share < kLeastStep) {
                continue;
            }
            put(place, share);
            if (is_positive(place) && energy(place) < before) {
                shares_[place] = share;
                return;
            }
        }
        put(place, start);
    }

    const Layout& layout_;
    PlacedTarget& moving_;
    const PlacedTarget& fixed_;
    double scale_;
    bool moves_a_;
    std::vector<std::optional<MovingPatch>> patches_;  // per layout face
    // Of the chain that is being improved.
    std::vector<Beside> beside_;
    ChainShares shares_;
};

double area_of_patches(const PlacedTarget& placed)
{
    double sum = 0;
    for (Index face = 0; face < placed.patches().size(); ++face) {
        const std::vector<Vec3> x = placed.positions(face);
        for (const auto& c : placed.patches()[face].map.corners) {
            sum += (x[c[1]] - x[c[0]]).cross(x[c[2]] - x[c[0]]).norm() / 2;
        }
    }
    return sum;
}

}  // namespace

double area_ratio(const PlacedTarget& a, const PlacedTarget& b)
{
    return area_of_patches(a) / area_of_patches(b);
}

MapOptimisation::MapOptimisation(const Layout& layout, PlacedTarget& a, PlacedTarget& b,
                                 MapEnergy judged_by)
    : layout_(layout), targets_{&a, &b}, scale_(area_ratio(a, b)), judged_by_(judged_by)
{}

void MapOptimisation::move(const std::vector<bool>& faces, const std::vector<bool>& edges,
                           bool is_exact)
{
    for (const std::size_t side : {std::size_t{1}, std::size_t{0}}) {
        MovingTarget moving(layout_, *targets_[side], *targets_[1 - side],
                            side == 0 ? scale_ : 1 / scale_, side == 0, judged_by_, faces);
        moving.improve_inside(is_exact);
        const PlacedTarget before = *targets_[side];
        const double energy = is_exact ? moving.exact_energy() : 0;
        moving.improve_chains(edges);
        moving.finish();
        if (is_exact && !(moving.exact_energy() < energy)) {
            *targets_[side] = before;
        }
    }
}

}  // namespace layout_embedding
