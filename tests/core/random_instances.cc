#include "random_instances.hh"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>

#include "mesh/polygon_mesh.hh"

namespace layout_embedding::test {

namespace {

using Triangle = std::array<Index, 3>;

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

/// A point on the unit sphere by rejection, without transcendental functions.
Vec3 random_direction(Random& random)
{
    for (;;) {
        // One by one: compilers differ in the order in which they evaluate arguments.
        Vec3 p;
        for (int i = 0; i < 3; ++i) {
            p[i] = 2 * random.unit() - 1;
        }
        const double length = p.norm();
        if (length > 0.1 && length <= 1) {
            return p / length;
        }
    }
}

PolygonMesh to_mesh(const std::vector<Triangle>& faces, std::vector<Vec3> positions)
{
    PolygonMesh mesh;
    mesh.positions = std::move(positions);
    for (const Triangle& f : faces) {
        mesh.add_face(f);
    }
    return mesh;
}

/// An octahedron, each face split in four `levels` times, blown up to a sphere with bumps.
PolygonMesh bumpy_sphere(int levels, Random& random)
{
    std::vector<Triangle> faces{{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    std::vector<Vec3> positions{{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
    for (int level = 0; level < levels; ++level) {
        std::vector<Triangle> finer;
        std::map<std::pair<Index, Index>, Index> midpoints;
        const auto midpoint = [&](Index a, Index b) {
            const auto [place, is_new] =
                midpoints.try_emplace(std::minmax(a, b), static_cast<Index>(positions.size()));
            if (is_new) {
                positions.push_back((positions[a] + positions[b]).normalized());
            }
            return place->second;
        };
        for (const auto& [a, b, c] : faces) {
            const Index ab = midpoint(a, b);
            const Index bc = midpoint(b, c);
            const Index ca = midpoint(c, a);
            finer.push_back({a, ab, ca});
            finer.push_back({ab, b, bc});
            finer.push_back({ca, bc, c});
            finer.push_back({ab, bc, ca});
        }
        faces = finer;
    }
    for (Vec3& p : positions) {
        p *= 0.6 + 0.8 * random.unit();
        p.z() *= 1.7;
    }
    return to_mesh(faces, positions);
}

PolygonMesh cube_layout()
{
    PolygonMesh mesh;
    mesh.positions.assign(8, Vec3::Zero());
    for (const std::array<Index, 4>& face : std::vector<std::array<Index, 4>>{
             {0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}) {
        mesh.add_face(face);
    }
    return mesh;
}

PolygonMesh prism_layout()
{
    PolygonMesh mesh;
    mesh.positions.assign(6, Vec3::Zero());
    for (const auto& face : std::vector<std::vector<Index>>{
             {0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}) {
        mesh.add_face(face);
    }
    return mesh;
}

}  // namespace

std::vector<Index> random_order(Index count, Random& random)
{
    std::vector<Index> order(count);
    std::iota(order.begin(), order.end(), Index{0});
    for (Index i = count; i > 1; --i) {
        std::swap(order[i - 1], order[random.below(i)]);
    }
    return order;
}

std::vector<Index> random_tree_first_order(const Layout& layout, Random& random)
{
    std::vector<Index> component(layout.vertex_count());
    std::iota(component.begin(), component.end(), Index{0});
    std::vector<Index> tree;
    std::vector<Index> others;
    for (const Index e : random_order(layout.edge_count(), random)) {
        const Index a = component[layout.tail(2 * e)];
        const Index b = component[layout.head(2 * e)];
        if (a == b) {
            others.push_back(e);
        } else {
            tree.push_back(e);
            std::replace(component.begin(), component.end(), a, b);
        }
    }
    tree.insert(tree.end(), others.begin(), others.end());
    return tree;
}

EmbeddingProblem problem_of(const PolygonMesh& layout, const PolygonMesh& target,
                            std::vector<Index> landmarks)
{
    return make_problem(
               std::make_shared<const Layout>(Layout::from_polygons(layout, "the layout").value()),
               std::make_shared<const TriangleMesh>(target), std::move(landmarks))
        .value();
}

std::vector<Instance> random_instances(std::uint64_t seed, int count)
{
    Random random(seed);
    std::vector<Instance> instances;
    for (int i = 0; i < count; ++i) {
        PolygonMesh layout;
        std::string name;
        switch (i % 3) {
            case 0:
                layout = cube_layout();
                name = "cube";
                break;
            case 1:
                layout = prism_layout();
                name = "prism";
                break;
            default: {
                const auto vertices = static_cast<Index>(4 + random.below(9));
                layout = to_mesh(random_sphere(vertices, random),
                                 std::vector<Vec3>(vertices, Vec3::Zero()));
                name = "triangulation" + std::to_string(vertices);
            }
        }
        PolygonMesh target;
        if (i % 2 == 0) {
            // No shape at all, only lengths: paths cross wildly.
            const auto vertices = static_cast<Index>(14 + random.below(60));
            const auto faces = random_sphere(vertices, random);
            std::vector<Vec3> positions;
            for (Index v = 0; v < vertices; ++v) {
                positions.push_back(random_direction(random));
            }
            target = to_mesh(faces, positions);
            name += " in random" + std::to_string(vertices);
        } else {
            target = bumpy_sphere(1 + static_cast<int>(random.below(3)), random);
            name += " in bumpy" + std::to_string(target.positions.size());
        }
        const auto order = random_order(target.vertex_count(), random);
        const auto shared_layout =
            std::make_shared<const Layout>(Layout::from_polygons(layout, "the layout").value());
        const auto shared_target = std::make_shared<const TriangleMesh>(target);
        auto problem = make_problem(shared_layout, shared_target,
                                    {order.begin(), order.begin() + layout.vertex_count()});
        instances.push_back({name + " #" + std::to_string(i), *problem});
    }
    return instances;
}

}  // namespace layout_embedding::test
