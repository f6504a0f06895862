#include <gtest/gtest.h>

#include "embedded_forms.hh"

// What a job does once its search is over, over the whole zoo.

namespace layout_embedding {
namespace {

/// Crossings with target edges beyond which an instance is left to the tests of single shapes.
constexpr Index kMostElements = 3000;

TEST(AllShapes, a_thousand_random_instances_pass_the_checker_in_each)
{
    int count = 0;
    for (std::uint64_t seed = 1; count < 1000; ++seed) {
        ASSERT_LT(seed, 20U);
        SCOPED_TRACE("seed " + std::to_string(seed));
        for (const test::EmbeddedInstance& instance : test::embedded_instances(seed)) {
            if (test::even_form(instance).element_count() <= kMostElements) {
                ++count;
                test::expect_valid_in_every_shape(instance);
            }
        }
    }
    RecordProperty("instances", count);
}

}  // namespace
}  // namespace layout_embedding
