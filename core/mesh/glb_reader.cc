#include "mesh/glb_reader.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/bytes.hh"
#include "base/json.hh"
#include "mesh/seams.hh"

namespace layout_embedding {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67;      // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kBinChunk = 0x004E4942;   // "BIN\0"
constexpr double kMostIds = kNone - 1;

using Matrix = Eigen::Matrix4d;

/// An array in the binary chunk.
struct Accessor {
    std::string_view bytes;
    std::size_t count = 0;
    std::size_t stride = 0;
    int component = 0;  // glTF's number of the type
    bool normalized = false;

    std::size_t component_size() const
    {
        return component == 5120 || component == 5121   ? 1
               : component == 5122 || component == 5123 ? 2
                                                        : 4;
    }
    double value(std::size_t element, std::size_t place) const
    {
        const std::string_view at = bytes.substr(element * stride + place * component_size());
        switch (component) {
            case 5120:
                return scaled(value_of_bytes<std::int8_t>(at), 127);
            case 5121:
                return scaled(value_of_bytes<std::uint8_t>(at), 255);
            case 5122:
                return scaled(value_of_bytes<std::int16_t>(at), 32767);
            case 5123:
                return scaled(value_of_bytes<std::uint16_t>(at), 65535);
            case 5125:
                return value_of_bytes<std::uint32_t>(at);
            default:
                return static_cast<double>(value_of_bytes<float>(at));
        }
    }

private:
    double scaled(double number, double largest) const
    {
        return normalized ? std::max(number / largest, -1.0) : number;
    }
};

class GlbReader {
public:
    GlbReader(std::string_view bytes, std::string_view subject, MeshAttributes* attributes)
        : bytes_(bytes), subject_(subject), attributes_(attributes)
    {}

    Result<PolygonMesh> read()
    {
        Status status = read_chunks();
        if (status) {
            status = read_scene();
        }
        if (!status) {
            return status.error();
        }
        if (attributes_ != nullptr) {
            // Seams are closed by giving corners other vertices: their values stay.
            attributes_->groups = groups_.take();
            attributes_->materials = materials_.take();
            finish(*attributes_);
        }
        return without_seams(mesh_);
    }

private:
    Error wrong(const std::string& what) const
    {
        return make_error(ErrorCode::syntaxError, subject_ + " has " + what);
    }
    /// Nodes and primitives may share arrays, so that a small file could stand for any number of
    /// vertices and triangles: no more of them than the file has bytes, or a generous number.
    std::size_t most_vertices() const
    {
        constexpr std::size_t kGenerous = 1'000'000;
        return std::min<std::size_t>(std::max(bytes_.size(), kGenerous), kNone / 4);
    }
    Error unknown(const std::string& what) const
    {
        return make_error(ErrorCode::unknownFormat, subject_ + " has " + what);
    }

    Status read_chunks()
    {
        if (bytes_.size() < 12 || value_of_bytes<std::uint32_t>(bytes_) != kMagic) {
            return make_error(ErrorCode::unknownFormat, subject_ + " has no GLB header");
        }
        if (value_of_bytes<std::uint32_t>(bytes_.substr(4)) != 2) {
            return unknown("another version of glTF than 2.0");
        }
        std::string_view rest = bytes_.substr(12);
        std::string_view json;
        while (rest.size() >= 8) {
            const auto size = value_of_bytes<std::uint32_t>(rest);
            const auto type = value_of_bytes<std::uint32_t>(rest.substr(4));
            rest.remove_prefix(8);
            if (size > rest.size()) {
                return wrong("a chunk that ends behind the file");
            }
            if (type == kJsonChunk && json.empty()) {
                json = rest.substr(0, size);
            } else if (type == kBinChunk && binary_.empty()) {
                binary_ = rest.substr(0, size);
            }
            rest.remove_prefix(size);
        }
        auto root = parse_json(json, subject_);
        if (!root) {
            return root.error();
        }
        root_ = std::move(*root);
        return {};
    }

    /// The elements of an array of the document; empty where there is none.
    static const std::vector<JsonValue>& list(const JsonValue& parent, const char* name)
    {
        static const std::vector<JsonValue> none;
        const JsonValue* found = parent.find(name);
        return found == nullptr ? none : found->items;
    }

    /// The element of a list of the document that a member refers to, or nullptr.
    const JsonValue* referred(const JsonValue& parent, const char* member, const char* name) const
    {
        const JsonValue* id = parent.find(member);
        const auto& items = list(root_, name);
        return id != nullptr && id->is_whole(kMostIds) && id->number < double(items.size())
                   ? &items[static_cast<std::size_t>(id->number)]
                   : nullptr;
    }

    static double number_of(const JsonValue& parent, const char* name, double otherwise)
    {
        const JsonValue* found = parent.find(name);
        return found != nullptr && found->is(JsonValue::Kind::number) ? found->number : otherwise;
    }

    Status read_scene()
    {
        const auto& nodes = list(root_, "nodes");
        visited_.assign(nodes.size(), false);
        const JsonValue* scene = referred(root_, "scene", "scenes");
        if (scene == nullptr && !list(root_, "scenes").empty()) {
            scene = &list(root_, "scenes").front();
        }
        if (scene == nullptr) {
            // A library without a scene: every mesh as it is.
            for (const JsonValue& mesh : list(root_, "meshes")) {
                if (const Status status = read_mesh(mesh, nullptr, Matrix::Identity()); !status) {
                    return status;
                }
            }
            return {};
        }
        return read_nodes(list(*scene, "nodes"), Matrix::Identity());
    }

    Status read_nodes(const std::vector<JsonValue>& roots, const Matrix& root_frame)
    {
        struct Entry {
            std::size_t node;
            Matrix frame;
        };
        const auto& nodes = list(root_, "nodes");
        std::vector<Entry> stack;
        const auto push = [&](const std::vector<JsonValue>& ids, const Matrix& frame) {
            // Backwards, so that they come off the stack in order.
            for (auto id = ids.rbegin(); id != ids.rend(); ++id) {
                if (!id->is_whole(kMostIds) || id->number >= double(nodes.size())) {
                    return false;
                }
                stack.push_back({static_cast<std::size_t>(id->number), frame});
            }
            return true;
        };
        bool fine = push(roots, root_frame);
        while (fine && !stack.empty()) {
            const Entry entry = stack.back();
            stack.pop_back();
            if (visited_[entry.node]) {
                return wrong("a node that is reached twice");
            }
            visited_[entry.node] = true;
            const JsonValue& node = nodes[entry.node];
            const Matrix frame = entry.frame * transformation(node);
            if (node.find("mesh") != nullptr) {
                const JsonValue* mesh = referred(node, "mesh", "meshes");
                if (mesh == nullptr) {
                    return wrong("a node with a mesh that does not exist");
                }
                if (const Status status = read_mesh(*mesh, &node, frame); !status) {
                    return status;
                }
            }
            fine = push(list(node, "children"), frame);
        }
        return fine ? Status() : wrong("a reference to a node that does not exist");
    }

    static Matrix transformation(const JsonValue& node)
    {
        const auto numbers = [&](const char* name, std::vector<double> otherwise) {
            const auto& items = list(node, name);
            if (items.size() == otherwise.size()) {
                for (std::size_t i = 0; i < items.size(); ++i) {
                    otherwise[i] = items[i].number;
                }
            }
            return otherwise;
        };
        Matrix matrix = Matrix::Identity();
        if (node.find("matrix") != nullptr) {
            const auto m = numbers("matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
            for (int i = 0; i < 16; ++i) {
                matrix(i % 4, i / 4) = m[static_cast<std::size_t>(i)];
            }
            return matrix;
        }
        const auto t = numbers("translation", {0, 0, 0});
        const auto q = numbers("rotation", {0, 0, 0, 1});
        const auto s = numbers("scale", {1, 1, 1});
        const double x = q[0];
        const double y = q[1];
        const double z = q[2];
        const double w = q[3];
        Eigen::Matrix3d turn;
        turn << 1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),  //
            2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),      //
            2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y);
        matrix.topLeftCorner<3, 3>() = turn * Vec3(s[0], s[1], s[2]).asDiagonal();
        matrix.topRightCorner<3, 1>() = Vec3(t[0], t[1], t[2]);
        return matrix;
    }

    static std::string name_of(const JsonValue* named)
    {
        const JsonValue* name = named == nullptr ? nullptr : named->find("name");
        return name == nullptr ? std::string() : as_word(name->string);
    }

    Status read_mesh(const JsonValue& mesh, const JsonValue* node, const Matrix& frame)
    {
        group_ = name_of(node);
        group_ = group_.empty() ? name_of(&mesh) : group_;
        for (const JsonValue& primitive : list(mesh, "primitives")) {
            const double mode = number_of(primitive, "mode", 4);
            if (mode < 4) {
                continue;  // points and lines
            }
            if (mode != 4 && mode != 5 && mode != 6) {
                return wrong("a primitive of an unknown kind");
            }
            if (const JsonValue* extensions = primitive.find("extensions")) {
                if (extensions->find("KHR_draco_mesh_compression") != nullptr) {
                    return unknown("compressed meshes (Draco), which have to be unpacked first");
                }
            }
            if (const Status status = read_primitive(primitive, mode, frame); !status) {
                return status;
            }
        }
        return {};
    }

    Status read_primitive(const JsonValue& primitive, double mode, const Matrix& frame)
    {
        Accessor positions;
        const JsonValue* attributes = primitive.find("attributes");
        const JsonValue* accessor =
            attributes == nullptr ? nullptr : referred(*attributes, "POSITION", "accessors");
        if (accessor == nullptr) {
            return wrong("a primitive without positions");
        }
        if (const Status status = read_accessor(*accessor, "VEC3", 3, positions); !status) {
            return status;
        }
        const std::size_t first = mesh_.positions.size();
        if (first + positions.count > most_vertices()) {
            return make_error(ErrorCode::tooLarge,
                              subject_ + " has more than " + std::to_string(most_vertices()) +
                                  " vertices, as meshes are used several times");
        }
        for (std::size_t v = 0; v < positions.count; ++v) {
            const Vec3 p(positions.value(v, 0), positions.value(v, 1), positions.value(v, 2));
            mesh_.positions.emplace_back(frame.topLeftCorner<3, 3>() * p +
                                         frame.topRightCorner<3, 1>());
        }
        CornerSource source;
        if (attributes_ != nullptr) {
            source = read_attributes(primitive, *attributes);
        }
        Accessor indices;
        std::size_t count = positions.count;
        const bool indexed = primitive.find("indices") != nullptr;
        if (indexed) {
            const JsonValue* of_indices = referred(primitive, "indices", "accessors");
            if (of_indices == nullptr) {
                return wrong("a primitive with indices that do not exist");
            }
            if (const Status status = read_accessor(*of_indices, "SCALAR", 1, indices); !status) {
                return status;
            }
            if (indices.component == 5126) {
                return wrong("indices that are no whole numbers");
            }
            indices.normalized = false;
            count = indices.count;
        }
        // A mirrored frame turns triangles inside out.
        const bool mirrored = frame.topLeftCorner<3, 3>().determinant() < 0;
        const std::size_t step = mode == 4 ? 3 : 1;
        if (mesh_.corners.size() + 3 * (count / step) > 3 * most_vertices()) {
            return make_error(ErrorCode::tooLarge,
                              subject_ + " has more than " + std::to_string(most_vertices()) +
                                  " triangles, as meshes are used several times");
        }
        for (std::size_t i = 0; i + 2 < count; i += step) {
            std::array<std::size_t, 3> places{mode == 6 ? 0 : i, i + 1, i + 2};
            if ((mode == 5 && i % 2 == 1) != mirrored) {
                std::swap(places[1], places[2]);
            }
            std::array<Index, 3> corners{};
            std::array<Index, 3> vertices{};
            for (std::size_t k = 0; k < 3; ++k) {
                const double vertex =
                    indexed ? indices.value(places[k], 0) : static_cast<double>(places[k]);
                if (!(vertex >= 0 && vertex < static_cast<double>(positions.count))) {
                    return make_error(ErrorCode::indexOutOfRange,
                                      subject_ + " has a triangle with the vertex " +
                                          std::to_string(static_cast<std::int64_t>(vertex)) +
                                          " of " + std::to_string(positions.count));
                }
                vertices[k] = static_cast<Index>(vertex);
                corners[k] = static_cast<Index>(first) + vertices[k];
            }
            // Strips are turned by triangles without area.
            if (mode == 4 || (corners[0] != corners[1] && corners[1] != corners[2] &&
                              corners[2] != corners[0])) {
                mesh_.add_face(corners);
                if (attributes_ != nullptr) {
                    add_attributes(vertices, source);
                }
            }
        }
        return {};
    }

    /// The values of the vertices of a primitive, from these ids on.
    struct CornerSource {
        Index places = kNone;
        Index colours = kNone;
        std::size_t place_count = 0;
        std::size_t colour_count = 0;
        std::string material;
    };

    /// Arrays that cannot be read have no values that could be used.
    CornerSource read_attributes(const JsonValue& primitive, const JsonValue& attributes)
    {
        CornerValues& places = attributes_->texture_coordinates;
        CornerValues& colours = attributes_->colours;
        places.size = 2;
        colours.size = 4;
        CornerSource source;
        const auto readable = [&](const CornerValues& values, const JsonValue& json,
                                  std::string_view type, std::size_t components) {
            Accessor accessor;
            const Status status = read_accessor(json, type, components, accessor);
            if (!status || values.count() + accessor.count > most_vertices()) {
                accessor.count = 0;
            }
            return accessor;
        };
        if (const JsonValue* json = referred(attributes, "TEXCOORD_0", "accessors")) {
            const Accessor array = readable(places, *json, "VEC2", 2);
            source.places = places.count();
            source.place_count = array.count;
            for (std::size_t v = 0; v < array.count; ++v) {
                // v points downwards in glTF.
                places.add(std::array<double, 2>{array.value(v, 0), 1 - array.value(v, 1)});
            }
        }
        if (const JsonValue* json = referred(attributes, "COLOR_0", "accessors")) {
            const JsonValue* type = json->find("type");
            const bool opaque = type == nullptr || type->string != "VEC4";
            const Accessor array =
                readable(colours, *json, opaque ? "VEC3" : "VEC4", opaque ? 3 : 4);
            source.colours = colours.count();
            source.colour_count = array.count;
            for (std::size_t v = 0; v < array.count; ++v) {
                colours.add(std::array<double, 4>{array.value(v, 0), array.value(v, 1),
                                                  array.value(v, 2),
                                                  opaque ? 1 : array.value(v, 3)});
            }
        }
        if (const JsonValue* material = referred(primitive, "material", "materials")) {
            const auto id = static_cast<std::int64_t>(primitive.find("material")->number);
            source.material = name_of(material);
            source.material =
                source.material.empty() ? "material_" + std::to_string(id) : source.material;
        }
        return source;
    }

    void add_attributes(const std::array<Index, 3>& vertices, const CornerSource& source)
    {
        const auto id = [](Index first, std::size_t count, Index vertex) {
            return first == kNone ? kNone : vertex < count ? first + vertex : kUnusable;
        };
        for (const Index v : vertices) {
            attributes_->texture_coordinates.ids.push_back(
                id(source.places, source.place_count, v));
            attributes_->colours.ids.push_back(id(source.colours, source.colour_count, v));
        }
        groups_.add(group_);
        materials_.add(source.material);
    }

    Status read_accessor(const JsonValue& json, std::string_view type, std::size_t components,
                         Accessor& accessor) const
    {
        if (json.find("sparse") != nullptr) {
            return unknown("sparse arrays");
        }
        const JsonValue* named = json.find("type");
        if (named == nullptr || named->string != type) {
            return wrong("an array of another type than " + std::string(type));
        }
        const JsonValue* view = referred(json, "bufferView", "bufferViews");
        if (view == nullptr) {
            return wrong("an array without a buffer view");
        }
        if (const JsonValue* extensions = view->find("extensions");
            extensions != nullptr && extensions->find("EXT_meshopt_compression") != nullptr) {
            return unknown("compressed buffers, which have to be unpacked first");
        }
        const JsonValue* buffer = referred(*view, "buffer", "buffers");
        if (buffer == nullptr || buffer->find("uri") != nullptr ||
            number_of(*view, "buffer", 0) != 0) {
            return unknown("data outside of the file");
        }
        const double component = number_of(json, "componentType", 0);
        if (!(component >= 5120 && component <= 5126) || component != std::floor(component) ||
            component == 5124) {
            return wrong("an array with an unknown type of numbers");
        }
        accessor.component = static_cast<int>(component);
        const JsonValue* normalized = json.find("normalized");
        accessor.normalized = normalized != nullptr && normalized->boolean;
        const std::size_t element = components * accessor.component_size();
        std::array<double, 5> numbers{
            number_of(*view, "byteOffset", 0), number_of(*view, "byteLength", -1),
            number_of(json, "byteOffset", 0), number_of(json, "count", -1),
            number_of(*view, "byteStride", static_cast<double>(element))};
        for (const double number : numbers) {
            if (!(number >= 0 && number <= kMostIds && number == std::floor(number))) {
                return wrong("an array with an impossible offset or length");
            }
        }
        const auto [view_offset, view_length, offset, count, stride] = numbers;
        if (count == 0) {
            return {};
        }
        const double end = offset + (count - 1) * stride + double(element);
        if (view_offset + view_length > static_cast<double>(binary_.size()) || end > view_length ||
            stride < static_cast<double>(element)) {
            return wrong("an array that ends behind its buffer");
        }
        accessor.bytes = binary_.substr(static_cast<std::size_t>(view_offset + offset));
        accessor.count = static_cast<std::size_t>(count);
        accessor.stride = static_cast<std::size_t>(stride);
        return {};
    }

    std::string_view bytes_;
    std::string subject_;
    std::string_view binary_;
    JsonValue root_;
    std::vector<bool> visited_;
    PolygonMesh mesh_;
    MeshAttributes* attributes_;
    FaceNaming groups_;
    FaceNaming materials_;
    /// Of the mesh that is being read.
    std::string group_;
};

}  // namespace

Result<PolygonMesh> read_glb(std::string_view bytes, std::string_view subject,
                             MeshAttributes* attributes)
{
    return GlbReader(bytes, subject, attributes).read();
}

}  // namespace layout_embedding
