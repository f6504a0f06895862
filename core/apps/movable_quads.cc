#include "apps/movable_quads.hh"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "apps/quad_statistics.hh"

namespace layout_embedding {

MovableQuads::MovableQuads(const TriangleMesh& target, std::vector<bool> fixed, QuadMesh& mesh)
    : target_(target), fixed_(std::move(fixed)), mesh_(mesh)
{
    for (Index face = 0; face < target.face_count(); ++face) {
        normals_.push_back(face_normal(target, face));
    }
    offsets_.assign(mesh.positions.size() + 1, 0);
    for (const auto& quad : mesh.quads) {
        for (const Index v : quad) {
            ++offsets_[v + 1];
        }
    }
    for (std::size_t v = 1; v < offsets_.size(); ++v) {
        offsets_[v] += offsets_[v - 1];
    }
    quads_.resize(offsets_.back());
    std::vector<Index> ends(offsets_.begin(), offsets_.end() - 1);
    for (Index q = 0; q < mesh.quads.size(); ++q) {
        for (const Index v : mesh.quads[q]) {
            quads_[ends[v]++] = q;
        }
    }
    for (Index v = 0; v < mesh.positions.size(); ++v) {
        if (!fixed_[v]) {
            free_.push_back(v);
        }
    }
    around_free_ = quads_around(free_);
}

std::vector<Index> MovableQuads::quads_around(const std::vector<Index>& vertices) const
{
    std::set<Index> found;
    for (const Index v : vertices) {
        found.insert(quads_.begin() + offsets_[v], quads_.begin() + offsets_[v + 1]);
    }
    return {found.begin(), found.end()};
}

std::vector<Index> MovableQuads::free_vertices_around(Index quad, int rings) const
{
    std::set<Index> found(mesh_.quads[quad].begin(), mesh_.quads[quad].end());
    for (int ring = 1; ring < rings; ++ring) {
        for (const Index q : quads_around({found.begin(), found.end()})) {
            found.insert(mesh_.quads[q].begin(), mesh_.quads[q].end());
        }
    }
    std::vector<Index> free;
    std::copy_if(found.begin(), found.end(), std::back_inserter(free),
                 [&](Index v) { return !fixed_[v]; });
    return free;
}

void MovableQuads::mark_around(Index v, std::vector<bool>& marks) const
{
    for (const Index q : quads_at(v)) {
        for (const Index w : mesh_.quads[q]) {
            marks[w] = true;
        }
    }
}

std::array<Vec3, 4> MovableQuads::corners(const std::array<Index, 4>& quad) const
{
    return {mesh_.positions[quad[0]], mesh_.positions[quad[1]], mesh_.positions[quad[2]],
            mesh_.positions[quad[3]]};
}

Vec3 MovableQuads::up(const std::array<Index, 4>& quad) const
{
    Vec3 sum(0, 0, 0);
    for (const Index corner : quad) {
        sum += normal(corner);
    }
    return sum;
}

Vec3 MovableQuads::mean_around(Index v) const
{
    Vec3 sum(0, 0, 0);
    for (const Index q : quads_at(v)) {
        const auto& quad = mesh_.quads[q];
        const auto at =
            static_cast<std::size_t>(std::find(quad.begin(), quad.end(), v) - quad.begin());
        sum += mesh_.positions[quad[(at + 1) % 4]] + mesh_.positions[quad[(at + 3) % 4]];
    }
    return sum / (2.0 * static_cast<double>(quads_at(v).size()));
}

double MovableQuads::jacobian(Index q) const
{
    const auto& quad = mesh_.quads[q];
    return scaled_jacobian(corners(quad), up(quad));
}

Index MovableQuads::flipped_quads() const
{
    Index count = 0;
    for (Index q = 0; q < mesh_.quads.size(); ++q) {
        count += is_flipped(q) ? 1 : 0;
    }
    return count;
}

bool MovableQuads::has_quads_up_to(double jacobian) const
{
    for (Index q = 0; q < mesh_.quads.size(); ++q) {
        if (!(this->jacobian(q) > jacobian)) {
            return true;
        }
    }
    return false;
}

double MovableQuads::quality(Index v) const
{
    double least = 1;
    for (const Index q : quads_at(v)) {
        least = std::min(least, jacobian(q));
    }
    return least;
}

Index MovableQuads::flipped_around(Index v, double least) const
{
    Index count = 0;
    for (const Index q : quads_at(v)) {
        count += jacobian(q) > least ? 0 : 1;
    }
    return count;
}

double MovableQuads::distortion(Index v, double least_cosine) const
{
    constexpr double kSmall = 5e-4;
    double sum = 0;
    for (const Index q : quads_at(v)) {
        const auto& quad = mesh_.quads[q];
        const std::array<Vec3, 4> c = corners(quad);
        Vec3 normal = quad_normal(c, up(quad), least_cosine);
        normal /= std::max(normal.norm(), 1e-300);
        for (std::size_t i = 0; i < 4; ++i) {
            const Vec3 a = c[(i + 1) % 4] - c[i];
            const Vec3 b = c[(i + 3) % 4] - c[i];
            const double d = a.cross(b).dot(normal);
            const double squares = a.squaredNorm() + b.squaredNorm();
            const double e = kSmall * squares;
            sum += squares / std::max(d + std::sqrt(d * d + e * e), 1e-300);
        }
    }
    return sum;
}

void MovableQuads::put(Index v, const Place& place)
{
    mesh_.points[v] = place.point;
    mesh_.positions[v] = place.position;
}

void MovableQuads::walk(Index v, const SurfacePoint& from, const Vec3& goal)
{
    mesh_.points[v] = walk_to_nearest(target_, from, goal);
    mesh_.positions[v] = position_of(target_, mesh_.points[v]);
}

void MovableQuads::restore(const Places& places)
{
    mesh_.points = places.points;
    mesh_.positions = places.positions;
}

void MovableQuads::unfold(std::span<const Index> vertices, std::span<const Index> quads,
                          const UnfoldingMeasure& measure)
{
    unfold_quads(target_, normals_, vertices, quads, measure, mesh_);
}

}  // namespace layout_embedding
