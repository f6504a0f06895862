#include "formats/reference_files.hh"

#include <algorithm>

#include "base/line_scanner.hh"

namespace layout_embedding {
namespace {

bool take_id(std::string_view& line, Index& id)
{
    std::int64_t number = 0;
    if (!take_integer(line, number) || number < 0 || number >= kNone) {
        return false;
    }
    id = static_cast<Index>(number);
    return true;
}

Error fail(ErrorCode code, std::string_view subject, const LineScanner& lines,
           const std::string& what)
{
    return make_error(
        code, std::string(subject) + " has " + what + " in line " + std::to_string(lines.number()),
        {{"line", lines.number()}});
}

void append_ids(std::string& text, std::span<const Index> ids)
{
    for (const Index id : ids) {
        text += ' ';
        text += std::to_string(id);
    }
    text += '\n';
}

}  // namespace

Result<ReferenceInput> read_reference_input(std::string_view bytes, std::string_view subject)
{
    ReferenceInput input;
    LineScanner lines(bytes);
    while (lines.next()) {
        std::string_view line = without_comment(lines.line());
        const std::string_view keyword = take_token(line);
        if (keyword == "lf" || keyword == "tif") {
            // File names may hold blanks.
            (keyword == "lf" ? input.layout_file : input.target_file) =
                std::string(without_leading_blanks(line));
        } else if (keyword == "mv") {
            std::array<Index, 2> match{};
            if (!take_id(line, match[0]) || !take_id(line, match[1])) {
                return fail(ErrorCode::landmarkOutOfRange, subject, lines,
                            "a match that is no pair of vertex ids");
            }
            input.matches.push_back(match);
        } else if (!keyword.empty()) {
            return fail(ErrorCode::syntaxError, subject, lines, "an unknown keyword");
        }
    }
    if (input.layout_file.empty() || input.target_file.empty()) {
        return make_error(ErrorCode::fileEmpty,
                          std::string(subject) + " names no layout (lf) or no target (tif)");
    }
    return input;
}

Result<ReferenceEmbedding> read_reference_embedding(std::string_view bytes,
                                                    std::string_view subject)
{
    ReferenceEmbedding embedding;
    LineScanner lines(bytes);
    while (lines.next()) {
        std::string_view line = without_comment(lines.line());
        const std::string_view keyword = take_token(line);
        if (keyword == "inp" || keyword == "tf") {
            (keyword == "inp" ? embedding.input_file : embedding.refined_file) =
                std::string(without_leading_blanks(line));
        } else if (keyword == "ee") {
            ReferenceEmbedding::Edge edge{};
            if (!take_id(line, edge.layout_edge[0]) || !take_id(line, edge.layout_edge[1])) {
                return fail(ErrorCode::indexOutOfRange, subject, lines,
                            "an edge that is no pair of vertex ids");
            }
            if (take_token(line) != ":") {
                return fail(ErrorCode::syntaxError, subject, lines, "an edge without a colon");
            }
            while (!without_leading_blanks(line).empty()) {
                if (!take_id(line, edge.chain.emplace_back())) {
                    return fail(ErrorCode::indexOutOfRange, subject, lines,
                                "something that is no vertex id");
                }
            }
            embedding.edges.push_back(std::move(edge));
        } else if (!keyword.empty()) {
            return fail(ErrorCode::syntaxError, subject, lines, "an unknown keyword");
        }
    }
    if (embedding.input_file.empty() || embedding.refined_file.empty()) {
        return make_error(ErrorCode::fileEmpty,
                          std::string(subject) + " names no input (inp) or no target (tf)");
    }
    return embedding;
}

std::string write_reference_input(const ReferenceInput& input)
{
    std::string text = "lf " + input.layout_file + "\ntif " + input.target_file + "\n\n";
    for (const std::array<Index, 2>& match : input.matches) {
        text += "mv";
        append_ids(text, match);
    }
    return text;
}

std::string write_reference_embedding(const ReferenceEmbedding& embedding)
{
    std::string text = "inp " + embedding.input_file + "\ntf " + embedding.refined_file + "\n\n";
    for (const ReferenceEmbedding::Edge& edge : embedding.edges) {
        std::vector<Index> chain = edge.chain;
        const auto& [a, b] = edge.layout_edge;
        text += "ee " + std::to_string(a) + " " + std::to_string(b) + " :";
        append_ids(text, chain);
        std::reverse(chain.begin(), chain.end());
        text += "ee " + std::to_string(b) + " " + std::to_string(a) + " :";
        append_ids(text, chain);
    }
    return text;
}

Result<std::vector<Index>> landmarks_of(const ReferenceInput& input, Index vertex_count,
                                        std::string_view subject)
{
    std::vector<Index> landmarks(vertex_count, kNone);
    for (const auto& [layout_vertex, target_vertex] : input.matches) {
        if (layout_vertex >= vertex_count || landmarks[layout_vertex] != kNone) {
            return make_error(
                ErrorCode::landmarkCount,
                std::string(subject) + " matches layout vertex " + std::to_string(layout_vertex) +
                    (layout_vertex < vertex_count ? " twice" : ", which does not exist"),
                {{"vertex", layout_vertex}});
        }
        landmarks[layout_vertex] = target_vertex;
    }
    const auto missing = std::find(landmarks.begin(), landmarks.end(), kNone);
    if (missing != landmarks.end()) {
        const auto vertex = missing - landmarks.begin();
        return make_error(
            ErrorCode::landmarkCount,
            std::string(subject) + " has no match of layout vertex " + std::to_string(vertex),
            {{"vertex", vertex}});
    }
    return landmarks;
}

}  // namespace layout_embedding
