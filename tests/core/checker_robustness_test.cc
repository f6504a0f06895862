#include <gtest/gtest.h>
#include <limits>
#include <map>

#include "checker_examples.hh"
#include "embedding/checker.hh"
#include "zoo.hh"

namespace layout_embedding {
namespace {

TEST(Checker, lists_at_most_ten_violations_of_a_kind)
{
    ClaimedEmbedding e = embed_in_itself(zoo::icosahedron(), 2, true);
    for (Vec3& p : e.refined.positions) {
        p *= 2;
    }
    std::map<std::string, std::size_t> counts;
    for (const Violation& violation : e.check().violations) {
        ++counts[violation.code];
    }
    EXPECT_EQ(counts,
              (std::map<std::string, std::size_t>{{"inputVertexMoved", kMaxViolationsPerCode},
                                                  {"vertexMisplaced", kMaxViolationsPerCode}}));
}

TEST(Checker, refuses_every_single_wrong_id)
{
    Random random(7);
    for (const Example& example : examples()) {
        for (int trial = 0; trial < 40; ++trial) {
            ClaimedEmbedding e = example.embedding;
            const auto spoil = [&](std::vector<Index>& ids) {
                Index& id = ids[random.below(ids.size())];
                const Index before = id;
                const std::uint64_t kind = random.below(8);
                id = kind == 0 ? kNone : kind == 1 ? 1U << 31 : ids[random.below(ids.size())];
                return id != before;
            };
            const std::uint64_t part = random.below(6);
            const bool changed =
                part == 0   ? spoil(e.refined.corners)
                : part == 1 ? spoil(e.refined.triangle_faces)
                : part == 2 ? spoil(e.refined.triangle_patches)
                : part == 3 ? spoil(e.refined.chains[random.below(e.refined.chains.size())])
                : part == 4 ? spoil(e.layout.corners)
                            : spoil(e.landmarks);
            EXPECT_EQ(changed, !e.check().valid())
                << example.name << ", trial " << trial << ", part " << part;
        }
    }
}

TEST(Checker, survives_garbage)
{
    Random random(11);
    const std::vector<Example> bases = examples();
    std::size_t refused = 0;
    constexpr std::size_t trials = 3000;
    for (std::size_t trial = 0; trial < trials; ++trial) {
        ClaimedEmbedding e = bases[random.below(bases.size())].embedding;
        const auto number = [&]() -> Index {
            const std::uint64_t kind = random.below(6);
            return kind == 0   ? kNone
                   : kind == 1 ? static_cast<Index>(random.bits())
                               : static_cast<Index>(random.below(200));
        };
        const auto spoil = [&](std::vector<Index>& ids) {
            const std::uint64_t kind = random.below(5);
            if (kind == 0) {
                ids.resize(random.below(2 * ids.size() + 2), number());
            } else if (!ids.empty()) {
                for (std::uint64_t n = random.below(4); n-- > 0;) {
                    ids[random.below(ids.size())] = number();
                }
            }
        };
        const auto real = [&] {
            constexpr std::array<double, 7> values{
                0, 1, -1, 1e300, -1e-300, 0.5, std::numeric_limits<double>::quiet_NaN()};
            return values[random.below(values.size())];
        };
        for (std::uint64_t n = 1 + random.below(3); n-- > 0;) {
            switch (random.below(12)) {
                case 0:
                    spoil(e.refined.corners);
                    break;
                case 1:
                    spoil(e.refined.triangle_faces);
                    break;
                case 2:
                    spoil(e.refined.triangle_patches);
                    break;
                case 3:
                    spoil(e.refined.vertex_faces);
                    break;
                case 4:
                    spoil(e.refined.chains[random.below(e.refined.chains.size())]);
                    break;
                case 5:
                    spoil(e.layout.corners);
                    break;
                case 6:
                    spoil(e.layout.face_offsets);
                    break;
                case 7:
                    spoil(e.target.corners);
                    break;
                case 8:
                    spoil(e.target.face_offsets);
                    break;
                case 9:
                    spoil(e.landmarks);
                    break;
                case 10:
                    if (!e.refined.vertex_barycentrics.empty()) {
                        e.refined.vertex_barycentrics[random.below(
                            e.refined.vertex_barycentrics.size())] = {real(), real(), real()};
                    }
                    break;
                default: {
                    std::vector<WeakPoint>& path = e.weak_paths[random.below(e.weak_paths.size())];
                    path[random.below(path.size())] = {number(), number(), number()};
                    break;
                }
            }
        }
        refused += e.check().valid() ? 0 : 1;
    }
    EXPECT_GT(refused, trials / 2);
}

}  // namespace
}  // namespace layout_embedding
