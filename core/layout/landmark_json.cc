#include "layout/landmark_json.hh"

#include "base/json.hh"
#include "base/number_text.hh"
#include "layout/landmark_points.hh"

namespace layout_embedding {
namespace {

/// Reads `[x, y, z]`.
bool read_point(const JsonValue* value, Vec3& point)
{
    if (value == nullptr || value->items.size() != 3) {
        return false;
    }
    for (int axis = 0; axis < 3; ++axis) {
        const JsonValue& number = value->items[static_cast<std::size_t>(axis)];
        if (!number.is(JsonValue::Kind::number)) {
            return false;
        }
        point[axis] = number.number;
    }
    return true;
}

std::string text_of(const JsonValue& parent, std::string_view name)
{
    const JsonValue* value = parent.find(name);
    return value == nullptr ? std::string() : value->string;
}

class LandmarkJsonReader {
public:
    LandmarkJsonReader(std::string_view subject, std::span<const Vec3> positions)
        : subject_(subject), positions_(positions)
    {}

    Result<Landmarks> read(const JsonValue& root)
    {
        const JsonValue* markups = root.find("markups");
        const JsonValue* landmarks = root.find("landmarks");
        const Status status = markups != nullptr     ? read_markups(*markups)
                              : landmarks != nullptr ? read_list(*landmarks)
                                                     : read_list(root);
        if (!status) {
            return status.error();
        }
        if (landmarks_.vertices.empty()) {
            return make_error(ErrorCode::fileEmpty, subject_ + " holds no landmark");
        }
        return std::move(landmarks_);
    }

private:
    Error fail(ErrorCode code, std::size_t place, const std::string& what) const
    {
        return make_error(code, subject_ + " has landmark " + std::to_string(place) + " " + what,
                          {{"landmark", static_cast<std::int64_t>(place)}});
    }

    /// Our own landmarks, or ids alone.
    Status read_list(const JsonValue& list)
    {
        if (!list.is(JsonValue::Kind::array)) {
            return make_error(ErrorCode::syntaxError, subject_ + " has no list of landmarks");
        }
        LandmarkPoints unplaced;
        std::vector<std::size_t> places;
        for (std::size_t i = 0; i < list.items.size(); ++i) {
            const JsonValue& item = list.items[i];
            const JsonValue* vertex =
                item.is(JsonValue::Kind::number) ? &item : item.find("vertex");
            landmarks_.names.push_back(text_of(item, "name"));
            if (vertex != nullptr && !vertex->is(JsonValue::Kind::null)) {
                if (!vertex->is_whole(kNone - 1)) {
                    return fail(ErrorCode::landmarkOutOfRange, i, "with an impossible vertex id");
                }
                landmarks_.vertices.push_back(static_cast<Index>(vertex->number));
                continue;
            }
            Vec3 point;
            if (!read_point(item.find("position"), point)) {
                return fail(ErrorCode::syntaxError, i, "with neither a vertex nor a position");
            }
            landmarks_.vertices.push_back(kNone);
            unplaced.points.push_back(point);
            unplaced.names.push_back(landmarks_.names.back());
            places.push_back(i);
        }
        return places.empty() ? Status() : place(unplaced, places);
    }

    Status read_markups(const JsonValue& markups)
    {
        const JsonValue* points =
            markups.items.empty() ? nullptr : markups.items.front().find("controlPoints");
        if (points == nullptr) {
            return make_error(ErrorCode::syntaxError, subject_ + " has no control points");
        }
        LandmarkPoints unplaced;
        unplaced.may_be_mirrored = true;
        std::vector<std::size_t> places;
        for (std::size_t i = 0; i < points->items.size(); ++i) {
            const JsonValue& item = points->items[i];
            const std::string status = text_of(item, "positionStatus");
            if (status == "undefined" || status == "missing") {
                continue;
            }
            Vec3 point;
            if (!read_point(item.find("position"), point)) {
                return fail(ErrorCode::syntaxError, i, "without a position");
            }
            places.push_back(landmarks_.vertices.size());
            landmarks_.vertices.push_back(kNone);
            landmarks_.names.push_back(text_of(item, "label"));
            unplaced.points.push_back(point);
            unplaced.names.push_back(landmarks_.names.back());
        }
        return place(unplaced, places);
    }

    Status place(const LandmarkPoints& points, const std::vector<std::size_t>& places)
    {
        auto placed = place_landmarks(points, positions_, subject_);
        if (!placed) {
            return placed.error();
        }
        for (std::size_t i = 0; i < places.size(); ++i) {
            landmarks_.vertices[places[i]] = placed->vertices[i];
        }
        landmarks_.notes = std::move(placed->notes);
        return {};
    }

    std::string subject_;
    std::span<const Vec3> positions_;
    Landmarks landmarks_;
};

}  // namespace

Result<Landmarks> read_landmark_json(std::string_view bytes, std::string_view subject,
                                     std::span<const Vec3> positions)
{
    const auto root = parse_json(bytes, subject);
    if (!root) {
        return root.error();
    }
    return LandmarkJsonReader(subject, positions).read(*root);
}

std::string write_landmark_json(std::span<const Index> vertices, std::span<const std::string> names,
                                std::span<const Vec3> positions)
{
    std::string json = "{\"version\":1,\"landmarks\":[";
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        json += i == 0 ? "\n{" : ",\n{";
        if (i < names.size() && !names[i].empty()) {
            json += "\"name\":";
            append_json_string(json, names[i]);
            json += ',';
        }
        json += "\"vertex\":" + std::to_string(vertices[i]);
        if (vertices[i] < positions.size()) {
            json += ",\"position\":[";
            for (int axis = 0; axis < 3; ++axis) {
                json += axis == 0 ? "" : ",";
                append_number(json, positions[vertices[i]][axis]);
            }
            json += ']';
        }
        json += '}';
    }
    return json + "\n]}\n";
}

}  // namespace layout_embedding
