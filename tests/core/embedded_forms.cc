#include "embedded_forms.hh"

#include <gtest/gtest.h>
#include <memory>
#include <stdexcept>
#include <utility>

#include "base/random.hh"
#include "embedding/angle_refinement.hh"
#include "embedding/angle_widening.hh"
#include "embedding/check_input.hh"
#include "embedding/realisation.hh"
#include "embedding/triangle_quality.hh"
#include "embedding/weak_to_normal_form.hh"
#include "embedding_checks.hh"
#include "patches/fairing.hh"
#include "search_ground.hh"
#include "zoo.hh"

namespace layout_embedding::test {

const std::vector<EmbeddedInstance>& all_embedded_instances()
{
    static const std::vector<EmbeddedInstance> instances = embedded_instances(1);
    return instances;
}

EmbeddedInstance embedded(const std::string& name, const PolygonMesh& layout,
                          const PolygonMesh& target, std::vector<Index> landmarks,
                          std::uint64_t seed)
{
    EmbeddingProblem problem = problem_of(layout, target, std::move(landmarks));
    PathGraph graph = PathGraph::barycentric(*problem.target, {seed, 0});
    for (std::uint64_t attempt = 0; attempt < 50; ++attempt) {
        Random random(seed + attempt);
        if (auto weak = insert_in_random_order(problem, graph, random)) {
            return {name, std::move(problem), std::move(graph), std::move(*weak)};
        }
    }
    throw std::runtime_error(name + ": insertion ends in a dead end 50 times");
}

EmbeddedInstance forty_strands_around_a_neck(int rings, bool upside_down)
{
    constexpr Index kSides = 40;
    std::vector<Index> landmarks;
    for (Index i = 0; i < kSides; ++i) {
        landmarks.push_back(2 + (upside_down ? 0 : kSides) + i);
    }
    for (Index i = 0; i < kSides; ++i) {
        landmarks.push_back(2 + (upside_down ? kSides : 0) + (i + kSides / 7) % kSides);
    }
    return embedded("neck of " + std::to_string(rings) + " rings", zoo::prism(kSides),
                    zoo::hourglass(kSides, rings), std::move(landmarks), 3);
}

EmbeddedInstance scaled(const EmbeddedInstance& instance, double scale)
{
    PolygonMesh mesh = to_polygons(*instance.problem.target);
    for (Vec3& p : mesh.positions) {
        p = scale * p;
    }
    EmbeddedInstance other = instance;
    other.problem.target = std::make_shared<TriangleMesh>(mesh);
    return other;
}

NormalForm even_form(const EmbeddedInstance& instance)
{
    auto form = normal_form_of(instance.problem, instance.graph, instance.weak);
    EXPECT_TRUE(form.ok()) << form.error().message;
    return std::move(*form);
}

NormalForm straight_form(const EmbeddedInstance& instance, const StraighteningOptions& options)
{
    Straightening straightening(even_form(instance), instance.problem.landmarks, options);
    while (straightening.step()) {
    }
    return straightening.take();
}

NormalForm fair_form(const EmbeddedInstance& instance, NormalForm straight)
{
    Fairing fairing(*instance.problem.layout, std::move(straight));
    while (fairing.step()) {
    }
    return fairing.take();
}

RefinedMesh cut(const EmbeddedInstance& instance, const NormalForm& form)
{
    auto refined = cut_along(*instance.problem.layout, form);
    EXPECT_TRUE(refined.ok()) << refined.error().message;
    return refined.ok() ? std::move(*refined) : RefinedMesh{};
}

void expect_valid(const EmbeddedInstance& instance, const NormalForm& form)
{
    expect_valid(instance.problem, instance.graph, instance.weak, cut(instance, form));
}

void expect_valid_in_every_shape(const EmbeddedInstance& instance)
{
    SCOPED_TRACE(instance.name);
    const std::vector<Index>& landmarks = instance.problem.landmarks;
    const double spacing = StraighteningOptions{}.spacing;
    const auto expect_sound = [&](const NormalForm& form, const char* shape) {
        SCOPED_TRACE(shape);
        RefinedMesh refined = cut(instance, form);
        refine_thin_triangles(*instance.problem.target, refined);
        expect_valid(instance.problem, instance.graph, instance.weak, refined);
        EXPECT_GT(triangle_quality(refined.positions, refined.corners).smallest_area, 0);
    };
    NormalForm even = even_form(instance);
    const double length = even.total_length();
    open_angles(even, landmarks, spacing);
    expect_sound(even, "even");
    NormalForm straight = straight_form(instance);
    EXPECT_LE(straight.total_length(), length);
    expect_sound(straight, "short");
    NormalForm fair = fair_form(instance, std::move(straight));
    open_angles(fair, landmarks, spacing);
    expect_sound(fair, "fair");
}

}  // namespace layout_embedding::test
