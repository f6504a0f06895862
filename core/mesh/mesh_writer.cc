#include "mesh/mesh_writer.hh"

#include "base/bytes.hh"
#include "base/number_text.hh"

namespace layout_embedding {
namespace {

void append_position(std::string& text, const Vec3& position)
{
    for (int i = 0; i < 3; ++i) {
        text += i == 0 ? "" : " ";
        append_number(text, position[i]);
    }
    text += '\n';
}

void append_ids(std::string& text, std::span<const Index> ids, std::uint64_t first)
{
    for (const Index id : ids) {
        text += ' ';
        text += std::to_string(id + first);
    }
    text += '\n';
}

}  // namespace

std::string write_obj(const PolygonMesh& mesh, const ObjExtras& extras)
{
    std::string text;
    text.reserve(mesh.positions.size() * 60 + mesh.corners.size() * 8);
    for (const Vec3& position : mesh.positions) {
        text += "v ";
        append_position(text, position);
    }
    for (Index f = 0; f < mesh.face_count(); ++f) {
        if (!extras.face_groups.empty() &&
            (f == 0 || extras.face_groups[f] != extras.face_groups[f - 1])) {
            const Index group = extras.face_groups[f];
            text += "g ";
            text += group == kNone ? "outside" : extras.group_prefix + std::to_string(group);
            text += '\n';
        }
        text += 'f';
        append_ids(text, mesh.face(f), 1);
    }
    if (!extras.chains.empty()) {
        text += "g layout_edges\n";
    }
    for (const std::vector<Index>& chain : extras.chains) {
        text += 'l';
        append_ids(text, chain, 1);
    }
    return text;
}

std::string write_off(const PolygonMesh& mesh)
{
    std::string text = "OFF\n" + std::to_string(mesh.vertex_count()) + " " +
                       std::to_string(mesh.face_count()) + " 0\n";
    text.reserve(mesh.positions.size() * 60 + mesh.corners.size() * 8);
    for (const Vec3& position : mesh.positions) {
        append_position(text, position);
    }
    for (Index f = 0; f < mesh.face_count(); ++f) {
        text += std::to_string(mesh.face(f).size());
        append_ids(text, mesh.face(f), 0);
    }
    return text;
}

std::string write_ply(const PolygonMesh& mesh)
{
    std::string ply = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                      std::to_string(mesh.vertex_count()) +
                      "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                      std::to_string(mesh.face_count()) +
                      "\nproperty list uchar int vertex_indices\nend_header\n";
    for (const Vec3& position : mesh.positions) {
        for (int axis = 0; axis < 3; ++axis) {
            append_bytes(ply, position[axis]);
        }
    }
    for (Index f = 0; f < mesh.face_count(); ++f) {
        append_bytes(ply, static_cast<std::uint8_t>(mesh.face(f).size()));
        for (const Index corner : mesh.face(f)) {
            append_bytes(ply, static_cast<std::int32_t>(corner));
        }
    }
    return ply;
}

}  // namespace layout_embedding
