#include "apps/candidate_paths.hh"

#include <algorithm>
#include <limits>
#include <string>

#include "surface/conflicts.hh"
#include "surface/cut_surface_search.hh"
#include "surface/distance_field.hh"
#include "surface/strands.hh"

namespace layout_embedding {

namespace {

// As much as a job allows its own distance fields.
constexpr std::uint64_t kCandidateFieldBytes = std::uint64_t{256} << 20U;

}  // namespace

Result<CandidatePaths> candidate_paths(const EmbeddingProblem& problem, const PathGraph& graph)
{
    const Strands strands(problem, graph);
    DistanceFields fields(graph, strands.passable(), kCandidateFieldBytes);
    CutSurfaceSearch search(strands, fields);
    const Index edge_count = problem.layout->edge_count();

    CandidatePaths found;
    found.lengths.assign(edge_count, std::numeric_limits<double>::infinity());
    std::vector<CandidateWalk> walks;
    for (Index edge = 0; edge < edge_count; ++edge) {
        search.begin(edge);
        switch (search.run()) {
            case CutSurfaceSearch::Outcome::found:
                found.lengths[edge] = graph.to_units(search.cost());
                found.paths.add(graph, edge, search.darts());
                walks.push_back({edge, search.darts()});
                break;
            case CutSurfaceSearch::Outcome::tied:
                return make_error(ErrorCode::unresolvedTie,
                                  "layout edge " + std::to_string(edge) +
                                      " has two shortest paths of equal length",
                                  {{"edge", edge}});
            default:
                break;  // landmarks are in the way
        }
    }

    // Places in `walks` are in the order of the edges: what is sorted stays so.
    const Conflicts conflicts = find_conflicts(strands, walks);
    for (const auto& [i, j] : conflicts.pairs) {
        found.pairs.emplace_back(walks[i].layout_edge, walks[j].layout_edge);
    }
    for (const auto& places : conflicts.triples) {
        std::array<Index, 3> edges{};
        std::transform(places.begin(), places.end(), edges.begin(),
                       [&](Index place) { return walks[place].layout_edge; });
        std::sort(edges.begin(), edges.end());
        found.triples.push_back(edges);
    }
    std::sort(found.triples.begin(), found.triples.end());
    return found;
}

}  // namespace layout_embedding
