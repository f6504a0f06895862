#include "apps/landmark_doubts.hh"

#include <algorithm>
#include <gtest/gtest.h>

#include "apps/embed_job.hh"
#include "base/random.hh"
#include "instances.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

using Kind = LandmarkDoubt::Kind;

struct Input {
    std::string name;
    PolygonMesh layout;
    PolygonMesh target;
    std::vector<Index> landmarks;
};

/// Layouts that fit, more or less.
std::vector<Input> fitting_inputs()
{
    std::vector<Input> inputs;
    std::uint64_t seed = 7;
    for (const auto& target : {zoo::bumpy_sphere(3, 1), zoo::stretched_sphere(3, {1, 0.5, 2})}) {
        for (const auto& layout :
             {zoo::cube(), zoo::icosahedron(), zoo::hull(14, 3), zoo::polygon_hull(16, 4)}) {
            for (const double displacement : {0.0, 0.2}) {
                inputs.push_back({"input " + std::to_string(seed), layout, target,
                                  zoo::displaced_landmarks(layout, target, displacement, seed)});
                ++seed;
            }
        }
    }
    return inputs;
}

PolygonMesh mirrored(const PolygonMesh& mesh)
{
    PolygonMesh result;
    result.positions = mesh.positions;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        std::vector<Index> corners(mesh.corners.begin() + mesh.face_offsets[f],
                                   mesh.corners.begin() + mesh.face_offsets[f + 1]);
        std::reverse(corners.begin(), corners.end());
        result.add_face(corners);
    }
    return result;
}

EmbedResult embedded(const Input& input, Algorithm algorithm = Algorithm::branch_and_bound,
                     std::uint64_t slice = UINT64_MAX)
{
    EmbedOptions options;
    options.algorithm = algorithm;
    options.work_limit = 200000;
    EmbedJob job(test::problem_of(input.layout, input.target, input.landmarks), options);
    while (job.step({std::numeric_limits<double>::infinity(), slice})) {
    }
    return job.result();
}

bool says(const EmbedResult& result, Kind kind)
{
    return std::any_of(result.doubts.begin(), result.doubts.end(),
                       [&](const LandmarkDoubt& doubt) { return doubt.kind == kind; });
}

/// How often a change that makes the embedding far longer was found out.
struct Count {
    int far_longer = 0;
    int said = 0;
};

TEST(LandmarkDoubts, layouts_that_fit_raise_none)
{
    for (const Input& input : fitting_inputs()) {
        const EmbedResult result = embedded(input);
        EXPECT_TRUE(result.refined) << input.name;
        EXPECT_TRUE(result.doubts.empty()) << input.name << ": " << result.doubts[0].message;
    }
}

TEST(LandmarkDoubts, a_mirror_image_that_fits_far_better_is_found)
{
    Count count;
    for (const Input& input : fitting_inputs()) {
        const double cost = embedded(input).cost;
        Input changed = input;
        changed.layout = mirrored(input.layout);
        const EmbedResult result = embedded(changed);
        if (cost <= LandmarkDoubts::kFarShorter * result.cost) {
            ++count.far_longer;
            count.said += says(result, Kind::mirrored) ? 1 : 0;
        }
        for (const LandmarkDoubt& doubt : result.doubts) {
            // What is said is a fact: an embedding of this cost exists.
            EXPECT_LE(doubt.cost, LandmarkDoubts::kFarShorter * result.cost);
            EXPECT_GE(doubt.cost, result.lower_bound * (1 - 1e-9) * (doubt.a == kNone ? 0 : 1));
            EXPECT_NE(doubt.message.find(doubt.a == kNone ? "mirror image" : "exchanged"),
                      std::string::npos);
        }
    }
    EXPECT_GE(count.far_longer, 8);
    EXPECT_EQ(count.said, count.far_longer);
}

TEST(LandmarkDoubts, an_exchange_that_fits_far_better_is_found)
{
    Count count;
    int same_pair = 0;
    Random random(5);
    for (const Input& input : fitting_inputs()) {
        const double cost = embedded(input).cost;
        Input changed = input;
        const auto n = static_cast<Index>(input.landmarks.size());
        const auto a = static_cast<Index>(random.below(n));
        const auto b = static_cast<Index>((a + 1 + random.below(n - 1)) % n);
        std::swap(changed.landmarks[a], changed.landmarks[b]);
        const EmbedResult result = embedded(changed);
        if (cost <= LandmarkDoubts::kFarShorter * result.cost) {
            ++count.far_longer;
            if (says(result, Kind::exchanged)) {
                ++count.said;
                const LandmarkDoubt& doubt = result.doubts.back();
                same_pair += std::minmax(a, b) == std::minmax(doubt.a, doubt.b) ? 1 : 0;
            }
        }
    }
    EXPECT_GE(count.far_longer, 8);
    // Another change may be as good, or better.
    EXPECT_GE(10 * count.said, 9 * count.far_longer);
    EXPECT_GE(10 * same_pair, 9 * count.said);
}

TEST(LandmarkDoubts, do_not_depend_on_slices_and_follow_no_heuristic)
{
    Input input = fitting_inputs()[2];
    std::swap(input.landmarks[0], input.landmarks[7]);
    const EmbedResult whole = embedded(input);
    const EmbedResult sliced = embedded(input, Algorithm::branch_and_bound, 500);
    ASSERT_EQ(whole.doubts.size(), sliced.doubts.size());
    for (std::size_t i = 0; i < whole.doubts.size(); ++i) {
        EXPECT_EQ(whole.doubts[i].message, sliced.doubts[i].message);
        EXPECT_EQ(whole.doubts[i].cost, sliced.doubts[i].cost);
    }
    EXPECT_TRUE(embedded(input, Algorithm::praun).doubts.empty());
}

TEST(LandmarkDoubts, a_disk_inside_out_is_told_apart_from_one_that_cannot_be_embedded)
{
    // All landmarks on the boundary: their order there is the wrong way round.
    const PolygonMesh target = zoo::grid_disk(8, 8);
    const Input input{"disk", zoo::polygon(4), target, {0, 72, 80, 8}};
    EXPECT_TRUE(embedded(input).refined);
    Input changed = input;
    changed.layout = mirrored(input.layout);
    const EmbedResult result = embedded(changed);
    EXPECT_FALSE(result.refined);
    EXPECT_TRUE(says(result, Kind::mirrored));
}

}  // namespace
}  // namespace layout_embedding
