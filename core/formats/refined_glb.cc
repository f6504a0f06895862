#include "formats/refined_glb.hh"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "base/bytes.hh"
#include "base/number_text.hh"
#include "formats/patch_colours.hh"
#include "patches/domain.hh"

namespace layout_embedding {
namespace {

constexpr int kArrayBuffer = 34962;
constexpr int kElementArrayBuffer = 34963;
constexpr Index kSidesOfTubes = 8;

struct Surface {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;
    std::vector<Index> corners;
};

Vec3 perpendicular(const Vec3& direction)
{
    int axis = 0;
    direction.cwiseAbs().minCoeff(&axis);
    return direction.cross(Vec3::Unit(axis)).normalized();
}

/// A tube of the given radius around a polyline, rings of vertices joined by triangles.
Surface tube(const std::vector<Vec3>& points, double radius)
{
    static const Domain circle = regular_polygon(kSidesOfTubes);
    Surface surface;
    Vec3 across(0, 0, 0);
    Vec3 along(0, 0, 1);
    for (std::size_t i = 0; i < points.size(); ++i) {
        Vec3 direction(0, 0, 0);
        for (const std::size_t j : {i, i + 1}) {
            if (j > 0 && j < points.size()) {
                const Vec3 step = points[j] - points[j - 1];
                direction += step.norm() > 0 ? step.normalized() : Vec3(0, 0, 0);
            }
        }
        along = direction.norm() > 1e-6 ? direction.normalized() : along;
        // The frame turns as little as it can.
        across -= along * across.dot(along);
        across = across.norm() > 1e-6 ? across.normalized() : perpendicular(along);
        const Vec3 up = along.cross(across);
        for (const PlanePoint& p : circle) {
            const Vec3 normal = across * p.x() + up * p.y();
            surface.positions.push_back(points[i] + radius * normal);
            surface.normals.push_back(normal);
        }
        for (Index k = 0; i > 0 && k < kSidesOfTubes; ++k) {
            const Index a = static_cast<Index>(i - 1) * kSidesOfTubes + k;
            const Index b = static_cast<Index>(i - 1) * kSidesOfTubes + (k + 1) % kSidesOfTubes;
            surface.corners.insert(surface.corners.end(), {a, b, b + kSidesOfTubes});
            surface.corners.insert(surface.corners.end(),
                                   {a, b + kSidesOfTubes, a + kSidesOfTubes});
        }
    }
    return surface;
}

/// Adds a ball: an octahedron, twice subdivided.
void add_ball(const Vec3& centre, double radius, Surface& surface)
{
    std::vector<Vec3> points{Vec3(1, 0, 0),  Vec3(0, 1, 0),  Vec3(0, 0, 1),
                             Vec3(-1, 0, 0), Vec3(0, -1, 0), Vec3(0, 0, -1)};
    std::vector<std::array<Index, 3>> faces{{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2},
                                            {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}};
    for (int level = 0; level < 2; ++level) {
        std::map<std::array<Index, 2>, Index> middles;
        const auto middle = [&](Index a, Index b) {
            const auto [place, fresh] = middles.try_emplace(
                std::array<Index, 2>{std::min(a, b), std::max(a, b)}, Index(points.size()));
            if (fresh) {
                points.push_back((points[a] + points[b]).normalized());
            }
            return place->second;
        };
        std::vector<std::array<Index, 3>> finer;
        for (const auto& [a, b, c] : faces) {
            const Index ab = middle(a, b);
            const Index bc = middle(b, c);
            const Index ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        faces = std::move(finer);
    }
    const Index first = static_cast<Index>(surface.positions.size());
    for (const Vec3& p : points) {
        surface.positions.push_back(centre + radius * p);
        surface.normals.push_back(p);
    }
    for (const auto& face : faces) {
        for (const Index corner : face) {
            surface.corners.push_back(first + corner);
        }
    }
}

/// The vertices that formats need where a vertex is all that its corners have: several of one where
/// their values differ. Those of the refined mesh come first, in its order.
struct SplitVertices {
    /// Per vertex: that of the refined mesh, and its values.
    std::vector<Index> origins;
    std::vector<Index> places;
    std::vector<Index> colours;
    /// Per corner.
    std::vector<Index> corners;

    SplitVertices(const RefinedMesh& refined, const MeshAttributes& attributes)
        : origins(refined.positions.size()), corners(refined.corners)
    {
        std::iota(origins.begin(), origins.end(), Index{0});
        const auto id_at = [](const CornerValues& values, std::size_t corner) {
            return values.empty() ? kNone : values.ids[corner];
        };
        std::map<std::array<Index, 3>, Index> others;
        std::vector<bool> seen(origins.size(), false);
        places.assign(origins.size(), kNone);
        colours.assign(origins.size(), kNone);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const Index vertex = corners[i];
            const Index place = id_at(attributes.texture_coordinates, i);
            const Index colour = id_at(attributes.colours, i);
            if (!seen[vertex]) {
                seen[vertex] = true;
                places[vertex] = place;
                colours[vertex] = colour;
            } else if (places[vertex] != place || colours[vertex] != colour) {
                const auto [found, fresh] =
                    others.try_emplace({vertex, place, colour}, static_cast<Index>(origins.size()));
                if (fresh) {
                    origins.push_back(vertex);
                    places.push_back(place);
                    colours.push_back(colour);
                }
                corners[i] = found->second;
            }
        }
    }
};

class GlbWriter {
public:
    GlbWriter(const RefinedMesh& refined, const MeshAttributes& attributes)
        : refined_(refined), attributes_(attributes)
    {
        low_ = high_ = refined.positions.empty() ? Vec3(0, 0, 0) : refined.positions[0];
        for (const Vec3& p : refined.positions) {
            low_ = low_.cwiseMin(p);
            high_ = high_.cwiseMax(p);
        }
        centre_ = (low_ + high_) / 2;
    }

    std::string write()
    {
        for (const Colour& colour : patch_palette()) {
            add_material(colour, 0.8);
        }
        const Index path_material = add_material(kPathColour, 0.5);
        if (!attributes_.colours.empty()) {
            white_material_ = add_material({255, 255, 255}, 0.8);
        }
        add_patches();
        add_paths(path_material);
        return assemble();
    }

private:
    /// Starts the next item of a JSON list.
    static std::string& next(std::string& list)
    {
        list += list.empty() ? "" : ",";
        return list;
    }

    Index add_material(const Colour& colour, double roughness)
    {
        std::string factor;
        for (const std::uint8_t part : colour) {
            // sRGB to linear with an exponent of 2 is close, and the same on every platform.
            next(factor);
            append_number(factor, std::round(part / 255.0 * part / 255.0 * 1e4) / 1e4);
        }
        next(materials_) += "{\"pbrMetallicRoughness\":{\"baseColorFactor\":[" + factor +
                            ",1],\"metallicFactor\":0,\"roughnessFactor\":";
        append_number(materials_, roughness);
        materials_ += "},\"doubleSided\":true}";
        return material_count_++;
    }

    Index add_view(std::size_t begin, int target)
    {
        next(views_) += "{\"buffer\":0,\"byteOffset\":" + std::to_string(begin) +
                        ",\"byteLength\":" + std::to_string(binary_.size() - begin) +
                        ",\"target\":" + std::to_string(target) + "}";
        return view_count_++;
    }

    Index add_accessor(Index view, int component, std::size_t count, const std::string& type,
                       const std::string& bounds = {})
    {
        next(accessors_) += "{\"bufferView\":" + std::to_string(view) +
                            ",\"componentType\":" + std::to_string(component) +
                            ",\"count\":" + std::to_string(count) + ",\"type\":\"" + type + "\"" +
                            bounds + "}";
        return accessor_count_++;
    }

    Index add_vectors(const std::vector<Vec3>& vectors, const Vec3& origin, bool with_bounds)
    {
        const std::size_t begin = binary_.size();
        std::array<float, 3> low{};
        std::array<float, 3> high{};
        for (std::size_t i = 0; i < vectors.size(); ++i) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const int a = static_cast<int>(axis);
                const float value = static_cast<float>(vectors[i][a] - origin[a]);
                append_bytes(binary_, value);
                low[axis] = i == 0 ? value : std::min(low[axis], value);
                high[axis] = i == 0 ? value : std::max(high[axis], value);
            }
        }
        std::string bounds;
        if (with_bounds) {
            const auto list = [](const std::array<float, 3>& values) {
                std::string text;
                for (const float value : values) {
                    append_number(next(text), static_cast<double>(value));
                }
                return text;
            };
            bounds = ",\"min\":[" + list(low) + "],\"max\":[" + list(high) + "]";
        }
        return add_accessor(add_view(begin, kArrayBuffer), 5126, vectors.size(), "VEC3", bounds);
    }

    Index add_indices(const std::vector<Index>& indices)
    {
        const std::size_t begin = binary_.size();
        for (const Index index : indices) {
            append_bytes(binary_, index);
        }
        return add_accessor(add_view(begin, kElementArrayBuffer), 5125, indices.size(), "SCALAR");
    }

    /// `attributes`: further ones, each with a comma before.
    void add_node(const std::string& name, Index positions, Index normals, Index indices,
                  Index material, const std::string& attributes = {})
    {
        next(meshes_) += "{\"name\":\"" + name + "\",\"primitives\":[{\"attributes\":{" +
                         "\"POSITION\":" + std::to_string(positions) +
                         ",\"NORMAL\":" + std::to_string(normals) + attributes +
                         "},\"indices\":" + std::to_string(indices) +
                         ",\"material\":" + std::to_string(material) + "}]}";
        next(nodes_) += "{\"name\":\"" + name + "\",\"mesh\":" + std::to_string(node_count_) + "}";
        ++node_count_;
    }

    void add_patches()
    {
        std::vector<Vec3> normals(refined_.positions.size(), Vec3(0, 0, 0));
        std::map<Index, std::vector<Index>> triangles;  // by patch; kNone, the outside, is last
        for (std::size_t t = 0; t < refined_.triangle_patches.size(); ++t) {
            const Index* c = &refined_.corners[3 * t];
            const Vec3& a = refined_.positions[c[0]];
            const Vec3 normal = (refined_.positions[c[1]] - a).cross(refined_.positions[c[2]] - a);
            for (int i = 0; i < 3; ++i) {
                normals[c[i]] += normal;
            }
            triangles[refined_.triangle_patches[t]].push_back(static_cast<Index>(t));
        }
        for (Vec3& normal : normals) {
            normal = normal.norm() > 0 ? normal.normalized() : Vec3(0, 0, 1);
        }
        const SplitVertices split(refined_, attributes_);
        std::vector<Vec3> positions;
        std::vector<Vec3> split_normals;
        for (const Index vertex : split.origins) {
            positions.push_back(refined_.positions[vertex]);
            split_normals.push_back(normals[vertex]);
        }
        const Index position_accessor = add_vectors(positions, centre_, true);
        const Index normal_accessor = add_vectors(split_normals, Vec3(0, 0, 0), false);
        const std::string more = add_attributes(split);
        const std::vector<Index> colours = triangle_colours(refined_);
        for (const auto& [patch, members] : triangles) {
            std::vector<Index> indices;
            for (const Index t : members) {
                indices.insert(indices.end(), &split.corners[3 * t], &split.corners[3 * t] + 3);
            }
            // Colours of vertices would be mixed with the material's.
            add_node(patch == kNone ? "outside" : "patch_" + std::to_string(patch),
                     position_accessor, normal_accessor, add_indices(indices),
                     attributes_.colours.empty() ? colours[members.front()] : white_material_,
                     more);
        }
    }

    /// Returns the attributes of all patches' primitives.
    std::string add_attributes(const SplitVertices& split)
    {
        std::string more;
        if (!attributes_.texture_coordinates.empty()) {
            // v points downwards in glTF.
            const Index accessor = add_values(
                split.places, attributes_.texture_coordinates, {0, 1},
                [](std::size_t i, double number) { return i == 1 ? 1 - number : number; });
            more += ",\"TEXCOORD_0\":" + std::to_string(accessor);
        }
        if (!attributes_.colours.empty()) {
            const Index accessor =
                add_values(split.colours, attributes_.colours, {1, 1, 1, 1},
                           [](std::size_t, double number) { return std::clamp(number, 0.0, 1.0); });
            more += ",\"COLOR_0\":" + std::to_string(accessor);
        }
        return more;
    }

    template <typename Written>
    Index add_values(const std::vector<Index>& ids, const CornerValues& values,
                     const std::array<double, 4>& otherwise, Written written)
    {
        const std::size_t begin = binary_.size();
        for (const Index id : ids) {
            for (std::size_t i = 0; i < values.size; ++i) {
                const double number = id == kNone ? otherwise[i] : values.value(id)[i];
                append_bytes(binary_, static_cast<float>(written(i, number)));
            }
        }
        return add_accessor(add_view(begin, kArrayBuffer), 5126, ids.size(),
                            "VEC" + std::to_string(values.size));
    }

    void add_surface(const std::string& name, const Surface& surface, Index material)
    {
        const Index positions = add_vectors(surface.positions, centre_, true);
        const Index normals = add_vectors(surface.normals, Vec3(0, 0, 0), false);
        add_node(name, positions, normals, add_indices(surface.corners), material);
    }

    void add_paths(Index material)
    {
        double length = 0;
        for (const std::vector<Index>& chain : refined_.chains) {
            for (std::size_t i = 1; i < chain.size(); ++i) {
                length += (refined_.positions[chain[i]] - refined_.positions[chain[i - 1]]).norm();
            }
        }
        if (refined_.chains.empty() || !(length > 0)) {
            return;
        }
        const double radius =
            std::min(0.003 * (high_ - low_).norm(), 0.04 * length / double(refined_.chains.size()));
        std::map<Index, Vec3> ends;
        for (std::size_t e = 0; e < refined_.chains.size(); ++e) {
            std::vector<Vec3> points;
            for (const Index vertex : refined_.chains[e]) {
                points.push_back(refined_.positions[vertex]);
            }
            if (points.size() < 2) {
                continue;
            }
            ends[refined_.chains[e].front()] = points.front();
            ends[refined_.chains[e].back()] = points.back();
            add_surface("edge_" + std::to_string(e), tube(points, radius), material);
        }
        Surface balls;
        for (const auto& [vertex, position] : ends) {
            add_ball(position, 2 * radius, balls);
        }
        add_surface("landmarks", balls, material);
    }

    std::string assemble()
    {
        std::string children;
        for (Index node = 0; node < node_count_; ++node) {
            next(children) += std::to_string(node);
        }
        std::string centre;
        for (int axis = 0; axis < 3; ++axis) {
            append_number(next(centre), centre_[axis]);
        }
        next(nodes_) += "{\"name\":\"embedding\",\"translation\":[" + centre + "],\"children\":[" +
                        children + "]}";
        std::string json =
            "{\"asset\":{\"version\":\"2.0\",\"generator\":\"layout-embedding\"},\"scene\":0,"
            "\"scenes\":[{\"nodes\":[" +
            std::to_string(node_count_) + "]}],\"nodes\":[" + nodes_ + "],\"meshes\":[" + meshes_ +
            "],\"materials\":[" + materials_ + "],\"accessors\":[" + accessors_ +
            "],\"bufferViews\":[" + views_ +
            "],\"buffers\":[{\"byteLength\":" + std::to_string(binary_.size()) + "}]}";
        json.resize((json.size() + 3) / 4 * 4, ' ');
        std::string glb = "glTF";
        append_bytes(glb, std::uint32_t{2});
        append_bytes(glb, static_cast<std::uint32_t>(28 + json.size() + binary_.size()));
        append_bytes(glb, static_cast<std::uint32_t>(json.size()));
        glb += "JSON";
        glb += json;
        append_bytes(glb, static_cast<std::uint32_t>(binary_.size()));
        glb += std::string("BIN\0", 4);
        glb += binary_;
        return glb;
    }

    const RefinedMesh& refined_;
    const MeshAttributes& attributes_;
    Index white_material_ = kNone;
    Vec3 low_;
    Vec3 high_;
    Vec3 centre_;
    std::string binary_;
    std::string views_;
    std::string accessors_;
    std::string materials_;
    std::string meshes_;
    std::string nodes_;
    Index view_count_ = 0;
    Index accessor_count_ = 0;
    Index material_count_ = 0;
    Index node_count_ = 0;
};

}  // namespace

std::string write_refined_glb(const RefinedMesh& refined, const MeshAttributes& attributes)
{
    return GlbWriter(refined, attributes).write();
}

}  // namespace layout_embedding
