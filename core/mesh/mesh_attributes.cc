#include "mesh/mesh_attributes.hh"

#include <algorithm>
#include <cmath>

namespace layout_embedding {
namespace {

/// Returns how many corners have a value that cannot be used.
std::size_t finish(CornerValues& values)
{
    std::vector<bool> usable(values.count());
    for (Index id = 0; id < usable.size(); ++id) {
        const auto value = values.value(id);
        usable[id] =
            std::all_of(value.begin(), value.end(), [](double x) { return std::isfinite(x); });
        if (!usable[id]) {
            double* const first = values.numbers.data() + std::size_t{id} * values.size;
            std::fill(first, first + values.size, 0.0);
        }
    }
    std::size_t unusable = 0;
    bool any = false;
    for (Index& id : values.ids) {
        if (id != kNone && (id >= usable.size() || !usable[id])) {
            id = kNone;
            ++unusable;
        }
        any = any || id != kNone;
    }
    if (!any) {
        values = {};
    }
    return unusable;
}

void finish(FaceNames& names)
{
    if (std::all_of(names.ids.begin(), names.ids.end(), [](Index id) { return id == kNone; })) {
        names = {};
    }
}

CornerValues through_repair(const CornerValues& values, const PolygonMesh& before,
                            const FaceOrigins& origins)
{
    CornerValues result{values.size, values.numbers, {}};
    if (values.empty()) {
        return result;
    }
    for (Index f = 0; f < origins.face_count(); ++f) {
        const Index begin = before.face_offsets[origins.face(f)];
        const Index end = before.face_offsets[origins.face(f) + 1];
        const std::span<const Index> ids(values.ids.data() + begin, values.ids.data() + end);
        if (origins.is_whole(f)) {
            result.ids.insert(result.ids.end(), ids.begin(), ids.end());
            continue;
        }
        std::vector<double> value(values.size);
        for (const std::array<double, 3>& weights : origins.places(f)) {
            const bool has_one = values.mix(ids.first<3>(), weights, value);
            result.ids.push_back(has_one ? result.add(value) : kNone);
        }
    }
    return result;
}

FaceNames through_repair(const FaceNames& names, const FaceOrigins& origins)
{
    FaceNames result{names.names, {}};
    for (Index f = 0; !names.empty() && f < origins.face_count(); ++f) {
        result.ids.push_back(names.ids[origins.face(f)]);
    }
    return result;
}

}  // namespace

Index CornerValues::add(std::span<const double> value)
{
    const Index id = count();
    numbers.insert(numbers.end(), value.begin(), value.end());
    return id;
}

std::string_view FaceNames::of_face(Index f) const
{
    return empty() || ids[f] == kNone ? std::string_view() : names[ids[f]];
}

void FaceNaming::add(const std::string& name)
{
    if (name.empty()) {
        result_.ids.push_back(kNone);
        return;
    }
    const auto [place, fresh] = ids_.try_emplace(name, static_cast<Index>(result_.names.size()));
    if (fresh) {
        result_.names.push_back(name);
    }
    result_.ids.push_back(place->second);
}

std::string as_word(std::string_view text)
{
    std::string word(text);
    for (char& c : word) {
        c = static_cast<unsigned char>(c) <= ' ' ? '_' : c;
    }
    return word;
}

std::string colour_word(const std::array<double, 3>& colour)
{
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string word = "colour_";
    for (const double part : colour) {
        // Not a number compares as false, and becomes 0.
        const auto byte =
            static_cast<std::size_t>(std::lround(255 * (part > 0 ? std::min(part, 1.0) : 0.0)));
        word += {kDigits[byte / 16], kDigits[byte % 16]};
    }
    return word;
}

std::vector<Index> corner_ids(std::span<const Index> vertex_ids, std::span<const Index> corners)
{
    std::vector<Index> ids;
    ids.reserve(corners.size());
    for (const Index corner : corners) {
        ids.push_back(vertex_ids[corner]);
    }
    return ids;
}

bool CornerValues::mix(std::span<const Index, 3> from, const std::array<double, 3>& weights,
                       std::span<double> value) const
{
    std::fill(value.begin(), value.end(), 0.0);
    for (std::size_t k = 0; k < 3; ++k) {
        if (weights[k] == 0) {
            continue;
        }
        if (from[k] == kNone) {
            return false;
        }
        const auto corner = this->value(from[k]);
        for (std::size_t i = 0; i < size; ++i) {
            value[i] += weights[k] * corner[i];
        }
    }
    return true;
}

void finish(MeshAttributes& attributes)
{
    attributes.unusable = finish(attributes.texture_coordinates) + finish(attributes.colours);
    finish(attributes.groups);
    finish(attributes.materials);
}

std::vector<Index> values_of_vertices(const CornerValues& values, std::span<const Index> corners,
                                      Index vertex_count)
{
    std::vector<Index> ids(vertex_count, kNone);
    for (std::size_t i = 0; i < values.ids.size(); ++i) {
        Index& id = ids[corners[i]];
        id = id == kNone ? values.ids[i] : id;
    }
    return ids;
}

MeshAttributes through_repair(const MeshAttributes& attributes, const PolygonMesh& before,
                              const FaceOrigins& origins)
{
    return {through_repair(attributes.texture_coordinates, before, origins),
            through_repair(attributes.colours, before, origins),
            through_repair(attributes.groups, origins),
            through_repair(attributes.materials, origins),
            attributes.material_files,
            attributes.unusable};
}

}  // namespace layout_embedding
