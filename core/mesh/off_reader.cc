#include "mesh/off_reader.hh"

#include <algorithm>
#include <string>

#include "base/line_scanner.hh"

namespace layout_embedding {
namespace {

class OffReader {
public:
    OffReader(std::string_view bytes, std::string_view subject)
        : bytes_(bytes.size()), lines_(bytes), subject_(subject)
    {}

    Result<PolygonMesh> read()
    {
        const Status status = read_all();
        if (!status) {
            return status.error();
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
        return {};
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
};

}  // namespace

Result<PolygonMesh> read_off(std::string_view bytes, std::string_view subject)
{
    return OffReader(bytes, subject).read();
}

}  // namespace layout_embedding
