#include <gtest/gtest.h>

#include "embedding/angle_refinement.hh"
#include "embedding/angle_widening.hh"
#include "embedding/realisation.hh"
#include "embedding/straightening.hh"
#include "embedding/weak_to_normal_form.hh"
#include "embedding_checks.hh"
#include "instances.hh"
#include "patches/fairing.hh"

// What a job does once its search is over, over the whole zoo.

namespace layout_embedding {
namespace {

/// Crossings with target edges beyond which an instance is left to the tests of single shapes.
constexpr Index kMostElements = 3000;

void expect_valid(const test::EmbeddedInstance& instance, const NormalForm& form)
{
    auto refined = cut_along(*instance.problem.layout, form);
    ASSERT_TRUE(refined.ok()) << refined.error().message;
    refine_thin_triangles(*instance.problem.target, *refined);
    test::expect_valid(instance.problem, instance.graph, instance.weak, *refined);
}

TEST(AllShapes, a_thousand_random_instances_pass_the_checker_in_each)
{
    int count = 0;
    for (std::uint64_t seed = 1; count < 1000; ++seed) {
        ASSERT_LT(seed, 20U);
        for (const test::EmbeddedInstance& instance : test::embedded_instances(seed)) {
            SCOPED_TRACE(instance.name + ", seed " + std::to_string(seed));
            auto form = normal_form_of(instance.problem, instance.graph, instance.weak);
            ASSERT_TRUE(form.ok()) << form.error().message;
            if (form->element_count() > kMostElements) {
                continue;
            }
            ++count;
            const double length = form->total_length();
            NormalForm even = *form;
            open_angles(even, instance.problem.landmarks, 0.25);
            expect_valid(instance, even);
            Straightening straightening(std::move(*form), instance.problem.landmarks);
            while (straightening.step()) {
            }
            NormalForm straight = straightening.take();
            EXPECT_LE(straight.total_length(), length);
            expect_valid(instance, straight);
            Fairing fairing(*instance.problem.layout, std::move(straight));
            while (fairing.step()) {
            }
            NormalForm fair = fairing.take();
            open_angles(fair, instance.problem.landmarks, 0.25);
            expect_valid(instance, fair);
        }
    }
    RecordProperty("instances", count);
}

}  // namespace
}  // namespace layout_embedding
