#include "mesh/off_reader.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "base/line_scanner.hh"

namespace layout_embedding {
namespace {

class OffReader {
public:
    OffReader(std::string_view bytes, std::string_view subject, MeshAttributes* attributes)
        : bytes_(bytes.size()), lines_(bytes), subject_(subject), attributes_(attributes)
    {}

    Result<PolygonMesh> read()
    {
        const Status status = read_all();
        if (!status) {
            return status.error();
        }
        if (attributes_ != nullptr) {
            finish_attributes();
        }
        return std::move(mesh_);
    }

private:
    Status read_all()
    {
        if (!next_line()) {
            return fail(ErrorCode::syntaxError, "no header");
        }
        if (Status status = read_header(); !status) {
            return status;
        }
        if (line_.empty() && !next_line()) {
            return fail(ErrorCode::syntaxError, "no counts");
        }
        std::int64_t vertices = 0;
        std::int64_t faces = 0;
        if (!take_integer(line_, vertices) || !take_integer(line_, faces) || vertices < 0 ||
            faces < 0) {
            return fail(ErrorCode::syntaxError, "no counts of vertices and faces");
        }
        if (vertices >= kNone - 1 || faces >= kNone - 1) {
            return fail(ErrorCode::tooLarge, "more elements than 32-bit ids can number");
        }
        // The counts may lie; lines of at least six ("0 0 0\n") and four characters do not.
        mesh_.positions.reserve(std::min(static_cast<std::size_t>(vertices), bytes_ / 6 + 1));
        mesh_.face_offsets.reserve(std::min(static_cast<std::size_t>(faces), bytes_ / 4) + 1);
        for (std::int64_t v = 0; v < vertices; ++v) {
            if (Status status = read_vertex(v, vertices); !status) {
                return status;
            }
        }
        for (std::int64_t f = 0; f < faces; ++f) {
            if (Status status = read_face(f, faces); !status) {
                return status;
            }
        }
        if (next_line()) {
            return fail(ErrorCode::syntaxError, "more lines than its counts say");
        }
        return {};
    }

    /// Reads the header word; leaves the rest of its line, which may hold the counts, in line_.
    Status read_header()
    {
        std::string_view rest = line_;
        std::string_view word = take_token(rest);
        if (word.size() < 3 || word.substr(word.size() - 3) != "OFF") {
            return {};  // the header is optional
        }
        word.remove_suffix(3);
        for (const char c : word) {
            if (c != 'C' && c != 'N' && c != 'S' && c != 'T') {
                return fail(ErrorCode::unknownFormat, "a header of another kind than OFF in 3D");
            }
        }
        has_colours_ = word.find('C') != std::string_view::npos;
        has_normals_ = word.find('N') != std::string_view::npos;
        has_texture_ = word.find("ST") != std::string_view::npos;
        line_ = without_comment(rest);
        if (line_ == "BINARY") {
            return fail(ErrorCode::unknownFormat, "binary content");
        }
        return {};
    }

    Status read_vertex(std::int64_t v, std::int64_t count)
    {
        if (!next_line()) {
            return missing("vertices", v, count);
        }
        Vec3 position;
        for (int i = 0; i < 3; ++i) {
            if (!take_number(line_, position[i])) {
                return fail(ErrorCode::syntaxError, "a vertex without three numbers");
            }
        }
        mesh_.positions.push_back(position);
        if (attributes_ != nullptr && (has_colours_ || has_texture_)) {
            read_vertex_attributes();
        }
        return {};
    }

    /// What stands behind the position: normal, colour of three or four numbers, texture.
    void read_vertex_attributes()
    {
        std::vector<double> numbers;
        for (double number = 0; take_number(line_, number);) {
            numbers.push_back(number);
        }
        const std::size_t begin = has_normals_ ? 3 : 0;
        const std::size_t texture = has_texture_ ? 2 : 0;
        const std::size_t rest = numbers.size() - std::min(numbers.size(), begin + texture);
        const bool fits = numbers.size() >= begin + texture && (has_colours_ || rest == 0);
        if (has_colours_) {
            CornerValues& colours = attributes_->colours;
            colours.size = colours.size > 0 ? colours.size : (rest < 4 ? 3 : 4);
            vertex_colours_.push_back(fits && rest >= colours.size
                                          ? colours.add({numbers.data() + begin, colours.size})
                                          : kUnusable);
        }
        if (has_texture_) {
            CornerValues& places = attributes_->texture_coordinates;
            places.size = 2;
            const std::size_t behind = begin + (has_colours_ ? std::min<std::size_t>(rest, 4) : 0);
            vertex_texture_.push_back(fits ? places.add({numbers.data() + behind, 2}) : kUnusable);
        }
    }

    /// What stands behind the corners: a colour, or the number of one.
    void read_face_attributes()
    {
        std::array<double, 3> colour{};
        std::size_t count = 0;
        while (count < 3 && take_number(line_, colour[count])) {
            ++count;
        }
        if (count == 3) {
            largest_face_colour_ =
                std::max({largest_face_colour_, colour[0], colour[1], colour[2]});
        }
        face_colours_.push_back(colour);
        face_colour_sizes_.push_back(static_cast<unsigned char>(count));
    }

    /// Colours are whole numbers up to 255 in one file and fractions up to 1 in another; nothing
    /// but the numbers says which.
    static double full_colour(double largest) { return largest > 1 ? 255 : 1; }

    void finish_attributes()
    {
        CornerValues& colours = attributes_->colours;
        double largest = 0;
        for (const double number : colours.numbers) {
            largest = std::max(largest, number);
        }
        for (double& number : colours.numbers) {
            number /= full_colour(largest);
        }
        if (has_colours_) {
            colours.ids = corner_ids(vertex_colours_, mesh_.corners);
        }
        if (has_texture_) {
            attributes_->texture_coordinates.ids = corner_ids(vertex_texture_, mesh_.corners);
        }
        FaceNaming groups;
        const double full = full_colour(largest_face_colour_);
        for (std::size_t f = 0; f < face_colours_.size(); ++f) {
            const auto& [red, green, blue] = face_colours_[f];
            groups.add(face_colour_sizes_[f] == 3
                           ? colour_word({red / full, green / full, blue / full})
                       : face_colour_sizes_[f] == 1 && red == std::floor(red) && std::abs(red) < 1e9
                           ? "colour_" + std::to_string(static_cast<std::int64_t>(red))
                           : "");
        }
        attributes_->groups = groups.take();
        finish(*attributes_);
    }

    Status read_face(std::int64_t f, std::int64_t count)
    {
        if (!next_line()) {
            return missing("faces", f, count);
        }
        std::int64_t corners = 0;
        if (!take_integer(line_, corners) || corners < 1) {
            return fail(ErrorCode::syntaxError, "a face without a number of corners");
        }
        if (corners > kMaxFaceCorners) {
            return fail(ErrorCode::faceTooLarge,
                        "a face of " + std::to_string(corners) + " corners");
        }
        for (std::int64_t i = 0; i < corners; ++i) {
            std::int64_t vertex = 0;
            if (!take_integer(line_, vertex)) {
                return fail(ErrorCode::syntaxError, "a face with fewer corners than it says");
            }
            if (vertex < 0 || vertex >= mesh_.vertex_count()) {
                return fail(ErrorCode::indexOutOfRange,
                            "a face with the vertex " + std::to_string(vertex) + " of " +
                                std::to_string(mesh_.vertex_count()) + " (counted from 0)");
            }
            mesh_.corners.push_back(static_cast<Index>(vertex));
        }
        if (mesh_.corners.size() >= kNone - kMaxFaceCorners) {
            return fail(ErrorCode::tooLarge, "more corners than 32-bit ids can number");
        }
        mesh_.face_offsets.push_back(static_cast<Index>(mesh_.corners.size()));
        if (attributes_ != nullptr) {
            read_face_attributes();
        }
        return {};
    }

    /// Moves to the next line that holds something.
    bool next_line()
    {
        while (lines_.next()) {
            line_ = without_comment(lines_.line());
            if (!line_.empty()) {
                return true;
            }
        }
        return false;
    }

    Error missing(const std::string& what, std::int64_t found, std::int64_t count)
    {
        return make_error(ErrorCode::syntaxError,
                          subject_ + " ends in line " + std::to_string(lines_.number()) +
                              " after " + std::to_string(found) + " of " + std::to_string(count) +
                              " " + what,
                          {{"line", lines_.number()}});
    }

    Error fail(ErrorCode code, const std::string& what)
    {
        return make_error(code,
                          subject_ + " has " + what + " in line " + std::to_string(lines_.number()),
                          {{"line", lines_.number()}});
    }

    std::size_t bytes_;
    LineScanner lines_;
    std::string subject_;
    std::string_view line_;
    PolygonMesh mesh_;
    MeshAttributes* attributes_;
    bool has_colours_ = false;
    bool has_normals_ = false;
    bool has_texture_ = false;
    std::vector<Index> vertex_colours_;
    std::vector<Index> vertex_texture_;
    std::vector<std::array<double, 3>> face_colours_;
    std::vector<unsigned char> face_colour_sizes_;
    double largest_face_colour_ = 0;
};

}  // namespace

Result<PolygonMesh> read_off(std::string_view bytes, std::string_view subject,
                             MeshAttributes* attributes)
{
    return OffReader(bytes, subject, attributes).read();
}

}  // namespace layout_embedding
