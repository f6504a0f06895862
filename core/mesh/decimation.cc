#include "mesh/decimation.hh"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace layout_embedding {
namespace {

/// The weight of distances to removed vertices beside those to their planes: the order where the
/// surface is flat.
constexpr double kVertexWeight = 0.01;
/// Vertices that unblock() looks at, at most.
constexpr std::size_t kMaxBlocked = 16;

/// The positions in a unit box, so that no sum or product of the quadrics gets out of range.
std::vector<Vec3> scaled_points(const std::vector<Vec3>& positions)
{
    Vec3 low = positions[0];
    Vec3 high = low;
    for (const Vec3& p : positions) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    const double size = std::max((high - low).maxCoeff(), std::numeric_limits<double>::min());
    std::vector<Vec3> points;
    points.reserve(positions.size());
    for (const Vec3& p : positions) {
        points.emplace_back((p - low) / size);
    }
    return points;
}

std::vector<Quadric> surface_quadrics(const TriangleMesh& mesh, const std::vector<Vec3>& points)
{
    std::vector<Quadric> quadrics(points.size());
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const auto corners = mesh.face(f);
        const Vec3& a = points[corners[0]];
        const Vec3 normal = (points[corners[1]] - a).cross(points[corners[2]] - a);
        const double length = std::sqrt(normal.dot(normal));
        if (!(length > 0)) {
            continue;
        }
        const Vec3 unit = normal / length;
        const double weight = length / 6;
        for (Index i = 0; i < 3; ++i) {
            quadrics[corners[i]].add_plane(unit, a, weight);
            quadrics[corners[i]].add_point(points[corners[i]], kVertexWeight * weight);
            if (mesh.opposite(3 * f + i) == kNone) {
                // A plane upright on the face.
                const Vec3& tail = points[corners[i]];
                const Index head = corners[(i + 1) % 3];
                const Vec3 edge = points[head] - tail;
                const double squared = edge.dot(edge);
                if (squared > 0) {
                    const Vec3 upright = edge.cross(unit) / std::sqrt(squared);
                    quadrics[corners[i]].add_plane(upright, tail, squared);
                    quadrics[head].add_plane(upright, tail, squared);
                }
            }
        }
    }
    return quadrics;
}

}  // namespace

bool Decimation::Later::operator()(const Entry& a, const Entry& b) const
{
    if (a.level != b.level) {
        return a.level > b.level;
    }
    if (a.cost != b.cost) {
        return a.cost > b.cost;
    }
    if (a.vertex != b.vertex) {
        return a.vertex > b.vertex;
    }
    return a.stamp > b.stamp;
}

Decimation::Decimation(const TriangleMesh& mesh, std::vector<bool> kept,
                       std::span<const Index> holes)
    : mesh_(mesh),
      kept_(std::move(kept)),
      hole_of_(mesh.vertex_count(), kNone),
      points_(scaled_points(mesh.positions())),
      quadrics_(surface_quadrics(mesh, points_)),
      states_(mesh.vertex_count())
{
    kept_.resize(mesh.vertex_count(), false);
    for (const Index hole : holes) {
        mesh_.for_each_neighbour(hole, [&](Index v) {
            if (kept_[v]) {
                hole_of_[v] = hole;
            }
        });
        kept_[hole] = true;
        mesh_.add_hole(hole);
    }
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
        reset(v);
    }
}

void Decimation::run(Index vertex_count, DecimationEffort effort)
{
    while (mesh_.vertex_count() > vertex_count && !queue_.empty() && queue_.top().level <= effort) {
        const Entry entry = queue_.top();
        queue_.pop();
        if (states_[entry.vertex].stamp == entry.stamp) {
            process(entry.vertex);
        }
    }
}

double Decimation::cost(Index v, Index w) const
{
    // Rounding must not make an order of its own below zero.
    return std::max(0.0, quadrics_[v](points_[w]) + quadrics_[w](points_[w]));
}

/// Looks at v as if for the first time: its cheapest collapse, whether possible or not.
void Decimation::reset(Index v)
{
    if (kept_[v]) {
        return;
    }
    State& state = states_[v];
    state.level = DecimationEffort::collapses;
    state.skipped = false;
    state.target = kNone;
    mesh_.for_each_neighbour(v, [&](Index w) {
        const double c = cost(v, w);
        if (state.target == kNone || c < state.cost || (c == state.cost && w < state.target)) {
            state.target = w;
            state.cost = c;
        }
    });
    push(v);
}

void Decimation::push(Index v)
{
    State& state = states_[v];
    ++state.stamp;
    queue_.push({state.cost, v, state.stamp, state.level});
}

/// Removes v, or puts it back into the queue for another way, or leaves it out.
void Decimation::process(Index v)
{
    State& state = states_[v];
    switch (state.level) {
        case DecimationEffort::collapses:
            if (!collapse_somewhere(v)) {
                state.level = DecimationEffort::flips;
                push(v);
            }
            return;
        case DecimationEffort::flips:
            if (star_.find(mesh_, points_, v, false)) {
                remove_with_flips(v);
                ++counts_.after_flips;
            } else {
                state.level = DecimationEffort::any_shape;
                push(v);
            }
            return;
        case DecimationEffort::any_shape:
            if (star_.find(mesh_, points_, v, true)) {
                remove_with_flips(v);
                ++counts_.in_any_shape;
            } else if (mesh_.degree(v) > StarTriangulation::kMaxDegree) {
                collapse_in_any_shape(v);
            } else {
                ++state.stamp;
            }
            return;
    }
}

/// Collapses v into the cheapest neighbour that takes it, or queues it for that one if others come
/// first; false if there is none.
bool Decimation::collapse_somewhere(Index v)
{
    sort_candidates(v);
    State& state = states_[v];
    for (const auto& [c, w] : candidates_) {
        if (!mesh_.can_collapse(v, w) || !keeps_shape(v, w)) {
            continue;
        }
        if (w == state.target) {
            ++counts_.collapses;
            collapse(v, w);
        } else {
            state.target = w;
            state.cost = c;
            state.skipped = true;
            push(v);
        }
        return true;
    }
    state.cost = candidates_.front().first;
    state.skipped = true;
    return false;
}

void Decimation::collapse_in_any_shape(Index v)
{
    sort_candidates(v);
    for (const auto& [c, w] : candidates_) {
        if (mesh_.can_collapse(v, w)) {
            ++counts_.in_any_shape;
            collapse(v, w);
            return;
        }
    }
    ++states_[v].stamp;
}

void Decimation::sort_candidates(Index v)
{
    candidates_.clear();
    mesh_.for_each_neighbour(v, [&](Index w) { candidates_.emplace_back(cost(v, w), w); });
    std::sort(candidates_.begin(), candidates_.end());
}

void Decimation::collapse(Index v, Index w)
{
    mesh_.collapse(v, w);
    quadrics_[w] += quadrics_[v];
    ++states_[v].stamp;
    reset(w);
    ring_.clear();
    mesh_.for_each_neighbour(w, [&](Index u) { ring_.push_back(u); });
    for (const Index u : ring_) {
        if (kept_[u]) {
            continue;
        }
        State& state = states_[u];
        if (state.level != DecimationEffort::collapses || state.skipped || state.target == v ||
            state.target == w) {
            reset(u);
            continue;
        }
        // Only its edge to w is another one; spares vertices of many neighbours a look at all.
        const double c = cost(u, w);
        if (c < state.cost || (c == state.cost && w < state.target)) {
            state.cost = c;
            state.target = w;
            push(u);
        }
    }
}

/// Removes v in the way that star_ has found.
void Decimation::remove_with_flips(Index v)
{
    ring_ = star_.ring();
    star_.apply(mesh_, v);
    ++states_[v].stamp;
    // One of the neighbours inherits.
    Index heir = kNone;
    double least = 0;
    for (const Index u : ring_) {
        const double c = quadrics_[v](points_[u]);
        if (heir == kNone || c < least || (c == least && u < heir)) {
            heir = u;
            least = c;
        }
    }
    quadrics_[heir] += quadrics_[v];
    for (const Index u : ring_) {
        reset(u);
    }
    // To their costs of moving to the heir.
    mesh_.for_each_neighbour(heir, [&](Index u) { reset(u); });
}

/// Whether no face of v turns over or becomes a needle when v moves to w. Faces may stay as bad as
/// they are.
bool Decimation::keeps_shape(Index v, Index w) const
{
    double worst = kNeedle;
    mesh_.for_each_outgoing(v, [&](Index h) {
        worst = std::min(worst, triangle_quality(points_[v], points_[mesh_.head(h)],
                                                 points_[mesh_.tail(EditableMesh::previous(h))]));
    });
    bool fine = true;
    mesh_.for_each_outgoing(v, [&](Index h) {
        const Index a = mesh_.head(h);
        const Index b = mesh_.tail(EditableMesh::previous(h));
        if (!fine || a == w || b == w) {
            return;
        }
        const Vec3 before = (points_[a] - points_[v]).cross(points_[b] - points_[v]);
        const Vec3 after = (points_[a] - points_[w]).cross(points_[b] - points_[w]);
        const double lengths = std::sqrt(before.dot(before)) * std::sqrt(after.dot(after));
        fine = (lengths == 0 || before.dot(after) > kLeastCosine * lengths) &&
               triangle_quality(points_[w], points_[a], points_[b]) >= worst;
    });
    return fine;
}

bool Decimation::unblock(Random& random, int tries)
{
    std::vector<Index> blocked;
    for (Index v = 0; v < mesh_.vertex_capacity() && blocked.size() < kMaxBlocked; ++v) {
        if (mesh_.has_vertex(v) && !kept_[v]) {
            blocked.push_back(v);
        }
    }
    std::vector<Index> halfedges;
    for (Index h = 0; h < 3 * mesh_.face_capacity(); ++h) {
        if (mesh_.has_face(TriangleMesh::face_of(h))) {
            halfedges.push_back(h);
        }
    }
    // Edges between neighbours of a blocked vertex: those beside its star are in the way.
    const auto obstacles = [&] {
        std::int64_t count = 0;
        for (const Index v : blocked) {
            ring_.clear();
            mesh_.for_each_neighbour(v, [&](Index u) { ring_.push_back(u); });
            for (std::size_t i = 0; i < ring_.size(); ++i) {
                for (std::size_t j = i + 1; j < ring_.size(); ++j) {
                    count += mesh_.adjacent(ring_[i], ring_[j]) ? 1 : 0;
                }
            }
        }
        return count;
    };
    std::int64_t least = obstacles();
    bool free = false;
    for (int i = 0; i < tries && !free; ++i) {
        const Index h = halfedges[random.below(halfedges.size())];
        const Index v = mesh_.tail(h);
        const Index w = mesh_.head(h);
        if (hole_of_[v] == w || hole_of_[w] == v || !mesh_.can_flip(h)) {
            continue;
        }
        mesh_.flip(h);
        const std::int64_t now = obstacles();
        // A little worse now and then, to get out of dead ends.
        if (now > least + static_cast<std::int64_t>(random.below(3))) {
            mesh_.flip(EditableMesh::previous(h));
            continue;
        }
        least = now;
        for (const Index u : blocked) {
            free = free || star_.find(mesh_, points_, u, true);
        }
    }
    for (const Index v : blocked) {
        reset(v);
    }
    return free;
}

SimplifiedMesh remaining_mesh(const Decimation& decimation, const std::vector<Vec3>& positions)
{
    const EditableMesh& mesh = decimation.mesh();
    SimplifiedMesh result;
    std::vector<Index> ids(mesh.vertex_capacity(), kNone);
    for (Index v = 0; v < mesh.vertex_capacity(); ++v) {
        if (mesh.has_vertex(v)) {
            ids[v] = static_cast<Index>(result.vertices.size());
            result.vertices.push_back(v);
            result.mesh.positions.push_back(positions[v]);
        }
    }
    for (Index f = 0; f < mesh.face_capacity(); ++f) {
        if (mesh.has_face(f)) {
            const std::array<Index, 3> corners{ids[mesh.tail(3 * f)], ids[mesh.tail(3 * f + 1)],
                                               ids[mesh.tail(3 * f + 2)]};
            result.mesh.add_face(corners);
        }
    }
    return result;
}

SimplifiedMesh simplified(const TriangleMesh& mesh, Index vertex_count, std::vector<bool> kept)
{
    Decimation decimation(mesh, std::move(kept));
    decimation.run(vertex_count, DecimationEffort::flips);
    return remaining_mesh(decimation, mesh.positions());
}

}  // namespace layout_embedding
