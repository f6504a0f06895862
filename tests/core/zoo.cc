#include "zoo.hh"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace layout_embedding::zoo {
namespace {

/// Cosine and sine of `share` of a full turn. By power series, since the C library's differ from
/// platform to platform.
std::array<double, 2> on_circle(double share)
{
    constexpr double kPi = 3.141592653589793;
    double x = 2 * kPi * (share - std::floor(share));
    if (x > kPi) {
        x -= 2 * kPi;
    }
    double cosine = 0;
    double sine = 0;
    double term = 1;
    for (int i = 1; i <= 34; i += 2) {
        cosine += term;
        term *= x / i;
        sine += term;
        term *= -x / (i + 1);
    }
    return {cosine, sine};
}

std::array<double, 2> on_circle(int i, int n)
{
    return on_circle(static_cast<double>(i) / n);
}

void add(PolygonMesh& mesh, std::initializer_list<int> corners)
{
    std::vector<Index> face;
    for (const int corner : corners) {
        face.push_back(static_cast<Index>(corner));
    }
    mesh.add_face(face);
}

/// An n by m grid of quads; `wrap_n`, `wrap_m`: closed in that direction. `position(i, j)` places
/// the vertices.
template <typename Position>
PolygonMesh grid(int n, int m, bool wrap_n, bool wrap_m, Position position)
{
    const int columns = wrap_n ? n : n + 1;
    const int rows = wrap_m ? m : m + 1;
    PolygonMesh mesh;
    for (int i = 0; i < columns; ++i) {
        for (int j = 0; j < rows; ++j) {
            mesh.positions.push_back(position(i, j));
        }
    }
    const auto id = [&](int i, int j) { return (i % columns) * rows + j % rows; };
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < m; ++j) {
            add(mesh, {id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)});
        }
    }
    return mesh;
}

}  // namespace

PolygonMesh tetrahedron()
{
    return on_unit_sphere(polygon_mesh({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}},
                                       {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}));
}

PolygonMesh cube()
{
    return on_unit_sphere(polygon_mesh(
        {{-1, -1, -1},
         {1, -1, -1},
         {1, 1, -1},
         {-1, 1, -1},
         {-1, -1, 1},
         {1, -1, 1},
         {1, 1, 1},
         {-1, 1, 1}},
        {{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}));
}

PolygonMesh octahedron()
{
    return polygon_mesh(
        {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
        {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}});
}

PolygonMesh icosahedron()
{
    const double t = (1 + std::sqrt(5.0)) / 2;
    return on_unit_sphere(polygon_mesh(
        {{-1, t, 0},
         {1, t, 0},
         {-1, -t, 0},
         {1, -t, 0},
         {0, -1, t},
         {0, 1, t},
         {0, -1, -t},
         {0, 1, -t},
         {t, 0, -1},
         {t, 0, 1},
         {-t, 0, -1},
         {-t, 0, 1}},
        {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
         {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
         {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}));
}

PolygonMesh icosphere(int levels)
{
    PolygonMesh mesh = icosahedron();
    for (int i = 0; i < levels; ++i) {
        mesh = on_unit_sphere(subdivided(mesh));
    }
    return mesh;
}

PolygonMesh stretched_sphere(int levels, const Vec3& axes)
{
    PolygonMesh mesh = icosphere(levels);
    for (Vec3& p : mesh.positions) {
        p = p.cwiseProduct(axes);
    }
    return mesh;
}

PolygonMesh prism(int n)
{
    PolygonMesh mesh;
    for (const double z : {-0.6, 0.6}) {
        for (int i = 0; i < n; ++i) {
            const auto [x, y] = on_circle(i, n);
            mesh.positions.emplace_back(0.8 * x, 0.8 * y, z);
        }
    }
    std::vector<Index> bottom;
    std::vector<Index> top;
    for (int i = 0; i < n; ++i) {
        bottom.push_back(static_cast<Index>(n - 1 - i));
        top.push_back(static_cast<Index>(n + i));
    }
    mesh.add_face(bottom);
    mesh.add_face(top);
    for (int i = 0; i < n; ++i) {
        const int j = (i + 1) % n;
        add(mesh, {i, j, n + j, n + i});
    }
    return on_unit_sphere(mesh);
}

PolygonMesh pyramid(int n)
{
    PolygonMesh mesh;
    std::vector<Index> base;
    for (int i = 0; i < n; ++i) {
        const auto [x, y] = on_circle(i, n);
        mesh.positions.emplace_back(0.8 * x, 0.8 * y, -0.6);
        base.push_back(static_cast<Index>(n - 1 - i));
    }
    mesh.positions.emplace_back(0, 0, 1);
    mesh.add_face(base);
    for (int i = 0; i < n; ++i) {
        add(mesh, {i, (i + 1) % n, n});
    }
    return on_unit_sphere(mesh);
}

PolygonMesh bipyramid(int n)
{
    PolygonMesh mesh;
    for (int i = 0; i < n; ++i) {
        const auto [x, y] = on_circle(i, n);
        mesh.positions.emplace_back(x, y, 0);
    }
    mesh.positions.emplace_back(0, 0, 1);
    mesh.positions.emplace_back(0, 0, -1);
    for (int i = 0; i < n; ++i) {
        add(mesh, {i, (i + 1) % n, n});
        add(mesh, {(i + 1) % n, i, n + 1});
    }
    return mesh;
}

PolygonMesh hourglass(int n, int rings)
{
    constexpr double kNeckRadius = 0.05;
    constexpr double kStep = 0.2;
    const double half = 0.5 * kStep * (rings - 1);
    PolygonMesh mesh;
    mesh.positions = {{0, 0, 2 + half}, {0, 0, -2 - half}};
    const auto ring = [&](int count, double radius, double z) {
        const int first = static_cast<int>(mesh.vertex_count());
        for (int i = 0; i < count; ++i) {
            const auto [x, y] = on_circle(i, count);
            mesh.positions.emplace_back(radius * x, radius * y, z);
        }
        return first;
    };
    const int top = ring(n, 1, 1 + half);
    const int bottom = ring(n, 1, -1 - half);
    const int neck = ring(3, kNeckRadius, half);
    for (int k = 1; k < rings; ++k) {
        const int above = neck + 3 * (k - 1);
        const int below = ring(3, kNeckRadius, half - kStep * k);
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3;
            add(mesh, {above + i, below + i, below + j});
            add(mesh, {above + i, below + j, above + j});
        }
    }
    const int last = neck + 3 * (rings - 1);
    for (int i = 0; i < n; ++i) {
        const int j = (i + 1) % n;
        const int s = 3 * i / n;  // of the three vertices that the cone ends at
        const int t = 3 * j / n;
        add(mesh, {0, top + i, top + j});
        add(mesh, {1, bottom + j, bottom + i});
        add(mesh, {top + i, neck + s, top + j});
        add(mesh, {bottom + i, bottom + j, last + s});
        if (s != t) {
            add(mesh, {top + j, neck + s, neck + t});
            add(mesh, {bottom + j, last + t, last + s});
        }
    }
    return mesh;
}

PolygonMesh quad_grid(int n, int m)
{
    return grid(n, m, false, false, [&](int i, int j) {
        return Vec3(static_cast<double>(i) / n, static_cast<double>(j) / m, 0);
    });
}

PolygonMesh grid_disk(int n, int m)
{
    return triangulated(quad_grid(n, m));
}

PolygonMesh hemisphere(int levels)
{
    PolygonMesh mesh;
    mesh.positions = octahedron().positions;
    mesh.positions.pop_back();
    for (int i = 0; i < 4; ++i) {
        add(mesh, {i, (i + 1) % 4, 4});
    }
    for (int i = 0; i < levels; ++i) {
        mesh = on_unit_sphere(subdivided(mesh));
    }
    return mesh;
}

PolygonMesh annulus(int n, int m)
{
    return triangulated(grid(m, n, false, true, [&](int i, int j) {
        const auto [x, y] = on_circle(j, n);
        const double radius = 1 + static_cast<double>(i) / m;
        return Vec3(radius * x, radius * y, 0);
    }));
}

PolygonMesh polygon(int n)
{
    PolygonMesh mesh;
    std::vector<Index> face;
    for (int i = 0; i < n; ++i) {
        const auto [x, y] = on_circle(i, n);
        mesh.positions.emplace_back(x, y, 0);
        face.push_back(static_cast<Index>(i));
    }
    mesh.add_face(face);
    return mesh;
}

PolygonMesh wheel(int n)
{
    PolygonMesh mesh;
    mesh.positions.emplace_back(0, 0, 0);
    for (int i = 0; i < n; ++i) {
        const auto [x, y] = on_circle(i, n);
        mesh.positions.emplace_back(x, y, 0);
        add(mesh, {0, i + 1, (i + 1) % n + 1});
    }
    return mesh;
}

PolygonMesh quad_ring(int n)
{
    return grid(1, n, false, true, [&](int i, int j) {
        const auto [x, y] = on_circle(j, n);
        return Vec3((1 + i) * x, (1 + i) * y, 0);
    });
}

PolygonMesh quad_torus(int n, int m)
{
    return grid(n, m, true, true, [&](int i, int j) {
        const auto [x, y] = on_circle(i, n);
        const auto [r, z] = on_circle(j, m);
        return Vec3((1 + 0.4 * r) * x, (1 + 0.4 * r) * y, 0.4 * z);
    });
}

PolygonMesh torus(int n, int m)
{
    return triangulated(quad_torus(n, m));
}

PolygonMesh slab(int genus, int levels)
{
    const int columns = 2 * genus + 1;
    const auto filled = [&](int i, int j, int k) {
        const bool inside = i >= 0 && i < columns && j >= 0 && j < 3 && k == 0;
        return inside && !(j == 1 && i % 2 == 1);
    };
    // The sides of the filled cubes that no other filled cube shares.
    std::map<std::array<int, 3>, Index> ids;
    PolygonMesh mesh;
    const auto id = [&](const std::array<int, 3>& place) {
        const auto [entry, is_new] = ids.emplace(place, mesh.vertex_count());
        if (is_new) {
            mesh.positions.emplace_back(place[0], place[1], place[2]);
        }
        return entry->second;
    };
    for (int i = 0; i < columns; ++i) {
        for (int j = 0; j < 3; ++j) {
            for (std::size_t axis = 0; filled(i, j, 0) && axis < 3; ++axis) {
                for (const int side : {0, 1}) {
                    std::array<int, 3> neighbour = {i, j, 0};
                    neighbour[axis] += 2 * side - 1;
                    if (filled(neighbour[0], neighbour[1], neighbour[2])) {
                        continue;
                    }
                    std::vector<Index> face;
                    for (const auto& [u, v] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
                        std::array<int, 3> corner = {i, j, 0};
                        corner[axis] += side;
                        corner[(axis + 1) % 3] += side == 1 ? u : v;
                        corner[(axis + 2) % 3] += side == 1 ? v : u;
                        face.push_back(id(corner));
                    }
                    mesh.add_face(face);
                }
            }
        }
    }
    mesh = triangulated(mesh);
    for (int i = 0; i < levels; ++i) {
        mesh = subdivided(mesh);
    }
    return mesh;
}

std::vector<NamedMesh> targets()
{
    return {
        {"tetrahedron", tetrahedron()},
        {"triangulated cube", triangulated(cube())},
        {"octahedron", octahedron()},
        {"icosahedron", icosahedron()},
        {"icosphere", icosphere(3)},
        {"shuffled icosphere", shuffled(icosphere(3), 1)},
        {"bumpy sphere", bumpy_sphere(3, 1)},
        {"another bumpy sphere", bumpy_sphere(4, 2)},
        {"stretched sphere", stretched_sphere(3, {10, 1, 0.3})},
        {"bipyramid", bipyramid(50)},
        {"hull", hull(24, 5)},
        {"grid disk", grid_disk(12, 9)},
        {"hemisphere", hemisphere(3)},
        {"annulus", annulus(24, 6)},
        {"torus", torus(24, 12)},
        {"slab of genus 2", slab(2, 1)},
        {"slab of genus 3", slab(3, 1)},
    };
}

std::vector<NamedMesh> layouts()
{
    return {
        {"tetrahedron", tetrahedron()},
        {"cube", cube()},
        {"octahedron", octahedron()},
        {"icosahedron", icosahedron()},
        {"triangular prism", prism(3)},
        {"hexagonal prism", prism(6)},
        {"pyramid", pyramid(4)},
        {"bipyramid", bipyramid(5)},
        {"hull", hull(16, 3)},
        {"polygon hull", polygon_hull(16, 3)},
        {"another polygon hull", polygon_hull(24, 4)},
        {"pillow of two triangles",
         polygon_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}})},
        {"tetrahedron with a dangling edge",
         polygon_mesh({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}, {0, 0, 0}},
                      {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2, 4, 2}})},
        {"polygon", polygon(5)},
        {"wheel", wheel(6)},
        {"quad grid", quad_grid(3, 2)},
        {"quad ring", quad_ring(5)},
        {"quad torus", quad_torus(3, 3)},
        {"slab of genus 2", slab(2, 0)},
    };
}

}  // namespace layout_embedding::zoo
