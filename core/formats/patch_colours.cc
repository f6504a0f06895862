#include "formats/patch_colours.hh"

#include <algorithm>

namespace layout_embedding {
namespace {

/// Pairs of different patches that meet along an edge, in both orders.
std::vector<std::array<Index, 2>> neighbouring_patches(const RefinedMesh& refined)
{
    struct Side {
        std::array<Index, 2> edge;
        Index patch;
    };
    std::vector<Side> sides;
    for (std::size_t h = 0; h < refined.corners.size(); ++h) {
        const Index a = refined.corners[h];
        const Index b = refined.corners[h % 3 == 2 ? h - 2 : h + 1];
        sides.push_back({{std::min(a, b), std::max(a, b)}, refined.triangle_patches[h / 3]});
    }
    std::sort(sides.begin(), sides.end(),
              [](const Side& a, const Side& b) { return a.edge < b.edge; });
    std::vector<std::array<Index, 2>> pairs;
    for (std::size_t i = 1; i < sides.size(); ++i) {
        const Index a = sides[i - 1].patch;
        const Index b = sides[i].patch;
        if (sides[i - 1].edge == sides[i].edge && a != b && a != kNone && b != kNone) {
            pairs.push_back({a, b});
            pairs.push_back({b, a});
        }
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

}  // namespace

const std::vector<Colour>& patch_palette()
{
    static const std::vector<Colour> palette{{119, 170, 221}, {238, 136, 102}, {238, 221, 136},
                                             {255, 170, 187}, {153, 221, 255}, {68, 187, 153},
                                             {187, 204, 51},  {170, 170, 0},   {221, 221, 221}};
    return palette;
}

std::vector<Index> triangle_colours(const RefinedMesh& refined)
{
    const Index grey = static_cast<Index>(patch_palette().size()) - 1;
    Index count = 0;
    for (const Index patch : refined.triangle_patches) {
        count = patch == kNone ? count : std::max(count, patch + 1);
    }
    std::vector<Index> colours(count, kNone);
    std::vector<Index> uses(grey, 0);
    const auto pairs = neighbouring_patches(refined);
    std::size_t place = 0;
    for (Index patch = 0; patch < count; ++patch) {
        std::vector<bool> taken(grey, false);
        for (; place < pairs.size() && pairs[place][0] == patch; ++place) {
            if (const Index colour = colours[pairs[place][1]]; colour != kNone) {
                taken[colour] = true;
            }
        }
        // The free colour that was used least.
        Index best = kNone;
        for (Index colour = 0; colour < grey; ++colour) {
            if (!taken[colour] && (best == kNone || uses[colour] < uses[best])) {
                best = colour;
            }
        }
        colours[patch] = best == kNone ? patch % grey : best;
        ++uses[colours[patch]];
    }
    std::vector<Index> of_triangles;
    of_triangles.reserve(refined.triangle_patches.size());
    for (const Index patch : refined.triangle_patches) {
        of_triangles.push_back(patch == kNone ? grey : colours[patch]);
    }
    return of_triangles;
}

}  // namespace layout_embedding
