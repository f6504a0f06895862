#include "patches/patch_shape.hh"

namespace layout_embedding {

double PatchShape::quotient() const
{
    constexpr double kFourPi = 12.566370614359172954;
    return perimeter > 0 ? kFourPi * area / (perimeter * perimeter) : 0;
}

std::vector<PatchShape> patch_shapes(const Layout& layout, const RefinedMesh& refined)
{
    std::vector<PatchShape> shapes(layout.face_count());
    for (std::size_t t = 0; t < refined.triangle_patches.size(); ++t) {
        if (const Index face = refined.triangle_patches[t]; face != kNone) {
            const Vec3& a = refined.positions[refined.corners[3 * t]];
            const Vec3 u = refined.positions[refined.corners[3 * t + 1]] - a;
            const Vec3 v = refined.positions[refined.corners[3 * t + 2]] - a;
            shapes[face].area += u.cross(v).norm() / 2;
        }
    }
    std::vector<double> lengths;
    for (const std::vector<Index>& chain : refined.chains) {
        lengths.push_back(chain_length(refined, chain));
    }
    for (Index face = 0; face < layout.face_count(); ++face) {
        for (const Index halfedge : layout.face_halfedges(face)) {
            shapes[face].perimeter += lengths[Layout::edge(halfedge)];
        }
    }
    return shapes;
}

double chain_length(const RefinedMesh& refined, const std::vector<Index>& chain)
{
    double length = 0;
    for (std::size_t i = 1; i < chain.size(); ++i) {
        length += (refined.positions[chain[i]] - refined.positions[chain[i - 1]]).norm();
    }
    return length;
}

}  // namespace layout_embedding
