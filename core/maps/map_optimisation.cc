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

/// One target's maps while they are moved over those of the other one.
class MapOptimisation::MovingTarget {
public:
    MovingTarget(const Layout& layout, PlacedTarget& moving, const PlacedTarget& fixed,
                 double scale, bool moves_a, MapEnergy judged_by, const std::vector<bool>& faces,
                 const std::vector<bool>& edges, bool is_exact)
        : layout_(layout),
          moving_(moving),
          fixed_(fixed),
          scale_(scale),
          moves_a_(moves_a),
          judged_by_(judged_by),
          faces_(faces),
          edges_(edges),
          is_exact_(is_exact),
          patches_(layout.face_count())
    {}

    /// Moves what is inside of a face or on an edge, or measures a face; false once all is done.
    bool step()
    {
        if (stage_ == Stage::over) {
            return false;
        }
        const bool on_edges = stage_ == Stage::chains;
        const Index count = on_edges ? layout_.edge_count() : layout_.face_count();
        const std::vector<bool>& chosen = on_edges ? edges_ : faces_;
        while (place_ < count && !chosen[place_]) {
            ++place_;
        }
        if (place_ < count) {
            work_at(place_++);
            return true;
        }
        place_ = 0;
        end_stage();
        return stage_ != Stage::over;
    }

    double progress() const
    {
        if (stage_ == Stage::over) {
            return 1;
        }
        const Index count = stage_ == Stage::chains ? layout_.edge_count() : layout_.face_count();
        return (static_cast<double>(stage_) + double(place_) / count) /
               static_cast<double>(Stage::over);
    }

private:
    enum class Stage : std::uint8_t { inside, before, chains, after, over };

    void work_at(Index place)
    {
        switch (stage_) {
            case Stage::inside:
                improve_inside(place);
                break;
            case Stage::before:
                energy_before_ += exact_energy(place);
                break;
            case Stage::chains:
                improve_chain(place);
                break;
            case Stage::after:
                energy_after_ += exact_energy(place);
                break;
            case Stage::over:
                break;
        }
    }

    void end_stage()
    {
        switch (stage_) {
            case Stage::inside:
                stage_ = is_exact_ ? Stage::before : Stage::chains;
                break;
            case Stage::before:
                before_chains_ = moving_;
                stage_ = Stage::chains;
                break;
            case Stage::chains:
                set_points();
                stage_ = is_exact_ ? Stage::after : Stage::over;
                break;
            case Stage::after:
                if (!(energy_after_ < energy_before_)) {
                    moving_ = std::move(*before_chains_);
                }
                stage_ = Stage::over;
                break;
            case Stage::over:
                break;
        }
    }

    /// What lowers the energy as MovingPatch sees it need not lower the exact one: where it does
    /// not, a patch stays if exact energies count.
    void improve_inside(Index face)
    {
        MovingPatch& patch = patches_[face].emplace(
            moving_.patches()[face], moving_.positions(face), fixed_.patches()[face],
            fixed_.positions(face), scale_, moves_a_, judged_by_);
        if (!is_exact_) {
            patch.improve_all();
            return;
        }
        const std::vector<PlanePoint> before = patch.points();
        const double energy = exact_energy(face);
        patch.improve_all();
        moving_.set_points(face, patch.points());
        if (!(exact_energy(face) < energy)) {
            moving_.set_points(face, before);
            patch.set_points(before);
        }
    }

    void improve_chain(Index edge)
    {
        find_beside(edge);
        shares_ = moving_.shares()[edge];
        for (std::size_t i = 1; i + 1 < shares_.size(); ++i) {
            improve(i);
        }
        moving_.set_shares(edge, shares_);
    }

    void set_points()
    {
        for (Index face = 0; face < layout_.face_count(); ++face) {
            if (patches_[face]) {
                moving_.set_points(face, patches_[face]->points());
            }
        }
    }

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
    MapEnergy judged_by_;
    const std::vector<bool>& faces_;
    const std::vector<bool>& edges_;
    bool is_exact_;
    Stage stage_ = Stage::inside;
    Index place_ = 0;  // of the stage: the next face or edge
    double energy_before_ = 0;
    double energy_after_ = 0;
    std::optional<PlacedTarget> before_chains_;
    std::vector<std::optional<MovingPatch>> patches_;  // per layout face
    // Of the chain that is being improved.
    std::vector<Beside> beside_;
    ChainShares shares_;
};

double area_ratio(const PlacedTarget& a, const PlacedTarget& b)
{
    return area_of_patches(a) / area_of_patches(b);
}

MapOptimisation::MapOptimisation(const Layout& layout, PlacedTarget& a, PlacedTarget& b,
                                 MapEnergy judged_by)
    : layout_(layout), targets_{&a, &b}, scale_(area_ratio(a, b)), judged_by_(judged_by)
{}
MapOptimisation::~MapOptimisation() = default;

void MapOptimisation::begin_round()
{
    begin_round(std::vector<bool>(layout_.face_count(), true),
                std::vector<bool>(layout_.edge_count(), true));
    is_exact_ = true;
}

void MapOptimisation::begin_round(std::vector<bool> faces, std::vector<bool> edges)
{
    faces_ = std::move(faces);
    edges_ = std::move(edges);
    is_exact_ = false;
    moving_.reset();
    sides_left_ = 2;
}

bool MapOptimisation::step()
{
    if (!moving_ && sides_left_ > 0) {
        const std::size_t side = sides_left_ - 1;
        moving_ = std::make_unique<MovingTarget>(layout_, *targets_[side], *targets_[1 - side],
                                                 side == 0 ? scale_ : 1 / scale_, side == 0,
                                                 judged_by_, faces_, edges_, is_exact_);
    }
    if (moving_ && !moving_->step()) {
        moving_.reset();
        --sides_left_;
    }
    return sides_left_ > 0;
}

double MapOptimisation::progress() const
{
    return 1 - (static_cast<double>(sides_left_) - (moving_ ? moving_->progress() : 0)) / 2;
}

}  // namespace layout_embedding
