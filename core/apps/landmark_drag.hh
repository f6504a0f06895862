#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/types.hh"
#include "embedding/normal_form.hh"
#include "layout/embedding_problem.hh"
#include "surface/distance_field.hh"
#include "surface/path_graph.hh"
#include "surface/polylines.hh"
#include "surface/strands.hh"
#include "surface/weak_embedding.hh"

namespace layout_embedding {

/// An embedding that follows while one landmark is moved by hand: only the paths at that landmark,
/// and those it is pushed through, are searched anew, in the path graph of the job that found the
/// embedding. What comes out is an embedding at every place, but nothing says how good; a job does,
/// once the hand rests.
///
/// Every move builds on the one before. Where the other paths make the landmark's own ones take
/// detours, the landmark's own go first and the others make room, if that is shorter in all.
class LandmarkDrag {
public:
    /// `embedding` is one of the whole layout. Keeps references to `graph` and `edge_costs`, those
    /// of a job for `problem`, and to the target.
    LandmarkDrag(EmbeddingProblem problem, const PathGraph& graph,
                 std::span<const double> edge_costs, const WeakEmbedding& embedding,
                 Index layout_vertex);

    Index layout_vertex() const { return layout_vertex_; }

    /// Moves the landmark to another vertex of the target. False, without any change, where another
    /// landmark is, where a landmark on the boundary would leave it or another one get there, and
    /// where no embedding was found within a bounded number of steps.
    bool move_to(Index target_vertex);

    /// With the landmark where it is now.
    const EmbeddingProblem& problem() const { return problem_; }
    const WeakEmbedding& embedding() const { return embedding_; }
    /// In target units and the path-graph metric.
    double cost() const;
    /// The paths, pulled straight (nearly as far as a job does) for the eye; those that run along
    /// edges of lower cost stay on them.
    Polylines paths() const;

private:
    struct Attempt {
        WeakEmbedding embedding;
        std::vector<Index> order;
        Length cost = 0;
        /// Of the paths at the landmark, together: alone, and as they are.
        Length alone = 0;
        Length together = 0;

        double detour() const
        {
            return alone > 0 ? static_cast<double>(together) / static_cast<double>(alone) : 1;
        }
    };

    bool is_allowed(Index target_vertex) const;
    bool is_at_landmark(Index layout_edge) const;
    Length cost_of(const WeakEmbedding& embedding) const;
    std::optional<Attempt> embed(const EmbeddingProblem& problem, bool own_paths_first);

    EmbeddingProblem problem_;
    const PathGraph& graph_;
    std::span<const double> edge_costs_;
    Index layout_vertex_;
    WeakEmbedding embedding_;
    std::vector<Index> order_;
    double detour_ = 1;
    /// False at all landmarks but the one that moves: the fields stay good wherever it is.
    std::vector<bool> passable_;
    DistanceFields fields_;
};

}  // namespace layout_embedding
