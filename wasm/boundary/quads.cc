// Quad meshes of a job's embedding.
#include "apps/quad_mesh.hh"
#include "boundary/boundary.hh"

namespace layout_embedding::boundary {

namespace {

const QuadMesh& quad_mesh(std::uint32_t handle)
{
    return handles<QuadMesh>().get(handle);
}

}  // namespace

/// Begins a quad mesh of a job's embedding. `segments` are `count` pairs of a layout edge and its
/// number of segments; an edge length of 0 stands for the default. `same` are `same_count` numbers
/// of segments of another mesh of the layout, which rule alone if there are any. Returns its
/// handle.
BOUNDARY_EXPORT(boundary_quads_job_create)
std::uint32_t boundary_quads_job_create(std::uint32_t job, double edge_length,
                                        const std::array<Index, 2>* segments, std::size_t count,
                                        const Index* same, std::size_t same_count,
                                        std::uint32_t relaxation_rounds)
{
    return guarded(0U, [&] {
        const EmbedJob& embedding = handles<JobObject>().get(job).job;
        if (!embedding.result().refined) {
            throw InvalidHandle("the job has no embedding");
        }
        QuadOptions options;
        options.edge_length = edge_length;
        for (std::size_t i = 0; i < count; ++i) {
            options.segments.emplace_back(segments[i][0], segments[i][1]);
        }
        options.segments_as.assign(same, same + same_count);
        options.relaxation_rounds = relaxation_rounds;
        return handles<QuadJobObject>().add(std::make_unique<QuadJobObject>(embedding, options));
    });
}

/// Works for so many milliseconds: 1 while there is more to do, kFailed where it went wrong.
BOUNDARY_EXPORT(boundary_quads_job_step)
std::int32_t boundary_quads_job_step(std::uint32_t job, double milliseconds)
{
    return guarded(kFailed,
                   [&] { return step_for(handles<QuadJobObject>().get(job).job, milliseconds); });
}

/// The share that is done, in [0, 1].
BOUNDARY_EXPORT(boundary_quads_job_progress)
double boundary_quads_job_progress(std::uint32_t job)
{
    return guarded(0.0, [&] { return handles<QuadJobObject>().get(job).job.progress(); });
}

/// Ends the relaxation; the mesh so far is taken.
BOUNDARY_EXPORT(boundary_quads_job_take)
std::uint32_t boundary_quads_job_take(std::uint32_t job)
{
    return guarded(0U, [&] {
        auto made = handles<QuadJobObject>().get(job).job.take();
        if (!made) {
            set_error(made.error());
            return 0U;
        }
        return handles<QuadMesh>().add(std::make_unique<QuadMesh>(std::move(*made)));
    });
}

BOUNDARY_EXPORT(boundary_quads_positions) std::uint32_t boundary_quads_positions(std::uint32_t mesh)
{
    return guarded(0U, [&] {
        set_view(quad_mesh(mesh).positions);
        return 1U;
    });
}

/// Views 4 vertex ids per quad.
BOUNDARY_EXPORT(boundary_quads_corners) std::uint32_t boundary_quads_corners(std::uint32_t mesh)
{
    return guarded(0U, [&] {
        set_view(quad_mesh(mesh).quads);
        return 1U;
    });
}

/// Views the layout face of each quad.
BOUNDARY_EXPORT(boundary_quads_faces) std::uint32_t boundary_quads_faces(std::uint32_t mesh)
{
    return guarded(0U, [&] {
        set_view(quad_mesh(mesh).quad_faces);
        return 1U;
    });
}

/// Views the vertices of one chain of the base complex; 0 beyond the last one.
BOUNDARY_EXPORT(boundary_quads_chain)
std::uint32_t boundary_quads_chain(std::uint32_t mesh, std::size_t chain)
{
    return guarded(0U, [&] {
        const QuadMesh& quads = quad_mesh(mesh);
        if (chain >= quads.chains.size()) {
            return 0U;
        }
        set_view(quads.chains[chain]);
        return 1U;
    });
}

/// Views the numbers of segments per edge of the base complex.
BOUNDARY_EXPORT(boundary_quads_segments) std::uint32_t boundary_quads_segments(std::uint32_t mesh)
{
    return guarded(0U, [&] {
        set_view(quad_mesh(mesh).segments);
        return 1U;
    });
}

/// Views two dual loops per layout edge.
BOUNDARY_EXPORT(boundary_quads_loops) std::uint32_t boundary_quads_loops(std::uint32_t mesh)
{
    return guarded(0U, [&] {
        set_view(quad_mesh(mesh).loops);
        return 1U;
    });
}

/// Views the statistics as 11 doubles: least and mean scaled Jacobian, flipped quads, least and
/// largest angle, angle deviation, least, mean and largest edge, whether all faces were subdivided,
/// the default edge length.
BOUNDARY_EXPORT(boundary_quads_statistics)
std::uint32_t boundary_quads_statistics(std::uint32_t mesh)
{
    return guarded(0U, [&] {
        const QuadMesh& quads = quad_mesh(mesh);
        const QuadStatistics& s = quads.statistics;
        set_owned_view(std::vector<double>{
            s.least_jacobian, s.mean_jacobian, static_cast<double>(s.flipped), s.least_angle,
            s.largest_angle, s.angle_deviation, s.least_edge, s.mean_edge, s.largest_edge,
            quads.is_subdivided ? 1.0 : 0.0, quads.default_edge_length});
        return 1U;
    });
}

BOUNDARY_EXPORT(boundary_quads_write_obj) std::uint32_t boundary_quads_write_obj(std::uint32_t mesh)
{
    return guarded(0U, [&] {
        set_owned_view(write_quad_obj(quad_mesh(mesh)));
        return 1U;
    });
}

}  // namespace layout_embedding::boundary
