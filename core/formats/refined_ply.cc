#include "formats/refined_ply.hh"

#include <algorithm>
#include <cmath>

#include "base/bytes.hh"
#include "formats/patch_colours.hh"

namespace layout_embedding {

namespace {

class PlyWriter {
public:
    PlyWriter(const RefinedMesh& refined, const MeshAttributes& attributes)
        : refined_(refined), attributes_(attributes)
    {}

    std::string write()
    {
        write_header();
        write_vertices();
        write_faces();
        for (std::size_t e = 0; e < refined_.chains.size(); ++e) {
            const std::vector<Index>& chain = refined_.chains[e];
            for (std::size_t i = 1; i < chain.size(); ++i) {
                append_bytes(ply_, static_cast<std::int32_t>(chain[i - 1]));
                append_bytes(ply_, static_cast<std::int32_t>(chain[i]));
                append_bytes(ply_, static_cast<std::int32_t>(e));
            }
        }
        return std::move(ply_);
    }

private:
    void write_header()
    {
        std::size_t segments = 0;
        for (const std::vector<Index>& chain : refined_.chains) {
            segments += chain.empty() ? 0 : chain.size() - 1;
        }
        ply_ =
            "ply\n"
            "format binary_little_endian 1.0\n"
            "comment patch: layout face, -1 outside; layout_edge: layout edge of the path\n";
        write_names("group", attributes_.groups);
        write_names("material", attributes_.materials);
        ply_ += "element vertex " + std::to_string(refined_.positions.size()) +
                "\nproperty double x\nproperty double y\nproperty double z\n";
        if (!attributes_.colours.empty()) {
            write_colour_properties();
            ply_ += attributes_.colours.size == 4 ? "property uchar alpha\n" : "";
        }
        ply_ += "element face " + std::to_string(refined_.triangle_patches.size()) +
                "\nproperty list uchar int vertex_indices\nproperty int patch\n";
        if (attributes_.colours.empty()) {
            write_colour_properties();
        }
        ply_ +=
            attributes_.texture_coordinates.empty() ? "" : "property list uchar float texcoord\n";
        ply_ += attributes_.groups.empty() ? "" : "property int group\n";
        ply_ += attributes_.materials.empty() ? "" : "property int material\n";
        ply_ += "element edge " + std::to_string(segments) +
                "\nproperty int vertex1\nproperty int vertex2\nproperty int layout_edge\n"
                "end_header\n";
        ply_.reserve(ply_.size() + 28 * refined_.positions.size() +
                     56 * refined_.triangle_patches.size() + 12 * segments);
    }

    void write_names(const std::string& what, const FaceNames& names)
    {
        for (std::size_t i = 0; i < names.names.size(); ++i) {
            ply_ += "comment " + what + " " + std::to_string(i) + " " + names.names[i] + "\n";
        }
    }

    void write_colour_properties()
    {
        ply_ += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    }

    void write_vertices()
    {
        const CornerValues& colours = attributes_.colours;
        const auto ids = values_of_vertices(colours, refined_.corners,
                                            static_cast<Index>(refined_.positions.size()));
        for (std::size_t v = 0; v < ids.size(); ++v) {
            for (int axis = 0; axis < 3; ++axis) {
                append_bytes(ply_, refined_.positions[v][axis]);
            }
            for (std::size_t i = 0; !colours.empty() && i < colours.size; ++i) {
                const double part = ids[v] == kNone ? 1 : colours.value(ids[v])[i];
                append_bytes(
                    ply_, static_cast<std::uint8_t>(std::lround(255 * std::clamp(part, 0.0, 1.0))));
            }
        }
    }

    void write_faces()
    {
        std::vector<Index> colours;
        if (attributes_.colours.empty()) {
            colours = triangle_colours(refined_);
        }
        const std::size_t triangles = refined_.triangle_patches.size();
        for (std::size_t t = 0; t < triangles; ++t) {
            append_bytes(ply_, std::uint8_t{3});
            for (std::size_t i = 0; i < 3; ++i) {
                append_bytes(ply_, static_cast<std::int32_t>(refined_.corners[3 * t + i]));
            }
            append_bytes(ply_, static_cast<std::int32_t>(refined_.triangle_patches[t]));
            if (!colours.empty()) {
                for (const std::uint8_t part : patch_palette()[colours[t]]) {
                    append_bytes(ply_, part);
                }
            }
            write_texture(t);
            for (const FaceNames* names : {&attributes_.groups, &attributes_.materials}) {
                if (!names->empty()) {
                    append_bytes(ply_, static_cast<std::int32_t>(names->ids[t]));
                }
            }
        }
    }

    void write_texture(std::size_t triangle)
    {
        const CornerValues& places = attributes_.texture_coordinates;
        if (places.empty()) {
            return;
        }
        const std::span<const Index> ids(places.ids.data() + 3 * triangle, 3);
        if (std::find(ids.begin(), ids.end(), kNone) != ids.end()) {
            append_bytes(ply_, std::uint8_t{0});
            return;
        }
        append_bytes(ply_, std::uint8_t{6});
        for (const Index id : ids) {
            for (const double number : places.value(id)) {
                append_bytes(ply_, static_cast<float>(number));
            }
        }
    }

    const RefinedMesh& refined_;
    const MeshAttributes& attributes_;
    std::string ply_;
};

}  // namespace

std::string write_refined_ply(const RefinedMesh& refined, const MeshAttributes& attributes)
{
    return PlyWriter(refined, attributes).write();
}

}  // namespace layout_embedding
