#include "problem_files.hh"

#include <ctime>
#include <fstream>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include "layout/landmark_reader.hh"
#include "layout/proximity.hh"
#include "mesh/mesh_reader.hh"
#include "mesh/validation.hh"

namespace layout_embedding {

namespace {

Result<std::string> bytes_of(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    if (!file) {
        return make_error(ErrorCode::invalidOption, path + " cannot be read");
    }
    return std::string{std::istreambuf_iterator<char>(file), {}};
}

Result<PolygonMesh> read_file(const std::string& path)
{
    const auto bytes = bytes_of(path);
    if (!bytes) {
        return bytes.error();
    }
    return read_mesh(*bytes, format_of_file_name(path), path);
}

Result<std::vector<Index>> read_landmark_file(const std::string& path)
{
    const auto bytes = bytes_of(path);
    if (!bytes) {
        return bytes.error();
    }
    auto landmarks = read_landmarks(*bytes, path);
    if (!landmarks) {
        return landmarks.error();
    }
    return std::move(landmarks->vertices);
}

}  // namespace

Result<EmbeddingProblem> load_problem(const std::string& layout_file,
                                      const std::string& target_file, const std::string& landmarks)
{
    auto layout_mesh = read_file(layout_file);
    if (!layout_mesh) {
        return layout_mesh.error();
    }
    auto target_mesh = read_file(target_file);
    if (!target_mesh) {
        return target_mesh.error();
    }
    auto layout = Layout::from_polygons(*layout_mesh, layout_file);
    if (!layout) {
        return layout.error();
    }
    if (Status usable = check_surface(*target_mesh, SurfaceKind::target, target_file); !usable) {
        return usable.error();
    }
    auto target = std::make_shared<TriangleMesh>(*target_mesh);
    auto vertices = landmarks == "proximity"
                        ? landmarks_by_proximity(*layout, layout_mesh->positions, *target)
                        : read_landmark_file(landmarks);
    if (!vertices) {
        return vertices.error();
    }
    return make_problem(std::make_shared<Layout>(std::move(*layout)), std::move(target),
                        std::move(*vertices));
}

double cpu_seconds()
{
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace layout_embedding
