#include "mesh/seams.hh"

#include <algorithm>

#include "mesh/weld.hh"

namespace layout_embedding {

PolygonMesh without_seams(const PolygonMesh& mesh)
{
    const bool finite = std::all_of(mesh.positions.begin(), mesh.positions.end(),
                                    [](const Vec3& p) { return p.allFinite(); });
    if (!finite || mesh.face_count() == 0) {
        return mesh;
    }
    PolygonMesh joined = welded(mesh, weld_classes(mesh));
    std::vector<bool> used(mesh.vertex_count(), false);
    for (const Index corner : joined.corners) {
        used[corner] = true;
    }
    std::vector<Index> ids(mesh.vertex_count(), kNone);
    joined.positions.clear();
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (used[v]) {
            ids[v] = joined.vertex_count();
            joined.positions.push_back(mesh.positions[v]);
        }
    }
    for (Index& corner : joined.corners) {
        corner = ids[corner];
    }
    return joined;
}

}  // namespace layout_embedding
