#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "random_draws.hh"
#include "zoo.hh"

namespace layout_embedding::zoo {

using test::random_direction;
using test::shuffle;

namespace {

using Triangle = std::array<Index, 3>;

Triangle triangle(int a, int b, int c)
{
    return {static_cast<Index>(a), static_cast<Index>(b), static_cast<Index>(c)};
}

/// A random triangulation of the sphere with `count` vertices, without parallel edges: a
/// tetrahedron whose faces are split at random, then random edge flips.
std::vector<Triangle> random_sphere(Index count, Random& random)
{
    std::vector<Triangle> faces{{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
    for (Index v = 4; v < count; ++v) {
        Triangle& face = faces[random.below(faces.size())];
        const auto [a, b, c] = face;
        face = {a, b, v};
        faces.push_back({b, c, v});
        faces.push_back({c, a, v});
    }
    std::set<std::pair<Index, Index>> edges;
    for (const Triangle& f : faces) {
        for (int i = 0; i < 3; ++i) {
            edges.insert(std::minmax(f[i], f[(i + 1) % 3]));
        }
    }
    for (Index flips = 0; flips < 10 * count; ++flips) {
        Triangle& left = faces[random.below(faces.size())];
        const auto i = random.below(3);
        const Index a = left[i];
        const Index b = left[(i + 1) % 3];
        const Index c = left[(i + 2) % 3];
        // The face on the other side has b, a in a row.
        for (Triangle& right : faces) {
            for (int k = 0; k < 3; ++k) {
                if (right[k] == b && right[(k + 1) % 3] == a) {
                    const Index d = right[(k + 2) % 3];
                    if (edges.insert(std::minmax(c, d)).second) {
                        edges.erase(std::minmax(a, b));
                        left = {c, d, b};
                        right = {d, c, a};
                    }
                    k = 3;
                    break;
                }
            }
        }
    }
    return faces;
}

}  // namespace

PolygonMesh bumpy_sphere(int levels, std::uint64_t seed)
{
    PolygonMesh mesh = icosphere(levels);
    Random random(seed);
    struct Bump {
        Vec3 direction;
        double height;
        double sharpness;
    };
    std::vector<Bump> bumps;
    for (int i = 0; i < 12; ++i) {
        const Vec3 direction = random_direction(random);
        const double height = 0.9 * random.unit() - 0.3;
        bumps.push_back({direction, height, 3 + 12 * random.unit()});
    }
    for (Vec3& p : mesh.positions) {
        double radius = 1;
        for (const Bump& bump : bumps) {
            radius += bump.height / (1 + bump.sharpness * (1 - bump.direction.dot(p)));
        }
        p *= std::max(radius, 0.2);
    }
    return mesh;
}

PolygonMesh crumpled_sphere(int levels, std::uint64_t seed)
{
    PolygonMesh mesh = octahedron();
    for (int level = 0; level < levels; ++level) {
        mesh = on_unit_sphere(subdivided(mesh));
    }
    Random random(seed);
    for (Vec3& p : mesh.positions) {
        p *= 0.6 + 0.8 * random.unit();
        p.z() *= 1.7;
    }
    return mesh;
}

PolygonMesh random_triangulation(int vertices, std::uint64_t seed)
{
    Random random(seed);
    const auto faces = random_sphere(static_cast<Index>(vertices), random);
    PolygonMesh mesh;
    for (int v = 0; v < vertices; ++v) {
        mesh.positions.push_back(random_direction(random));
    }
    for (const Triangle& face : faces) {
        mesh.add_face(face);
    }
    return mesh;
}

PolygonMesh hull(int points, std::uint64_t seed)
{
    Random random(seed);
    PolygonMesh mesh;
    for (int i = 0; i < points; ++i) {
        mesh.positions.push_back(random_direction(random));
    }
    const auto& p = mesh.positions;
    for (int a = 0; a < points; ++a) {
        for (int b = a + 1; b < points; ++b) {
            for (int c = b + 1; c < points; ++c) {
                const Vec3 normal = (p[b] - p[a]).cross(p[c] - p[a]);
                bool above = false;
                bool below = false;
                for (int d = 0; d < points; ++d) {
                    if (d != a && d != b && d != c) {
                        (normal.dot(p[d] - p[a]) > 0 ? above : below) = true;
                    }
                }
                if (!above) {
                    mesh.add_face(triangle(a, b, c));
                } else if (!below) {
                    mesh.add_face(triangle(a, c, b));
                }
            }
        }
    }
    return mesh;
}

PolygonMesh polygon_hull(int points, std::uint64_t seed)
{
    const PolygonMesh triangles = hull(points, seed);
    Random random(seed + 1);
    std::vector<std::vector<Index>> faces;
    std::vector<std::array<Index, 2>> edges;
    std::vector<int> degrees(triangles.vertex_count(), 0);
    for (Index f = 0; f < triangles.face_count(); ++f) {
        const auto face = triangles.face(f);
        faces.emplace_back(face.begin(), face.end());
        for (std::size_t i = 0; i < 3; ++i) {
            ++degrees[face[i]];
            if (face[i] < face[(i + 1) % 3]) {
                edges.push_back({face[i], face[(i + 1) % 3]});
            }
        }
    }
    shuffle(edges, random);
    // `face` turned so that it begins with b after it ended with a.
    const auto opened = [](std::vector<Index> face, Index a, Index b) {
        for (std::size_t i = 0; i < face.size(); ++i) {
            if (face.back() == a && face.front() == b) {
                return face;
            }
            std::rotate(face.begin(), face.begin() + 1, face.end());
        }
        return std::vector<Index>();
    };
    for (const auto& [a, b] : edges) {
        if (degrees[a] <= 3 || degrees[b] <= 3) {
            continue;
        }
        std::size_t left = faces.size();
        std::size_t right = faces.size();
        for (std::size_t f = 0; f < faces.size(); ++f) {
            left = opened(faces[f], a, b).empty() ? left : f;
            right = opened(faces[f], b, a).empty() ? right : f;
        }
        if (left == right) {
            continue;
        }
        std::vector<Index> merged = opened(faces[left], a, b);        // b ... a
        const std::vector<Index> other = opened(faces[right], b, a);  // a ... b
        merged.insert(merged.end(), other.begin() + 1, other.end() - 1);
        if (std::set<Index>(merged.begin(), merged.end()).size() != merged.size()) {
            continue;
        }
        --degrees[a];
        --degrees[b];
        faces[left] = merged;
        faces.erase(faces.begin() + static_cast<std::ptrdiff_t>(right));
    }
    return polygon_mesh(triangles.positions, faces);
}

}  // namespace layout_embedding::zoo
