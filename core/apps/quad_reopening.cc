#include "apps/quad_reopening.hh"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <map>
#include <set>
#include <span>
#include <vector>

#include "apps/quad_vertex_moves.hh"

namespace layout_embedding {

struct ReopeningAttempt {
    /// What opens a fold: vertices spread out as means of their neighbours, lower their energy one
    /// by one whatever that flips on the way, or unfold together: at once, softly at first, or to
    /// quads of one size.
    enum class Opening : std::uint8_t { spread, lower, unfold, soften, inflate };

    int rings;
    Opening opening;
    /// Moves what is around a landmark back onto it first; for quads at landmarks.
    bool centres = false;
};

namespace {

using Opening = ReopeningAttempt::Opening;

constexpr std::array<ReopeningAttempt, 31> kAttempts{{
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
/// That help most often where quads are not folded, but flat.
constexpr std::array<ReopeningAttempt, 9> kBriefAttempts{{
    {2, Opening::unfold},
    {2, Opening::soften},
    {3, Opening::unfold},
    {2, Opening::lower},
    {2, Opening::spread},
    {3, Opening::soften},
    {4, Opening::unfold},
    {4, Opening::soften},
    {6, Opening::unfold},
}};
/// The scaled Jacobian that unfolding aims for, in floors.
constexpr double kMargin = 1.5;

}  // namespace

bool QuadReopening::step()
{
    const std::span<const ReopeningAttempt> attempts =
        goal_.is_brief ? std::span<const ReopeningAttempt>(kBriefAttempts) : kAttempts;
    if (moves_ > goal_.most_moves) {
        return false;
    }
    while (quad_ < quads_.quad_count() && !is_bad(quad_)) {
        ++quad_;
    }
    if (quad_ < quads_.quad_count()) {
        has_helped_ = reopen(quad_++, attempts[attempt_]) || has_helped_;
        return true;
    }
    // What has helped with one quad may help with those that are left.
    if (!has_helped_) {
        ++attempt_;
    }
    has_helped_ = false;
    quad_ = 0;
    return attempt_ < attempts.size() && quads_.has_quads_up_to(goal_.floor);
}

/// Unfolds the vertices within some rings around a quad together, or spreads them evenly, as
/// means of their neighbours, which opens folds, too, or lowers their energy one by one
/// whatever that flips on the way; and then improves what is around them. All stays as it was
/// unless that helps.
bool QuadReopening::reopen(Index quad, const ReopeningAttempt& attempt)
{
    constexpr int kRoundsPerRing = 10;
    constexpr int kTurns = 3;
    constexpr int kImprovingRounds = 15;
    constexpr int kMendingRounds = 5;
    constexpr double kLeastGain = 1e-3;
    const std::vector<Index> inside = quads_.free_vertices_around(quad, attempt.rings);
    const std::vector<Index> touched = quads_.quads_around(inside);
    const auto bad = [&] {
        return std::count_if(touched.begin(), touched.end(), [&](Index q) { return is_bad(q); });
    };
    const auto worst = [&] {
        double least = 1;
        for (const Index q : touched) {
            least = std::min(least, quads_.jacobian(q));
        }
        return least;
    };
    const Index landmark = attempt.centres ? inner_fixed_vertex(quad) : kNone;
    if (attempt.centres && landmark == kNone) {
        return false;
    }
    const auto bad_before = bad();
    const double worst_before = worst();
    std::vector<MovableQuads::Place> places;
    for (const Index v : inside) {
        places.push_back(quads_.place(v));
    }
    const int rounds = kRoundsPerRing * std::min(attempt.rings, 8);
    double softness = attempt.opening == Opening::unfold ? kLeastSoftness : kMostSoftness;
    for (int round = 0; round < rounds; ++round) {
        moves_ += inside.size();
        if (attempt.centres) {
            centre_on(landmark, attempt.rings - 1);
        }
        if (attempt.opening >= Opening::unfold) {
            quads_.unfold(inside, touched,
                          {softness, attempt.opening == Opening::inflate, kMargin * goal_.floor,
                           goal_.least_cosine});
            if (bad() == 0) {
                break;
            }
            softness = harder(softness);
            continue;
        }
        for (const Index v : inside) {
            if (attempt.opening == Opening::lower) {
                lower_distortion(quads_, v, {.may_flip = true, .least_cosine = goal_.least_cosine});
                continue;
            }
            quads_.walk(v, quads_.place(v).point, quads_.mean_around(v));
        }
    }
    for (int turn = 0; turn < kTurns && bad() > 0; ++turn) {
        for (int round = 0; round < kImprovingRounds && bad() > 0; ++round) {
            moves_ += inside.size();
            for (const Index v : inside) {
                lower_distortion(quads_, v, {.least_cosine = goal_.least_cosine});
            }
        }
        for (int round = 0; round < kMendingRounds && bad() > 0; ++round) {
            moves_ += inside.size();
            for (const Index v : inside) {
                if (quads_.quality(v) < kBadQuality) {
                    look_around(quads_, v);
                }
            }
        }
    }
    const auto bad_after = bad();
    const double worst_after = worst();
    const bool helps = goal_.floor > 0
                           ? worst_after >= worst_before && bad_after <= bad_before &&
                                 (bad_after < bad_before || worst_after > worst_before + kLeastGain)
                           : bad_after < bad_before;
    if (helps) {
        return true;
    }
    for (std::size_t i = 0; i < inside.size(); ++i) {
        quads_.put(inside[i], places[i]);
    }
    return false;
}

/// A corner of a quad that is fixed and has quads all around, kNone if there is none.
Index QuadReopening::inner_fixed_vertex(Index quad) const
{
    for (const Index v : quads_.quad(quad)) {
        std::map<Index, int> sides;
        for (const Index q : quads_.quads_at(v)) {
            const auto& corners = quads_.quad(q);
            const auto at = static_cast<std::size_t>(std::find(corners.begin(), corners.end(), v) -
                                                     corners.begin());
            ++sides[corners[(at + 1) % 4]];
            ++sides[corners[(at + 3) % 4]];
        }
        if (quads_.is_fixed(v) && std::all_of(sides.begin(), sides.end(),
                                              [](const auto& side) { return side.second == 2; })) {
            return v;
        }
    }
    return kNone;
}

/// Moves what is around a fixed vertex so that this lies in the middle of its neighbours, and
/// the less the more rings away.
void QuadReopening::centre_on(Index centre, int rings)
{
    std::set<Index> found{centre};
    std::vector<Index> ring{centre};
    Vec3 shift(0, 0, 0);
    for (int level = 1; level <= rings; ++level) {
        std::set<Index> next;
        for (const Index q : quads_.quads_around(ring)) {
            next.insert(quads_.quad(q).begin(), quads_.quad(q).end());
        }
        ring.clear();
        std::set_difference(next.begin(), next.end(), found.begin(), found.end(),
                            std::back_inserter(ring));
        found.insert(next.begin(), next.end());
        if (level == 1) {
            for (const Index v : ring) {
                shift += (quads_.position(centre) - quads_.position(v)) / double(ring.size());
            }
        }
        for (const Index v : ring) {
            if (!quads_.is_fixed(v)) {
                const double share = double(rings + 1 - level) / rings;
                quads_.walk(v, quads_.place(v).point, quads_.position(v) + share * shift);
            }
        }
    }
}

}  // namespace layout_embedding
