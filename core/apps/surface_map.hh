#pragma once

#include <array>
#include <memory>
#include <vector>

#include "base/result.hh"
#include "layout/layout.hh"
#include "maps/map_distortion.hh"
#include "maps/moving_patch.hh"
#include "maps/overlay.hh"
#include "maps/placed_target.hh"

namespace layout_embedding {

struct SurfaceMapOptions {
    /// Rounds of optimisation at most (maps/map_optimisation.hh); 0 leaves the maps of the patches
    /// as they are.
    Index rounds = 5;
    /// How often all paths are moved at most (maps/seam_optimisation.hh), each time followed by
    /// such rounds, for as long as the energy sinks by more than a fiftieth of what it exceeds an
    /// isometry by; 0 keeps the paths of the embeddings.
    Index seam_passes = 8;
};

/// A layout's embedding in a target, with its landmarks.
struct MappedTarget {
    EmbeddedTarget embedded;
    /// Target vertex per layout vertex.
    std::vector<Index> landmarks;
};

/// A one-to-one piecewise linear map between two targets of the same layout, through a domain per
/// layout face (paper, Sec. 5.3): its homotopy class is that of the embeddings. Targets are called
/// a (0) and b (1).
class SurfaceMap {
public:
    /// Maps the patches of two embeddings that check_embedding() accepts onto common domains,
    /// lowers the map's distortion, and confirms it by check_maps(). Errors: parametrisationFailed;
    /// internal, if the check refuses the map.
    static Result<SurfaceMap> make(std::shared_ptr<const Layout> layout, MappedTarget a,
                                   MappedTarget b, const SurfaceMapOptions& options = {});

    const Layout& layout() const { return *layout_; }
    const PlacedTarget& placed(std::size_t side) const { return placed_[side]; }
    /// The image on the other target of a point of target `side`; face kNone where that lies
    /// outside of all patches (a layout with boundary).
    SurfacePoint image(std::size_t side, const SurfacePoint& point) const;
    /// The images of all vertices of target `side`, landmarks exactly.
    const std::vector<SurfacePoint>& vertex_images(std::size_t side) const
    {
        return vertex_images_[side];
    }
    const Overlay& overlay() const { return overlay_; }
    const MapDistortion& distortion() const { return distortion_; }
    /// Before optimisation.
    const MapDistortion& first_distortion() const { return first_distortion_; }

private:
    friend class SurfaceMapJob;
    SurfaceMap() = default;
    void find_vertex_images(const std::vector<Index>& landmarks_a,
                            const std::vector<Index>& landmarks_b);

    std::shared_ptr<const Layout> layout_;
    std::vector<PlacedTarget> placed_;
    std::array<std::vector<SurfacePoint>, 2> vertex_images_;
    Overlay overlay_;
    MapDistortion distortion_;
    MapDistortion first_distortion_;
};

class MapOptimisation;
class SeamOptimisation;

/// SurfaceMap::make() in steps: the map as the patches are, rounds of optimisation and passes over
/// the paths face by face and edge by edge, the check.
class SurfaceMapJob {
public:
    SurfaceMapJob(std::shared_ptr<const Layout> layout, MappedTarget a, MappedTarget b,
                  const SurfaceMapOptions& options = {});
    ~SurfaceMapJob();

    /// Does some work; false once the job is over.
    bool step();
    /// Share of the optimisation that is done, at least, in [0, 1].
    double progress() const;
    /// Has the map checked as far as the rounds and passes that are done have optimised it.
    void end_optimisation();
    /// The map, or what went wrong; once, when the job is over.
    Result<SurfaceMap> take();

private:
    enum class Stage : std::uint8_t { place, rounds, unjudged_round, paths, check, over };

    Status place();
    MapEnergy judged_by() const;
    Status optimise();
    void end_rounds();
    Status move_paths();
    Status check();
    /// Takes over what has been moved if that has lowered the energy; by how much it has.
    Result<double> keep_if_better();

    std::array<MappedTarget, 2> targets_;
    SurfaceMapOptions options_;
    SurfaceMap map_;
    Stage stage_ = Stage::place;
    Index round_ = 0;  // since the paths were moved
    Index pass_ = 0;
    double before_pass_ = 0;  // the mean energy before the last pass
    Status status_;
    // Of a round or a pass: both targets, and what moves their maps.
    std::vector<PlacedTarget> moved_;
    std::unique_ptr<MapOptimisation> round_of_maps_;
    std::unique_ptr<SeamOptimisation> pass_over_paths_;
};

}  // namespace layout_embedding
