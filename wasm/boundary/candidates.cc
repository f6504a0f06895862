// The candidate paths of a job's problem, and the conflicts between them.
#include "apps/candidate_paths.hh"
#include "boundary/boundary.hh"

namespace layout_embedding::boundary {

namespace {

/// Those that were found last; the paths themselves are to be drawn.
CandidatePaths& last_found()
{
    static CandidatePaths found;
    return found;
}

}  // namespace

/// Finds the candidate paths in a job's path graph, to be drawn (paths.cc), and views the length of
/// each layout edge's, infinity without a path. Conflicts are kept for the views below.
BOUNDARY_EXPORT(boundary_candidates_find) std::uint32_t boundary_candidates_find(std::uint32_t job)
{
    return guarded(0U, [&] {
        const EmbedJob& embedding = handles<JobObject>().get(job).job;
        if (embedding.graph() == nullptr) {
            throw InvalidHandle("the job has no path graph");
        }
        auto found = candidate_paths(embedding.problem(), *embedding.graph());
        if (!found) {
            set_error(found.error());
            return 0U;
        }
        last_found() = std::move(*found);
        drawn_paths() = std::move(last_found().paths);
        set_view(last_found().lengths);
        return 1U;
    });
}

/// Views the conflicting pairs, 2 layout edges each.
BOUNDARY_EXPORT(boundary_candidates_pairs) std::uint32_t boundary_candidates_pairs()
{
    return guarded(0U, [&] {
        std::vector<Index> edges;
        for (const auto& [a, b] : last_found().pairs) {
            edges.insert(edges.end(), {a, b});
        }
        set_owned_view(edges);
        return 1U;
    });
}

/// Views the conflicting triples, 3 layout edges each.
BOUNDARY_EXPORT(boundary_candidates_triples) std::uint32_t boundary_candidates_triples()
{
    return guarded(0U, [&] {
        std::vector<Index> edges;
        for (const auto& triple : last_found().triples) {
            edges.insert(edges.end(), triple.begin(), triple.end());
        }
        set_owned_view(edges);
        return 1U;
    });
}

}  // namespace layout_embedding::boundary
