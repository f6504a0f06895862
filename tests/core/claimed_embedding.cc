#include "claimed_embedding.hh"

#include <algorithm>
#include <cmath>
#include <map>

#include "zoo.hh"

namespace layout_embedding {

namespace {

using EdgeKey = std::pair<Index, Index>;

EdgeKey key(Index a, Index b)
{
    return {std::min(a, b), std::max(a, b)};
}

struct Mesh {
    std::vector<Vec3> positions;
    std::vector<std::array<Index, 3>> triangles;
    std::vector<Index> patches;
};

/// Each triangle becomes four; chains get the new vertices.
void subdivide(Mesh& mesh, std::vector<std::vector<Index>>& chains)
{
    std::map<EdgeKey, Index> middles;
    const auto middle = [&](Index a, Index b) {
        const auto [found, fresh] =
            middles.try_emplace(key(a, b), static_cast<Index>(mesh.positions.size()));
        if (fresh) {
            mesh.positions.push_back((mesh.positions[a] + mesh.positions[b]) / 2);
        }
        return found->second;
    };
    Mesh fine;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto [a, b, c] = mesh.triangles[t];
        const Index ab = middle(a, b);
        const Index bc = middle(b, c);
        const Index ca = middle(c, a);
        for (const std::array<Index, 3>& part :
             {std::array<Index, 3>{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}}) {
            fine.triangles.push_back(part);
            fine.patches.push_back(mesh.patches[t]);
        }
    }
    mesh.triangles = std::move(fine.triangles);
    mesh.patches = std::move(fine.patches);
    for (std::vector<Index>& chain : chains) {
        std::vector<Index> longer{chain[0]};
        for (std::size_t i = 1; i < chain.size(); ++i) {
            longer.push_back(middles.at(key(chain[i - 1], chain[i])));
            longer.push_back(chain[i]);
        }
        chain = std::move(longer);
    }
}

/// Splits each target edge at a random place and each target face into four triangles and these
/// into three; vertices on edges get their coordinates in the first face that meets them.
void refine_target(const Mesh& target, ClaimedEmbedding& result, Random& random)
{
    RefinedMesh& refined = result.refined;
    /// A new vertex and its coordinate at the larger end of its edge.
    std::map<EdgeKey, std::pair<Index, double>> splits;
    const auto add = [&](Index face, const std::array<double, 3>& b) {
        const std::array<Index, 3>& corners = target.triangles[face];
        refined.positions.push_back(b[0] * target.positions[corners[0]] +
                                    b[1] * target.positions[corners[1]] +
                                    b[2] * target.positions[corners[2]]);
        refined.vertex_faces.push_back(face);
        refined.vertex_barycentrics.push_back(b);
        return static_cast<Index>(refined.positions.size() - 1);
    };
    for (Index f = 0; f < target.triangles.size(); ++f) {
        const std::array<Index, 3>& corners = target.triangles[f];
        // Corner, split, corner, split, ... around the face, with their coordinates.
        std::array<Index, 6> ring;
        std::array<Vec3, 6> places;
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3;
            ring[2 * i] = corners[i];
            places[2 * i] = Vec3::Unit(i);
            const auto [found, fresh] = splits.try_emplace(key(corners[i], corners[j]));
            auto& [vertex, share] = found->second;
            if (fresh) {
                share = 0.3 + 0.4 * random.unit();
            }
            std::array<double, 3> b{0, 0, 0};
            b[corners[i] > corners[j] ? i : j] = share;
            b[corners[i] > corners[j] ? j : i] = 1 - share;
            if (fresh) {
                vertex = add(f, b);
            }
            ring[2 * i + 1] = vertex;
            places[2 * i + 1] = Vec3(b[0], b[1], b[2]);
        }
        for (const std::array<int, 3>& part :
             {std::array<int, 3>{0, 1, 5}, {2, 3, 1}, {4, 5, 3}, {1, 3, 5}}) {
            const Vec3 center = (places[part[0]] + places[part[1]] + places[part[2]]) / 3;
            const Index v = add(f, {center[0], center[1], 1 - center[0] - center[1]});
            for (int i = 0; i < 3; ++i) {
                for (const Index corner : {ring[part[i]], ring[part[(i + 1) % 3]], v}) {
                    refined.corners.push_back(corner);
                }
                refined.triangle_faces.push_back(f);
                refined.triangle_patches.push_back(target.patches[f]);
            }
        }
    }
    for (std::vector<Index>& chain : refined.chains) {
        std::vector<Index> longer{chain[0]};
        for (std::size_t i = 1; i < chain.size(); ++i) {
            longer.push_back(splits.at(key(chain[i - 1], chain[i])).first);
            longer.push_back(chain[i]);
        }
        chain = std::move(longer);
    }
}

}  // namespace

std::set<std::string> ClaimedEmbedding::codes() const
{
    std::set<std::string> result;
    for (const Violation& violation : check().violations) {
        result.insert(violation.code);
    }
    return result;
}

ClaimedEmbedding embed_in_itself(const PolygonMesh& polygons, int subdivisions, bool refine,
                                 std::uint64_t seed, const std::set<Index>& dropped)
{
    ClaimedEmbedding result;
    Random random(seed);
    Mesh mesh{polygons.positions, {}, {}};
    std::map<EdgeKey, bool> edges;
    result.layout.positions = polygons.positions;
    for (Index f = 0; f < polygons.face_count(); ++f) {
        const std::span<const Index> corners = polygons.face(f);
        const bool kept = dropped.count(f) == 0;
        const Index patch = kept ? result.layout.face_count() : kNone;
        if (kept) {
            result.layout.add_face(corners);
        }
        Vec3 center = Vec3::Zero();
        for (const Index v : corners) {
            center += polygons.positions[v] / static_cast<double>(corners.size());
        }
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const Index a = corners[i];
            const Index b = corners[(i + 1) % corners.size()];
            if (kept && edges.emplace(key(a, b), true).second) {
                result.layout_edges.push_back({a, b});
                result.refined.chains.push_back({a, b});
            }
            if (corners.size() > 3) {
                mesh.triangles.push_back({a, b, static_cast<Index>(mesh.positions.size())});
                mesh.patches.push_back(patch);
            }
        }
        if (corners.size() > 3) {
            mesh.positions.push_back(center);
        } else {
            mesh.triangles.push_back({corners[0], corners[1], corners[2]});
            mesh.patches.push_back(patch);
        }
    }
    for (Index v = 0; v < polygons.vertex_count(); ++v) {
        result.landmarks.push_back(v);
    }
    for (int i = 0; i < subdivisions; ++i) {
        subdivide(mesh, result.refined.chains);
    }
    result.target.positions = mesh.positions;
    for (const std::array<Index, 3>& triangle : mesh.triangles) {
        result.target.add_face(triangle);
    }
    for (const std::vector<Index>& chain : result.refined.chains) {
        result.weak_paths.push_back(weak_path_along(chain));
    }
    result.refined.positions = mesh.positions;
    if (refine) {
        refine_target(mesh, result, random);
    } else {
        result.refined.corners = result.target.corners;
        result.refined.triangle_patches = mesh.patches;
        for (Index f = 0; f < mesh.triangles.size(); ++f) {
            result.refined.triangle_faces.push_back(f);
        }
    }
    return result;
}

void shake(ClaimedEmbedding& embedding, int moves, std::uint64_t seed)
{
    RefinedMesh& refined = embedding.refined;
    Random random(seed);
    std::map<EdgeKey, std::pair<Index, Index>> left;  // directed edge: triangle, third corner
    for (Index t = 0; t < embedding.triangle_count(); ++t) {
        for (int i = 0; i < 3; ++i) {
            left[{refined.corners[3 * t + i], refined.corners[3 * t + (i + 1) % 3]}] = {
                t, refined.corners[3 * t + (i + 2) % 3]};
        }
    }
    std::vector<bool> taken(refined.positions.size(), false);
    for (const Index v : embedding.landmarks) {
        taken[v] = true;
    }
    for (const std::vector<Index>& chain : refined.chains) {
        for (const Index v : chain) {
            taken[v] = true;
        }
    }
    for (int move = 0; move < moves; ++move) {
        std::vector<Index>& chain = refined.chains[random.below(refined.chains.size())];
        const std::size_t i = random.below(chain.size() - 1);
        const Index a = chain[i];
        const Index b = chain[i + 1];
        const bool to_the_left = random.below(2) == 0;
        const auto there = to_the_left ? left.find({a, b}) : left.find({b, a});
        const auto beyond = to_the_left ? left.find({b, a}) : left.find({a, b});
        if (there == left.end()) {
            continue;
        }
        // The triangle goes over to the patch on the other side, which at a boundary edge is
        // outside.
        const auto [triangle, apex] = there->second;
        const Index patch =
            beyond == left.end() ? kNone : refined.triangle_patches[beyond->second.first];
        if (!taken[apex]) {
            taken[apex] = true;
            chain.insert(chain.begin() + static_cast<std::ptrdiff_t>(i) + 1, apex);
            refined.triangle_patches[triangle] = patch;
        } else if (i + 2 < chain.size() && chain[i + 2] == apex) {
            taken[b] = false;
            chain.erase(chain.begin() + static_cast<std::ptrdiff_t>(i) + 1);
            refined.triangle_patches[triangle] = patch;
        }
    }
}

void twist_weak_paths(ClaimedEmbedding& embedding, const std::vector<Index>& loop, int times)
{
    for (std::vector<WeakPoint>& path : embedding.weak_paths) {
        std::vector<WeakPoint> longer;
        for (const WeakPoint& point : path) {
            longer.push_back(point);
            const auto found = std::find(loop.begin(), loop.end(), point[0]);
            if (point[1] != kNone || found == loop.end()) {
                continue;
            }
            std::vector<Index> around(found, loop.end());
            around.insert(around.end(), loop.begin(), found + 1);
            if (times < 0) {
                std::reverse(around.begin(), around.end());
            }
            const std::vector<WeakPoint> turn = weak_path_along(around);
            for (int i = 0; i < std::abs(times); ++i) {
                longer.insert(longer.end(), turn.begin() + 1, turn.end());
            }
        }
        path = std::move(longer);
    }
}

std::vector<WeakPoint> weak_path_along(const std::vector<Index>& vertices)
{
    std::vector<WeakPoint> path;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        if (i > 0) {
            path.push_back({vertices[i - 1], vertices[i], kNone});
        }
        path.push_back({vertices[i], kNone, kNone});
    }
    return path;
}

PolygonMesh grid_polygons(Index columns, Index rows, bool torus)
{
    std::vector<Vec3> positions;
    std::vector<std::vector<Index>> faces;
    const Index lines = torus ? rows : rows + 1;
    const double turn = 2 * std::acos(-1.0);
    for (Index j = 0; j < lines; ++j) {
        for (Index i = 0; i < columns; ++i) {
            const double u = turn * i / columns;
            const double v = turn * j / lines;
            const double radius = torus ? 3 + std::cos(v) : 1.0 + j;
            positions.emplace_back(radius * std::cos(u), radius * std::sin(u),
                                   torus ? -std::sin(v) : 0);
        }
    }
    const auto id = [&](Index i, Index j) { return (j % lines) * columns + i % columns; };
    for (Index j = 0; j < rows; ++j) {
        for (Index i = 0; i < columns; ++i) {
            faces.push_back({id(i, j), id(i, j + 1), id(i + 1, j + 1), id(i + 1, j)});
        }
    }
    return zoo::polygon_mesh(positions, faces);
}

}  // namespace layout_embedding
