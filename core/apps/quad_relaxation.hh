#pragma once

#include <memory>
#include <vector>

#include "apps/quad_mesh.hh"

namespace layout_embedding {

/// Moves the vertices of a quad mesh that are not fixed, on the target and one after the other: a
/// few rounds towards the means of their neighbours, where the smallest scaled Jacobian of the
/// quads around stays above 0.5 or grows; then 2 * `rounds` rounds, or until they hardly move, to
/// lower an energy that grows as corners become flat. Where quads are flipped then, all vertices
/// lower it together, for as many rounds at most (apps/quad_unfolding.hh); bad quads are untangled
/// and the worst ones mended, by turns, for as long as fewer stay flipped; and neighbourhoods of
/// what is flipped even so are placed anew where that helps, after which `rounds` rounds even them
/// out.
///
/// Where quads stay flipped, all begins anew, up to four times, with rounds in which all vertices
/// lower the energy together, however folded the quads are: towards quads of one size first, then
/// of any. The mesh with the fewest flipped quads counts. Where more than a hundredth is flipped at
/// first, all begins anew before anything is placed anew.
///
/// At the end, neighbourhoods of quads with a scaled Jacobian up to 0.1 are placed anew where that
/// makes such quads fewer or the worst one better, with more effort up to 0.03, and all is evened
/// out once more.
class QuadRelaxation {
public:
    /// `target` and `mesh` must outlive this; `fixed` says so of every vertex.
    QuadRelaxation(const TriangleMesh& target, std::vector<bool> fixed, Index rounds,
                   QuadMesh& mesh);
    ~QuadRelaxation();

    /// Does a round; false once there is nothing left to do. The mesh may be left as it is at any
    /// time.
    bool step();
    /// Share of the rounds that are done, at most, in [0, 1].
    double progress() const;

private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
};

/// Per quad, the mean of the target's normals at its corners.
std::vector<Vec3> surface_normals(const TriangleMesh& target, const QuadMesh& mesh);

}  // namespace layout_embedding
