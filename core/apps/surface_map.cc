#include "apps/surface_map.hh"

#include <algorithm>
#include <cmath>

#include "embedding/realisation.hh"
#include "maps/exact_location.hh"
#include "maps/map_checker.hh"
#include "maps/map_optimisation.hh"
#include "maps/seam_optimisation.hh"
#include "patches/refined_strands.hh"

namespace layout_embedding {
namespace {

/// Rounds end where one lowers the energy by less than this share of what it exceeds an isometry
/// by, passes over the paths where one does with its rounds.
constexpr double kLeastEnergyGain = 1e-3;
constexpr double kLeastPassGain = 2e-2;
/// What is ahead after a pass over the paths, as a share of what was ahead before it.
constexpr double kPassesAhead = 0.6;
constexpr double kIsometry = 4;

}  // namespace

SurfaceMapJob::SurfaceMapJob(std::shared_ptr<const Layout> layout, MappedTarget a, MappedTarget b,
                             const SurfaceMapOptions& options)
    : targets_{std::move(a), std::move(b)}, options_(options)
{
    map_.layout_ = std::move(layout);
}
SurfaceMapJob::~SurfaceMapJob() = default;

bool SurfaceMapJob::step()
{
    switch (stage_) {
        case Stage::place:
            status_ = place();
            break;
        case Stage::rounds:
        case Stage::unjudged_round:
            status_ = optimise();
            break;
        case Stage::paths:
            status_ = move_paths();
            break;
        case Stage::check:
            status_ = check();
            break;
        case Stage::over:
            return false;
    }
    if (!status_) {
        stage_ = Stage::over;
    }
    return stage_ != Stage::over;
}

double SurfaceMapJob::progress() const
{
    if (stage_ == Stage::place || stage_ == Stage::over) {
        return stage_ == Stage::over ? 1 : 0;
    }
    // Rounds, and the pass after them.
    const double rounds_share = pass_ == 0 && options_.seam_passes > 0 ? 0
                                : pass_ < options_.seam_passes         ? 0.5
                                                                       : 1;
    double part = 1;
    if (stage_ == Stage::paths) {
        const double done = pass_over_paths_ ? pass_over_paths_->progress() : 0;
        part = rounds_share + (1 - rounds_share) * done;
    } else if (stage_ != Stage::check) {
        const double done = round_of_maps_ ? round_of_maps_->progress() : 0;
        part = options_.rounds > 0 ? rounds_share * std::min(1.0, (round_ + done) / options_.rounds)
                                   : rounds_share;
    }
    // How many passes it takes is not known: most end after two or three, each counts less.
    const auto share = [](double passes) { return 1 - std::pow(kPassesAhead, passes); };
    return std::min(1.0, share(pass_ + part) / share(options_.seam_passes + 1.0));
}

void SurfaceMapJob::end_optimisation()
{
    if (stage_ == Stage::place) {
        options_.rounds = options_.seam_passes = 0;
    } else if (stage_ != Stage::over) {
        round_of_maps_.reset();
        pass_over_paths_.reset();
        stage_ = Stage::check;
    }
}

Result<SurfaceMap> SurfaceMapJob::take()
{
    if (!status_) {
        return status_.error();
    }
    return std::move(map_);
}

Status SurfaceMapJob::place()
{
    const Layout& layout = *map_.layout_;
    std::array<EmbeddedTarget, 2> targets{targets_[0].embedded, targets_[1].embedded};
    std::array<std::vector<Patch>, 2> patches;
    for (std::size_t side = 0; side < 2; ++side) {
        // Where paths move, the mesh is cut anew.
        const TriangleMesh& target = *targets[side].target;
        if (has_added_vertices(target, *targets[side].refined)) {
            auto cut = cut_along(layout, strands_of(target, *targets[side].refined));
            if (!cut) {
                return cut.error();
            }
            targets[side].refined = std::make_shared<const RefinedMesh>(std::move(*cut));
        }
        auto made = patches_of(layout, *targets[side].refined);
        if (!made) {
            return made.error();
        }
        patches[side] = std::move(*made);
    }
    const auto domains = common_domains(layout, targets, patches);
    if (!domains) {
        return domains.error();
    }
    for (std::size_t side = 0; side < 2; ++side) {
        auto placed =
            PlacedTarget::place(layout, targets[side], std::move(patches[side]), *domains);
        if (!placed) {
            return placed.error();
        }
        map_.placed_.push_back(std::move(*placed));
    }
    auto made = overlay(layout, map_.placed_[0], map_.placed_[1]);
    if (!made) {
        return made.error();
    }
    map_.overlay_ = std::move(*made);
    map_.distortion_ = map_distortion(map_.placed_[0], map_.placed_[1], map_.overlay_);
    map_.first_distortion_ = map_.distortion_;
    // Where paths may move they do so first: the way to good maps is shorter than from maps that
    // are good for paths in bad places.
    stage_ = options_.seam_passes > 0 ? Stage::paths : Stage::rounds;
    return {};
}

/// Judged by places alone, the first of several passes leads out of bad maps that samples hold
/// back; all else lowers what it left between places.
MapEnergy SurfaceMapJob::judged_by() const
{
    const bool is_first = stage_ == Stage::paths && pass_ == 0 && options_.seam_passes > 1;
    return is_first ? MapEnergy::places : MapEnergy::places_and_samples;
}

Status SurfaceMapJob::optimise()
{
    if (!round_of_maps_) {
        if (round_ == options_.rounds) {
            end_rounds();
            return {};
        }
        const bool is_judged = stage_ == Stage::rounds;
        moved_ = map_.placed_;
        round_of_maps_ = std::make_unique<MapOptimisation>(
            *map_.layout_, moved_[0], moved_[1], is_judged ? judged_by() : MapEnergy::samples);
        if (is_judged) {
            round_of_maps_->begin_round();
        } else {
            round_of_maps_->begin_round(std::vector<bool>(map_.layout_->face_count(), true),
                                        std::vector<bool>(map_.layout_->edge_count(), true));
        }
        return {};
    }
    if (round_of_maps_->step()) {
        return {};
    }
    round_of_maps_.reset();
    const double excess = map_.distortion_.mean_energy - kIsometry;
    const auto gain = keep_if_better();
    if (!gain) {
        return gain.error();
    }
    if (stage_ == Stage::rounds && !(*gain > 0)) {
        // Patches that get worse by themselves may still make the whole better.
        stage_ = Stage::unjudged_round;
        return {};
    }
    stage_ = Stage::rounds;
    ++round_;
    if (!(*gain > kLeastEnergyGain * excess)) {
        end_rounds();
    }
    return {};
}

void SurfaceMapJob::end_rounds()
{
    // The first pass and the others judge by different energies: only those that follow say
    // whether there is more to gain.
    const double energy = map_.distortion_.mean_energy;
    const bool gains =
        pass_ < 2 || before_pass_ - energy > kLeastPassGain * (before_pass_ - kIsometry);
    stage_ = pass_ < options_.seam_passes && gains ? Stage::paths : Stage::check;
}

Status SurfaceMapJob::move_paths()
{
    if (!pass_over_paths_) {
        moved_ = map_.placed_;
        pass_over_paths_ =
            std::make_unique<SeamOptimisation>(*map_.layout_, moved_[0], moved_[1], judged_by());
        return {};
    }
    if (pass_over_paths_->step()) {
        return {};
    }
    const bool has_moved = pass_over_paths_->kept() > 0;
    pass_over_paths_.reset();
    if (!has_moved && pass_ > 0) {
        stage_ = Stage::check;
        return {};
    }
    before_pass_ = map_.distortion_.mean_energy;
    if (has_moved) {
        if (const auto gain = keep_if_better(); !gain) {
            return gain.error();
        }
    }
    ++pass_;
    round_ = 0;
    stage_ = Stage::rounds;
    return {};
}

Result<double> SurfaceMapJob::keep_if_better()
{
    auto laid = overlay(*map_.layout_, moved_[0], moved_[1]);
    if (!laid) {
        return laid.error();
    }
    const MapDistortion distortion = map_distortion(moved_[0], moved_[1], *laid);
    const double gain = map_.distortion_.mean_energy - distortion.mean_energy;
    if (gain > 0) {
        map_.placed_ = std::move(moved_);
        map_.overlay_ = std::move(*laid);
        map_.distortion_ = distortion;
    }
    return gain;
}

Status SurfaceMapJob::check()
{
    const auto& [a, b] = targets_;
    const CheckReport report =
        check_maps(*map_.layout_, a.landmarks, map_.placed_[0], b.landmarks, map_.placed_[1]);
    if (!report.valid()) {
        return make_error(ErrorCode::internal, "the map was refused (" +
                                                   report.violations.front().code +
                                                   "): " + report.violations.front().message);
    }
    map_.find_vertex_images(a.landmarks, b.landmarks);
    stage_ = Stage::over;
    return {};
}

Result<SurfaceMap> SurfaceMap::make(std::shared_ptr<const Layout> layout, MappedTarget a,
                                    MappedTarget b, const SurfaceMapOptions& options)
{
    SurfaceMapJob job(std::move(layout), std::move(a), std::move(b), options);
    while (job.step()) {
    }
    return job.take();
}

SurfacePoint SurfaceMap::image(std::size_t side, const SurfacePoint& point) const
{
    const DomainPoint place = placed_[side].to_domain(point);
    if (place.face == kNone) {
        return {};
    }
    const PlacedTarget& other = placed_[1 - side];
    const PointLocation location(other.patches()[place.face].map);
    const auto [triangle, weights] = location.find(place.point);
    return other.to_surface(place.face, triangle, weights);
}

void SurfaceMap::find_vertex_images(const std::vector<Index>& landmarks_a,
                                    const std::vector<Index>& landmarks_b)
{
    for (std::size_t side = 0; side < 2; ++side) {
        const PlacedTarget& own = placed_[side];
        const PlacedTarget& other = placed_[1 - side];
        vertex_images_[side].assign(own.target().vertex_count(), {});
        for (Index face = 0; face < layout_->face_count(); ++face) {
            const PlacedPatch& placed = own.patches()[face];
            const ExactLocation location(other.patches()[face]);
            for (Index v = 0; v < placed.patch.vertices.size(); ++v) {
                const Index vertex = placed.patch.vertices[v];
                if (vertex >= own.target().vertex_count()) {
                    continue;
                }
                const GridPoint point = to_grid(placed.map.points[v]);
                const ExactPlace place = location.find(point);
                vertex_images_[side][vertex] =
                    other.to_surface(face, place.triangle, location.weights(place.triangle, point));
            }
        }
        // Landmarks to the corner that is the other one.
        const std::vector<Index>& from = side == 0 ? landmarks_a : landmarks_b;
        const std::vector<Index>& to = side == 0 ? landmarks_b : landmarks_a;
        for (std::size_t i = 0; i < from.size(); ++i) {
            const Index h = other.target().outgoing(to[i]);
            SurfacePoint& image = vertex_images_[side][from[i]];
            image = {TriangleMesh::face_of(h), {0, 0, 0}};
            image.barycentrics[h % 3] = 1;
        }
    }
}

}  // namespace layout_embedding
