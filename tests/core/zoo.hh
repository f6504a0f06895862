#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/error.hh"
#include "mesh/polygon_mesh.hh"
#include "mesh/validation.hh"

/// Meshes that every test runs over; instances.hh makes problems of them. All are oriented
/// counter-clockwise seen from outside (disks and annuli: from +z), their positions use + - * / and
/// square roots alone and are the same on every platform.
namespace layout_embedding::zoo {

// Closed surfaces of genus 0. All but the bumpy, crumpled and stretched ones have their vertices
// on the unit sphere.
PolygonMesh tetrahedron();
/// Six quads.
PolygonMesh cube();
PolygonMesh octahedron();
PolygonMesh icosahedron();
/// The icosahedron, `levels` times subdivided: 10 * 4^levels + 2 vertices.
PolygonMesh icosphere(int levels);
/// A star-shaped sphere with seeded smooth bumps and dents.
PolygonMesh bumpy_sphere(int levels, std::uint64_t seed);
/// A subdivided octahedron, 4^levels * 8 faces, each vertex at a random distance from the centre
/// and the whole stretched along z: rough all over.
PolygonMesh crumpled_sphere(int levels, std::uint64_t seed);
/// A random triangulation of the sphere without parallel edges, whose vertices stand at random
/// points of the unit sphere whatever their neighbours: no shape at all, only lengths.
PolygonMesh random_triangulation(int vertices, std::uint64_t seed);
/// An ellipsoid with the given half axes: long thin triangles.
PolygonMesh stretched_sphere(int levels, const Vec3& axes);
/// Two n-gons joined by n quads.
PolygonMesh prism(int n);
/// An n-gon and n triangles to an apex.
PolygonMesh pyramid(int n);
/// Two apices joined to an n-gon by 2n triangles: both have degree n.
PolygonMesh bipyramid(int n);
/// Two cones of n triangles each, with a cap, joined by a neck of `rings` rings of three vertices.
/// The rims are vertices 2 .. n + 1 above and n + 2 .. 2n + 1 below, in the same order.
PolygonMesh hourglass(int n, int rings);
/// The convex hull of `points` random points of the unit sphere: a triangulation of the sphere
/// with all kinds of degrees. O(points^4).
PolygonMesh hull(int points, std::uint64_t seed);
/// hull() after edges, picked at random, were deleted for as long as all vertices keep a degree of
/// three and all faces different corners: polygons of all sizes.
PolygonMesh polygon_hull(int points, std::uint64_t seed);

// Surfaces with boundary.
/// A flat n by m grid of squares in the unit square, each cut into two triangles.
PolygonMesh grid_disk(int n, int m);
/// The upper half of a subdivided octahedron, on the unit sphere.
PolygonMesh hemisphere(int levels);
/// A flat ring, n squares around and m across, each cut into two triangles.
PolygonMesh annulus(int n, int m);
/// A grid of n by m quads.
PolygonMesh quad_grid(int n, int m);
/// One n-gon.
PolygonMesh polygon(int n);
/// n triangles around an inner vertex, vertex 0.
PolygonMesh wheel(int n);
/// A ring of n quads.
PolygonMesh quad_ring(int n);

// Higher genus.
/// n squares around and m across, each cut into two triangles; n, m >= 3.
PolygonMesh torus(int n, int m);
/// A torus of n by m quads; n, m >= 3.
PolygonMesh quad_torus(int n, int m);
/// A slab with `genus` holes, in triangles, `levels` times subdivided.
PolygonMesh slab(int genus, int levels);

// Tools.
PolygonMesh polygon_mesh(std::vector<Vec3> positions, const std::vector<std::vector<Index>>& faces);
/// Every vertex moved to the unit sphere, in its direction from the origin.
PolygonMesh on_unit_sphere(PolygonMesh mesh);
/// Every face cut into a fan from its first corner.
PolygonMesh triangulated(const PolygonMesh& mesh);
/// Every triangle cut into four at its edges' midpoints; old vertices keep their ids.
PolygonMesh subdivided(const PolygonMesh& triangles);
/// The same surface with vertices and faces in a random order.
PolygonMesh shuffled(const PolygonMesh& mesh, std::uint64_t seed);
/// Every face gets vertices of its own, as in an STL file.
PolygonMesh soup(const PolygonMesh& mesh);

/// `count` different vertices of `target` at random, none on its boundary.
std::vector<Index> random_landmarks(const PolygonMesh& target, Index count, std::uint64_t seed);
/// Per layout vertex, in turn, the vertex of `target` nearest to its position moved by
/// `displacement` in a random direction, not on the boundary and not taken before. With 0 the
/// layout's own embedding on a sphere, the more the harder.
std::vector<Index> displaced_landmarks(const PolygonMesh& layout, const PolygonMesh& target,
                                       double displacement, std::uint64_t seed);

struct NamedMesh {
    std::string name;
    PolygonMesh mesh;
};

/// Small and middle-sized targets of every topology (up to some thousand faces).
std::vector<NamedMesh> targets();
/// Layouts of every topology.
std::vector<NamedMesh> layouts();

/// A mesh with exactly one thing wrong.
struct BrokenMesh {
    std::string name;
    PolygonMesh mesh;
    SurfaceKind kind;
    ErrorCode code;
    /// Words that the message must contain: the place.
    std::string where;
    /// Whether repair_surface() makes a surface of it.
    bool mendable;
};

std::vector<BrokenMesh> broken_meshes();

}  // namespace layout_embedding::zoo
