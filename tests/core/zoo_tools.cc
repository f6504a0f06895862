#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "random_draws.hh"
#include "zoo.hh"

namespace layout_embedding::zoo {

using test::random_direction;
using test::shuffle;

namespace {

std::vector<bool> boundary_vertices(const PolygonMesh& mesh)
{
    std::set<std::pair<Index, Index>> directed;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const auto face = mesh.face(f);
        for (std::size_t i = 0; i < face.size(); ++i) {
            directed.emplace(face[i], face[(i + 1) % face.size()]);
        }
    }
    std::vector<bool> boundary(mesh.vertex_count(), false);
    for (const auto& [a, b] : directed) {
        if (directed.count({b, a}) == 0) {
            boundary[a] = boundary[b] = true;
        }
    }
    return boundary;
}

}  // namespace

PolygonMesh polygon_mesh(std::vector<Vec3> positions, const std::vector<std::vector<Index>>& faces)
{
    PolygonMesh mesh;
    mesh.positions = std::move(positions);
    for (const auto& face : faces) {
        mesh.add_face(face);
    }
    return mesh;
}

PolygonMesh on_unit_sphere(PolygonMesh mesh)
{
    for (Vec3& p : mesh.positions) {
        p /= p.norm();
    }
    return mesh;
}

PolygonMesh triangulated(const PolygonMesh& mesh)
{
    PolygonMesh result;
    result.positions = mesh.positions;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const auto face = mesh.face(f);
        for (std::size_t i = 2; i < face.size(); ++i) {
            result.add_face(std::array<Index, 3>{face[0], face[i - 1], face[i]});
        }
    }
    return result;
}

PolygonMesh subdivided(const PolygonMesh& triangles)
{
    PolygonMesh result;
    result.positions = triangles.positions;
    std::map<std::pair<Index, Index>, Index> midpoints;
    const auto midpoint = [&](Index a, Index b) {
        const auto [entry, is_new] = midpoints.emplace(std::minmax(a, b), result.vertex_count());
        if (is_new) {
            result.positions.push_back((triangles.positions[a] + triangles.positions[b]) / 2);
        }
        return entry->second;
    };
    for (Index f = 0; f < triangles.face_count(); ++f) {
        const auto face = triangles.face(f);
        const Index ab = midpoint(face[0], face[1]);
        const Index bc = midpoint(face[1], face[2]);
        const Index ca = midpoint(face[2], face[0]);
        result.add_face(std::array<Index, 3>{face[0], ab, ca});
        result.add_face(std::array<Index, 3>{ab, face[1], bc});
        result.add_face(std::array<Index, 3>{ca, bc, face[2]});
        result.add_face(std::array<Index, 3>{ab, bc, ca});
    }
    return result;
}

PolygonMesh shuffled(const PolygonMesh& mesh, std::uint64_t seed)
{
    Random random(seed);
    std::vector<Index> new_ids(mesh.vertex_count());
    std::iota(new_ids.begin(), new_ids.end(), 0);
    shuffle(new_ids, random);
    std::vector<Index> faces(mesh.face_count());
    std::iota(faces.begin(), faces.end(), 0);
    shuffle(faces, random);
    PolygonMesh result;
    result.positions.resize(mesh.vertex_count());
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        result.positions[new_ids[v]] = mesh.positions[v];
    }
    for (const Index f : faces) {
        std::vector<Index> face;
        for (const Index corner : mesh.face(f)) {
            face.push_back(new_ids[corner]);
        }
        std::rotate(face.begin(),
                    face.begin() + static_cast<std::ptrdiff_t>(random.below(face.size())),
                    face.end());
        result.add_face(face);
    }
    return result;
}

PolygonMesh soup(const PolygonMesh& mesh)
{
    PolygonMesh result;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        std::vector<Index> face;
        for (const Index corner : mesh.face(f)) {
            face.push_back(result.vertex_count());
            result.positions.push_back(mesh.positions[corner]);
        }
        result.add_face(face);
    }
    return result;
}

std::vector<Index> random_landmarks(const PolygonMesh& target, Index count, std::uint64_t seed)
{
    const std::vector<bool> boundary = boundary_vertices(target);
    std::vector<Index> landmarks;
    for (Index v = 0; v < target.vertex_count(); ++v) {
        if (!boundary[v]) {
            landmarks.push_back(v);
        }
    }
    Random random(seed);
    shuffle(landmarks, random);
    landmarks.resize(std::min<std::size_t>(count, landmarks.size()));
    return landmarks;
}

std::vector<Index> displaced_landmarks(const PolygonMesh& layout, const PolygonMesh& target,
                                       double displacement, std::uint64_t seed)
{
    std::vector<bool> taken = boundary_vertices(target);
    Random random(seed);
    std::vector<Index> landmarks;
    for (const Vec3& position : layout.positions) {
        const Vec3 place = position + displacement * random_direction(random);
        Index nearest = kNone;
        double distance = std::numeric_limits<double>::infinity();
        for (Index v = 0; v < target.vertex_count(); ++v) {
            const double d = (target.positions[v] - place).squaredNorm();
            if (!taken[v] && d < distance) {
                nearest = v;
                distance = d;
            }
        }
        if (nearest == kNone) {
            break;  // more layout vertices than the target can hold
        }
        taken[nearest] = true;
        landmarks.push_back(nearest);
    }
    return landmarks;
}

}  // namespace layout_embedding::zoo
