#include "embedding_instances.hh"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "surface/cut_surface_search.hh"
#include "surface/distance_field.hh"
#include "surface/hole_guard.hh"
#include "surface/strands.hh"

namespace layout_embedding::instances {

namespace {

PolygonMesh polygons(std::vector<Vec3> positions, const std::vector<std::vector<Index>>& faces)
{
    PolygonMesh mesh;
    mesh.positions = std::move(positions);
    for (const auto& face : faces) {
        mesh.add_face(face);
    }
    return mesh;
}

Vec3 on_circle(Index i, Index count, double radius, double z)
{
    const double angle = 2 * 3.14159265358979 * i / count;
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

std::vector<std::vector<Index>> faces_of(const PolygonMesh& mesh)
{
    std::vector<std::vector<Index>> faces;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        faces.emplace_back(mesh.face(f).begin(), mesh.face(f).end());
    }
    return faces;
}

}  // namespace

PolygonMesh tetrahedron()
{
    return polygons({{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}},
                    {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
}

PolygonMesh octahedron()
{
    return polygons(
        {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
        {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}});
}

PolygonMesh icosahedron()
{
    // Two poles and two rings of five.
    std::vector<Vec3> positions{{0, 0, 1}, {0, 0, -1}};
    const double z = 1 / std::sqrt(5.0);
    for (Index i = 0; i < 5; ++i) {
        positions.push_back(on_circle(2 * i, 10, 2 * z, z));
        positions.push_back(on_circle(2 * i + 1, 10, 2 * z, -z));
    }
    std::vector<std::vector<Index>> faces;
    for (Index i = 0; i < 5; ++i) {
        const Index upper = 2 + 2 * i;
        const Index lower = upper + 1;
        const Index next_upper = 2 + 2 * ((i + 1) % 5);
        const Index next_lower = next_upper + 1;
        faces.push_back({0, upper, next_upper});
        faces.push_back({upper, lower, next_upper});
        faces.push_back({next_upper, lower, next_lower});
        faces.push_back({1, next_lower, lower});
    }
    return polygons(std::move(positions), faces);
}

PolygonMesh cube()
{
    return polygons(
        {{-1, -1, -1},
         {1, -1, -1},
         {1, 1, -1},
         {-1, 1, -1},
         {-1, -1, 1},
         {1, -1, 1},
         {1, 1, 1},
         {-1, 1, 1}},
        {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}});
}

PolygonMesh prism(Index sides)
{
    std::vector<Vec3> positions;
    std::vector<std::vector<Index>> faces(2);
    for (Index i = 0; i < sides; ++i) {
        positions.push_back(on_circle(i, sides, 1, -1));
        positions.push_back(on_circle(i, sides, 1, 1));
        const Index j = (i + 1) % sides;
        faces.push_back({2 * i, 2 * j, 2 * j + 1, 2 * i + 1});
        faces[0].insert(faces[0].begin(), 2 * i);
        faces[1].push_back(2 * i + 1);
    }
    return polygons(std::move(positions), faces);
}

PolygonMesh pyramid(Index sides)
{
    std::vector<Vec3> positions{{0, 0, 1}};
    std::vector<std::vector<Index>> faces(1);
    for (Index i = 0; i < sides; ++i) {
        positions.push_back(on_circle(i, sides, 1, 0));
        faces.push_back({0, 1 + i, 1 + (i + 1) % sides});
        faces[0].insert(faces[0].begin(), 1 + i);
    }
    return polygons(std::move(positions), faces);
}

PolygonMesh bipyramid(Index sides)
{
    std::vector<Vec3> positions{{0, 0, 1}, {0, 0, -1}};
    std::vector<std::vector<Index>> faces;
    for (Index i = 0; i < sides; ++i) {
        positions.push_back(on_circle(i, sides, 1, 0));
        faces.push_back({0, 2 + i, 2 + (i + 1) % sides});
        faces.push_back({1, 2 + (i + 1) % sides, 2 + i});
    }
    return polygons(std::move(positions), faces);
}

PolygonMesh torus(Index across, Index around)
{
    std::vector<Vec3> positions;
    std::vector<std::vector<Index>> faces;
    for (Index i = 0; i < around; ++i) {
        for (Index j = 0; j < across; ++j) {
            const Vec3 profile = on_circle(j, across, 1, 0);
            positions.push_back(on_circle(i, around, 3 + profile.x(), profile.y()));
            const Index next_i = (i + 1) % around;
            const Index next_j = (j + 1) % across;
            faces.push_back({i * across + j, next_i * across + j, next_i * across + next_j,
                             i * across + next_j});
        }
    }
    return polygons(std::move(positions), faces);
}

PolygonMesh disk(Index size)
{
    std::vector<Vec3> positions;
    std::vector<std::vector<Index>> faces;
    const Index stride = size + 1;
    for (Index i = 0; i <= size; ++i) {
        for (Index j = 0; j <= size; ++j) {
            positions.emplace_back(i, j, 0.1 * i * j / size);
            if (i < size && j < size) {
                faces.push_back({i * stride + j, (i + 1) * stride + j, (i + 1) * stride + j + 1,
                                 i * stride + j + 1});
            }
        }
    }
    return polygons(std::move(positions), faces);
}

PolygonMesh annulus(Index around, Index across)
{
    std::vector<Vec3> positions;
    std::vector<std::vector<Index>> faces;
    const Index stride = across + 1;
    for (Index i = 0; i < around; ++i) {
        for (Index j = 0; j <= across; ++j) {
            positions.push_back(on_circle(i, around, 1 + j, 0.1 * j));
            if (j < across) {
                const Index next = (i + 1) % around;
                faces.push_back(
                    {i * stride + j, i * stride + j + 1, next * stride + j + 1, next * stride + j});
            }
        }
    }
    return polygons(std::move(positions), faces);
}

PolygonMesh triangulated(const PolygonMesh& mesh, Random& random)
{
    std::vector<std::vector<Index>> faces;
    for (auto face : faces_of(mesh)) {
        if (face.size() == 4) {
            std::rotate(face.begin(), face.begin() + static_cast<long>(random.below(2)),
                        face.end());
            faces.push_back({face[0], face[2], face[3]});
            face.pop_back();
        }
        faces.push_back(face);
    }
    return polygons(mesh.positions, faces);
}

PolygonMesh subdivided(const PolygonMesh& mesh)
{
    std::vector<Vec3> positions = mesh.positions;
    std::map<std::pair<Index, Index>, Index> midpoints;
    const auto midpoint = [&](Index a, Index b) {
        const auto [place, fresh] =
            midpoints.try_emplace(std::minmax(a, b), static_cast<Index>(positions.size()));
        if (fresh) {
            positions.push_back(0.5 * (mesh.positions[a] + mesh.positions[b]));
        }
        return place->second;
    };
    std::vector<std::vector<Index>> faces;
    for (const auto& face : faces_of(mesh)) {
        const Index ab = midpoint(face[0], face[1]);
        const Index bc = midpoint(face[1], face[2]);
        const Index ca = midpoint(face[2], face[0]);
        faces.push_back({face[0], ab, ca});
        faces.push_back({face[1], bc, ab});
        faces.push_back({face[2], ca, bc});
        faces.push_back({ab, bc, ca});
    }
    return polygons(std::move(positions), faces);
}

PolygonMesh on_sphere(PolygonMesh mesh)
{
    for (Vec3& p : mesh.positions) {
        p.normalize();
    }
    return mesh;
}

PolygonMesh scrambled(const PolygonMesh& mesh, Random& random)
{
    PolygonMesh result = mesh;
    double scale = 0;
    for (const Vec3& p : mesh.positions) {
        scale = std::max(scale, p.norm());
    }
    for (Vec3& p : result.positions) {
        p += 0.05 * scale * Vec3(random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5);
        p.z() *= 2;
    }
    for (Index i = 0; i < mesh.face_count(); ++i) {
        const TriangleMesh connectivity(result);
        const Index h =
            connectivity.halfedge(static_cast<Index>(random.below(connectivity.edge_count())));
        const Index twin = connectivity.opposite(h);
        if (twin == kNone) {
            continue;
        }
        const Index a = connectivity.tail(h);
        const Index b = connectivity.head(h);
        const Index left = connectivity.head(TriangleMesh::next(h));
        const Index right = connectivity.head(TriangleMesh::next(twin));
        bool joined = false;
        Index degrees = 0;
        for (Index g = 0; g < connectivity.halfedge_count(); ++g) {
            const Index tail = connectivity.tail(g);
            const Index head = connectivity.head(g);
            joined = joined || std::minmax(tail, head) == std::minmax(left, right);
            degrees += tail == a || tail == b ? 1 : 0;
        }
        if (joined || degrees < 9) {
            continue;  // The flip would double an edge or make a vertex of degree two.
        }
        const std::array<Index, 3> first{left, right, b};
        const std::array<Index, 3> second{right, left, a};
        std::copy(first.begin(), first.end(),
                  result.corners.begin() + 3 * TriangleMesh::face_of(h));
        std::copy(second.begin(), second.end(),
                  result.corners.begin() + 3 * TriangleMesh::face_of(twin));
    }
    return result;
}

EmbeddingProblem problem(const PolygonMesh& layout, const PolygonMesh& target,
                         std::vector<Index> landmarks)
{
    return make_problem(
               std::make_shared<Layout>(Layout::from_polygons(layout, "the layout").value()),
               std::make_shared<TriangleMesh>(target), std::move(landmarks))
        .value();
}

std::vector<Index> random_landmarks(Index count, const PolygonMesh& target, Random& random)
{
    const TriangleMesh mesh(target);
    std::vector<Index> vertices;
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        if (!mesh.is_boundary_vertex(v)) {
            vertices.push_back(v);
        }
    }
    for (Index i = 0; i < count; ++i) {
        std::swap(vertices[i], vertices[i + random.below(vertices.size() - i)]);
    }
    vertices.resize(count);
    return vertices;
}

std::optional<WeakEmbedding> insert_in_random_order(const EmbeddingProblem& problem,
                                                    const PathGraph& graph, Random& random)
{
    const Layout& layout = *problem.layout;
    Strands strands(problem, graph);
    DistanceFields fields(graph, strands.passable(), std::uint64_t{1} << 26U);
    CutSurfaceSearch search(strands, fields);
    const HoleGuard guard(strands);
    std::vector<Index> order(layout.edge_count());
    std::iota(order.begin(), order.end(), Index{0});
    for (Index i = 0; i < order.size(); ++i) {
        std::swap(order[i], order[i + random.below(order.size() - i)]);
    }
    std::vector<Index> components(layout.vertex_count());
    std::iota(components.begin(), components.end(), Index{0});
    for (const bool tree : {true, false}) {
        for (bool changed = true; changed;) {
            changed = false;
            for (const Index e : order) {
                const Index a = components[layout.tail(2 * e)];
                const Index b = components[layout.head(2 * e)];
                if (strands.is_embedded(e) || (tree && a == b)) {
                    continue;
                }
                search.begin(e);
                if (search.run() != CutSurfaceSearch::Outcome::found ||
                    !strands.insert(e, search.darts())) {
                    return std::nullopt;
                }
                if (!guard.accepts()) {
                    strands.undo();
                    continue;
                }
                std::replace(components.begin(), components.end(), a, b);
                changed = true;
            }
        }
    }
    if (strands.insertion_order().size() != layout.edge_count()) {
        return std::nullopt;
    }
    return strands.weak_embedding();
}

std::vector<Instance> random_instances(std::uint64_t seed, int rounds)
{
    Random random(seed);
    std::vector<std::pair<std::string, PolygonMesh>> spheres;
    spheres.emplace_back("octahedron18", on_sphere(subdivided(octahedron())));
    spheres.emplace_back("icosahedron12", icosahedron());
    spheres.emplace_back("icosphere162", on_sphere(subdivided(subdivided(icosahedron()))));
    spheres.emplace_back("icosphere42 scrambled",
                         scrambled(on_sphere(subdivided(icosahedron())), random));
    spheres.emplace_back("icosphere162 scrambled",
                         scrambled(on_sphere(subdivided(subdivided(icosahedron()))), random));
    spheres.emplace_back("bipyramid50", subdivided(bipyramid(12)));
    const std::vector<std::pair<std::string, PolygonMesh>> sphere_layouts{
        {"tetrahedron", tetrahedron()}, {"cube", cube()},         {"octahedron", octahedron()},
        {"prism5", prism(5)},           {"pyramid6", pyramid(6)}, {"disk2", disk(2)},
        {"icosahedron", icosahedron()}};
    std::vector<Instance> instances;
    const auto add = [&](const std::string& name, const PolygonMesh& layout,
                         const PolygonMesh& target, std::vector<Index> landmarks) {
        EmbeddingProblem p = problem(layout, target, std::move(landmarks));
        PathGraph graph = PathGraph::barycentric(*p.target, {random.bits(), 0});
        if (auto weak = insert_in_random_order(p, graph, random)) {
            instances.push_back({name, std::move(p), std::move(graph), std::move(*weak)});
        }
    };
    for (int round = 0; round < rounds; ++round) {
        const std::string suffix = ", round " + std::to_string(round);
        for (const auto& [target_name, target] : spheres) {
            for (const auto& [layout_name, layout] : sphere_layouts) {
                add(layout_name + " on " + target_name + suffix, layout, target,
                    random_landmarks(layout.vertex_count(), target, random));
            }
        }
        // The vertices of a coarse torus lie on a fine one, each moved at random.
        const PolygonMesh fine_torus = triangulated(torus(8, 12), random);
        std::vector<Index> landmarks;
        for (Index i = 0; i < 4; ++i) {
            for (Index j = 0; j < 4; ++j) {
                landmarks.push_back((3 * i + static_cast<Index>(random.below(2))) * 8 + 2 * j +
                                    static_cast<Index>(random.below(2)));
            }
        }
        add("torus4x4 on torus8x12" + suffix, torus(4, 4), fine_torus, landmarks);
        const PolygonMesh fine_disk = scrambled(triangulated(disk(5), random), random);
        add("disk2 on disk5" + suffix, disk(2), fine_disk, random_landmarks(9, fine_disk, random));
        const PolygonMesh fine_ring = triangulated(annulus(9, 4), random);
        add("annulus4x1 on annulus9x4" + suffix, annulus(4, 1), fine_ring,
            random_landmarks(8, fine_ring, random));
        // Landmarks on the boundary: the corners and side midpoints of a square.
        add("disk2 on disk6, boundary landmarks" + suffix, disk(2), triangulated(disk(6), random),
            {0, 3, 6, 21, 24, 27, 42, 45, 48});
    }
    return instances;
}

}  // namespace layout_embedding::instances
