// The shape collection as files; see kUsage. For tests, benchmarks and the page's gallery.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "mesh/mesh_reader.hh"
#include "mesh/mesh_writer.hh"
#include "mesh/triangle_mesh.hh"
#include "mesh/validation.hh"
#include "shapes/collection_check.hh"
#include "shapes/map_check.hh"
#include "shapes/shape.hh"
#include "shapes/statistics.hh"

namespace layout_embedding::shapes {
namespace {

constexpr const char* kUsage =
    "generate_shapes --list\n"
    "    prints classes and members\n"
    "generate_shapes --class NAME [--member N] --output DIR [--vertices N] [--seed N]\n"
    "generate_shapes --all [--member N] --output DIR [--vertices N] [--seed N]\n"
    "    writes, for each class, DIR/CLASS/landmarks.json (names of the landmarks in order) and,\n"
    "    for each member, DIR/CLASS/MEMBER.obj and MEMBER.txt (0-based vertex ids of the\n"
    "    landmarks, one per line), and DIR/index.json about all that was written; --member may be\n"
    "    given more than once\n"
    "    --digits N  rounds coordinates to N decimals (smaller files)\n"
    "generate_shapes --statistics [--class NAME] [--vertices N] [FILE...]\n"
    "    prints edge lengths, angles and valences of members, and of mesh files beside them\n"
    "generate_shapes --check [--class NAME] [--others N] [--doubts] [--vertices N] [--seed N]\n"
    "    embeds the template layout of every member in the next N members of its class (all), by\n"
    "    the exact method and by the heuristics; with --doubts, also the template's mirror image\n"
    "    and with two landmarks exchanged, and counts what is said of these. 2000 vertices each\n"
    "    unless told otherwise. Takes about 20 minutes for\n"
    "    everything, without --doubts\n"
    "generate_shapes --check --maps [--class NAME] [--member N] [--others N] [--vertices N]\n"
    "    embeds the quad template of member N (0) of each class in it and in others, makes quad\n"
    "    meshes of the same connectivity, and maps it onto the others; with --quads instead of\n"
    "    --maps, without maps\n";

struct Arguments {
    bool list = false;
    bool all = false;
    bool statistics = false;
    bool check = false;
    bool quads = false;
    CollectionCheckOptions check_options;
    std::string class_name;
    /// Empty for all.
    std::vector<Index> members;
    std::string output;
    int digits = -1;
    ShapeOptions options;
    std::vector<std::string> files;
};

int fail(const std::string& message)
{
    std::fprintf(stderr, "%s\n", message.c_str());
    return 2;
}

/// False, with a message, if the arguments make no sense.
bool parse(int count, char** words, Arguments& arguments)
{
    for (int i = 1; i < count; ++i) {
        const std::string word = words[i];
        const auto number = [&](std::uint64_t& value) {
            char* end = nullptr;
            const bool present = i + 1 < count && words[i + 1][0] >= '0' && words[i + 1][0] <= '9';
            value = present ? std::strtoull(words[++i], &end, 10) : 0;
            if (!present || *end != '\0') {
                fail(word + " needs a number");
                return false;
            }
            return true;
        };
        const auto text = [&](std::string& value) {
            if (i + 1 == count) {
                fail(word + " needs a value");
                return false;
            }
            value = words[++i];
            return true;
        };
        std::uint64_t value = 0;
        if (word == "--list") {
            arguments.list = true;
        } else if (word == "--all") {
            arguments.all = true;
        } else if (word == "--statistics") {
            arguments.statistics = true;
        } else if (word == "--check") {
            arguments.check = true;
        } else if (word == "--maps") {
            arguments.quads = arguments.check_options.maps = true;
        } else if (word == "--quads") {
            arguments.quads = true;
        } else if (word == "--doubts") {
            arguments.check_options.doubts = true;
        } else if (word == "--class") {
            if (!text(arguments.class_name)) {
                return false;
            }
        } else if (word == "--output") {
            if (!text(arguments.output)) {
                return false;
            }
        } else if (word == "--member" || word == "--vertices" || word == "--digits" ||
                   word == "--seed" || word == "--others") {
            if (!number(value)) {
                return false;
            }
            if (word == "--member") {
                arguments.members.push_back(static_cast<Index>(value));
            } else if (word == "--vertices") {
                arguments.options.vertices = static_cast<Index>(value);
            } else if (word == "--others") {
                arguments.check_options.others = static_cast<Index>(value);
            } else if (word == "--digits") {
                arguments.digits = static_cast<int>(value);
            } else {
                arguments.options.seed = value;
            }
        } else if (word.starts_with("--")) {
            fail("unknown option " + word);
            return false;
        } else {
            arguments.files.push_back(word);
        }
    }
    return true;
}

std::string quoted(const std::string& text)
{
    return '"' + text + '"';
}

bool write_file(const std::filesystem::path& path, const std::string& content)
{
    std::ofstream file(path, std::ios::binary);
    file << content;
    return static_cast<bool>(file.flush());
}

void round_positions(PolygonMesh& mesh, int digits)
{
    double scale = 1.0;
    for (int i = 0; i < digits; ++i) {
        scale *= 10.0;
    }
    for (Vec3& p : mesh.positions) {
        for (double& x : p) {
            x = std::round(x * scale) / scale;
        }
    }
}

std::string landmarks_json(const ShapeClass& shape_class, const Shape& shape)
{
    std::string json = "{\n    \"class\": " + quoted(shape_class.name) +
                       ",\n    \"title\": " + quoted(shape_class.title) +
                       ",\n    \"genus\": " + std::to_string(shape_class.genus) +
                       ",\n    \"boundaryLoops\": " + std::to_string(shape_class.boundary_loops) +
                       ",\n    \"landmarks\": [";
    for (std::size_t i = 0; i < shape.landmark_names.size(); ++i) {
        json += (i == 0 ? "\n        " : ",\n        ") + quoted(shape.landmark_names[i]);
    }
    return json + "\n    ]\n}\n";
}

int print_list()
{
    for (const ShapeClass& shape_class : shape_classes()) {
        std::printf("%s (%s, genus %d, %d boundary loops)\n", shape_class.name.c_str(),
                    shape_class.title.c_str(), shape_class.genus, shape_class.boundary_loops);
        for (Index m = 0; m < shape_class.member_count(); ++m) {
            std::printf("  %2u %-16s %u vertices\n", m, shape_class.members[m].c_str(),
                        default_vertex_count(shape_class, m));
        }
    }
    return 0;
}

/// The classes that are asked for.
std::vector<const ShapeClass*> chosen(const Arguments& arguments)
{
    std::vector<const ShapeClass*> classes;
    for (const ShapeClass& shape_class : shape_classes()) {
        if (arguments.class_name.empty() || arguments.class_name == shape_class.name) {
            classes.push_back(&shape_class);
        }
    }
    return classes;
}

bool wants_member(const Arguments& arguments, Index member)
{
    const auto& members = arguments.members;
    return members.empty() || std::find(members.begin(), members.end(), member) != members.end();
}

int print_statistics(const Arguments& arguments)
{
    std::printf("%s", statistics_head().c_str());
    for (const std::string& file : arguments.files) {
        std::ifstream stream(file, std::ios::binary);
        const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
        const auto mesh = read_mesh(bytes, format_of_file_name(file), file);
        if (!mesh) {
            return fail(mesh.error().message);
        }
        if (const Status valid = check_surface(*mesh, SurfaceKind::target, file); !valid) {
            return fail(valid.error().message);
        }
        const std::string name = std::filesystem::path(file).filename().string();
        std::printf("%s", statistics_line(name, TriangleMesh(*mesh)).c_str());
    }
    for (const ShapeClass* shape_class : chosen(arguments)) {
        for (Index m = 0; m < shape_class->member_count(); ++m) {
            if (!wants_member(arguments, m)) {
                continue;
            }
            const auto shape = make_shape(*shape_class, m, arguments.options);
            if (!shape) {
                return fail(shape.error().message);
            }
            const std::string name = shape_class->name + "/" + shape_class->members[m];
            std::printf("%s", statistics_line(name, TriangleMesh(shape->mesh)).c_str());
        }
    }
    return 0;
}

int write_shapes(const Arguments& arguments)
{
    const std::filesystem::path folder = arguments.output;
    std::string index;
    for (const ShapeClass* shape_class : chosen(arguments)) {
        std::error_code error;
        std::filesystem::create_directories(folder / shape_class->name, error);
        std::string members;
        for (Index m = 0; m < shape_class->member_count(); ++m) {
            if (!wants_member(arguments, m)) {
                continue;
            }
            auto shape = make_shape(*shape_class, m, arguments.options);
            if (!shape) {
                return fail(shape.error().message);
            }
            if (arguments.digits >= 0) {
                round_positions(shape->mesh, arguments.digits);
                const Status valid = check_surface(shape->mesh, SurfaceKind::target, "the result");
                if (!valid) {
                    return fail(valid.error().message);
                }
            }
            std::string ids;
            for (const Index landmark : shape->landmarks) {
                ids += std::to_string(landmark) + "\n";
            }
            const std::string name = shape_class->name + "/" + shape_class->members[m];
            if (!write_file(folder / (name + ".obj"), write_obj(shape->mesh)) ||
                !write_file(folder / (name + ".txt"), ids) ||
                !write_file(folder / shape_class->name / "landmarks.json",
                            landmarks_json(*shape_class, *shape))) {
                return fail("cannot write " + (folder / name).string());
            }
            std::printf("%s: %u vertices\n", name.c_str(), shape->mesh.vertex_count());
            members += std::string(members.empty() ? "" : ",") +
                       "\n                { \"name\": " + quoted(shape_class->members[m]) +
                       ", \"vertices\": " + std::to_string(shape->mesh.vertex_count()) +
                       ", \"mesh\": " + quoted(name + ".obj") +
                       ", \"landmarks\": " + quoted(name + ".txt") + " }";
        }
        if (members.empty()) {
            return fail("there is no such member of " + shape_class->name);
        }
        index +=
            std::string(index.empty() ? "" : ",") +
            "\n        {\n            \"name\": " + quoted(shape_class->name) +
            ",\n            \"title\": " + quoted(shape_class->title) +
            ",\n            \"genus\": " + std::to_string(shape_class->genus) +
            ",\n            \"boundaryLoops\": " + std::to_string(shape_class->boundary_loops) +
            ",\n            \"landmarkNames\": " + quoted(shape_class->name + "/landmarks.json") +
            ",\n            \"members\": [" + members + "\n            ]\n        }";
    }
    if (!write_file(folder / "index.json", "{\n    \"classes\": [" + index + "\n    ]\n}\n")) {
        return fail("cannot write " + (folder / "index.json").string());
    }
    return 0;
}

int run(int count, char** words)
{
    Arguments arguments;
    if (!parse(count, words, arguments)) {
        return 2;
    }
    if (arguments.list) {
        return print_list();
    }
    if (!arguments.class_name.empty() && find_shape_class(arguments.class_name) == nullptr) {
        return fail("there is no class " + arguments.class_name + "; --list names them");
    }
    if (arguments.statistics) {
        return print_statistics(arguments);
    }
    if (arguments.check) {
        CollectionCheckOptions& options = arguments.check_options;
        options.seed = arguments.options.seed;
        if (arguments.options.vertices != 0) {
            options.vertices = arguments.options.vertices;
        }
        if (arguments.quads) {
            const bool all =
                check_maps_of_collection(chosen(arguments), arguments.members, options);
            return all ? 0 : 1;
        }
        return check_collection(chosen(arguments), options) ? 0 : 1;
    }
    if (arguments.output.empty() || arguments.all != arguments.class_name.empty() ||
        !arguments.files.empty()) {
        return fail(kUsage);
    }
    return write_shapes(arguments);
}

}  // namespace
}  // namespace layout_embedding::shapes

int main(int count, char** words)
{
    return layout_embedding::shapes::run(count, words);
}
