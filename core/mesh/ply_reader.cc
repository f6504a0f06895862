#include "mesh/ply_reader.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/bytes.hh"
#include "base/line_scanner.hh"

namespace layout_embedding {
namespace {

enum class Scalar { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::optional<Scalar> scalar_of(std::string_view name)
{
    constexpr std::array<std::string_view, 8> kOld{"char", "uchar", "short", "ushort",
                                                   "int",  "uint",  "float", "double"};
    constexpr std::array<std::string_view, 8> kNew{"int8",  "uint8",  "int16",   "uint16",
                                                   "int32", "uint32", "float32", "float64"};
    for (std::size_t i = 0; i < kOld.size(); ++i) {
        if (name == kOld[i] || name == kNew[i]) {
            return static_cast<Scalar>(i);
        }
    }
    return std::nullopt;
}

std::size_t size_of(Scalar type)
{
    constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
    return kSizes[static_cast<std::size_t>(type)];
}

/// What a property is for. Those up to v are numbers of a vertex; colours are numbers of a face,
/// too.
enum class Role {
    x,
    y,
    z,
    red,
    green,
    blue,
    opacity,
    u,
    v,
    skipped,
    corners,
    texture_list,
    texture_number,
    label,
};

constexpr std::size_t kNumberRoles = static_cast<std::size_t>(Role::v) + 1;

constexpr std::size_t place_of(Role role)
{
    return static_cast<std::size_t>(role);
}

/// Which attribute a number of a vertex or a face is, by the names that programs use.
Role attribute_role(std::string_view name)
{
    constexpr std::array<std::pair<std::string_view, Role>, 18> kRoles{{
        {"red", Role::red},
        {"diffuse_red", Role::red},
        {"green", Role::green},
        {"diffuse_green", Role::green},
        {"blue", Role::blue},
        {"diffuse_blue", Role::blue},
        {"alpha", Role::opacity},
        {"diffuse_alpha", Role::opacity},
        {"u", Role::u},
        {"s", Role::u},
        {"texture_u", Role::u},
        {"texture_s", Role::u},
        {"tx", Role::u},
        {"v", Role::v},
        {"t", Role::v},
        {"texture_v", Role::v},
        {"texture_t", Role::v},
        {"ty", Role::v},
    }};
    const auto* const found = std::find_if(kRoles.begin(), kRoles.end(),
                                           [&](const auto& role) { return role.first == name; });
    return found == kRoles.end() ? Role::skipped : found->second;
}

/// What stands for the full colour in a type.
double full_colour(Scalar type)
{
    return type >= Scalar::float32 ? 1 : type == Scalar::uint16 ? 65535 : 255;
}

struct Property {
    Role role = Role::skipped;
    /// Of labels.
    std::string name;
    Scalar type{};
    std::optional<Scalar> count_type;  // of a list
};

struct Element {
    std::string name;
    std::int64_t count = 0;
    std::vector<Property> properties;

    bool has(Role role) const
    {
        return std::any_of(properties.begin(), properties.end(),
                           [&](const Property& p) { return p.role == role; });
    }
    bool has_colour() const { return has(Role::red) && has(Role::green) && has(Role::blue); }
    bool has_place() const { return has(Role::u) && has(Role::v); }
};

class PlyReader {
public:
    PlyReader(std::string_view bytes, std::string_view subject, MeshAttributes* attributes)
        : rest_(bytes), subject_(subject), attributes_(attributes)
    {}

    Result<PolygonMesh> read()
    {
        if (const Status status = read_header(); !status) {
            return status.error();
        }
        // Vertices may come after the faces.
        const auto vertices = std::find_if(elements_.begin(), elements_.end(),
                                           [](const Element& e) { return e.name == "vertex"; });
        vertex_count_ = vertices == elements_.end() ? 0 : vertices->count;
        for (const Element& element : elements_) {
            if (const Status status = read_element(element); !status) {
                return status.error();
            }
        }
        if (attributes_ != nullptr) {
            finish_attributes();
        }
        return std::move(mesh_);
    }

private:
    /// The next line of the header, without its end.
    bool next_line(std::string_view& line)
    {
        if (rest_.empty()) {
            return false;
        }
        ++line_number_;
        const std::size_t length = std::min(rest_.find_first_of("\r\n"), rest_.size());
        line = rest_.substr(0, length);
        rest_.remove_prefix(length);
        const bool two = rest_.substr(0, 2) == "\r\n";
        rest_.remove_prefix(std::min(rest_.size(), std::size_t{two ? 2U : 1U}));
        return true;
    }

    Error header_error(ErrorCode code, const std::string& what) const
    {
        return make_error(code,
                          subject_ + " has " + what + " in line " + std::to_string(line_number_),
                          {{"line", line_number_}});
    }

    Status read_header()
    {
        std::string_view line;
        if (!next_line(line) || take_token(line) != "ply") {
            return make_error(ErrorCode::unknownFormat, subject_ + " has no PLY header");
        }
        bool has_format = false;
        while (next_line(line)) {
            const std::string_view keyword = take_token(line);
            if (keyword == "end_header") {
                if (!has_format) {
                    return header_error(ErrorCode::syntaxError, "a PLY header without a format");
                }
                return {};
            }
            if (keyword == "format") {
                has_format = true;
                const std::string_view format = take_token(line);
                is_text_ = format == "ascii";
                big_endian_ = format == "binary_big_endian";
                if ((!is_text_ && !big_endian_ && format != "binary_little_endian") ||
                    take_token(line) != "1.0") {
                    return header_error(ErrorCode::unknownFormat, "an unknown version of PLY");
                }
            } else if (keyword == "element") {
                Element element;
                element.name = std::string(take_token(line));
                if (!take_integer(line, element.count) || element.count < 0) {
                    return header_error(ErrorCode::syntaxError, "an element without a count");
                }
                if (element.count >= kNone - 1) {
                    return header_error(ErrorCode::tooLarge,
                                        "more elements than 32-bit ids can number");
                }
                const bool again =
                    std::any_of(elements_.begin(), elements_.end(),
                                [&](const Element& e) { return e.name == element.name; });
                if (again) {
                    return header_error(ErrorCode::syntaxError, "an element for the second time");
                }
                elements_.push_back(std::move(element));
            } else if (keyword == "property") {
                if (const Status status = read_property(line); !status) {
                    return status;
                }
            } else if (keyword == "comment") {
                if (take_token(line) == "TextureFile") {
                    texture_files_.push_back(as_word(without_comment(line)));
                }
            } else if (!keyword.empty() && keyword != "obj_info") {
                return header_error(ErrorCode::syntaxError, "an unknown keyword");
            }
        }
        return header_error(ErrorCode::syntaxError, "no end of its header");
    }

    Status read_property(std::string_view line)
    {
        if (elements_.empty()) {
            return header_error(ErrorCode::syntaxError, "a property before any element");
        }
        Element& element = elements_.back();
        Property property;
        std::string_view type = take_token(line);
        if (type == "list") {
            property.count_type = scalar_of(take_token(line));
            if (!property.count_type || *property.count_type >= Scalar::float32) {
                return header_error(ErrorCode::syntaxError, "a list without a type of its count");
            }
            type = take_token(line);
        }
        const auto scalar = scalar_of(type);
        const std::string_view name = take_token(line);
        if (!scalar || name.empty()) {
            return header_error(ErrorCode::syntaxError, "a property of unknown type or no name");
        }
        property.type = *scalar;
        if (element.name == "vertex" && !property.count_type) {
            property.role = name == "x"   ? Role::x
                            : name == "y" ? Role::y
                            : name == "z" ? Role::z
                                          : wanted(attribute_role(name));
        } else if (element.name == "face" && property.count_type) {
            property.role = name == "vertex_indices" || name == "vertex_index" ? Role::corners
                            : name == "texcoord" ? wanted(Role::texture_list)
                                                 : Role::skipped;
        } else if (element.name == "face") {
            property.role = wanted(face_role(name, *scalar));
            property.name = as_word(name);
        } else if (element.name == "tristrips") {
            return header_error(ErrorCode::unknownFormat, "triangle strips instead of faces");
        }
        element.properties.push_back(property);
        return {};
    }

    Role wanted(Role role) const { return attributes_ == nullptr ? Role::skipped : role; }

    /// Whole numbers of faces mark regions, but for what is known to be something else.
    static Role face_role(std::string_view name, Scalar type)
    {
        const Role role = attribute_role(name);
        if (role == Role::red || role == Role::green || role == Role::blue) {
            return role;
        }
        if (name == "texnumber") {
            return Role::texture_number;
        }
        return role != Role::skipped || name == "flags" || type >= Scalar::float32 ? Role::skipped
                                                                                   : Role::label;
    }

    Status read_element(const Element& element)
    {
        const bool is_vertex = element.name == "vertex";
        const bool is_face = element.name == "face";
        if (is_vertex && !(element.has(Role::x) && element.has(Role::y) && element.has(Role::z))) {
            return make_error(ErrorCode::syntaxError, subject_ + " has vertices without x, y, z");
        }
        if (is_face && !element.has(Role::corners)) {
            return make_error(ErrorCode::syntaxError,
                              subject_ + " has faces without a list vertex_indices");
        }
        if (element.properties.empty()) {
            return {};
        }
        // The counts may lie.
        const std::size_t most = std::min<std::size_t>(
            static_cast<std::size_t>(element.count), rest_.size() / element.properties.size() + 1);
        if (is_vertex) {
            mesh_.positions.reserve(most);
        } else if (is_face) {
            mesh_.face_offsets.reserve(most + 1);
        }
        for (std::int64_t i = 0; i < element.count; ++i) {
            if (const Status status = read_one(element, i); !status) {
                return status;
            }
            if (attributes_ != nullptr && is_vertex) {
                add_vertex_attributes(element);
            } else if (attributes_ != nullptr && is_face) {
                add_face_attributes(element);
            }
        }
        return {};
    }

    Error element_error(ErrorCode code, const Element& element, std::int64_t id,
                        const std::string& what) const
    {
        return make_error(code,
                          subject_ + " has " + what + " in " + element.name + " " +
                              std::to_string(id) + " (counted from 0)",
                          {{element.name == "vertex" ? "vertex" : "face", id}});
    }

    Status read_one(const Element& element, std::int64_t id)
    {
        numbers_.fill(0);
        labels_.clear();
        texture_list_.clear();
        bool has_corners = false;
        for (const Property& property : element.properties) {
            std::int64_t count = 1;
            if (property.count_type) {
                double number = 0;
                if (!take_scalar(*property.count_type, number)) {
                    return element_error(ErrorCode::syntaxError, element, id, "no list");
                }
                if (!(number >= 0) || number != std::floor(number) || number > kNone) {
                    return element_error(ErrorCode::syntaxError, element, id,
                                         "a list of no possible length");
                }
                count = static_cast<std::int64_t>(number);
                if (property.role == Role::corners && count > kMaxFaceCorners) {
                    return element_error(ErrorCode::faceTooLarge, element, id,
                                         std::to_string(count) + " corners");
                }
            }
            for (std::int64_t i = 0; i < count; ++i) {
                double number = 0;
                if (!take_scalar(property.type, number)) {
                    return element_error(ErrorCode::syntaxError, element, id,
                                         "something that is no number, or the end of the file,");
                }
                switch (property.role) {
                    case Role::x:
                    case Role::y:
                    case Role::z:
                    case Role::u:
                    case Role::v:
                        numbers_[place_of(property.role)] = number;
                        break;
                    case Role::red:
                    case Role::green:
                    case Role::blue:
                    case Role::opacity:
                        numbers_[place_of(property.role)] = number / full_colour(property.type);
                        break;
                    case Role::skipped:
                        break;
                    case Role::texture_list:
                        if (texture_list_.size() < 2 * std::size_t{kMaxFaceCorners}) {
                            texture_list_.push_back(number);
                        }
                        break;
                    case Role::texture_number:
                        texture_number_ = number;
                        break;
                    case Role::label:
                        if (std::abs(number) <= kNone && number == std::floor(number)) {
                            labels_ += (labels_.empty() ? "" : " ") + property.name + "_" +
                                       std::to_string(static_cast<std::int64_t>(number));
                        }
                        break;
                    case Role::corners:
                        if (has_corners) {
                            break;
                        }
                        if (!(number >= 0) || number != std::floor(number) ||
                            number >= static_cast<double>(vertex_count_)) {
                            return element_error(ErrorCode::indexOutOfRange, element, id,
                                                 "a corner that is none of the " +
                                                     std::to_string(vertex_count_) + " vertices");
                        }
                        mesh_.corners.push_back(static_cast<Index>(number));
                        break;
                }
            }
            has_corners = has_corners || property.role == Role::corners;
        }
        if (element.name == "vertex") {
            mesh_.positions.emplace_back(numbers_[0], numbers_[1], numbers_[2]);
        } else if (element.name == "face") {
            if (mesh_.corners.size() >= kNone - kMaxFaceCorners) {
                return element_error(ErrorCode::tooLarge, element, id,
                                     "more corners than 32-bit ids can number");
            }
            mesh_.face_offsets.push_back(static_cast<Index>(mesh_.corners.size()));
        }
        return {};
    }

    void add_vertex_attributes(const Element& element)
    {
        if (element.has_colour()) {
            CornerValues& colours = attributes_->colours;
            colours.size = element.has(Role::opacity) ? 4 : 3;
            colours.add({&numbers_[place_of(Role::red)], colours.size});
        }
        if (element.has_place() && !has_texture_lists()) {
            attributes_->texture_coordinates.size = 2;
            attributes_->texture_coordinates.add({&numbers_[place_of(Role::u)], 2});
        }
    }

    bool has_texture_lists() const
    {
        return std::any_of(elements_.begin(), elements_.end(),
                           [](const Element& e) { return e.has(Role::texture_list); });
    }

    void add_face_attributes(const Element& element)
    {
        if (element.has(Role::texture_list)) {
            CornerValues& places = attributes_->texture_coordinates;
            places.size = 2;
            const std::size_t corners =
                mesh_.corners.size() - mesh_.face_offsets[mesh_.face_offsets.size() - 2];
            for (std::size_t i = 0; i < corners; ++i) {
                places.ids.push_back(texture_list_.empty() ? kNone
                                     : texture_list_.size() < 2 * corners
                                         ? kUnusable
                                         : places.add({&texture_list_[2 * i], 2}));
            }
        }
        if (element.has_colour()) {
            labels_ += (labels_.empty() ? "" : " ") +
                       colour_word({numbers_[place_of(Role::red)], numbers_[place_of(Role::green)],
                                    numbers_[place_of(Role::blue)]});
        }
        groups_.add(labels_);
        const bool numbered = element.has(Role::texture_number);
        const double texture = numbered ? texture_number_ : 0;
        if (texture >= 0 && texture < static_cast<double>(texture_files_.size())) {
            materials_.add(texture_files_[static_cast<std::size_t>(texture)]);
        } else {
            materials_.add(numbered && texture >= 0 && texture <= kNone
                               ? "texture_" + std::to_string(static_cast<std::int64_t>(texture))
                               : "");
        }
    }

    void finish_attributes()
    {
        // Values of vertices have the ids of the vertices.
        if (attributes_->colours.size > 0) {
            attributes_->colours.ids = mesh_.corners;
        }
        CornerValues& places = attributes_->texture_coordinates;
        if (places.size > 0 && !has_texture_lists()) {
            places.ids = mesh_.corners;
        }
        attributes_->groups = groups_.take();
        attributes_->materials = materials_.take();
        finish(*attributes_);
    }

    bool take_scalar(Scalar type, double& number)
    {
        if (is_text_) {
            rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t\r\n"), rest_.size()));
            return parse_number(rest_, number) &&
                   (rest_.empty() ||
                    std::string_view(" \t\r\n").find(rest_.front()) != std::string_view::npos);
        }
        const std::size_t size = size_of(type);
        if (rest_.size() < size) {
            return false;
        }
        switch (type) {
            case Scalar::int8:
                number = value_of_bytes<std::int8_t>(rest_);
                break;
            case Scalar::uint8:
                number = value_of_bytes<std::uint8_t>(rest_);
                break;
            case Scalar::int16:
                number = value_of_bytes<std::int16_t>(rest_, big_endian_);
                break;
            case Scalar::uint16:
                number = value_of_bytes<std::uint16_t>(rest_, big_endian_);
                break;
            case Scalar::int32:
                number = value_of_bytes<std::int32_t>(rest_, big_endian_);
                break;
            case Scalar::uint32:
                number = value_of_bytes<std::uint32_t>(rest_, big_endian_);
                break;
            case Scalar::float32:
                number = static_cast<double>(value_of_bytes<float>(rest_, big_endian_));
                break;
            case Scalar::float64:
                number = value_of_bytes<double>(rest_, big_endian_);
                break;
        }
        rest_.remove_prefix(size);
        return true;
    }

    std::string_view rest_;
    std::string subject_;
    std::int64_t line_number_ = 0;
    bool is_text_ = false;
    bool big_endian_ = false;
    std::vector<Element> elements_;
    std::int64_t vertex_count_ = 0;
    PolygonMesh mesh_;
    MeshAttributes* attributes_;
    std::vector<std::string> texture_files_;
    FaceNaming groups_;
    FaceNaming materials_;
    // Of the vertex or face that was read last:
    std::array<double, kNumberRoles> numbers_{};
    std::vector<double> texture_list_;
    double texture_number_ = -1;
    std::string labels_;
};

}  // namespace

Result<PolygonMesh> read_ply(std::string_view bytes, std::string_view subject,
                             MeshAttributes* attributes)
{
    return PlyReader(bytes, subject, attributes).read();
}

}  // namespace layout_embedding
