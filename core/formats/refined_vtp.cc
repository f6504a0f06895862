#include "formats/refined_vtp.hh"

#include <array>
#include <span>

#include "base/number_text.hh"

namespace layout_embedding {
namespace {

class VtpWriter {
public:
    VtpWriter(const RefinedMesh& refined, const MeshAttributes& attributes)
        : refined_(refined), attributes_(attributes)
    {}

    std::string write()
    {
        const std::size_t lines = refined_.chains.size();
        const std::size_t triangles = refined_.triangle_patches.size();
        text_ =
            "<?xml version=\"1.0\"?>\n"
            "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
            "header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"" +
            std::to_string(refined_.positions.size()) + "\" NumberOfVerts=\"0\" NumberOfLines=\"" +
            std::to_string(lines) + "\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
            std::to_string(triangles) + "\">\n";
        write_colours();
        text_ += "<CellData Scalars=\"patch\">\n";
        write_cells(
            "patch", [](std::size_t) { return kNone; },
            [&](std::size_t t) { return refined_.triangle_patches[t]; });
        write_cells(
            "layout_edge", [](std::size_t line) { return static_cast<Index>(line); },
            [](std::size_t) { return kNone; });
        write_cells(
            "target_face", [](std::size_t) { return kNone; },
            [&](std::size_t t) {
                return t < refined_.triangle_faces.size() ? refined_.triangle_faces[t] : kNone;
            });
        write_names("group", attributes_.groups);
        write_names("material", attributes_.materials);
        write_texture();
        text_ += "</CellData>\n<Points>\n";
        open("Float64", "Points", 3);
        for (const Vec3& position : refined_.positions) {
            for (int axis = 0; axis < 3; ++axis) {
                text_ += axis == 0 ? "" : " ";
                append_number(text_, position[axis]);
            }
            text_ += '\n';
        }
        close();
        text_ += "</Points>\n<Lines>\n";
        open("Int64", "connectivity");
        for (const std::vector<Index>& chain : refined_.chains) {
            for (const Index vertex : chain) {
                append(vertex);
            }
            text_ += '\n';
        }
        close();
        open("Int64", "offsets");
        std::size_t offset = 0;
        for (const std::vector<Index>& chain : refined_.chains) {
            offset += chain.size();
            text_ += std::to_string(offset) + "\n";
        }
        close();
        text_ += "</Lines>\n<Polys>\n";
        open("Int64", "connectivity");
        for (std::size_t i = 0; i < refined_.corners.size(); ++i) {
            append(refined_.corners[i]);
            text_ += i % 3 == 2 ? "\n" : "";
        }
        close();
        open("Int64", "offsets");
        for (std::size_t t = 1; t <= triangles; ++t) {
            text_ += std::to_string(3 * t) + "\n";
        }
        close();
        text_ += "</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
        return std::move(text_);
    }

private:
    void open(const std::string& type, const std::string& name, int components = 1)
    {
        text_ += "<DataArray type=\"" + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
                 std::to_string(components) + "\" format=\"ascii\">\n";
    }
    void close() { text_ += "</DataArray>\n"; }
    void append(Index id) { text_ += id == kNone ? "-1 " : std::to_string(id) + " "; }

    void append(std::span<const double> numbers)
    {
        for (const double number : numbers) {
            append_number(text_, number);
            text_ += ' ';
        }
        text_ += '\n';
    }

    void write_colours()
    {
        const CornerValues& colours = attributes_.colours;
        if (colours.empty()) {
            return;
        }
        const std::array<double, 4> white{1, 1, 1, 1};
        text_ += "<PointData>\n";
        open("Float64", "colour", static_cast<int>(colours.size));
        for (const Index id : values_of_vertices(colours, refined_.corners,
                                                 static_cast<Index>(refined_.positions.size()))) {
            append(id == kNone ? std::span(white).first(colours.size) : colours.value(id));
        }
        close();
        text_ += "</PointData>\n";
    }

    void write_names(const std::string& what, const FaceNames& names)
    {
        if (!names.empty()) {
            write_cells(
                what, [](std::size_t) { return kNone; },
                [&](std::size_t t) { return names.ids[t]; });
        }
    }

    void write_texture()
    {
        const CornerValues& places = attributes_.texture_coordinates;
        if (places.empty()) {
            return;
        }
        open("Float64", "texture_coordinates", 6);
        const std::array<double, 6> none{};
        for (std::size_t line = 0; line < refined_.chains.size(); ++line) {
            append(none);
        }
        for (std::size_t i = 0; i < places.ids.size(); ++i) {
            append(places.ids[i] == kNone ? std::span(none).first(2) : places.value(places.ids[i]));
        }
        close();
    }

    template <typename OfLine, typename OfTriangle>
    void write_cells(const std::string& name, OfLine of_line, OfTriangle of_triangle)
    {
        open("Int32", name);
        for (std::size_t line = 0; line < refined_.chains.size(); ++line) {
            append(of_line(line));
        }
        for (std::size_t t = 0; t < refined_.triangle_patches.size(); ++t) {
            text_ += t % 32 == 0 ? "\n" : "";
            append(of_triangle(t));
        }
        text_ += '\n';
        close();
    }

    const RefinedMesh& refined_;
    const MeshAttributes& attributes_;
    std::string text_;
};

}  // namespace

std::string write_refined_vtp(const RefinedMesh& refined, const MeshAttributes& attributes)
{
    return VtpWriter(refined, attributes).write();
}

}  // namespace layout_embedding
