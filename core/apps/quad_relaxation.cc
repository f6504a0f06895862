#include "apps/quad_relaxation.hh"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "patches/newton_step.hh"

namespace layout_embedding {

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
    }

    bool step()
    {
        if (stage_ == Stage::over) {
            return false;
        }
        const Index rounds = (stage_ == Stage::untangle ? 2 : 1) * rounds_;
        const bool more = round_ < rounds && round();
        ++round_;
        if (!more) {
            round_ = 0;
            stage_ = stage_ == Stage::smooth     ? Stage::untangle
                     : stage_ == Stage::untangle ? Stage::mend
                                                 : next_turn();
        }
        return stage_ != Stage::over;
    }

    double progress() const
    {
        const double share = rounds_ > 0 ? double(round_) / (2.0 * rounds_) : 0;
        const double stage = stage_ == Stage::smooth     ? 0
                             : stage_ == Stage::untangle ? 2 * turn_ + 1
                                                         : 2 * turn_ + 2;
        return stage_ == Stage::over ? 1 : std::min(1.0, (stage + share) / (2 * kMostTurns + 1));
    }

private:
    /// Means of neighbours do not untangle. What does, by turns, for as long as it makes flipped
    /// quads fewer: a smooth energy where many are folded over each other, and the worst quad
    /// around each vertex. Neither step is taken where it would flip more.
    enum class Stage : std::uint8_t { smooth, untangle, mend, over };

    static constexpr int kMostTurns = 8;
    static constexpr int kMostInVain = 2;
    /// In lengths of the edges around a vertex.
    static constexpr double kLeastMove = 1e-3;

    /// A round of the stage; false if another one would change nothing.
    bool round()
    {
        constexpr double kBadAtFirst = 0.2;
        constexpr double kBad = 0.1;
        return stage_ == Stage::smooth     ? smooth()
               : stage_ == Stage::untangle ? untangle(turn_ % 2 == 0 ? kBadAtFirst : kBad)
                                           : mend();
    }

    Stage next_turn()
    {
        const Index flipped = flipped_quads();
        turns_in_vain_ = flipped < least_flipped_ ? 0 : turns_in_vain_ + 1;
        least_flipped_ = std::min(least_flipped_, flipped);
        ++turn_;
        return flipped > 0 && turn_ < kMostTurns && turns_in_vain_ < kMostInVain ? Stage::untangle
                                                                                 : Stage::over;
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

    Index flipped_around(Index v) const
    {
        Index count = 0;
        for (Index place = offsets_[v]; place < offsets_[v + 1]; ++place) {
            const auto& quad = mesh_.quads[quads_[place]];
            count += scaled_jacobian(corners(quad), up(quad)) > 0 ? 0 : 1;
        }
        return count;
    }

    /// Moves v; how far, in lengths of the edges around it.
    double move(Index v)
    {
        constexpr double kGood = 0.5;
        Vec3 mean(0, 0, 0);
        double length = 0;
        Index count = 0;
        for (Index place = offsets_[v]; place < offsets_[v + 1]; ++place) {
            const auto& quad = mesh_.quads[quads_[place]];
            const auto at = std::find(quad.begin(), quad.end(), v) - quad.begin();
            for (const auto step : {1, 3}) {
                const Vec3& neighbour =
                    mesh_.positions[quad[static_cast<std::size_t>((at + step) % 4)]];
                mean += neighbour;
                length += (neighbour - mesh_.positions[v]).norm();
                ++count;
            }
        }
        mean /= count;
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

    Index flipped_quads() const
    {
        Index count = 0;
        for (const auto& quad : mesh_.quads) {
            count += scaled_jacobian(corners(quad), up(quad)) > 0 ? 0 : 1;
        }
        return count;
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
    /// as seen along the surface's normal, and e small.
    double distortion(Index v) const
    {
        constexpr double kSmall = 1e-2;
        double size = 0;
        double sum = 0;
        for (Index place = offsets_[v]; place < offsets_[v + 1]; ++place) {
            const auto& quad = mesh_.quads[quads_[place]];
            for (std::size_t i = 0; i < 4; ++i) {
                size +=
                    (mesh_.positions[quad[(i + 1) % 4]] - mesh_.positions[quad[i]]).squaredNorm();
            }
        }
        size *= kSmall / (4.0 * (offsets_[v + 1] - offsets_[v]));
        for (Index place = offsets_[v]; place < offsets_[v + 1]; ++place) {
            const auto& quad = mesh_.quads[quads_[place]];
            const std::array<Vec3, 4> c = corners(quad);
            Vec3 normal = up(quad);
            normal /= std::max(normal.norm(), 1e-300);
            for (std::size_t i = 0; i < 4; ++i) {
                const Vec3 a = c[(i + 1) % 4] - c[i];
                const Vec3 b = c[(i + 3) % 4] - c[i];
                const double d = a.cross(b).dot(normal);
                sum += (a.squaredNorm() + b.squaredNorm()) /
                       std::max(d + std::sqrt(d * d + size * size), 1e-300);
            }
        }
        return sum;
    }

    /// Vertices around bad quads look around for a place where the worst quad is better.
    bool mend()
    {
        constexpr double kBad = 0.1;
        bool improved = false;
        for (Index v = 0; v < mesh_.positions.size(); ++v) {
            if (!fixed_[v] && quality(v) < kBad) {
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
    /// flips no more quads. Returns by which share it lowered the distortion.
    double improve(Index v)
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
        const double h = 1e-3 * std::max(length, 1e-3 * longest);
        PlanePoint step = newton_step(
            [&](double x, double y) {
                mesh_.positions[v] = old_position + x * across + y * along;
                return distortion(v);
            },
            before, h);
        if (const double size = step.norm(); size > longest) {
            step *= longest / size;
        }
        for (int halving = 0; halving < kHalvings; ++halving, step /= 2) {
            mesh_.points[v] = walk_to_nearest(target_, old_point,
                                              old_position + step.x() * across + step.y() * along);
            mesh_.positions[v] = position_of(target_, mesh_.points[v]);
            const double after = distortion(v);
            if (after < before && flipped_around(v) <= flipped) {
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
    Stage stage_ = Stage::smooth;
    Index round_ = 0;  // of the stage
    int turn_ = 0;
    int turns_in_vain_ = 0;
    Index least_flipped_ = kNone;
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
