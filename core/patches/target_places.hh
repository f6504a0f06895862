#pragma once

#include "embedding/refined_mesh.hh"
#include "mesh/triangle_mesh.hh"
#include "patches/parametrisation.hh"
#include "patches/patch.hh"

namespace layout_embedding {

/// Where vertices of a parametrised patch lie on the target: at a vertex, on an edge, or inside of
/// a face. All must outlive this.
class TargetPlaces {
public:
    TargetPlaces(const TriangleMesh& target, const RefinedMesh& refined, const Patch& patch,
                 const Parametrisation& map)
        : target_(target), refined_(refined), patch_(patch), map_(map)
    {}

    /// The edge of the target that two vertices lie on or at the ends of, kNone if there is none.
    /// Vertices of one triangle have one iff the triangle's side is a part of it.
    Index common_edge(Index v, Index w) const;

    /// Of a vertex on an edge or at its end.
    double parameter_on(Index edge, Index v) const;

private:
    struct Spot {
        Index vertex = kNone;
        Index edge = kNone;
        double parameter = 0;
    };

    Spot spot_of(Index v) const;
    Spot refined_spot(Index vertex) const;

    const TriangleMesh& target_;
    const RefinedMesh& refined_;
    const Patch& patch_;
    const Parametrisation& map_;
};

/// The edge of the target that a new vertex of a refined mesh lies on, and its parameter there as
/// in NormalForm::Element; no edge for a vertex inside of a face.
struct EdgePlace {
    Index edge;
    double parameter;
};
EdgePlace edge_place(const TriangleMesh& target, const RefinedMesh& refined, Index vertex);

}  // namespace layout_embedding
