#include "apps/quad_relaxation.hh"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include "apps/movable_quads.hh"
#include "apps/quad_reopening.hh"
#include "apps/quad_unfolding.hh"
#include "apps/quad_vertex_moves.hh"

namespace layout_embedding {
namespace {

/// How to begin: rounds in which all vertices unfold together, to quads of one size first and then
/// to whatever size, in shares of the relaxation's rounds. Most meshes need none of that. Where one
/// way leaves folds, another one often leaves none.
struct Way {
    double inflating;
    double unfolding;
    /// Moves that placing neighbourhoods of what is still flipped anew may take, per vertex of the
    /// mesh.
    std::size_t reopening_moves;
};
constexpr std::array<Way, 5> kWays{
    {{0, 0, 100}, {2, 2, 250}, {1.4, 1.4, 250}, {0, 2, 250}, {3, 3, 250}}};

/// How quads that are nearly flat are lifted at the end, in this order; most_moves are per vertex
/// of the mesh. Their own normals hide that they stand on edge, and lowering the distortion leaves
/// those as flat as they are, so some are seen from the surface.
constexpr std::array<ReopeningGoal, 3> kLifts{
    {{0.1, true, 0.3, 30}, {0.1, true, 0, 20}, {0.03, false, 0.3, 100}}};
/// Share of the work before that.
constexpr double kRelaxed = 0.8;

}  // namespace

class QuadRelaxation::Implementation {
public:
    Implementation(const TriangleMesh& target, std::vector<bool> fixed, Index rounds,
                   QuadMesh& mesh)
        : quads_(target, std::move(fixed), mesh), rounds_(rounds)
    {
        is_active_.assign(quads_.vertex_count(), true);
    }

    bool step()
    {
        if (stage_ == Stage::over) {
            return false;
        }
        if (first_.points.empty()) {
            first_ = quads_.places();
        }
        const bool more = round_ < rounds_of_stage() && round();
        ++round_;
        if (!more) {
            round_ = 0;
            end_stage();
        }
        return stage_ != Stage::over;
    }

    double progress() const
    {
        const Index rounds = rounds_of_stage();
        const double share = rounds > 0 ? std::min(1.0, double(round_) / rounds) : 1;
        switch (stage_) {
            case Stage::lift:
                return kRelaxed + (0.98 - kRelaxed) * (double(lift_) + share) / kLifts.size();
            case Stage::even_out:
                return 0.98 + 0.02 * share;
            case Stage::over:
                return 1;
            default:
                break;
        }
        // Most often one of the first two ways is the last one.
        constexpr std::array<double, kWays.size() + 1> kBegins{0, 0.4, 0.9, 0.94, 0.97, 1};
        return kRelaxed * (kBegins[way_] + (kBegins[way_ + 1] - kBegins[way_]) * progress_of_way());
    }

private:
    double progress_of_way() const
    {
        const Index rounds = rounds_of_stage();
        const double share = rounds > 0 ? std::min(1.0, double(round_) / rounds) : 0;
        switch (stage_) {
            case Stage::inflate:
                return 0.15 * share;
            case Stage::open:
                return 0.15 + 0.15 * share;
            case Stage::smooth:
                return 0.3 + 0.05 * share;
            case Stage::settle:
                return 0.35 + 0.15 * share;
            case Stage::unfold:
                return 0.5 + 0.1 * share;
            case Stage::untangle:
            case Stage::mend:
                return 0.6 +
                       0.3 * (turn_ + (stage_ == Stage::mend ? 0.5 : 0) + share / 2) / kMostTurns;
            case Stage::reopen:
                return 0.9 + 0.05 * share;
            case Stage::resettle:
                return 0.95 + 0.05 * share;
            case Stage::lift:
            case Stage::even_out:
            case Stage::over:
                break;
        }
        return 1;
    }

    /// Means of neighbours even the mesh out where it is good. Elsewhere a smooth energy of all
    /// corners does. If quads are flipped then, all vertices lower it together until none is. What
    /// is flipped even so is untangled by turns, for as long as that makes flipped quads fewer: the
    /// energy around bad quads, and the worst quad around each vertex. Neither step is taken where
    /// it would flip more. What is still flipped has folded neighbours, and is placed anew together
    /// with them. If that does not help, all begins anew, but first all vertices lower the energy
    /// together, towards quads of one size and then of any, which opens what is folded at the
    /// beginning. The way that leaves the fewest flipped counts. What is nearly flat then is lifted
    /// (kLifts), and all is evened out once more.
    enum class Stage : std::uint8_t {
        inflate,
        open,
        smooth,
        settle,
        unfold,
        untangle,
        mend,
        reopen,
        resettle,
        lift,
        even_out,
        over
    };

    static constexpr Index kSmoothRounds = 5;
    static constexpr Index kEveningRounds = 10;
    static constexpr int kMostTurns = 8;
    static constexpr int kMostInVain = 2;
    /// Share of quads that are flipped.
    static constexpr double kMostToReopen = 0.01;
    /// Neighbourhoods that are placed anew.
    static constexpr Index kMostAttempts = 600;
    /// In lengths of the edges around a vertex.
    static constexpr double kLeastMove = 1e-3;

    Index rounds_of_stage() const
    {
        switch (stage_) {
            case Stage::inflate:
                return static_cast<Index>(kWays[way_].inflating * rounds_);
            case Stage::open:
                return static_cast<Index>(kWays[way_].unfolding * rounds_);
            case Stage::smooth:
                return std::min(kSmoothRounds, rounds_);
            case Stage::settle:
            case Stage::unfold:
            case Stage::untangle:
                return 2 * rounds_;
            case Stage::mend:
            case Stage::resettle:
                return rounds_;
            case Stage::even_out:
                return std::min(kEveningRounds, rounds_);
            case Stage::reopen:
            case Stage::lift:
                return rounds_ > 0 ? kMostAttempts : 0;
            case Stage::over:
                break;
        }
        return 0;
    }

    /// A round of the stage; false if another one would change nothing.
    bool round()
    {
        constexpr double kAll = 2;
        // At the end there are to be no more quads that are nearly flipped, either.
        constexpr double kFlat = 0.03;
        constexpr double kBadAtFirst = 0.2;
        constexpr double kBad = 0.1;
        switch (stage_) {
            case Stage::inflate:
            case Stage::open:
                return unfold_softly();
            case Stage::smooth:
                return smooth();
            case Stage::settle:
            case Stage::resettle:
                return untangle(kAll, {.flat = stage_ == Stage::resettle ? kFlat : 0});
            case Stage::unfold:
                return unfold();
            case Stage::untangle:
                return untangle(turn_ % 2 == 0 ? kBadAtFirst : kBad);
            case Stage::mend:
                return mend();
            case Stage::reopen:
            case Stage::lift:
                return reopening_->step();
            case Stage::even_out:
                return untangle(kAll, {.floor = kLifts.front().floor});
            case Stage::over:
                break;
        }
        return false;
    }

    void end_stage()
    {
        switch (stage_) {
            case Stage::inflate:
                stage_ = Stage::open;
                break;
            case Stage::open:
                stage_ = Stage::smooth;
                break;
            case Stage::smooth:
                stage_ = Stage::settle;
                break;
            case Stage::settle:
                stage_ = Stage::unfold;
                break;
            case Stage::unfold:
                if (least_unfolded_ != kNone) {
                    quads_.restore(unfolded_);
                }
                // Placing very many anew takes longer than another way.
                if (way_ == 0 && quads_.flipped_quads() > kMostToReopen * quads_.quad_count()) {
                    end_way();
                } else {
                    stage_ = Stage::untangle;
                }
                break;
            case Stage::untangle:
                stage_ = Stage::mend;
                break;
            case Stage::mend:
                end_turn();
                break;
            case Stage::reopen:
                stage_ = Stage::resettle;
                break;
            case Stage::resettle:
                end_way();
                break;
            case Stage::lift:
                begin_lift(lift_ + 1);
                break;
            case Stage::even_out:
                stage_ = Stage::over;
                break;
            case Stage::over:
                break;
        }
    }

    /// Begins anew in another way if need be; at the end the best one counts.
    void end_way()
    {
        if (const Index flipped = quads_.flipped_quads(); flipped < least_of_ways_) {
            least_of_ways_ = flipped;
            best_ = quads_.places();
        }
        if (least_of_ways_ > 0 && rounds_ > 0 && way_ + 1 < kWays.size()) {
            ++way_;
            quads_.restore(first_);
            is_active_.assign(quads_.vertex_count(), true);
            least_unfolded_ = least_flipped_ = kNone;
            turn_ = turns_in_vain_ = 0;
            stage_ = Stage::inflate;
            return;
        }
        quads_.restore(best_);
        is_lifted_ = false;
        begin_lift(0);
    }

    void begin_lift(std::size_t lift)
    {
        lift_ = lift;
        if (lift == kLifts.size() || rounds_ == 0) {
            stage_ = is_lifted_ ? Stage::even_out : Stage::over;
            return;
        }
        ReopeningGoal goal = kLifts[lift];
        goal.most_moves *= quads_.vertex_count();
        is_lifted_ = is_lifted_ || quads_.has_quads_up_to(goal.floor);
        reopening_.emplace(quads_, goal);
        stage_ = Stage::lift;
    }

    void end_turn()
    {
        const Index flipped = quads_.flipped_quads();
        turns_in_vain_ = flipped < least_flipped_ ? 0 : turns_in_vain_ + 1;
        least_flipped_ = std::min(least_flipped_, flipped);
        ++turn_;
        if (flipped > 0 && turn_ < kMostTurns && turns_in_vain_ < kMostInVain) {
            stage_ = Stage::untangle;
        } else if (flipped > 0) {
            reopening_.emplace(quads_, ReopeningGoal{.most_moves = kWays[way_].reopening_moves *
                                                                   quads_.vertex_count()});
            stage_ = Stage::reopen;
        } else {
            end_way();
        }
    }

    bool smooth()
    {
        std::vector<bool> next(is_active_.size(), false);
        bool moved = false;
        for (Index v = 0; v < quads_.vertex_count(); ++v) {
            if (!quads_.is_fixed(v) && is_active_[v] && move_to_mean(quads_, v) > kLeastMove) {
                moved = true;
                quads_.mark_around(v, next);
            }
        }
        is_active_ = std::move(next);
        return moved;
    }

    /// Around quads whose scaled Jacobian is below `bad`, a sum over all corners goes down that
    /// grows as a corner becomes flat, and is finite for folded ones (Escobar et al., "Simultaneous
    /// untangling and smoothing of tetrahedral meshes", 2003).
    bool untangle(double bad, const StepRule& rule = {})
    {
        constexpr double kLeastGain = 1e-3;
        std::vector<bool> is_bad(quads_.vertex_count(), false);
        std::vector<bool> is_near(quads_.vertex_count(), false);
        for (Index q = 0; q < quads_.quad_count(); ++q) {
            if (quads_.jacobian(q) < bad) {
                for (const Index v : quads_.quad(q)) {
                    is_bad[v] = true;
                }
            }
        }
        for (Index v = 0; v < is_bad.size(); ++v) {
            if (is_bad[v]) {
                quads_.mark_around(v, is_near);
            }
        }
        bool improved = false;
        for (Index v = 0; v < quads_.vertex_count(); ++v) {
            if (is_near[v] && !quads_.is_fixed(v)) {
                improved = lower_distortion(quads_, v, rule) > kLeastGain || improved;
            }
        }
        return improved;
    }

    /// Lowers the energy of all vertices together, the softer it is the earlier.
    bool unfold_softly()
    {
        const bool inflates = stage_ == Stage::inflate;
        if (quads_.free_vertices().empty() || (!inflates && quads_.flipped_quads() == 0)) {
            return false;
        }
        softness_ = round_ == 0 ? kMostSoftness : harder(softness_);
        quads_.unfold(quads_.free_vertices(), quads_.quads_around_free(), {softness_, inflates});
        return true;
    }

    /// Lowers the energy of all vertices together. Folds may close on the way: the round with the
    /// fewest counts.
    bool unfold()
    {
        if (round_ == 0) {
            keep_unfolded();
        }
        if (least_unfolded_ == 0 || quads_.free_vertices().empty()) {
            return false;
        }
        quads_.unfold(quads_.free_vertices(), quads_.quads_around_free(), {kLeastSoftness, false});
        keep_unfolded();
        return true;
    }

    void keep_unfolded()
    {
        if (const Index flipped = quads_.flipped_quads(); flipped < least_unfolded_) {
            least_unfolded_ = flipped;
            unfolded_ = quads_.places();
        }
    }

    /// Vertices around bad quads look around for a place where the worst quad is better.
    bool mend()
    {
        bool improved = false;
        for (Index v = 0; v < quads_.vertex_count(); ++v) {
            if (!quads_.is_fixed(v) && quads_.quality(v) < kBadQuality) {
                improved = look_around(quads_, v) || improved;
            }
        }
        return improved;
    }

    MovableQuads quads_;
    Index rounds_;
    Stage stage_ = Stage::inflate;
    Index round_ = 0;  // of the stage
    std::size_t way_ = 0;
    MovableQuads::Places first_;
    MovableQuads::Places best_;
    Index least_of_ways_ = kNone;
    int turn_ = 0;
    int turns_in_vain_ = 0;
    Index least_flipped_ = kNone;
    std::vector<bool> is_active_;  // per vertex, while smoothing
    // While all unfold.
    double softness_ = 0;
    Index least_unfolded_ = kNone;
    MovableQuads::Places unfolded_;
    std::optional<QuadReopening> reopening_;
    std::size_t lift_ = 0;
    bool is_lifted_ = false;
};

QuadRelaxation::QuadRelaxation(const TriangleMesh& target, std::vector<bool> fixed, Index rounds,
                               QuadMesh& mesh)
    : implementation_(std::make_unique<Implementation>(target, std::move(fixed), rounds, mesh))
{}
QuadRelaxation::~QuadRelaxation() = default;

bool QuadRelaxation::step()
{
    return implementation_->step();
}
double QuadRelaxation::progress() const
{
    return implementation_->progress();
}

std::vector<Vec3> surface_normals(const TriangleMesh& target, const QuadMesh& mesh)
{
    std::vector<Vec3> normals;
    normals.reserve(mesh.quads.size());
    for (const auto& quad : mesh.quads) {
        Vec3 sum(0, 0, 0);
        for (const Index v : quad) {
            sum += face_normal(target, mesh.points[v].face);
        }
        normals.push_back(sum);
    }
    return normals;
}

}  // namespace layout_embedding
