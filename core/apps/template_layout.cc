#include "apps/template_layout.hh"

#include <memory>
#include <utility>
#include <vector>

#include "apps/layout_shortening.hh"
#include "layout/quad_pairing.hh"
#include "mesh/decimation.hh"

namespace layout_embedding {

namespace {

// Which edges are twisted can be told from a coarse mesh of the target with about so many vertices.
constexpr Index kEnoughVertices = 5000;

ShortenedLayout shortened(const PolygonMesh& layout, const TriangleMesh& target,
                          std::span<const Index> landmarks)
{
    if (target.vertex_count() <= 2 * kEnoughVertices) {
        const std::shared_ptr<const TriangleMesh> borrowed(std::shared_ptr<void>(), &target);
        return shortened_layout(layout, borrowed, {landmarks.begin(), landmarks.end()});
    }
    std::vector<bool> kept(target.vertex_count(), false);
    for (const Index v : landmarks) {
        kept[v] = true;
    }
    const SimplifiedMesh coarse = simplified(target, kEnoughVertices, std::move(kept));
    std::vector<Index> ids(target.vertex_count(), kNone);
    for (Index v = 0; v < coarse.vertices.size(); ++v) {
        ids[coarse.vertices[v]] = v;
    }
    std::vector<Index> there;
    for (const Index v : landmarks) {
        there.push_back(ids[v]);
    }
    return shortened_layout(layout, std::make_shared<const TriangleMesh>(coarse.mesh), there);
}

}  // namespace

Result<TemplateLayout> template_layout(const TriangleMesh& target, std::span<const Index> landmarks,
                                       const TemplateOptions& options)
{
    auto decimated = decimated_layout(target, landmarks);
    if (!decimated) {
        return decimated.error();
    }
    ShortenedLayout shorter = shortened(decimated->mesh, target, landmarks);
    TemplateLayout result{std::move(shorter.mesh), decimated->counts, decimated->times_unblocked,
                          shorter.flips};
    if (options.quads) {
        result.mesh = merged_into_quads(result.mesh);
    }
    return result;
}

}  // namespace layout_embedding
