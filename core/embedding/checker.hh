#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/types.hh"
#include "embedding/refined_mesh.hh"
#include "mesh/polygon_mesh.hh"

namespace layout_embedding {

/// A point of a weak path: one target vertex id (that vertex), two (the midpoint of their edge) or
/// three (the centroid of their face); unused places hold kNone.
using WeakPoint = std::array<Index, 3>;

/// Everything the checker looks at: the input as it was read, and a claimed embedding.
struct CheckInput {
    const PolygonMesh& layout;
    const PolygonMesh& target;
    /// Target vertex per layout vertex.
    const std::vector<Index>& landmarks;
    const RefinedMesh& refined;
    /// Per chain of `refined.chains`: its two layout vertices, start and end.
    const std::vector<std::array<Index, 2>>& layout_edges;
    /// Per chain: its weak path from start to end; empty as a whole to leave out the comparison of
    /// homotopy classes.
    const std::vector<std::vector<WeakPoint>>& weak_paths;
};

/// One reason to refuse an embedding.
struct Violation {
    /// A stable camelCase name, for example "chainsMeet".
    std::string code;
    /// One sentence with the ids concerned.
    std::string message;
};

struct CheckReport {
    /// Empty: the embedding is valid.
    std::vector<Violation> violations;
    bool valid() const { return violations.empty(); }
};

/// Confirms that `input` is a valid embedding (design, Sec. 5). Independent by intent: this file
/// and its source share nothing with the search, the layout class or the realisation but plain
/// arrays, and build their own connectivity.
CheckReport check_embedding(const CheckInput& input);

}  // namespace layout_embedding
