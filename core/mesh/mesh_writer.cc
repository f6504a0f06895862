#include "mesh/mesh_writer.hh"

#include <algorithm>
#include <array>

#include "base/bytes.hh"
#include "base/number_text.hh"

namespace layout_embedding {
namespace {

void append_numbers(std::string& text, std::span<const double> numbers)
{
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        text += i == 0 ? "" : " ";
        append_number(text, numbers[i]);
    }
    text += '\n';
}

void append_position(std::string& text, const Vec3& position)
{
    append_numbers(text, std::array<double, 3>{position.x(), position.y(), position.z()});
}

void append_obj_vertices(std::string& text, const PolygonMesh& mesh,
                         const MeshAttributes& attributes)
{
    const CornerValues& colours = attributes.colours;
    const auto ids = values_of_vertices(colours, mesh.corners, mesh.vertex_count());
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        text += "v ";
        append_position(text, mesh.positions[v]);
        if (ids[v] != kNone) {
            text.back() = ' ';
            append_numbers(text, colours.value(ids[v]).first(3));
        }
    }
    const CornerValues& places = attributes.texture_coordinates;
    for (Index id = 0; id < places.count(); ++id) {
        text += "vt ";
        append_numbers(text, places.value(id));
    }
}

void append_obj_face(std::string& text, std::span<const Index> face, std::span<const Index> texture)
{
    text += 'f';
    for (std::size_t i = 0; i < face.size(); ++i) {
        text += ' ' + std::to_string(std::uint64_t{face[i]} + 1);
        if (!texture.empty()) {
            text += '/' + std::to_string(std::uint64_t{texture[i]} + 1);
        }
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
    const MeshAttributes none;
    const MeshAttributes& attributes = extras.attributes == nullptr ? none : *extras.attributes;
    for (const std::string& file : attributes.material_files) {
        text += "mtllib " + file + '\n';
    }
    append_obj_vertices(text, mesh, attributes);
    std::string groups;
    std::string material;
    const auto change = [&](std::string& from, const std::string& to) {
        if (from != to) {
            from = to;
            text += to;
        }
    };
    const CornerValues& places = attributes.texture_coordinates;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        if (!extras.face_groups.empty() || !attributes.groups.empty()) {
            std::string line = "g";
            if (!extras.face_groups.empty()) {
                const Index group = extras.face_groups[f];
                line += ' ';
                line += group == kNone ? "outside" : extras.group_prefix + std::to_string(group);
            }
            if (const std::string_view name = attributes.groups.of_face(f); !name.empty()) {
                (line += ' ') += name;
            }
            line += '\n';
            change(groups, line);
        }
        if (!attributes.materials.empty()) {
            const std::string_view name = attributes.materials.of_face(f);
            if (!name.empty() || !material.empty()) {
                std::string line = "usemtl";
                if (!name.empty()) {
                    (line += ' ') += name;
                }
                line += '\n';
                change(material, line);
            }
        }
        std::span<const Index> texture;
        if (!places.empty()) {
            texture = {places.ids.data() + mesh.face_offsets[f],
                       places.ids.data() + mesh.face_offsets[f + 1]};
            // A face has them at all corners or at none.
            const bool has_all = std::find(texture.begin(), texture.end(), kNone) == texture.end();
            texture = has_all ? texture : std::span<const Index>();
        }
        append_obj_face(text, mesh.face(f), texture);
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
