#pragma once

#include "base/types.hh"
#include "mesh/triangle_mesh.hh"

namespace layout_embedding {

/// How large the angles of a refined mesh ought to be, as tangents: a third of the least angle of
/// the whole target; where that is below 3 degrees, 3 degrees or a third of the least angle of the
/// face, whichever is less.
class WantedAngles {
public:
    /// Keeps a reference. O(#F).
    explicit WantedAngles(const TriangleMesh& target);

    double tangent_in(Index face) const;

private:
    const TriangleMesh& target_;
    double everywhere_;
};

/// The tangent of the angle between two vectors in space; infinite for right and larger ones.
double tangent_between(const Vec3& u, const Vec3& v);

}  // namespace layout_embedding
