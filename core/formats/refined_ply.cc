#include "formats/refined_ply.hh"

#include "base/bytes.hh"
#include "formats/patch_colours.hh"

namespace layout_embedding {

std::string write_refined_ply(const RefinedMesh& refined)
{
    std::size_t segments = 0;
    for (const std::vector<Index>& chain : refined.chains) {
        segments += chain.empty() ? 0 : chain.size() - 1;
    }
    const std::size_t triangles = refined.triangle_patches.size();
    std::string ply =
        "ply\n"
        "format binary_little_endian 1.0\n"
        "comment patch: layout face, -1 outside; layout_edge: layout edge of the path\n"
        "element vertex " +
        std::to_string(refined.positions.size()) +
        "\nproperty double x\nproperty double y\nproperty double z\n"
        "element face " +
        std::to_string(triangles) +
        "\nproperty list uchar int vertex_indices\nproperty int patch\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\n"
        "element edge " +
        std::to_string(segments) +
        "\nproperty int vertex1\nproperty int vertex2\nproperty int layout_edge\n"
        "end_header\n";
    ply.reserve(ply.size() + 24 * refined.positions.size() + 20 * triangles + 12 * segments);
    for (const Vec3& position : refined.positions) {
        for (int axis = 0; axis < 3; ++axis) {
            append_bytes(ply, position[axis]);
        }
    }
    const std::vector<Index> colours = triangle_colours(refined);
    for (std::size_t t = 0; t < triangles; ++t) {
        append_bytes(ply, std::uint8_t{3});
        for (std::size_t i = 0; i < 3; ++i) {
            append_bytes(ply, static_cast<std::int32_t>(refined.corners[3 * t + i]));
        }
        append_bytes(ply, static_cast<std::int32_t>(refined.triangle_patches[t]));
        for (const std::uint8_t part : patch_palette()[colours[t]]) {
            append_bytes(ply, part);
        }
    }
    for (std::size_t e = 0; e < refined.chains.size(); ++e) {
        const std::vector<Index>& chain = refined.chains[e];
        for (std::size_t i = 1; i < chain.size(); ++i) {
            append_bytes(ply, static_cast<std::int32_t>(chain[i - 1]));
            append_bytes(ply, static_cast<std::int32_t>(chain[i]));
            append_bytes(ply, static_cast<std::int32_t>(e));
        }
    }
    return ply;
}

}  // namespace layout_embedding
