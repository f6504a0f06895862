#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/random.hh"
#include "embedding/checker.hh"

namespace layout_embedding {

/// An embedding made by hand for tests of the checker, all of whose parts can be spoiled: the
/// target is the layout itself with finer faces, so that layout edges are chains of target edges.
/// Shares no code with the library.
struct ClaimedEmbedding {
    PolygonMesh layout;
    PolygonMesh target;
    std::vector<Index> landmarks;
    RefinedMesh refined;
    std::vector<std::array<Index, 2>> layout_edges;
    std::vector<std::vector<WeakPoint>> weak_paths;

    CheckReport check() const
    {
        return check_embedding({layout, target, landmarks, refined, layout_edges, weak_paths});
    }
    /// The codes of all violations.
    std::set<std::string> codes() const;

    Index triangle_count() const { return static_cast<Index>(refined.corners.size() / 3); }
};

/// The embedding of a polygon mesh in itself: `subdivisions` times each triangle becomes four (each
/// polygon a fan around its centre before); every layout face in `dropped` is taken out of the
/// layout but stays in the target.
///
/// With `refine`, the refined mesh has new vertices on the target's edges, at random places, and
/// inside its faces; otherwise it is the target.
ClaimedEmbedding embed_in_itself(const PolygonMesh& polygons, int subdivisions, bool refine,
                                 std::uint64_t seed = 1, const std::set<Index>& dropped = {});

/// Moves chains across single triangles, `moves` times at random places where that is allowed. This
/// is an isotopy: the embedding stays valid and every chain in its class.
void shake(ClaimedEmbedding& embedding, int moves, std::uint64_t seed);

/// Inserts the closed walk of target vertices `loop` (consecutive ones, and last and first, joined
/// by edges), `times` times over and backwards if negative, into each weak path at each of its
/// visits to a vertex of the walk. If the paths cross the loop wherever they meet it, this is a
/// Dehn twist of all paths.
void twist_weak_paths(ClaimedEmbedding& embedding, const std::vector<Index>& loop, int times);

/// A weak path along target edges through the given vertices.
std::vector<WeakPoint> weak_path_along(const std::vector<Index>& vertices);

/// A grid of quads, closed in one direction (an annulus, `columns` around) or in both (a torus).
/// Vertex (column, row) is number row * columns + column, which tests of the checker rely on.
PolygonMesh grid_polygons(Index columns, Index rows, bool torus);

}  // namespace layout_embedding
