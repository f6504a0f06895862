// How good a job's embedding is.
#include "boundary/boundary.hh"
#include "patches/quality_report.hh"

namespace layout_embedding::boundary {

/// Views a report on a job's embedding: 2 doubles per layout edge (length, turning), then 4 per
/// layout face (area, perimeter, isoperimetric quotient, stretch).
BOUNDARY_EXPORT(boundary_job_quality) std::uint32_t boundary_job_quality(std::uint32_t job)
{
    return guarded(0U, [&] {
        const EmbedJob& embedding = handles<JobObject>().get(job).job;
        if (!embedding.result().refined) {
            throw InvalidHandle("the job has no embedding");
        }
        const auto report =
            quality_report(*embedding.problem().layout, *embedding.result().refined);
        if (!report) {
            set_error(report.error());
            return 0U;
        }
        std::vector<double> numbers;
        for (const QualityReport::Edge& edge : report->edges) {
            numbers.insert(numbers.end(), {edge.length, edge.turning});
        }
        for (const QualityReport::Patch& patch : report->patches) {
            numbers.insert(numbers.end(), {patch.area, patch.perimeter,
                                           patch.isoperimetric_quotient, patch.stretch});
        }
        set_owned_view(numbers);
        return 1U;
    });
}

}  // namespace layout_embedding::boundary
