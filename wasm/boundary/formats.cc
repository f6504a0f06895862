// Embeddings in the formats of other programs, and the reference implementation's input files.
#include "boundary/boundary.hh"
#include "embedding/carried_attributes.hh"
#include "embedding/check_input.hh"
#include "embedding/refined_obj.hh"
#include "formats/reference_files.hh"
#include "formats/refined_glb.hh"
#include "formats/refined_ply.hh"
#include "formats/refined_svg.hh"
#include "formats/refined_vtp.hh"
#include "mesh/mesh_writer.hh"

namespace layout_embedding::boundary {

namespace {

/// What a refined mesh can be written as; in the order of src/formats.ts.
enum class ExportFormat { obj, ply, vtp, glb, svg };

/// Views `refined` in a format, with attributes of its own. `view` has 7 numbers: direction, up,
/// width.
std::uint32_t view_export(const RefinedMesh& refined, const MeshAttributes& attributes,
                          ExportFormat format, const double* view)
{
    switch (format) {
        case ExportFormat::obj:
            set_owned_view(write_refined_obj(refined, attributes));
            return 1;
        case ExportFormat::ply:
            set_owned_view(write_refined_ply(refined, attributes));
            return 1;
        case ExportFormat::vtp:
            set_owned_view(write_refined_vtp(refined, attributes));
            return 1;
        case ExportFormat::glb:
            set_owned_view(write_refined_glb(refined, attributes));
            return 1;
        case ExportFormat::svg:
            break;
    }
    const auto svg = write_refined_svg(
        refined, {{view[0], view[1], view[2]}, {view[3], view[4], view[5]}, view[6]});
    if (!svg) {
        set_error(svg.error());
        return 0;
    }
    set_owned_view(*svg);
    return 1;
}

const RefinedMesh& refined_of(std::uint32_t job)
{
    const auto& refined = handles<JobObject>().get(job).job.result().refined;
    if (!refined) {
        throw InvalidHandle("the job has no embedding");
    }
    return *refined;
}

}  // namespace

/// Views a job's embedding in an ExportFormat, with the attributes of its target, seen from `view`
/// (direction, up, width) where that matters.
BOUNDARY_EXPORT(boundary_job_write)
std::uint32_t boundary_job_write(std::uint32_t job, std::uint32_t format, const double* view)
{
    return guarded(0U, [&] {
        const RefinedMesh& refined = refined_of(job);
        const JobObject& object = handles<JobObject>().get(job);
        const auto kind = static_cast<ExportFormat>(format);
        if (object.attributes == nullptr || kind == ExportFormat::svg) {
            return view_export(refined, {}, kind, view);
        }
        return view_export(
            refined, carried_attributes(*object.attributes, *object.job.problem().target, refined),
            kind, view);
    });
}

/// The same of a claimed embedding.
BOUNDARY_EXPORT(boundary_check_write)
std::uint32_t boundary_check_write(std::uint32_t check, std::uint32_t format, const double* view)
{
    return guarded(0U, [&] {
        return view_export(handles<CheckObject>().get(check).refined, {},
                           static_cast<ExportFormat>(format), view);
    });
}

/// Views a job's problem as an .inp file that names the given layout and target.
BOUNDARY_EXPORT(boundary_job_write_inp)
std::uint32_t boundary_job_write_inp(std::uint32_t job, const char* layout, std::size_t layout_size,
                                     const char* target, std::size_t target_size)
{
    return guarded(0U, [&] {
        ReferenceInput input{{layout, layout_size}, {target, target_size}, {}};
        Index vertex = 0;
        for (const Index landmark : handles<JobObject>().get(job).job.problem().landmarks) {
            input.matches.push_back({vertex++, landmark});
        }
        set_owned_view(write_reference_input(input));
        return 1U;
    });
}

/// Views a job's embedding as a .lem file that names the given .inp file and refined target.
BOUNDARY_EXPORT(boundary_job_write_lem)
std::uint32_t boundary_job_write_lem(std::uint32_t job, const char* input, std::size_t input_size,
                                     const char* refined, std::size_t refined_size)
{
    return guarded(0U, [&] {
        ReferenceEmbedding embedding{{input, input_size}, {refined, refined_size}, {}};
        const Layout& layout = *handles<JobObject>().get(job).job.problem().layout;
        const RefinedMesh& mesh = refined_of(job);
        for (Index e = 0; e < layout.edge_count(); ++e) {
            embedding.edges.push_back({{layout.tail(2 * e), layout.head(2 * e)}, mesh.chains[e]});
        }
        set_owned_view(write_reference_embedding(embedding));
        return 1U;
    });
}

/// Views a job's layout as OBJ, with its vertices at their landmarks.
BOUNDARY_EXPORT(boundary_job_write_layout)
std::uint32_t boundary_job_write_layout(std::uint32_t job)
{
    return guarded(0U, [&] {
        const EmbeddingProblem& problem = handles<JobObject>().get(job).job.problem();
        PolygonMesh mesh = to_polygons(*problem.layout);
        mesh.positions.clear();
        for (const Index landmark : problem.landmarks) {
            mesh.positions.push_back(problem.target->position(landmark));
        }
        set_owned_view(write_obj(mesh));
        return 1U;
    });
}

/// Views a job's target as OBJ.
BOUNDARY_EXPORT(boundary_job_write_target)
std::uint32_t boundary_job_write_target(std::uint32_t job)
{
    return guarded(0U, [&] {
        set_owned_view(write_obj(to_polygons(*handles<JobObject>().get(job).job.problem().target)));
        return 1U;
    });
}

/// Reads an .inp file; the functions below view what is in it. Returns its handle.
BOUNDARY_EXPORT(boundary_reference_read)
std::uint32_t boundary_reference_read(const char* bytes, std::size_t size, const char* subject,
                                      std::size_t subject_size)
{
    return guarded(0U, [&] {
        auto input = read_reference_input({bytes, size}, {subject, subject_size});
        if (!input) {
            set_error(input.error());
            return 0U;
        }
        return handles<ReferenceInput>().add(std::make_unique<ReferenceInput>(std::move(*input)));
    });
}

BOUNDARY_EXPORT(boundary_reference_layout)
std::uint32_t boundary_reference_layout(std::uint32_t reference)
{
    return guarded(0U, [&] {
        set_view(std::string_view(handles<ReferenceInput>().get(reference).layout_file));
        return 1U;
    });
}

BOUNDARY_EXPORT(boundary_reference_target)
std::uint32_t boundary_reference_target(std::uint32_t reference)
{
    return guarded(0U, [&] {
        set_view(std::string_view(handles<ReferenceInput>().get(reference).target_file));
        return 1U;
    });
}

/// Views the target vertex of each of `vertex_count` layout vertices.
BOUNDARY_EXPORT(boundary_reference_landmarks)
std::uint32_t boundary_reference_landmarks(std::uint32_t reference, std::uint32_t vertex_count,
                                           const char* subject, std::size_t subject_size)
{
    return guarded(0U, [&] {
        const auto landmarks = landmarks_of(handles<ReferenceInput>().get(reference), vertex_count,
                                            {subject, subject_size});
        if (!landmarks) {
            set_error(landmarks.error());
            return 0U;
        }
        set_owned_view(*landmarks);
        return 1U;
    });
}

}  // namespace layout_embedding::boundary
