// Maps between the embeddings of one layout in two targets.
#include "apps/surface_map.hh"
#include "boundary/boundary.hh"

namespace layout_embedding::boundary {

namespace {

const SurfaceMap& surface_map(std::uint32_t handle)
{
    return handles<SurfaceMap>().get(handle);
}

MappedTarget mapped_target(const EmbedJob& job)
{
    if (!job.result().refined) {
        throw InvalidHandle("the job has no embedding");
    }
    return {{job.problem().target, std::make_shared<const RefinedMesh>(*job.result().refined)},
            job.problem().landmarks};
}

std::size_t checked_side(std::uint32_t side)
{
    if (side > 1) {
        throw std::out_of_range("a map has the sides 0 and 1");
    }
    return side;
}

/// The faces of points, all bits set for none, as ids.
std::vector<Index> faces_of(const std::vector<SurfacePoint>& points)
{
    std::vector<Index> faces;
    faces.reserve(points.size());
    for (const SurfacePoint& point : points) {
        faces.push_back(point.face);
    }
    return faces;
}

std::vector<std::array<double, 3>> barycentrics_of(const std::vector<SurfacePoint>& points)
{
    std::vector<std::array<double, 3>> barycentrics;
    barycentrics.reserve(points.size());
    for (const SurfacePoint& point : points) {
        barycentrics.push_back(point.barycentrics);
    }
    return barycentrics;
}

std::vector<SurfacePoint> overlay_points(const SurfaceMap& map, std::size_t side)
{
    std::vector<SurfacePoint> points;
    points.reserve(map.overlay().points.size());
    for (const auto& both : map.overlay().points) {
        points.push_back(both[side]);
    }
    return points;
}

/// Points handed out by two calls: faces, then barycentric coordinates.
std::vector<SurfacePoint>& shown_points()
{
    static std::vector<SurfacePoint> points;
    return points;
}

}  // namespace

/// Keeps a job's embedding, whatever becomes of the job. Returns its handle.
BOUNDARY_EXPORT(boundary_embedding_create)
std::uint32_t boundary_embedding_create(std::uint32_t job)
{
    return guarded(0U, [&] {
        const EmbedJob& embedding = handles<JobObject>().get(job).job;
        return handles<EmbeddingObject>().add(std::make_unique<EmbeddingObject>(
            EmbeddingObject{embedding.problem().layout, mapped_target(embedding)}));
    });
}

/// Begins the map between a kept embedding (side 0) and a job's (side 1) of the same layout.
/// Returns its handle.
BOUNDARY_EXPORT(boundary_map_job_create)
std::uint32_t boundary_map_job_create(std::uint32_t embedding, std::uint32_t job,
                                      std::uint32_t rounds, std::uint32_t seam_passes)
{
    return guarded(0U, [&] {
        const EmbeddingObject& reference = handles<EmbeddingObject>().get(embedding);
        const EmbedJob& other = handles<JobObject>().get(job).job;
        if (other.problem().layout != reference.layout) {
            throw InvalidHandle("the embeddings are of different layouts");
        }
        return handles<SurfaceMapJob>().add(std::make_unique<SurfaceMapJob>(
            reference.layout, reference.target, mapped_target(other),
            SurfaceMapOptions{rounds, seam_passes}));
    });
}

/// Works for so many milliseconds: 1 while there is more to do, kFailed where it went wrong.
BOUNDARY_EXPORT(boundary_map_job_step)
std::int32_t boundary_map_job_step(std::uint32_t job, double milliseconds)
{
    return guarded(kFailed,
                   [&] { return step_for(handles<SurfaceMapJob>().get(job), milliseconds); });
}

/// The share that is done, in [0, 1].
BOUNDARY_EXPORT(boundary_map_job_progress) double boundary_map_job_progress(std::uint32_t job)
{
    return guarded(0.0, [&] { return handles<SurfaceMapJob>().get(job).progress(); });
}

/// Has the map finished as far as it is optimised.
BOUNDARY_EXPORT(boundary_map_job_end) std::uint32_t boundary_map_job_end(std::uint32_t job)
{
    return guarded(0U, [&] {
        handles<SurfaceMapJob>().get(job).end_optimisation();
        return 1U;
    });
}

/// The map of a job that is over. Returns its handle.
BOUNDARY_EXPORT(boundary_map_job_take) std::uint32_t boundary_map_job_take(std::uint32_t job)
{
    return guarded(0U, [&] {
        auto made = handles<SurfaceMapJob>().get(job).take();
        if (!made) {
            set_error(made.error());
            return 0U;
        }
        return handles<SurfaceMap>().add(std::make_unique<SurfaceMap>(std::move(*made)));
    });
}

/// The images of all vertices of a side, for boundary_map_faces() and the like.
BOUNDARY_EXPORT(boundary_map_vertex_images)
std::uint32_t boundary_map_vertex_images(std::uint32_t map, std::uint32_t side)
{
    return guarded(0U, [&] {
        shown_points() = surface_map(map).vertex_images(checked_side(side));
        return 1U;
    });
}

/// The images of points of a side, likewise: `count` faces, and 3 coordinates for each.
BOUNDARY_EXPORT(boundary_map_images)
std::uint32_t boundary_map_images(std::uint32_t map, std::uint32_t side, const Index* faces,
                                  const std::array<double, 3>* barycentrics, std::size_t count)
{
    return guarded(0U, [&] {
        const SurfaceMap& made = surface_map(map);
        const std::size_t from = checked_side(side);
        std::vector<SurfacePoint> images;
        for (std::size_t i = 0; i < count; ++i) {
            const auto& b = barycentrics[i];
            const double sum = b[0] + b[1] + b[2];
            if (faces[i] >= made.placed(from).target().face_count() || !(sum > 0.5 && sum < 2)) {
                set_error(make_error(ErrorCode::indexOutOfRange,
                                     "point " + std::to_string(i) +
                                         " is not given by a face of its target and three "
                                         "coordinates that add up to 1",
                                     {{"point", static_cast<std::int64_t>(i)}}));
                return 0U;
            }
            images.push_back(made.image(from, {faces[i], b}));
        }
        shown_points() = std::move(images);
        return 1U;
    });
}

/// The vertices of the overlay on a side, likewise.
BOUNDARY_EXPORT(boundary_map_overlay_points)
std::uint32_t boundary_map_overlay_points(std::uint32_t map, std::uint32_t side)
{
    return guarded(0U, [&] {
        shown_points() = overlay_points(surface_map(map), checked_side(side));
        return 1U;
    });
}

/// Views the faces of the last points, all bits set for no point.
BOUNDARY_EXPORT(boundary_map_point_faces) std::uint32_t boundary_map_point_faces()
{
    return guarded(0U, [&] {
        set_owned_view(faces_of(shown_points()));
        return 1U;
    });
}

/// Views the barycentric coordinates of the last points, 3 doubles each.
BOUNDARY_EXPORT(boundary_map_point_barycentrics) std::uint32_t boundary_map_point_barycentrics()
{
    return guarded(0U, [&] {
        set_owned_view(barycentrics_of(shown_points()));
        return 1U;
    });
}

/// Views the positions of the last points, which are on a side; zero for no point.
BOUNDARY_EXPORT(boundary_map_point_positions)
std::uint32_t boundary_map_point_positions(std::uint32_t map, std::uint32_t side)
{
    return guarded(0U, [&] {
        const TriangleMesh& target = surface_map(map).placed(checked_side(side)).target();
        std::vector<std::array<double, 3>> positions;
        for (const SurfacePoint& point : shown_points()) {
            const Vec3 p = point.face == kNone ? Vec3(0, 0, 0) : position_of(target, point);
            positions.push_back({p.x(), p.y(), p.z()});
        }
        set_owned_view(positions);
        return 1U;
    });
}

/// Views 3 vertex ids per triangle of the overlay.
BOUNDARY_EXPORT(boundary_map_overlay_corners)
std::uint32_t boundary_map_overlay_corners(std::uint32_t map)
{
    return guarded(0U, [&] {
        set_view(surface_map(map).overlay().corners);
        return 1U;
    });
}

/// Views the layout face of each triangle of the overlay.
BOUNDARY_EXPORT(boundary_map_overlay_patches)
std::uint32_t boundary_map_overlay_patches(std::uint32_t map)
{
    return guarded(0U, [&] {
        set_view(surface_map(map).overlay().layout_faces);
        return 1U;
    });
}

/// Views the face of a side that each triangle of the overlay lies in.
BOUNDARY_EXPORT(boundary_map_overlay_faces)
std::uint32_t boundary_map_overlay_faces(std::uint32_t map, std::uint32_t side)
{
    return guarded(0U, [&] {
        std::vector<Index> faces;
        for (const auto& both : surface_map(map).overlay().faces) {
            faces.push_back(both[checked_side(side)]);
        }
        set_owned_view(faces);
        return 1U;
    });
}

/// Views the barycentric coordinates of the corners of each triangle of the overlay in that face:
/// 9 doubles per triangle.
BOUNDARY_EXPORT(boundary_map_overlay_weights)
std::uint32_t boundary_map_overlay_weights(std::uint32_t map, std::uint32_t side)
{
    return guarded(0U, [&] {
        const SurfaceMap& made = surface_map(map);
        const std::size_t s = checked_side(side);
        std::vector<std::array<double, 3>> weights;
        for (std::size_t t = 0; t < made.overlay().corners.size(); ++t) {
            for (const Index v : made.overlay().corners[t]) {
                weights.push_back(coordinates_in_face(made.placed(s).target(),
                                                      made.overlay().points[v][s],
                                                      made.overlay().faces[t][s]));
            }
        }
        set_owned_view(weights);
        return 1U;
    });
}

/// Views 8 doubles: mean and largest energy, mean conformal and area distortion; then the same
/// before optimisation.
BOUNDARY_EXPORT(boundary_map_distortion) std::uint32_t boundary_map_distortion(std::uint32_t map)
{
    return guarded(0U, [&] {
        const SurfaceMap& made = surface_map(map);
        std::vector<double> numbers;
        for (const MapDistortion* d : {&made.distortion(), &made.first_distortion()}) {
            numbers.insert(numbers.end(),
                           {d->mean_energy, d->largest_energy, d->mean_conformal, d->mean_area});
        }
        set_owned_view(numbers);
        return 1U;
    });
}

}  // namespace layout_embedding::boundary
