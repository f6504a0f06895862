#include "embedding/refined_obj.hh"

#include "mesh/mesh_writer.hh"

namespace layout_embedding {

std::string write_refined_obj(const RefinedMesh& refined, const MeshAttributes& attributes)
{
    PolygonMesh mesh;
    mesh.positions = refined.positions;
    mesh.corners = refined.corners;
    for (std::size_t end = 3; end <= refined.corners.size(); end += 3) {
        mesh.face_offsets.push_back(static_cast<Index>(end));
    }
    return write_obj(mesh, {refined.triangle_patches, "patch_", refined.chains, &attributes});
}

}  // namespace layout_embedding
