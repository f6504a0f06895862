// Validation and repair on meshes that a text format would hardly lead to: bytes become corners of
// few vertices on a small grid of positions, so that vertices coincide, lie on lines, and faces
// share edges in every way.
#include <array>
#include <vector>

#include "fuzz.hh"
#include "mesh_properties.hh"

using namespace layout_embedding;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (size < 2) {
        return 0;
    }
    PolygonMesh mesh;
    const std::size_t vertices = 1 + data[0] % 32;
    const bool triangles = (data[1] & 1U) != 0;
    std::size_t at = 2;
    for (std::size_t v = 0; v < vertices && at < size; ++v, ++at) {
        mesh.positions.emplace_back(data[at] & 3U, (data[at] >> 2U) & 3U, (data[at] >> 4U) & 3U);
    }
    if (mesh.positions.empty()) {
        return 0;
    }
    while (at < size) {
        const std::size_t count = triangles ? 3 : 1 + data[at++] % 6;
        std::vector<Index> face;
        for (; face.size() < count && at < size; ++at) {
            face.push_back(static_cast<Index>(data[at] % mesh.positions.size()));
        }
        if (face.size() == count) {
            mesh.add_face(face);
        }
    }
    check_mesh_properties(mesh);
    return 0;
}
