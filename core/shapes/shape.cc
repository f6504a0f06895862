#include "shapes/shape.hh"

#include <algorithm>
#include <cmath>

#include "base/random.hh"
#include "mesh/triangle_mesh.hh"
#include "mesh/validation.hh"
#include "shapes/classes/classes.hh"
#include "shapes/extraction.hh"
#include "shapes/surface_noise.hh"

namespace layout_embedding::shapes {

namespace {

std::uint64_t seed_of(const ShapeClass& shape_class, Index member, std::uint64_t seed)
{
    std::uint64_t hash = Random::mix(seed + 1);
    for (const char letter : shape_class.name) {
        hash = Random::mix(hash + static_cast<unsigned char>(letter));
    }
    return Random::mix(hash + member);
}

Error defect(const std::string& subject, const std::string& what)
{
    return make_error(ErrorCode::internal, subject + " " + what);
}

/// What differs from member to member besides the figure.
struct Finish {
    RemeshOptions remesh;
    /// Amplitude of the noise as a part of the shortest edge at a vertex.
    double noise;
};

Finish finish_of(const ShapeClass& shape_class, Index member, const ShapeOptions& options)
{
    // The looks of a collection come from many sources: clean and rough ones take turns.
    static constexpr double kIrregularities[] = {0.35, 0.6, 0.1, 0.8, 0.45, 1.0, 0.55, 0.2};
    static constexpr double kNoises[] = {0.0, 0.07, 0.0, 0.12, 0.04, 0.0, 0.14, 0.06};
    Random random(seed_of(shape_class, member, options.seed));
    Finish finish;
    finish.remesh.vertices =
        options.vertices != 0 ? options.vertices : default_vertex_count(shape_class, member);
    finish.remesh.adaptivity = 0.45 + 0.4 * random.unit();
    finish.remesh.irregularity = kIrregularities[member % 8];
    finish.remesh.seed = random.bits();
    finish.noise = kNoises[(member + shape_class.name.size()) % 8];
    return finish;
}

}  // namespace

Index default_vertex_count(const ShapeClass& shape_class, Index member)
{
    static constexpr Index kCounts[] = {6000, 3000, 10000, 4500, 2000, 16000, 8000, 2500};
    // One large mesh per class.
    return member == shape_class.name.size() % 8 ? 50000 : kCounts[member % 8];
}

const std::vector<ShapeClass>& shape_classes()
{
    static const std::vector<ShapeClass> kClasses = all_classes();
    return kClasses;
}

const ShapeClass* find_shape_class(const std::string& name)
{
    for (const ShapeClass& shape_class : shape_classes()) {
        if (shape_class.name == name) {
            return &shape_class;
        }
    }
    return nullptr;
}

Result<Shape> make_shape(const ShapeClass& shape_class, Index member, const ShapeOptions& options)
{
    const std::string subject = "member " + std::to_string(member) + " of " + shape_class.name;
    if (member >= shape_class.member_count()) {
        return make_error(ErrorCode::invalidOption, subject + " does not exist: there are " +
                                                        std::to_string(shape_class.member_count()));
    }
    if (options.vertices != 0 && (options.vertices < 500 || options.vertices > 200000)) {
        return make_error(ErrorCode::invalidOption, "a shape has 500 to 200000 vertices, not " +
                                                        std::to_string(options.vertices));
    }
    const Figure figure = shape_class.build(member);
    const double size = figure.solid.size();
    Finish finish = finish_of(shape_class, member, options);
    const double cell = figure.detail > 0.0 ? figure.detail : size / 100.0;
    finish.remesh.cell = cell;

    std::vector<Anchor> anchors;
    Shape shape;
    for (const LandmarkRay& ray : figure.landmarks) {
        const auto point = figure.solid.exit(ray.inside, ray.direction, size, 0.5 * cell);
        if (!point) {
            return defect(subject, "has a landmark, " + ray.name + ", that misses its surface");
        }
        anchors.push_back({*point, ray.on_boundary});
        shape.landmark_names.push_back(ray.name);
    }
    RawSurface raw = extract_surface(figure.solid, anchors.front().position, cell);
    if (figure.cut) {
        raw = clip_surface(raw, figure.cut->origin, figure.cut->normal, cell);
    }
    if (raw.corners.empty()) {
        return defect(subject, "has no surface at its first landmark");
    }
    Remeshed remeshed = remesh(figure.solid, raw, figure.cut, anchors, finish.remesh);
    shape.landmarks = std::move(remeshed.anchors);
    shape.mesh = remeshed.mesh.polygon_mesh();
    add_surface_noise(shape.mesh, finish.noise, finish.remesh.seed);

    if (const Status valid = check_surface(shape.mesh, SurfaceKind::target, subject); !valid) {
        return valid.error();
    }
    const TriangleMesh mesh(shape.mesh);
    if (mesh.euler_characteristic() != shape_class.euler_characteristic() ||
        static_cast<int>(mesh.boundary_loop_count()) != shape_class.boundary_loops) {
        return defect(subject, "has Euler characteristic " +
                                   std::to_string(mesh.euler_characteristic()) + " and " +
                                   std::to_string(mesh.boundary_loop_count()) +
                                   " boundary loops, which is not what its class has");
    }
    return shape;
}

}  // namespace layout_embedding::shapes
