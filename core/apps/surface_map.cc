#include "apps/surface_map.hh"

#include "maps/exact_location.hh"
#include "maps/map_checker.hh"
#include "maps/map_optimisation.hh"
#include "maps/seam_optimisation.hh"

namespace layout_embedding {
namespace {

/// Optimisation ends where a round lowers the energy by less than this share of what it exceeds an
/// isometry by.
constexpr double kLeastEnergyGain = 1e-3;
constexpr double kIsometry = 4;

}  // namespace

Result<SurfaceMap> SurfaceMap::make(std::shared_ptr<const Layout> layout, MappedTarget a,
                                    MappedTarget b, const SurfaceMapOptions& options)
{
    SurfaceMap map;
    map.layout_ = std::move(layout);
    const std::array<EmbeddedTarget, 2> targets{a.embedded, b.embedded};
    std::array<std::vector<Patch>, 2> patches;
    for (std::size_t side = 0; side < 2; ++side) {
        auto made = patches_of(*map.layout_, *targets[side].refined);
        if (!made) {
            return made.error();
        }
        patches[side] = std::move(*made);
    }
    const auto domains = common_domains(*map.layout_, targets, patches);
    if (!domains) {
        return domains.error();
    }
    for (std::size_t side = 0; side < 2; ++side) {
        auto placed =
            PlacedTarget::place(*map.layout_, targets[side], std::move(patches[side]), *domains);
        if (!placed) {
            return placed.error();
        }
        map.placed_.push_back(std::move(*placed));
    }
    auto made = layout_embedding::overlay(*map.layout_, map.placed_[0], map.placed_[1]);
    if (!made) {
        return made.error();
    }
    map.overlay_ = std::move(*made);
    map.distortion_ = map_distortion(map.placed_[0], map.placed_[1], map.overlay_);
    map.first_distortion_ = map.distortion_;
    const auto keep_if_better = [&](std::vector<PlacedTarget> moved) -> Result<double> {
        auto laid = layout_embedding::overlay(*map.layout_, moved[0], moved[1]);
        if (!laid) {
            return laid.error();
        }
        const MapDistortion distortion = map_distortion(moved[0], moved[1], *laid);
        const double gain = map.distortion_.mean_energy - distortion.mean_energy;
        if (gain > 0) {
            map.placed_ = std::move(moved);
            map.overlay_ = std::move(*laid);
            map.distortion_ = distortion;
        }
        return gain;
    };
    const auto improve_maps = [&]() -> Status {
        for (Index round = 0; round < options.rounds; ++round) {
            std::vector<PlacedTarget> moved = map.placed_;
            MapOptimisation(*map.layout_, moved[0], moved[1]).round();
            const double excess = map.distortion_.mean_energy - kIsometry;
            const auto gain = keep_if_better(std::move(moved));
            if (!gain) {
                return gain.error();
            }
            if (!(*gain > kLeastEnergyGain * excess)) {
                break;
            }
        }
        return {};
    };
    if (const Status status = improve_maps(); !status) {
        return status.error();
    }
    for (Index pass = 0; pass < options.seam_passes; ++pass) {
        std::vector<PlacedTarget> moved = map.placed_;
        if (SeamOptimisation(*map.layout_, moved[0], moved[1]).pass() == 0) {
            break;
        }
        if (const auto gain = keep_if_better(std::move(moved)); !gain) {
            return gain.error();
        }
        if (const Status status = improve_maps(); !status) {
            return status.error();
        }
    }
    const CheckReport report =
        check_maps(*map.layout_, a.landmarks, map.placed_[0], b.landmarks, map.placed_[1]);
    if (!report.valid()) {
        return make_error(ErrorCode::internal, "the map was refused (" +
                                                   report.violations.front().code +
                                                   "): " + report.violations.front().message);
    }
    map.find_vertex_images(a.landmarks, b.landmarks);
    return map;
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
