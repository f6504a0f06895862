#include "layout/landmark_reader.hh"

#include "base/line_scanner.hh"
#include "layout/landmark_json.hh"
#include "layout/landmark_points.hh"

namespace layout_embedding {
namespace {

double size_of(std::span<const Vec3> positions)
{
    Vec3 low = positions[0];
    Vec3 high = positions[0];
    for (const Vec3& p : positions) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    return (high - low).maxCoeff();
}

Result<Landmarks> read_points(std::string_view bytes, std::string_view subject,
                              std::span<const Vec3> positions)
{
    auto points = read_picked_points(bytes, subject);
    if (!points) {
        return points.error();
    }
    if (points->points.empty()) {
        return make_error(ErrorCode::fileEmpty, std::string(subject) + " holds no landmark");
    }
    auto placed = place_landmarks(*points, positions, subject);
    if (!placed) {
        return placed.error();
    }
    return Landmarks{std::move(placed->vertices), std::move(points->names),
                     std::move(placed->notes)};
}

}  // namespace

Result<Landmarks> read_landmarks(std::string_view bytes, std::string_view subject,
                                 std::span<const Vec3> positions)
{
    const std::size_t start = bytes.find_first_not_of(" \t\r\n");
    if (start != std::string_view::npos) {
        const char first = bytes[start];
        if (first == '{' || first == '[') {
            return read_landmark_json(bytes, subject, positions);
        }
        if (first == '<') {
            return read_points(bytes, subject, positions);
        }
    }
    constexpr double kTolerance = 1e-4;
    const double tolerance = positions.empty() ? 0 : kTolerance * size_of(positions);
    Landmarks landmarks;
    Index displaced = 0;
    std::string first_displaced;
    LineScanner lines(bytes);
    const auto fail = [&](ErrorCode code, const std::string& what) {
        return make_error(
            code,
            std::string(subject) + " has " + what + " in line " + std::to_string(lines.number()),
            {{"line", lines.number()}});
    };
    while (lines.next()) {
        std::string_view line = without_comment(lines.line());
        if (line.empty()) {
            continue;
        }
        std::int64_t id = 0;
        if (!take_integer(line, id)) {
            return fail(ErrorCode::syntaxError, "something that is no vertex id");
        }
        if (id < 0 || id >= kNone) {
            return fail(ErrorCode::landmarkOutOfRange, "the vertex id " + std::to_string(id));
        }
        landmarks.vertices.push_back(static_cast<Index>(id));
        if (without_comment(line).empty()) {
            continue;
        }
        Vec3 position;
        if (!take_number(line, position.x()) || !take_number(line, position.y()) ||
            !take_number(line, position.z()) || !without_comment(line).empty()) {
            return fail(ErrorCode::syntaxError,
                        "neither an id alone nor an id and three coordinates");
        }
        if (static_cast<std::size_t>(id) < positions.size() &&
            !((positions[static_cast<std::size_t>(id)] - position).cwiseAbs().maxCoeff() <=
              tolerance)) {
            if (displaced++ == 0) {
                first_displaced = "line " + std::to_string(lines.number()) + " (vertex " +
                                  std::to_string(id) + ")";
            }
        }
    }
    if (landmarks.vertices.empty()) {
        return make_error(ErrorCode::fileEmpty, std::string(subject) + " holds no landmark");
    }
    if (displaced > 0) {
        landmarks.notes.push_back(std::string(subject) +
                                  " gives positions that are not those of the target for " +
                                  std::to_string(displaced) + " of its vertex ids, first in " +
                                  first_displaced + "; the ids are used.");
    }
    return landmarks;
}

std::string write_landmarks(std::span<const Index> vertices)
{
    std::string text;
    for (const Index vertex : vertices) {
        text += std::to_string(vertex);
        text += '\n';
    }
    return text;
}

}  // namespace layout_embedding
