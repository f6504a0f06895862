#include "instances.hh"

#include <memory>
#include <utility>

#include "base/random.hh"
#include "random_draws.hh"
#include "search_ground.hh"
#include "zoo.hh"

namespace layout_embedding::test {

namespace {

/// Targets beyond this are left out: many instances are kept at a time.
constexpr Index kMostFaces = 1300;

class Collector {
public:
    explicit Collector(std::uint64_t seed) : random_(seed) {}

    void add(const std::string& name, EmbeddingProblem problem)
    {
        PathGraph graph = PathGraph::barycentric(*problem.target, {random_.bits(), 0});
        if (auto weak = insert_in_random_order(problem, graph, random_)) {
            instances_.push_back({name, std::move(problem), std::move(graph), std::move(*weak)});
        }
    }

    /// Nothing if the target cannot hold the layout.
    void add(const std::string& name, const PolygonMesh& layout, const PolygonMesh& target,
             std::vector<Index> landmarks)
    {
        auto problem = make_problem(
            std::make_shared<Layout>(Layout::from_polygons(layout, "the layout").value()),
            std::make_shared<TriangleMesh>(target), std::move(landmarks));
        if (problem.ok()) {
            add(name, std::move(*problem));
        }
    }

    std::uint64_t seed() { return random_.bits(); }
    std::vector<EmbeddedInstance> take() { return std::move(instances_); }

private:
    Random random_;
    std::vector<EmbeddedInstance> instances_;
};

}  // namespace

EmbeddingProblem problem_of(const PolygonMesh& layout, const PolygonMesh& target,
                            std::vector<Index> landmarks)
{
    return make_problem(
               std::make_shared<const Layout>(Layout::from_polygons(layout, "the layout").value()),
               std::make_shared<const TriangleMesh>(target), std::move(landmarks))
        .value();
}

std::vector<Instance> random_instances(std::uint64_t seed, int count)
{
    Random random(seed);
    std::vector<Instance> instances;
    for (int i = 0; i < count; ++i) {
        PolygonMesh layout;
        std::string name;
        switch (i % 3) {
            case 0:
                layout = zoo::cube();
                name = "cube";
                break;
            case 1:
                layout = zoo::prism(3);
                name = "prism";
                break;
            default: {
                const int vertices = 4 + static_cast<int>(random.below(9));
                layout = zoo::random_triangulation(vertices, random.bits());
                name = "triangulation" + std::to_string(vertices);
            }
        }
        PolygonMesh target;
        if (i % 2 == 0) {
            const int vertices = 14 + static_cast<int>(random.below(60));
            target = zoo::random_triangulation(vertices, random.bits());
            name += " in random" + std::to_string(vertices);
        } else {
            const int levels = 1 + static_cast<int>(random.below(3));
            target = zoo::crumpled_sphere(levels, random.bits());
            name += " in crumpled" + std::to_string(target.vertex_count());
        }
        const auto landmarks = zoo::random_landmarks(target, layout.vertex_count(), random.bits());
        instances.push_back(
            {name + " #" + std::to_string(i), problem_of(layout, target, landmarks)});
    }
    return instances;
}

std::vector<Instance> tiny_instances(std::uint64_t seed, int count)
{
    Random random(seed);
    std::vector<Instance> instances;
    for (int i = 0; i < count; ++i) {
        const auto [name, layout] = i % 4 == 0    ? std::pair("pyramid", zoo::pyramid(4))
                                    : i % 64 == 1 ? std::pair("prism", zoo::prism(3))
                                                  : std::pair("tetrahedron", zoo::tetrahedron());
        const int vertices = 12 + static_cast<int>(random.below(20));
        const PolygonMesh target = zoo::random_triangulation(vertices, random.bits());
        const auto landmarks = zoo::random_landmarks(target, layout.vertex_count(), random.bits());
        instances.push_back(
            {name + std::string(" #") + std::to_string(i), problem_of(layout, target, landmarks)});
    }
    return instances;
}

Instance smallest_counterexample()
{
    const PolygonMesh layout = zoo::polygon_mesh(std::vector<Vec3>(6, Vec3::Zero()),
                                                 {{4, 1, 0, 2, 5, 3}, {0, 1, 4, 3}, {2, 0, 3, 5}});
    const PolygonMesh target = zoo::polygon_mesh(
        {{0, 1, 0},
         {-0.484, 0.865, 0.131},
         {-0.082, 0.913, -0.4},
         {-0.865, 0.131, -0.484},
         {-0.703, 0.711, 0},
         {-0.082, -0.913, -0.4},
         {-0.602, -0.372, 0.707},
         {-0.564, -0.513, 0.647},
         {-0.602, -0.372, -0.707},
         {-0.783, -0.346, -0.516},
         {-0.758, -0.468, -0.454},
         {-0.564, -0.513, -0.647}},
        {{0, 1, 8}, {1, 0, 2},  {1, 2, 8},  {8, 4, 0},  {0, 4, 5},  {8, 5, 4},   {0, 6, 2},
         {0, 7, 6}, {6, 7, 2},  {0, 5, 7},  {7, 5, 2},  {3, 8, 11}, {11, 10, 9}, {8, 9, 10},
         {8, 3, 9}, {11, 9, 3}, {8, 10, 5}, {5, 11, 2}, {2, 11, 8}, {10, 11, 5}});
    return {"smallest counterexample", problem_of(layout, target, {1, 4, 10, 3, 5, 0})};
}

std::vector<EmbeddedInstance> embedded_instances(std::uint64_t seed)
{
    Collector collector(seed);
    for (const auto& [target_name, target] : zoo::targets()) {
        if (target.face_count() > kMostFaces) {
            continue;
        }
        for (const auto& [layout_name, layout] : zoo::layouts()) {
            const std::string name = layout_name + " on " + target_name;
            collector.add(name + ", random", layout, target,
                          zoo::random_landmarks(target, layout.vertex_count(), collector.seed()));
            collector.add(name + ", displaced", layout, target,
                          zoo::displaced_landmarks(layout, target, 0.5, collector.seed()));
        }
    }
    // Corners and side midpoints of a square, and its middle: vertices (x, y) of a 6 by 6 grid.
    for (int i = 0; i < 5; ++i) {
        collector.add("quad grid on grid disk, boundary landmarks", zoo::quad_grid(2, 2),
                      zoo::grid_disk(6, 6), {0, 3, 6, 21, 24, 27, 42, 45, 48});
    }
    for (auto& [name, problem] : random_instances(seed, 30)) {
        collector.add(name, std::move(problem));
    }
    return collector.take();
}

}  // namespace layout_embedding::test
