#include "apps/quad_relaxation.hh"

#include <algorithm>
#include <cmath>
#include <utility>

#include "patches/domain.hh"

namespace layout_embedding {

class QuadRelaxation::Implementation {
public:
    Implementation(const TriangleMesh& target, std::vector<bool> fixed, Index rounds,
                   QuadMesh& mesh)
        : target_(target), fixed_(std::move(fixed)), rounds_(rounds), mesh_(mesh)
    {
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
        if (stage_ == kStages) {
            return false;
        }
        const bool is_mending = stage_ == kMend || stage_ == kMendAgain;
        const Index rounds = (is_mending ? 2 : 1) * rounds_;
        const bool more = round_ < rounds && (stage_ == kSmooth     ? smooth()
                                              : stage_ == kUntangle ? untangle()
                                                                    : mend());
        ++round_;
        if (!more) {
            ++stage_;
            round_ = 0;
        }
        return stage_ < kStages;
    }

    double progress() const
    {
        const double share = rounds_ > 0 ? double(round_) / (2.0 * rounds_) : 0;
        return std::min(1.0, (stage_ + share) / kStages);
    }

private:
    // Stages, in this order; what untangling does may be mended again.
    static constexpr int kSmooth = 0;
    static constexpr int kMend = 1;
    static constexpr int kUntangle = 2;
    static constexpr int kMendAgain = 3;
    static constexpr int kStages = 4;

    /// Each of these does a round; false if another one would change nothing.
    bool smooth()
    {
        double moved = 0;
        for (Index v = 0; v < mesh_.positions.size(); ++v) {
            if (!fixed_[v]) {
                moved = std::max(moved, move(v));
            }
        }
        return moved >= 1e-3;
    }

    /// The smallest scaled Jacobian of the quads around v.
    double quality(Index v) const
    {
        double least = 1;
        for (Index place = offsets_[v]; place < offsets_[v + 1]; ++place) {
            std::array<Vec3, 4> corners;
            Vec3 up(0, 0, 0);
            for (std::size_t i = 0; i < 4; ++i) {
                const Index corner = mesh_.quads[quads_[place]][i];
                corners[i] = mesh_.positions[corner];
                up += face_normal(target_, mesh_.points[corner].face);
            }
            least = std::min(least, scaled_jacobian(corners, up));
        }
        return least;
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

    /// Means of neighbours do not untangle; where quads are still bad, vertices look around for a
    /// place where the worst quad around them is better.
    bool mend()
    {
        constexpr double kBad = 0.25;
        bool improved = false;
        for (Index v = 0; v < mesh_.positions.size(); ++v) {
            if (!fixed_[v] && quality(v) < kBad) {
                improved = look_around(
                               v, [&](Index w) { return quality(w); }, 1e-3) ||
                           improved;
            }
        }
        return improved;
    }

    /// The worst quad alone says nothing about the way out where several are folded over each
    /// other: there, a sum over all corners goes down, finite for folded ones (Escobar et al.,
    /// "Simultaneous untangling and smoothing of tetrahedral meshes", 2003).
    bool untangle()
    {
        constexpr double kBad = 0.05;
        std::vector<bool> active(mesh_.positions.size(), false);
        for (Index v = 0; v < mesh_.positions.size(); ++v) {
            if (quality(v) < kBad) {
                for (Index place = offsets_[v]; place < offsets_[v + 1]; ++place) {
                    for (const Index w : mesh_.quads[quads_[place]]) {
                        active[w] = true;
                    }
                }
            }
        }
        bool improved = false;
        for (Index v = 0; v < mesh_.positions.size(); ++v) {
            if (active[v] && !fixed_[v]) {
                improved = look_around(
                               v, [&](Index w) { return -distortion(w); }, 1e-6) ||
                           improved;
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
            Vec3 up(0, 0, 0);
            for (const Index corner : quad) {
                up += face_normal(target_, mesh_.points[corner].face);
            }
            const double length = up.norm();
            up = length > 0 ? Vec3(up / length) : up;
            for (std::size_t i = 0; i < 4; ++i) {
                const Vec3& here = mesh_.positions[quad[i]];
                const Vec3 a = mesh_.positions[quad[(i + 1) % 4]] - here;
                const Vec3 b = mesh_.positions[quad[(i + 3) % 4]] - here;
                const double d = a.cross(b).dot(up);
                const double positive = d + std::sqrt(d * d + size * size);
                sum += (a.squaredNorm() + b.squaredNorm()) / std::max(positive, 1e-300);
            }
        }
        return sum;
    }

    /// Moves v to the place around it that has the most of `value`, a function of vertices; false
    /// if that is no more than a share `least` better.
    template <typename Value>
    bool look_around(Index v, const Value& value, double least)
    {
        static const Domain directions = regular_polygon(8);
        const Vec3 old_position = mesh_.positions[v];
        const SurfacePoint old_point = mesh_.points[v];
        double length = 0;
        for (Index place = offsets_[v]; place < offsets_[v + 1]; ++place) {
            const auto& quad = mesh_.quads[quads_[place]];
            for (const Index corner : quad) {
                length = std::max(length, (mesh_.positions[corner] - old_position).norm());
            }
        }
        const Vec3 normal = face_normal(target_, old_point.face);
        int axis = 0;
        normal.cwiseAbs().minCoeff(&axis);
        const Vec3 across = normal.cross(Vec3::Unit(axis)).normalized();
        const Vec3 along = normal.cross(across);
        const double before = value(v);
        double best = before;
        SurfacePoint best_point = old_point;
        for (const double step : {0.4, 0.15, 0.05, 0.015}) {
            for (const PlanePoint& direction : directions) {
                mesh_.points[v] = walk_to_nearest(
                    target_, old_point,
                    old_position +
                        step * length * (direction.x() * across + direction.y() * along));
                mesh_.positions[v] = position_of(target_, mesh_.points[v]);
                if (const double here = value(v); here > best) {
                    best = here;
                    best_point = mesh_.points[v];
                }
            }
        }
        mesh_.points[v] = best_point;
        mesh_.positions[v] = best > before ? position_of(target_, best_point) : old_position;
        return best > before + least * std::max(1.0, std::abs(before));
    }

    const TriangleMesh& target_;
    std::vector<bool> fixed_;
    Index rounds_;
    QuadMesh& mesh_;
    int stage_ = kSmooth;
    Index round_ = 0;             // of the stage
    std::vector<Index> offsets_;  // per vertex: its first place in quads_
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
