#include "layout/landmark_points.hh"

#include <algorithm>
#include <numeric>

#include "base/line_scanner.hh"
#include "layout/nearest_points.hh"

namespace layout_embedding {
namespace {

/// Replaces the five named entities of XML.
std::string unescaped(std::string_view text)
{
    std::string result;
    while (!text.empty()) {
        bool replaced = false;
        for (const auto& [entity, character] : {std::pair<std::string_view, char>{"&amp;", '&'},
                                                {"&lt;", '<'},
                                                {"&gt;", '>'},
                                                {"&quot;", '"'},
                                                {"&apos;", '\''}}) {
            if (text.substr(0, entity.size()) == entity) {
                result += character;
                text.remove_prefix(entity.size());
                replaced = true;
                break;
            }
        }
        if (!replaced) {
            result += text.front();
            text.remove_prefix(1);
        }
    }
    return result;
}

/// The value of an attribute of an XML tag; false where it has none of that name.
bool find_attribute(std::string_view tag, std::string_view name, std::string_view& value)
{
    constexpr std::string_view kBlanks = " \t\r\n";
    for (;;) {
        tag.remove_prefix(std::min(tag.find_first_of(kBlanks), tag.size()));
        tag.remove_prefix(std::min(tag.find_first_not_of(kBlanks), tag.size()));
        const std::size_t equals = tag.find('=');
        if (equals == std::string_view::npos) {
            return false;
        }
        std::string_view key = tag.substr(0, equals);
        key = key.substr(0, key.find_last_not_of(kBlanks) + 1);
        tag.remove_prefix(equals + 1);
        tag.remove_prefix(std::min(tag.find_first_not_of(kBlanks), tag.size()));
        if (tag.empty() || (tag.front() != '"' && tag.front() != '\'')) {
            return false;
        }
        const std::size_t end = tag.find(tag.front(), 1);
        if (end == std::string_view::npos) {
            return false;
        }
        if (key == name) {
            value = tag.substr(1, end - 1);
            return true;
        }
        tag.remove_prefix(end + 1);
        // The next attribute follows a blank; a missing one is forgiven.
        if (!tag.empty() && kBlanks.find(tag.front()) == std::string_view::npos) {
            return false;
        }
    }
}

/// How far the points are from their nearest vertices, squared and summed.
double misfit(const NearestPoints& tree, std::span<const Vec3> points)
{
    double sum = 0;
    for (const Vec3& point : points) {
        sum += tree.nearest(point, 1).front().squared_distance;
    }
    return sum;
}

}  // namespace

Result<LandmarkPoints> read_picked_points(std::string_view bytes, std::string_view subject)
{
    LandmarkPoints landmarks;
    std::size_t place = 0;
    const auto fail = [&](const std::string& what) {
        const auto line =
            1 + std::count(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(place), '\n');
        return make_error(
            ErrorCode::syntaxError,
            std::string(subject) + " has " + what + " in line " + std::to_string(line),
            {{"line", line}});
    };
    while ((place = bytes.find('<', place)) != std::string_view::npos) {
        if (bytes.substr(place, 4) == "<!--") {
            const std::size_t end = bytes.find("-->", place);
            if (end == std::string_view::npos) {
                return fail("a comment without an end");
            }
            place = end;
            continue;
        }
        const std::size_t end = bytes.find('>', place);
        if (end == std::string_view::npos) {
            return fail("a tag without an end");
        }
        std::string_view tag = bytes.substr(place + 1, end - place - 1);
        if (!tag.empty() && tag.back() == '/') {
            tag.remove_suffix(1);
        }
        const std::string_view kind = tag.substr(0, tag.find_first_of(" \t\r\n"));
        std::string_view value;
        if (kind == "point" && !(find_attribute(tag, "active", value) && value == "0")) {
            Vec3 point;
            int axis = 0;
            for (const std::string_view name : {"x", "y", "z"}) {
                if (!find_attribute(tag, name, value) || !take_number(value, point[axis++]) ||
                    !without_leading_blanks(value).empty()) {
                    return fail("a point without the numbers x, y and z");
                }
            }
            landmarks.points.push_back(point);
            landmarks.names.push_back(find_attribute(tag, "name", value) ? unescaped(value) : "");
        }
        place = end;
    }
    return landmarks;
}

Result<PlacedLandmarks> place_landmarks(const LandmarkPoints& landmarks,
                                        std::span<const Vec3> positions, std::string_view subject)
{
    constexpr double kFar = 0.05;
    const std::string name(subject);
    if (positions.empty()) {
        return make_error(ErrorCode::landmarkNeedsTarget, name + " holds points");
    }
    if (landmarks.points.size() > positions.size()) {
        return make_error(ErrorCode::landmarkCount,
                          name + " holds " + std::to_string(landmarks.points.size()) +
                              " points for " + std::to_string(positions.size()) + " vertices");
    }
    std::vector<Index> ids;
    Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
    Vec3 high = -low;
    for (Index v = 0; v < positions.size(); ++v) {
        if (positions[v].allFinite()) {
            ids.push_back(v);
            low = low.cwiseMin(positions[v]);
            high = high.cwiseMax(positions[v]);
        }
    }
    std::vector<Vec3> points = landmarks.points;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!points[i].allFinite() || ids.size() < points.size()) {
            return make_error(ErrorCode::nonFinitePosition,
                              name + " has landmark " + std::to_string(i) +
                                  " at no finite point, or the target has too few",
                              {{"landmark", static_cast<std::int64_t>(i)}});
        }
    }
    PlacedLandmarks placed;
    const NearestPoints tree(positions, ids);
    if (landmarks.may_be_mirrored) {
        std::vector<Vec3> turned;
        for (const Vec3& p : points) {
            turned.emplace_back(-p.x(), -p.y(), p.z());
        }
        if (misfit(tree, turned) < misfit(tree, points)) {
            points = std::move(turned);
            placed.notes.push_back(name +
                                   " fits the target after a change of sign of x and y (between "
                                   "LPS and RAS), which was made.");
        }
    }
    std::vector<bool> taken(positions.size(), false);
    const double far = kFar * (high - low).maxCoeff();
    std::string first_far;
    Index far_count = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        // At most i of the nearest are taken.
        std::size_t count = 1;
        const NearestPoints::Neighbour* nearest = nullptr;
        std::vector<NearestPoints::Neighbour> candidates;
        while (nearest == nullptr) {
            candidates = tree.nearest(points[i], std::min(count, i + 1));
            for (const NearestPoints::Neighbour& candidate : candidates) {
                if (!taken[candidate.id]) {
                    nearest = &candidate;
                    break;
                }
            }
            count *= 4;
        }
        taken[nearest->id] = true;
        placed.vertices.push_back(nearest->id);
        if (nearest->squared_distance > far * far && far_count++ == 0) {
            first_far = "landmark " + std::to_string(i);
            if (i < landmarks.names.size() && !landmarks.names[i].empty()) {
                first_far += " (" + landmarks.names[i] + ")";
            }
        }
    }
    if (far_count > 0) {
        placed.notes.push_back(name + " has " + std::to_string(far_count) +
                               " points far from the target, first " + first_far +
                               "; the nearest vertices are used.");
    }
    return placed;
}

}  // namespace layout_embedding
