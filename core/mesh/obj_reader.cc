#include "mesh/obj_reader.hh"

#include <algorithm>
#include <istream>
#include <limits>
#include <optional>
#include <streambuf>
#include <string>
#include <vector>

#include "base/line_scanner.hh"

#define TINYOBJLOADER_USE_DOUBLE
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

namespace layout_embedding {
namespace {

/// So that an index fits an int; a file of more vertices than that is out of reach.
constexpr int kMaxDigits = 9;

/// What an OBJ file says besides places, line by line.
class AttributeLines {
public:
    explicit AttributeLines(MeshAttributes& attributes) : attributes_(attributes)
    {
        attributes.texture_coordinates.size = 2;
        attributes.colours.size = 3;
    }

    /// The rest of a vertex line.
    void read_colour(std::string_view rest)
    {
        std::array<double, 3> colour{};
        std::size_t count = 0;
        while (count < 3 && take_number(rest, colour[count])) {
            ++count;
        }
        // One number is a weight.
        vertex_colours_.push_back(count == 3   ? attributes_.colours.add(colour)
                                  : count == 2 ? kUnusable
                                               : kNone);
    }

    /// A line of another kind than `v` and `f`.
    void read(std::string_view keyword, std::string_view rest)
    {
        if (keyword == "vt") {
            std::array<double, 2> place{std::numeric_limits<double>::quiet_NaN(), 0};
            if (take_number(rest, place[0])) {
                take_number(rest, place[1]);
            }
            attributes_.texture_coordinates.add(place);
        } else if (keyword == "g") {
            group_ = words(rest);
        } else if (keyword == "usemtl") {
            material_ = words(rest);
        } else if (keyword == "mtllib") {
            attributes_.material_files.push_back(words(rest));
        }
    }

    void add_face(const tinyobj::index_t* indices, int count)
    {
        const auto known = std::int64_t{attributes_.texture_coordinates.count()};
        for (int i = 0; i < count; ++i) {
            const std::int64_t given = indices[i].texcoord_index;
            const std::int64_t id = given > 0 ? given - 1 : known + given;
            attributes_.texture_coordinates.ids.push_back(given == 0 ? kNone
                                                          : id < 0   ? kUnusable
                                                                     : static_cast<Index>(id));
        }
        groups_.add(group_);
        materials_.add(material_);
    }

    void finish(const PolygonMesh& mesh)
    {
        attributes_.colours.ids = corner_ids(vertex_colours_, mesh.corners);
        attributes_.groups = groups_.take();
        attributes_.materials = materials_.take();
        layout_embedding::finish(attributes_);
    }

private:
    /// One blank between words, as line ends are written.
    static std::string words(std::string_view rest)
    {
        std::string text;
        for (auto word = take_token(rest); !word.empty(); word = take_token(rest)) {
            text += text.empty() ? "" : " ";
            text += word;
        }
        return text;
    }

    MeshAttributes& attributes_;
    std::vector<Index> vertex_colours_;
    FaceNaming groups_;
    FaceNaming materials_;
    std::string group_;
    std::string material_;
};

/// The text of an OBJ file as tinyobjloader gets to see it: its `f` lines alone, one at a time,
/// each checked before. Vertices are read here, since tinyobjloader's numbers are not correctly
/// rounded, and so is all that it takes without a word: it stops at a bad index, lets a face of
/// more than 255 corners wrap around, and knows no lines.
class FaceLines : public std::streambuf {
public:
    /// `attributes` may be null.
    FaceLines(std::string_view bytes, std::string_view subject, PolygonMesh& mesh,
              AttributeLines* attributes)
        : lines_(bytes), subject_(subject), mesh_(mesh), attributes_(attributes)
    {}

    std::int64_t line_number() const { return line_number_; }
    const std::optional<Error>& error() const { return error_; }

    void fail(ErrorCode code, std::int64_t line, const std::string& what)
    {
        if (!error_) {
            error_ =
                make_error(code, subject_ + " has " + what + " in line " + std::to_string(line),
                           {{"line", line}});
        }
    }

protected:
    int_type underflow() override
    {
        while (!error_ && lines_.next()) {
            line_number_ = lines_.number();
            std::string_view line = without_leading_blanks(lines_.line());
            const std::string_view keyword = line.substr(0, line.find_first_of(" \t\\"));
            if (keyword != "v" && keyword != "f") {
                if (attributes_ != nullptr) {
                    attributes_->read(keyword, line.substr(keyword.size()));
                }
                continue;  // lines that continue such a one begin with neither
            }
            line = without_comment(joined(line)).substr(1);
            if (keyword == "v") {
                read_vertex(line);
                continue;
            }
            if (!check_face(line)) {
                continue;
            }
            // tinyobjloader gets the end of every line, so that it asks for no more than this one.
            text_ = "f";
            text_ += line;
            text_ += '\n';
            setg(text_.data(), text_.data(), text_.data() + text_.size());
            return traits_type::to_int_type(text_.front());
        }
        return traits_type::eof();
    }

private:
    static bool is_continued(std::string_view line) { return !line.empty() && line.back() == '\\'; }

    /// `line` with those that continue it.
    std::string_view joined(std::string_view line)
    {
        if (!is_continued(line)) {
            return line;
        }
        joined_ = line;
        while (is_continued(joined_)) {
            joined_.back() = ' ';
            if (lines_.next()) {
                joined_ += lines_.line();
            }
        }
        return joined_;
    }

    void read_vertex(std::string_view line)
    {
        Vec3 position;
        for (int i = 0; i < 3; ++i) {
            if (!take_number(line, position[i])) {
                fail(ErrorCode::syntaxError, line_number_, "a vertex without three numbers");
                return;
            }
        }
        if (mesh_.positions.size() >= kNone - 1) {
            fail(ErrorCode::tooLarge, line_number_, "more vertices than 32-bit ids can number");
            return;
        }
        mesh_.positions.push_back(position);
        if (attributes_ != nullptr) {
            attributes_->read_colour(line);
        }
    }

    /// Whether the words of a face line are indices, not too many of them.
    bool check_face(std::string_view line)
    {
        std::int64_t count = 0;
        for (std::string_view word = take_token(line); !word.empty(); word = take_token(line)) {
            if (!is_corner(word)) {
                fail(ErrorCode::syntaxError, line_number_,
                     "a face with something that is no vertex index");
                return false;
            }
            if (longest_number(word) > kMaxDigits) {
                fail(ErrorCode::indexOutOfRange, line_number_,
                     "a face with the index " + std::string(word));
                return false;
            }
            ++count;
        }
        if (count == 0) {
            fail(ErrorCode::syntaxError, line_number_, "a face without corners");
        } else if (count > kMaxFaceCorners) {
            fail(ErrorCode::faceTooLarge, line_number_,
                 "a face of " + std::to_string(count) + " corners");
        }
        return !error_;
    }

    /// i, i/j, i//k or i/j/k.
    static bool is_corner(std::string_view word)
    {
        int slashes = 0;
        bool vertex = false;
        for (std::size_t i = 0; i < word.size(); ++i) {
            const char c = word[i];
            if (c == '/') {
                if (++slashes > 2) {
                    return false;
                }
            } else if (c >= '0' && c <= '9') {
                vertex = vertex || slashes == 0;
            } else if (c != '-' || (i > 0 && word[i - 1] != '/')) {
                return false;
            }
        }
        return vertex;
    }

    static int longest_number(std::string_view word)
    {
        int longest = 0;
        int digits = 0;
        for (const char c : word) {
            digits = c >= '0' && c <= '9' ? digits + 1 : 0;
            longest = std::max(longest, digits);
        }
        return longest;
    }

    LineScanner lines_;
    std::string subject_;
    PolygonMesh& mesh_;
    AttributeLines* attributes_;
    std::int64_t line_number_ = 0;
    std::optional<Error> error_;
    std::string joined_;
    std::string text_;
};

/// Collects the faces that tinyobjloader hands over.
struct FaceSink {
    PolygonMesh& mesh;
    FaceLines& lines;
    AttributeLines* attributes;
    /// Faces with corners that were no vertices yet when they were read, and their lines.
    std::vector<std::pair<Index, std::int64_t>> forward_references;

    void add(const tinyobj::index_t* indices, int count)
    {
        const auto vertices = static_cast<std::int64_t>(mesh.positions.size());
        bool forward = false;
        for (int i = 0; i < count; ++i) {
            const std::int64_t given = indices[i].vertex_index;
            const std::int64_t id = given > 0 ? given - 1 : vertices + given;
            if (given == 0 || id < 0) {
                lines.fail(ErrorCode::indexOutOfRange, lines.line_number(),
                           "a face with the vertex index " + std::to_string(given));
                return;
            }
            forward = forward || id >= vertices;
            mesh.corners.push_back(static_cast<Index>(id));
        }
        if (forward) {
            forward_references.emplace_back(mesh.face_count(), lines.line_number());
        }
        if (mesh.corners.size() >= kNone - kMaxFaceCorners) {
            lines.fail(ErrorCode::tooLarge, lines.line_number(),
                       "more corners than 32-bit ids can number");
            return;
        }
        mesh.face_offsets.push_back(static_cast<Index>(mesh.corners.size()));
        if (attributes != nullptr) {
            attributes->add_face(indices, count);
        }
    }

    void check_forward_references()
    {
        for (const auto& [face, line] : forward_references) {
            for (const Index corner : mesh.face(face)) {
                if (corner >= mesh.vertex_count()) {
                    lines.fail(ErrorCode::indexOutOfRange, line,
                               "a face with the vertex index " +
                                   std::to_string(std::int64_t{corner} + 1) + " of " +
                                   std::to_string(mesh.vertex_count()) + " vertices");
                    return;
                }
            }
        }
    }
};

}  // namespace

Result<PolygonMesh> read_obj(std::string_view bytes, std::string_view subject,
                             MeshAttributes* attributes)
{
    PolygonMesh mesh;
    std::optional<AttributeLines> attribute_lines;
    if (attributes != nullptr) {
        attribute_lines.emplace(*attributes);
    }
    AttributeLines* const collector = attribute_lines ? &*attribute_lines : nullptr;
    FaceLines lines(bytes, subject, mesh, collector);
    FaceSink sink{mesh, lines, collector, {}};
    tinyobj::callback_t callback;
    callback.index_cb = [](void* user_data, tinyobj::index_t* indices, int count) {
        static_cast<FaceSink*>(user_data)->add(indices, count);
    };
    std::istream stream(&lines);
    tinyobj::LoadObjWithCallback(stream, callback, &sink);
    if (!lines.error()) {
        sink.check_forward_references();
    }
    if (lines.error()) {
        return *lines.error();
    }
    if (collector != nullptr) {
        collector->finish(mesh);
    }
    return mesh;
}

}  // namespace layout_embedding
