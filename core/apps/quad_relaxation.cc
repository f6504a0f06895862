#include "apps/quad_relaxation.hh"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "apps/quad_unfolding.hh"
#include "patches/newton_step.hh"

namespace layout_embedding {
namespace {

/// What opens a fold: vertices spread out as means of their neighbours, lower their energy one
/// by one whatever that flips on the way, or unfold together: at once, softly at first, or to
/// quads of one size.
enum class Opening : std::uint8_t { spread, lower, unfold, soften, inflate };
struct Attempt {
    int rings;
    Opening opening;
    /// Moves what is around a landmark back onto it first; for quads at landmarks.
    bool centres = false;
};
constexpr std::array<Attempt, 31> kAttempts{{
    {4, Opening::soften, true},   {8, Opening::soften, true}, {4, Opening::inflate, true},
    {8, Opening::inflate, true},  {2, Opening::unfold},       {2, Opening::soften},
    {3, Opening::unfold},         {3, Opening::inflate},      {1, Opening::spread},
    {2, Opening::spread},         {2, Opening::inflate},      {2, Opening::lower},
    {5, Opening::unfold},         {5, Opening::soften},       {5, Opening::inflate},
    {3, Opening::spread},         {4, Opening::lower},        {8, Opening::unfold},
    {8, Opening::soften},         {8, Opening::inflate},      {5, Opening::spread},
    {8, Opening::spread},         {8, Opening::lower},        {12, Opening::unfold},
    {12, Opening::inflate},       {16, Opening::unfold},      {12, Opening::soften, true},
    {12, Opening::inflate, true}, {16, Opening::soften},      {16, Opening::inflate},
    {24, Opening::unfold},
}};

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

}  // namespace

class QuadRelaxation::Implementation {
public:
    Implementation(const TriangleMesh& target, std::vector<bool> fixed, Index rounds,
                   QuadMesh& mesh)
        : target_(target), fixed_(std::move(fixed)), rounds_(rounds), mesh_(mesh)
    {
        is_active_.assign(mesh.positions.size(), true);
        for (Index face = 0; face < target.face_count(); ++face) {
            normals_.push_back(face_normal(target, face));
        }
        offsets_.assign(mesh.positions.size() + 1, 0);
        for (const auto& quad : mesh.quads) {
            for (const Index v : quad) {
                ++offsets_[v + 1];
            }
        }
        for (std::size_t v = 1; v < offsets_.size(); ++v) {
            offsets_[v] += offsets_[v - 1];
        }
        quads_.resize(offsets_.back());
        std::vector<Index> ends(offsets_.begin(), offsets_.end() - 1);
        for (Index q = 0; q < mesh.quads.size(); ++q) {
            for (const Index v : mesh.quads[q]) {
                quads_[ends[v]++] = q;
            }
        }
        for (Index v = 0; v < mesh.positions.size(); ++v) {
            if (!fixed_[v]) {
                free_.push_back(v);
            }
        }
        around_free_ = quads_around(free_);
    }

    bool step()
    {
        if (stage_ == Stage::over) {
            return false;
        }
        if (first_.points.empty()) {
            first_ = {mesh_.points, mesh_.positions};
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
        if (stage_ == Stage::over) {
            return 1;
        }
        // Most often one of the first two ways is the last one.
        constexpr std::array<double, kWays.size() + 1> kBegins{0, 0.4, 0.9, 0.94, 0.97, 1};
        return kBegins[way_] + (kBegins[way_ + 1] - kBegins[way_]) * progress_of_way();
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
    /// beginning. The way that leaves the fewest flipped counts.
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
        over
    };

    static constexpr Index kSmoothRounds = 5;
    static constexpr int kMostTurns = 8;
    static constexpr int kMostInVain = 2;
    /// Neighbourhoods that are placed anew.
    static constexpr Index kMostAttempts = 600;
    static constexpr double kLeastSoftness = 1e-4;
    static constexpr double kMostSoftness = 0.2;
    static constexpr double kSoftnessPerRound = 0.85;
    /// In lengths of the edges around a vertex.
    static constexpr double kLeastMove = 1e-3;
    /// The least scaled Jacobian of vertices that look around.
    static constexpr double kBadQuality = 0.1;

    /// Of all vertices.
    struct Places {
        std::vector<SurfacePoint> points;
        std::vector<Vec3> positions;
    };
    void restore(const Places& places)
    {
        mesh_.points = places.points;
        mesh_.positions = places.positions;
    }

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
            case Stage::reopen:
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
                return untangle(kAll);
            case Stage::unfold:
                return unfold();
            case Stage::untangle:
                return untangle(turn_ % 2 == 0 ? kBadAtFirst : kBad);
            case Stage::mend:
                return mend();
            case Stage::reopen:
                return reopen();
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
                    restore(unfolded_);
                }
                stage_ = Stage::untangle;
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
            case Stage::over:
                break;
        }
    }

    /// Begins anew in another way if need be; at the end the best one counts.
    void end_way()
    {
        if (const Index flipped = flipped_quads(); flipped < least_of_ways_) {
            least_of_ways_ = flipped;
            best_ = {mesh_.points, mesh_.positions};
        }
        if (least_of_ways_ > 0 && rounds_ > 0 && way_ + 1 < kWays.size()) {
            ++way_;
            restore(first_);
            is_active_.assign(mesh_.positions.size(), true);
            least_unfolded_ = least_flipped_ = kNone;
            turn_ = turns_in_vain_ = 0;
            reopened_quad_ = 0;
            reopening_ = reopening_moves_ = 0;
            has_reopened_ = false;
            stage_ = Stage::inflate;
            return;
        }
        restore(best_);
        stage_ = Stage::over;
    }

    void end_turn()
    {
        const Index flipped = flipped_quads();
        turns_in_vain_ = flipped < least_flipped_ ? 0 : turns_in_vain_ + 1;
        least_flipped_ = std::min(least_flipped_, flipped);
        ++turn_;
        if (flipped > 0 && turn_ < kMostTurns && turns_in_vain_ < kMostInVain) {
            stage_ = Stage::untangle;
        } else if (flipped > 0) {
            stage_ = Stage::reopen;
        } else {
            end_way();
        }
    }

    bool smooth()
    {
        std::vector<bool> next(is_active_.size(), false);
        bool moved = false;
        for (Index v = 0; v < mesh_.positions.size(); ++v) {
            if (!fixed_[v] && is_active_[v] && move(v) > kLeastMove) {
                moved = true;
                mark_around(v, next);
            }
        }
        is_active_ = std::move(next);
        return moved;
    }

    void mark_around(Index v, std::vector<bool>& marks) const
    {
        for (Index place = offsets_[v]; place < offsets_[v + 1]; ++place) {
            for (const Index w : mesh_.quads[quads_[place]]) {
                marks[w] = true;
            }
        }
    }

    Vec3 up(const std::array<Index, 4>& quad) const
    {
        Vec3 sum(0, 0, 0);
        for (const Index corner : quad) {
            sum += normals_[mesh_.points[corner].face];
        }
        return sum;
    }

    std::array<Vec3, 4> corners(const std::array<Index, 4>& quad) const
    {
        return {mesh_.positions[quad[0]], mesh_.positions[quad[1]], mesh_.positions[quad[2]],
                mesh_.positions[quad[3]]};
    }

    /// The smallest scaled Jacobian of the quads around v.
    double quality(Index v) const
    {
        double least = 1;
        for (Index place = offsets_[v]; place < offsets_[v + 1]; ++place) {
            const auto& quad = mesh_.quads[quads_[place]];
            least = std::min(least, scaled_jacobian(corners(quad), up(quad)));
        }
        return least;
    }

    Index flipped_around(Index v, double least = 0) const
    {
        Index count = 0;
        for (Index place = offsets_[v]; place < offsets_[v + 1]; ++place) {
            const auto& quad = mesh_.quads[quads_[place]];
            count += scaled_jacobian(corners(quad), up(quad)) > least ? 0 : 1;
        }
        return count;
    }

    /// Quads that are nearly flipped: at the end there are to be no more of these, either.
    Index flat_around(Index v) const
    {
        constexpr double kFlat = 0.03;
        return stage_ == Stage::resettle ? flipped_around(v, kFlat) : 0;
    }

    /// Moves v; how far, in lengths of the edges around it.
    double move(Index v)
    {
        constexpr double kGood = 0.5;
        const Vec3 mean = mean_around(v);
        double length = 0;
        Index count = 0;
        for (Index place = offsets_[v]; place < offsets_[v + 1]; ++place) {
            const auto& quad = mesh_.quads[quads_[place]];
            const auto at = std::find(quad.begin(), quad.end(), v) - quad.begin();
            for (const auto step : {1, 3}) {
                const Vec3& neighbour =
                    mesh_.positions[quad[static_cast<std::size_t>((at + step) % 4)]];
                length += (neighbour - mesh_.positions[v]).norm();
                ++count;
            }
        }
        length /= count;
        const SurfacePoint old_point = mesh_.points[v];
        const Vec3 old_position = mesh_.positions[v];
        const double before = quality(v);
        for (const double step : {1.0, 0.5, 0.2}) {
            mesh_.points[v] =
                walk_to_nearest(target_, old_point, (1 - step) * old_position + step * mean);
            mesh_.positions[v] = position_of(target_, mesh_.points[v]);
            const double after = quality(v);
            if (after > before || after >= kGood) {
                return length > 0 ? (mesh_.positions[v] - old_position).norm() / length : 0;
            }
        }
        mesh_.points[v] = old_point;
        mesh_.positions[v] = old_position;
        return 0;
    }

    bool is_flipped(Index q) const
    {
        const auto& quad = mesh_.quads[q];
        return !(scaled_jacobian(corners(quad), up(quad)) > 0);
    }

    Index flipped_quads() const
    {
        Index count = 0;
        for (Index q = 0; q < mesh_.quads.size(); ++q) {
            count += is_flipped(q) ? 1 : 0;
        }
        return count;
    }

    /// Places the neighbourhood of the next flipped quad anew, in one way after the other; false
    /// once nothing is flipped or no way is left.
    bool reopen()
    {
        if (reopening_moves_ > kWays[way_].reopening_moves * mesh_.positions.size()) {
            return false;
        }
        while (reopened_quad_ < mesh_.quads.size() && !is_flipped(reopened_quad_)) {
            ++reopened_quad_;
        }
        if (reopened_quad_ < mesh_.quads.size()) {
            has_reopened_ = reopen(reopened_quad_++, kAttempts[reopening_]) || has_reopened_;
            return true;
        }
        // What has helped with one quad may help with those that are left.
        if (!has_reopened_) {
            ++reopening_;
        }
        const bool again = reopening_ < kAttempts.size() && flipped_quads() > 0;
        has_reopened_ = false;
        reopened_quad_ = 0;
        return again;
    }

    /// Unfolds the vertices within some rings around a quad together, or spreads them evenly, as
    /// means of their neighbours, which opens folds, too, or lowers their energy one by one
    /// whatever that flips on the way; and then improves what is around them. All stays as it was
    /// unless fewer quads are flipped.
    bool reopen(Index quad, const Attempt& attempt)
    {
        constexpr int kRoundsPerRing = 10;
        constexpr int kTurns = 3;
        constexpr int kImprovingRounds = 15;
        constexpr int kMendingRounds = 5;
        const std::vector<Index> inside = free_vertices_around(quad, attempt.rings);
        const std::vector<Index> touched = quads_around(inside);
        const auto flipped = [&] {
            return std::count_if(touched.begin(), touched.end(),
                                 [&](Index q) { return is_flipped(q); });
        };
        const Index landmark = attempt.centres ? inner_fixed_vertex(quad) : kNone;
        if (attempt.centres && landmark == kNone) {
            return false;
        }
        const auto before = flipped();
        std::vector<std::pair<SurfacePoint, Vec3>> places;
        for (const Index v : inside) {
            places.emplace_back(mesh_.points[v], mesh_.positions[v]);
        }
        const int rounds = kRoundsPerRing * std::min(attempt.rings, 8);
        double softness = attempt.opening == Opening::unfold ? kLeastSoftness : kMostSoftness;
        for (int round = 0; round < rounds; ++round) {
            reopening_moves_ += inside.size();
            if (attempt.centres) {
                centre_on(landmark, attempt.rings - 1);
            }
            if (attempt.opening >= Opening::unfold) {
                unfold_quads(target_, normals_, inside, touched,
                             {softness, attempt.opening == Opening::inflate}, mesh_);
                if (flipped() == 0) {
                    break;
                }
                softness = std::max(softness * kSoftnessPerRound, kLeastSoftness);
                continue;
            }
            for (const Index v : inside) {
                if (attempt.opening == Opening::lower) {
                    improve(v, true);
                    continue;
                }
                mesh_.points[v] = walk_to_nearest(target_, mesh_.points[v], mean_around(v));
                mesh_.positions[v] = position_of(target_, mesh_.points[v]);
            }
        }
        for (int turn = 0; turn < kTurns && flipped() > 0; ++turn) {
            for (int round = 0; round < kImprovingRounds && flipped() > 0; ++round) {
                reopening_moves_ += inside.size();
                for (const Index v : inside) {
                    improve(v);
                }
            }
            for (int round = 0; round < kMendingRounds && flipped() > 0; ++round) {
                reopening_moves_ += inside.size();
                for (const Index v : inside) {
                    if (quality(v) < kBadQuality) {
                        look_around(v);
                    }
                }
            }
        }
        if (flipped() < before) {
            return true;
        }
        for (std::size_t i = 0; i < inside.size(); ++i) {
            std::tie(mesh_.points[inside[i]], mesh_.positions[inside[i]]) = places[i];
        }
        return false;
    }

    /// A corner of a quad that is fixed and has quads all around, kNone if there is none.
    Index inner_fixed_vertex(Index quad) const
    {
        for (const Index v : mesh_.quads[quad]) {
            std::map<Index, int> sides;
            for (Index place = offsets_[v]; place < offsets_[v + 1]; ++place) {
                const auto& corners = mesh_.quads[quads_[place]];
                const auto at = static_cast<std::size_t>(
                    std::find(corners.begin(), corners.end(), v) - corners.begin());
                ++sides[corners[(at + 1) % 4]];
                ++sides[corners[(at + 3) % 4]];
            }
            if (fixed_[v] && std::all_of(sides.begin(), sides.end(),
                                         [](const auto& side) { return side.second == 2; })) {
                return v;
            }
        }
        return kNone;
    }

    /// Moves what is around a fixed vertex so that this lies in the middle of its neighbours, and
    /// the less the more rings away.
    void centre_on(Index centre, int rings)
    {
        std::set<Index> found{centre};
        std::vector<Index> ring{centre};
        Vec3 shift(0, 0, 0);
        for (int level = 1; level <= rings; ++level) {
            std::set<Index> next;
            for (const Index q : quads_around(ring)) {
                next.insert(mesh_.quads[q].begin(), mesh_.quads[q].end());
            }
            ring.clear();
            std::set_difference(next.begin(), next.end(), found.begin(), found.end(),
                                std::back_inserter(ring));
            found.insert(next.begin(), next.end());
            if (level == 1) {
                for (const Index v : ring) {
                    shift += (mesh_.positions[centre] - mesh_.positions[v]) / double(ring.size());
                }
            }
            for (const Index v : ring) {
                if (!fixed_[v]) {
                    const double share = double(rings + 1 - level) / rings;
                    mesh_.points[v] = walk_to_nearest(target_, mesh_.points[v],
                                                      mesh_.positions[v] + share * shift);
                    mesh_.positions[v] = position_of(target_, mesh_.points[v]);
                }
            }
        }
    }

    /// In increasing order.
    std::vector<Index> free_vertices_around(Index quad, int rings) const
    {
        std::set<Index> found(mesh_.quads[quad].begin(), mesh_.quads[quad].end());
        for (int ring = 1; ring < rings; ++ring) {
            for (const Index q : quads_around({found.begin(), found.end()})) {
                found.insert(mesh_.quads[q].begin(), mesh_.quads[q].end());
            }
        }
        std::vector<Index> free;
        std::copy_if(found.begin(), found.end(), std::back_inserter(free),
                     [&](Index v) { return !fixed_[v]; });
        return free;
    }

    std::vector<Index> quads_around(const std::vector<Index>& vertices) const
    {
        std::set<Index> found;
        for (const Index v : vertices) {
            found.insert(quads_.begin() + offsets_[v], quads_.begin() + offsets_[v + 1]);
        }
        return {found.begin(), found.end()};
    }

    Vec3 mean_around(Index v) const
    {
        Vec3 sum(0, 0, 0);
        for (Index place = offsets_[v]; place < offsets_[v + 1]; ++place) {
            const auto& quad = mesh_.quads[quads_[place]];
            const auto at =
                static_cast<std::size_t>(std::find(quad.begin(), quad.end(), v) - quad.begin());
            sum += mesh_.positions[quad[(at + 1) % 4]] + mesh_.positions[quad[(at + 3) % 4]];
        }
        return sum / (2.0 * (offsets_[v + 1] - offsets_[v]));
    }

    /// Around quads whose scaled Jacobian is below `bad`, a sum over all corners goes down that
    /// grows as a corner becomes flat, and is finite for folded ones (Escobar et al., "Simultaneous
    /// untangling and smoothing of tetrahedral meshes", 2003).
    bool untangle(double bad)
    {
        constexpr double kLeastGain = 1e-3;
        std::vector<bool> is_bad(mesh_.positions.size(), false);
        std::vector<bool> is_near(mesh_.positions.size(), false);
        for (const auto& quad : mesh_.quads) {
            if (scaled_jacobian(corners(quad), up(quad)) < bad) {
                for (const Index v : quad) {
                    is_bad[v] = true;
                }
            }
        }
        for (Index v = 0; v < is_bad.size(); ++v) {
            if (is_bad[v]) {
                mark_around(v, is_near);
            }
        }
        bool improved = false;
        for (Index v = 0; v < mesh_.positions.size(); ++v) {
            if (is_near[v] && !fixed_[v]) {
                improved = improve(v) > kLeastGain || improved;
            }
        }
        return improved;
    }

    /// How far the corners of the quads around v are from those of squares: at a corner with the
    /// edges a and b, (a^2 + b^2) / (d + sqrt(d^2 + e^2)), where d is the signed area between them
    /// as seen along the quad's normal (quad_normal()), and e a small share of a^2 + b^2, so that
    /// small quads beside large ones count as much.
    double distortion(Index v) const
    {
        constexpr double kSmall = 5e-4;
        double sum = 0;
        for (Index place = offsets_[v]; place < offsets_[v + 1]; ++place) {
            const auto& quad = mesh_.quads[quads_[place]];
            const std::array<Vec3, 4> c = corners(quad);
            Vec3 normal = quad_normal(c, up(quad));
            normal /= std::max(normal.norm(), 1e-300);
            for (std::size_t i = 0; i < 4; ++i) {
                const Vec3 a = c[(i + 1) % 4] - c[i];
                const Vec3 b = c[(i + 3) % 4] - c[i];
                const double d = a.cross(b).dot(normal);
                const double squares = a.squaredNorm() + b.squaredNorm();
                const double e = kSmall * squares;
                sum += squares / std::max(d + std::sqrt(d * d + e * e), 1e-300);
            }
        }
        return sum;
    }

    /// Lowers the energy of all vertices together, the softer it is the earlier.
    bool unfold_softly()
    {
        const bool inflates = stage_ == Stage::inflate;
        if (free_.empty() || (!inflates && flipped_quads() == 0)) {
            return false;
        }
        softness_ =
            round_ == 0 ? kMostSoftness : std::max(softness_ * kSoftnessPerRound, kLeastSoftness);
        unfold_quads(target_, normals_, free_, around_free_, {softness_, inflates}, mesh_);
        return true;
    }

    /// Lowers the energy of all vertices together. Folds may close on the way: the round with the
    /// fewest counts.
    bool unfold()
    {
        if (round_ == 0) {
            keep_unfolded();
        }
        if (least_unfolded_ == 0 || free_.empty()) {
            return false;
        }
        unfold_quads(target_, normals_, free_, around_free_, {kLeastSoftness, false}, mesh_);
        keep_unfolded();
        return true;
    }

    void keep_unfolded()
    {
        if (const Index flipped = flipped_quads(); flipped < least_unfolded_) {
            least_unfolded_ = flipped;
            unfolded_ = {mesh_.points, mesh_.positions};
        }
    }

    /// Vertices around bad quads look around for a place where the worst quad is better.
    bool mend()
    {
        bool improved = false;
        for (Index v = 0; v < mesh_.positions.size(); ++v) {
            if (!fixed_[v] && quality(v) < kBadQuality) {
                improved = look_around(v) || improved;
            }
        }
        return improved;
    }

    bool look_around(Index v)
    {
        const Vec3 old_position = mesh_.positions[v];
        const SurfacePoint old_point = mesh_.points[v];
        double length = 0;
        for (Index place = offsets_[v]; place < offsets_[v + 1]; ++place) {
            for (const Index corner : mesh_.quads[quads_[place]]) {
                length = std::max(length, (mesh_.positions[corner] - old_position).norm());
            }
        }
        const Vec3& normal = normals_[old_point.face];
        int axis = 0;
        normal.cwiseAbs().minCoeff(&axis);
        const Vec3 across = normal.cross(Vec3::Unit(axis)).normalized();
        const Vec3 along = normal.cross(across);
        const double before = quality(v);
        const Index flipped = flipped_around(v);
        double best = before;
        SurfacePoint best_point = old_point;
        for (const double step : {0.4, 0.15, 0.05, 0.015}) {
            for (const PlanePoint& direction : directions_) {
                mesh_.points[v] = walk_to_nearest(
                    target_, old_point,
                    old_position +
                        step * length * (direction.x() * across + direction.y() * along));
                mesh_.positions[v] = position_of(target_, mesh_.points[v]);
                if (const double here = quality(v); here > best && flipped_around(v) <= flipped) {
                    best = here;
                    best_point = mesh_.points[v];
                }
            }
        }
        mesh_.points[v] = best_point;
        mesh_.positions[v] = best > before ? position_of(target_, best_point) : old_position;
        return best > before + 1e-3;
    }

    /// Moves v by a Newton step in the tangent plane, cut back until it lowers the distortion and
    /// flips no more quads, unless it may. Returns by which share it lowered the distortion.
    double improve(Index v, bool may_flip = false)
    {
        constexpr int kHalvings = 6;
        const Vec3 old_position = mesh_.positions[v];
        const SurfacePoint old_point = mesh_.points[v];
        double length = std::numeric_limits<double>::infinity();
        double longest = 0;
        for (Index place = offsets_[v]; place < offsets_[v + 1]; ++place) {
            for (const Index corner : mesh_.quads[quads_[place]]) {
                if (corner != v) {
                    const double distance = (mesh_.positions[corner] - old_position).norm();
                    length = std::min(length, distance);
                    longest = std::max(longest, distance);
                }
            }
        }
        const Vec3& normal = normals_[old_point.face];
        int axis = 0;
        normal.cwiseAbs().minCoeff(&axis);
        const Vec3 across = normal.cross(Vec3::Unit(axis)).normalized();
        const Vec3 along = normal.cross(across);
        const double before = distortion(v);
        const Index flipped = flipped_around(v);
        const Index flat = flat_around(v);
        const double h = 1e-3 * std::max(length, 1e-3 * longest);
        PlanePoint step = newton_step(
            [&](double x, double y) {
                mesh_.positions[v] = old_position + x * across + y * along;
                return distortion(v);
            },
            before, h);
        const double size = step.norm();
        if (!std::isfinite(size)) {
            mesh_.positions[v] = old_position;  // all around v lies in one place
            return 0;
        }
        if (size > longest) {
            step *= longest / size;
        }
        for (int halving = 0; halving < kHalvings; ++halving, step /= 2) {
            mesh_.points[v] = walk_to_nearest(target_, old_point,
                                              old_position + step.x() * across + step.y() * along);
            mesh_.positions[v] = position_of(target_, mesh_.points[v]);
            const double after = distortion(v);
            if (after < before &&
                (may_flip || (flipped_around(v) <= flipped && flat_around(v) <= flat))) {
                return 1 - after / before;
            }
        }
        mesh_.points[v] = old_point;
        mesh_.positions[v] = old_position;
        return 0;
    }

    const TriangleMesh& target_;
    std::vector<bool> fixed_;
    Index rounds_;
    QuadMesh& mesh_;
    Stage stage_ = Stage::inflate;
    Index round_ = 0;  // of the stage
    std::size_t way_ = 0;
    Places first_;
    Places best_;
    Index least_of_ways_ = kNone;
    int turn_ = 0;
    int turns_in_vain_ = 0;
    Index least_flipped_ = kNone;
    // All vertices that are not fixed, and the quads around them.
    std::vector<Index> free_;
    std::vector<Index> around_free_;
    // While all unfold.
    double softness_ = 0;
    Index least_unfolded_ = kNone;
    Places unfolded_;
    // While neighbourhoods are placed anew: the next quad, and in which way.
    Index reopened_quad_ = 0;
    std::size_t reopening_ = 0;
    bool has_reopened_ = false;
    std::size_t reopening_moves_ = 0;
    std::vector<bool> is_active_;                   // per vertex, while smoothing
    std::vector<Vec3> normals_;                     // per face of the target
    const Domain directions_ = regular_polygon(8);  // that are tried around a vertex
    std::vector<Index> offsets_;                    // per vertex: its first place in quads_
    std::vector<Index> quads_;
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
