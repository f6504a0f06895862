// Whole embeddings: bytes become a layout and a target, both spheres of triangles made by splits
// and flips of a tetrahedron, so that layouts have any rotation system, with landmarks anywhere.
#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "apps/embed_job.hh"
#include "fuzz.hh"
#include "mesh/validation.hh"

using namespace layout_embedding;

namespace {

/// Bytes one after the other, zeros after the last.
class Bytes {
public:
    Bytes(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}
    Index below(std::size_t count) { return at_ == end_ ? 0 : static_cast<Index>(*at_++ % count); }

private:
    const std::uint8_t* at_;
    const std::uint8_t* end_;
};

/// A sphere of triangles that grows by splits and changes by flips.
class Sphere {
public:
    /// A vertex inside a face, off its plane by a part of `offset`.
    void split(Index face, double offset)
    {
        const auto [a, b, c] = faces_[face];
        const Vec3 normal =
            (positions_[b] - positions_[a]).cross(positions_[c] - positions_[a]).normalized();
        const auto v = static_cast<Index>(positions_.size());
        positions_.push_back((positions_[a] + positions_[b] + positions_[c]) / 3 + offset * normal);
        faces_[face] = {a, b, v};
        faces_.push_back({b, c, v});
        faces_.push_back({c, a, v});
    }

    /// Turns the edge after a face's first corner, unless the new edge is there already.
    void flip(Index face)
    {
        const auto [a, b, c] = faces_[face];
        for (Index other = 0; other < faces_.size(); ++other) {
            for (int turn = 0; turn < 3; ++turn) {
                const auto [p, q, d] = faces_[other];
                if (p == b && q == a && !has_edge(c, d)) {
                    faces_[other] = {c, d, b};
                    faces_[face] = {d, c, a};
                    return;
                }
                std::rotate(faces_[other].begin(), faces_[other].begin() + 1, faces_[other].end());
            }
        }
    }

    void change(Bytes& bytes, Index steps)
    {
        for (Index i = 0; i < steps; ++i) {
            const Index face = bytes.below(faces_.size());
            const Index kind = bytes.below(8);
            std::rotate(faces_[face].begin(), faces_[face].begin() + kind % 3, faces_[face].end());
            if (kind < 5) {
                split(face, 0.05 * (kind + 1));
            } else {
                flip(face);
            }
        }
    }

    PolygonMesh mesh() const
    {
        PolygonMesh mesh;
        mesh.positions = positions_;
        for (const auto& face : faces_) {
            mesh.add_face(std::vector<Index>(face.begin(), face.end()));
        }
        return mesh;
    }

private:
    bool has_edge(Index a, Index b) const
    {
        return std::any_of(faces_.begin(), faces_.end(), [&](const auto& face) {
            return std::count(face.begin(), face.end(), a) > 0 &&
                   std::count(face.begin(), face.end(), b) > 0;
        });
    }

    std::vector<Vec3> positions_ = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
    std::vector<std::array<Index, 3>> faces_ = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    Bytes bytes(data, size);
    EmbedOptions options;
    options.algorithm = static_cast<Algorithm>(bytes.below(6));
    options.shape = bytes.below(2) == 0 ? PathShape::shortened : PathShape::even;
    options.seed = bytes.below(256);
    options.gap = 0;
    options.work_limit = 20'000;
    Sphere layout_sphere;
    layout_sphere.change(bytes, bytes.below(6));
    Sphere target_sphere;
    target_sphere.change(bytes, 8 + bytes.below(16));

    const auto layout = Layout::from_polygons(layout_sphere.mesh(), "the layout");
    FUZZ_CHECK(layout.ok());
    const PolygonMesh target = target_sphere.mesh();
    if (!check_surface(target, SurfaceKind::target, "the target")) {
        return 0;  // a flip has left a face without area
    }
    std::vector<Index> free_vertices(target.positions.size());
    for (Index v = 0; v < free_vertices.size(); ++v) {
        free_vertices[v] = v;
    }
    std::vector<Index> landmarks;
    while (landmarks.size() < layout->vertex_count() && !free_vertices.empty()) {
        const Index place = bytes.below(free_vertices.size());
        landmarks.push_back(free_vertices[place]);
        free_vertices.erase(free_vertices.begin() + place);
    }
    auto problem = make_problem(std::make_shared<const Layout>(*layout),
                                std::make_shared<const TriangleMesh>(target), landmarks);
    if (!problem) {
        FUZZ_CHECK(problem.error().code == ErrorCode::landmarkCount);
        return 0;  // more layout vertices than the target has
    }
    EmbedJob job(std::move(*problem), options);
    while (job.step()) {
    }
    // The job sends what it found through the checker itself, and fails where that refuses.
    const EmbedResult& result = job.result();
    FUZZ_CHECK(result.status != EmbedStatus::failed ||
               job.error().code == ErrorCode::unresolvedTie);
    FUZZ_CHECK(result.exact_cost >= result.exact_lower_bound);
    FUZZ_CHECK(result.status != EmbedStatus::optimal || result.refined.has_value());
    return 0;
}
