#include "patches/patch.hh"

#include <string>

#include "mesh/triangle_mesh.hh"

namespace layout_embedding {
namespace {

PolygonMesh polygons_of(const RefinedMesh& refined)
{
    PolygonMesh mesh;
    mesh.positions = refined.positions;
    mesh.corners = refined.corners;
    for (std::size_t end = 3; end <= refined.corners.size(); end += 3) {
        mesh.face_offsets.push_back(static_cast<Index>(end));
    }
    return mesh;
}

/// The halfedge from one vertex to another, kNone if there is none.
Index find_halfedge(const TriangleMesh& mesh, Index tail, Index head)
{
    const Index first = mesh.outgoing(tail);
    Index h = first;
    do {
        if (mesh.head(h) == head) {
            return h;
        }
        h = mesh.rotated_ccw(h);
    } while (h != kNone && h != first);
    return kNone;
}

class PatchBuilder {
public:
    PatchBuilder(const Layout& layout, const RefinedMesh& refined)
        : layout_(layout), refined_(refined), mesh_(polygons_of(refined))
    {}

    Result<std::vector<Patch>> run()
    {
        for (const std::vector<Index>& chain : refined_.chains) {
            for (std::size_t i = 1; i < chain.size(); ++i) {
                if (find_halfedge(mesh_, chain[i - 1], chain[i]) == kNone &&
                    find_halfedge(mesh_, chain[i], chain[i - 1]) == kNone) {
                    return make_error(
                        ErrorCode::realisationFailed,
                        "a chain leaves the mesh at vertex " + std::to_string(chain[i - 1]),
                        {{"vertex", chain[i - 1]}});
                }
            }
        }
        mark_chains();
        corner_vertices_.assign(mesh_.halfedge_count(), kNone);
        patches_.resize(layout_.face_count());
        for (Index face = 0; face < layout_.face_count(); ++face) {
            patches_[face].face = face;
            if (const Status status = trace_boundary(face); !status) {
                return status.error();
            }
        }
        for (Index triangle = 0; triangle < mesh_.face_count(); ++triangle) {
            const Index face = refined_.triangle_patches[triangle];
            if (face != kNone) {
                add_triangle(patches_[face], triangle);
            }
        }
        return std::move(patches_);
    }

private:
    void mark_chains()
    {
        is_chain_edge_.assign(mesh_.edge_count(), false);
        for (const std::vector<Index>& chain : refined_.chains) {
            for (std::size_t i = 1; i < chain.size(); ++i) {
                Index h = find_halfedge(mesh_, chain[i - 1], chain[i]);
                if (h == kNone) {
                    h = find_halfedge(mesh_, chain[i], chain[i - 1]);
                }
                is_chain_edge_[mesh_.edge(h)] = true;
            }
        }
    }

    Status trace_boundary(Index face)
    {
        Patch& patch = patches_[face];
        for (const Index side : layout_.face_halfedges(face)) {
            patch.sides.push_back(static_cast<Index>(patch.vertices.size()));
            const std::vector<Index>& chain = refined_.chains[Layout::edge(side)];
            const bool forward = side % 2 == 0;
            for (std::size_t i = 1; i < chain.size(); ++i) {
                const Index from = forward ? chain[i - 1] : chain[chain.size() - i];
                const Index to = forward ? chain[i] : chain[chain.size() - i - 1];
                const Index h = find_halfedge(mesh_, from, to);
                if (h == kNone || refined_.triangle_patches[TriangleMesh::face_of(h)] != face ||
                    corner_vertices_[h] != kNone) {
                    return make_error(ErrorCode::realisationFailed,
                                      "the chains around layout face " + std::to_string(face) +
                                          " do not bound its triangles at vertex " +
                                          std::to_string(from),
                                      {{"face", face}, {"vertex", from}});
                }
                add_vertex(patch, h);
            }
        }
        patch.sides.push_back(static_cast<Index>(patch.vertices.size()));
        return {};
    }

    void add_triangle(Patch& patch, Index triangle)
    {
        patch.triangles.push_back(triangle);
        std::array<Index, 3> corners{};
        for (Index i = 0; i < 3; ++i) {
            const Index h = 3 * triangle + i;
            if (corner_vertices_[h] == kNone) {
                add_vertex(patch, h);
            }
            corners[i] = corner_vertices_[h];
        }
        patch.corners.push_back(corners);
    }

    /// The tail of h becomes a vertex of the patch, in all corners between chains around it.
    void add_vertex(Patch& patch, Index h)
    {
        const Index id = static_cast<Index>(patch.vertices.size());
        patch.vertices.push_back(mesh_.tail(h));
        corner_vertices_[h] = id;
        for (Index left = h; !is_chain_edge_[mesh_.edge(TriangleMesh::previous(left))];) {
            left = mesh_.rotated_ccw(left);
            if (left == kNone || left == h) {
                break;
            }
            corner_vertices_[left] = id;
        }
        for (Index right = h; !is_chain_edge_[mesh_.edge(right)];) {
            const Index opposite = mesh_.opposite(right);
            if (opposite == kNone) {
                break;
            }
            right = TriangleMesh::next(opposite);
            if (corner_vertices_[right] == id) {
                break;
            }
            corner_vertices_[right] = id;
        }
    }

    const Layout& layout_;
    const RefinedMesh& refined_;
    TriangleMesh mesh_;
    std::vector<bool> is_chain_edge_;
    std::vector<Index> corner_vertices_;  // per halfedge: the patch vertex at its tail
    std::vector<Patch> patches_;
};

}  // namespace

Result<std::vector<Patch>> patches_of(const Layout& layout, const RefinedMesh& refined)
{
    return PatchBuilder(layout, refined).run();
}

}  // namespace layout_embedding
