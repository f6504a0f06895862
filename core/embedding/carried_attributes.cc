#include "embedding/carried_attributes.hh"

#include <algorithm>

#include "embedding/refined_origin.hh"

namespace layout_embedding {
namespace {

/// So that vertices of any degree cost no more than their corners.
constexpr int kMostCompared = 32;

CornerValues carried(const CornerValues& values, const TriangleMesh& target,
                     const RefinedMesh& refined)
{
    CornerValues result{values.size, {}, {}};
    if (values.empty()) {
        return result;
    }
    const RefinedOrigin origin(target, refined);
    // The values at a vertex as a list: its first one, and after each the next.
    std::vector<Index> first(refined.positions.size(), kNone);
    std::vector<Index> next;
    std::vector<double> value(values.size);
    const auto id_of_value = [&](Index vertex) {
        int compared = 0;
        for (Index id = first[vertex]; id != kNone && compared < kMostCompared; id = next[id]) {
            ++compared;
            if (std::equal(value.begin(), value.end(), result.value(id).begin())) {
                return id;
            }
        }
        next.push_back(first[vertex]);
        return first[vertex] = result.add(value);
    };
    result.ids.reserve(refined.corners.size());
    for (std::size_t i = 0; i < refined.corners.size(); ++i) {
        const Index face = refined.triangle_faces[i / 3];
        const Index vertex = refined.corners[i];
        const std::span<const Index, 3> corners(values.ids.data() + std::size_t{face} * 3, 3);
        const bool has_one = values.mix(corners, origin.in_face(vertex, face), value);
        result.ids.push_back(has_one ? id_of_value(vertex) : kNone);
    }
    return result;
}

FaceNames carried(const FaceNames& names, const RefinedMesh& refined)
{
    FaceNames result{names.names, {}};
    for (std::size_t t = 0; !names.empty() && t < refined.triangle_faces.size(); ++t) {
        result.ids.push_back(names.ids[refined.triangle_faces[t]]);
    }
    return result;
}

}  // namespace

MeshAttributes carried_attributes(const MeshAttributes& attributes, const TriangleMesh& target,
                                  const RefinedMesh& refined)
{
    return {carried(attributes.texture_coordinates, target, refined),
            carried(attributes.colours, target, refined),
            carried(attributes.groups, refined),
            carried(attributes.materials, refined),
            attributes.material_files,
            attributes.unusable};
}

}  // namespace layout_embedding
