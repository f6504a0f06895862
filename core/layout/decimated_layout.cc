#include "layout/decimated_layout.hh"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "base/random.hh"
#include "layout/embedding_problem.hh"
#include "layout/layout.hh"

namespace layout_embedding {
namespace {

/// Edge flips that unblock() may try at a time, and how often it may be asked.
constexpr int kUnblockingTries = 2000;
constexpr Index kMostUnblockings = 200;

std::string counted(std::size_t count, const std::string& noun)
{
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

/// The vertices of each boundary loop, in an order that has the hole on its left.
std::vector<std::vector<Index>> boundary_loops(const TriangleMesh& mesh)
{
    std::vector<std::vector<Index>> loops;
    std::vector<bool> seen(mesh.halfedge_count(), false);
    for (Index start = 0; start < mesh.halfedge_count(); ++start) {
        if (mesh.opposite(start) != kNone || seen[start]) {
            continue;
        }
        loops.emplace_back();
        for (Index h = start; !seen[h]; h = mesh.outgoing(mesh.head(h))) {
            seen[h] = true;
            loops.back().push_back(mesh.tail(h));
        }
        // Along the halfedges the hole is to the right.
        std::reverse(loops.back().begin(), loops.back().end());
    }
    return loops;
}

/// A target on its way to a layout.
class LayoutDecimation {
public:
    LayoutDecimation(const TriangleMesh& target, std::span<const Index> landmarks)
        : target_(target), landmarks_(landmarks), ids_(target.vertex_count(), kNone)
    {
        for (Index i = 0; i < landmarks.size(); ++i) {
            ids_[landmarks[i]] = i;
        }
        for (std::vector<Index>& loop : boundary_loops(target)) {
            const auto on_loop = static_cast<Index>(
                std::count_if(loop.begin(), loop.end(), [&](Index v) { return ids_[v] != kNone; }));
            at_least_ += std::max<Index>(on_loop, 3);
            if (on_loop < 3) {
                open_loops_.push_back(std::move(loop));
            } else {
                ++kept_loops_;
                on_kept_loops_ += on_loop;
            }
        }
    }

    Result<DecimatedLayout> run()
    {
        if (Status enough = check_counts(); !enough) {
            return enough.error();
        }
        if (landmarks_.size() == 3 && target_.euler_characteristic() == 2) {
            return two_triangles();
        }
        const TriangleMesh closed = open_loops_.empty() ? TriangleMesh() : with_cones();
        const TriangleMesh& mesh = open_loops_.empty() ? target_ : closed;
        std::vector<bool> kept(mesh.vertex_count(), false);
        for (const Index v : landmarks_) {
            kept[v] = true;
        }
        std::vector<Index> holes;
        for (Index v = target_.vertex_count(); v < mesh.vertex_count(); ++v) {
            holes.push_back(v);
        }
        const auto wanted = static_cast<Index>(landmarks_.size() + open_loops_.size());
        DecimatedLayout result;
        Decimation decimation(mesh, std::move(kept), holes);
        decimation.run(wanted, DecimationEffort::any_shape);
        Random random(1);
        while (decimation.mesh().vertex_count() > wanted &&
               result.times_unblocked < kMostUnblockings) {
            ++result.times_unblocked;
            decimation.unblock(random, kUnblockingTries);
            decimation.run(wanted, DecimationEffort::any_shape);
        }
        if (decimation.mesh().vertex_count() > wanted) {
            return not_reached(counted(decimation.mesh().vertex_count() - wanted, "vertex") +
                               " too many cannot be removed");
        }
        result.counts = decimation.counts();
        result.mesh = layout_mesh(decimation.mesh());
        return result;
    }

private:
    /// By Euler's formula a triangulation has a given number of edges, and without parallel ones
    /// at most one per pair of vertices. Boundary loops share no vertex.
    Status check_counts() const
    {
        const long loops = target_.boundary_loop_count();
        const long genus = (2 - target_.euler_characteristic() - loops) / 2;
        const auto cones = static_cast<long>(open_loops_.size());
        const auto fits = [&](long landmarks) {
            const long vertices = landmarks + cones;
            const long edges = 3 * vertices - 6 + 6 * genus + 3 * kept_loops_ - on_kept_loops_;
            // The one closed surface of genus 2 that Euler's formula would allow does not exist
            // (Huneke 1978).
            return landmarks >= at_least_ && edges <= vertices * (vertices - 1) / 2 &&
                   !(genus == 2 && loops == 0 && vertices == 9);
        };
        const auto given = static_cast<long>(landmarks_.size());
        const bool closed_sphere = genus == 0 && loops == 0;
        long needed = given;
        while (!closed_sphere && !fits(needed)) {
            ++needed;
        }
        if (needed == given) {
            return {};
        }
        return make_error(
            ErrorCode::tooFewLandmarksForSurface,
            counted(landmarks_.size(), "landmark") + " cannot make a layout of a " +
                "target of genus " + std::to_string(genus) + " with " +
                counted(static_cast<std::size_t>(loops), "boundary loop") +
                ", which takes at least " + std::to_string(needed),
            {{"landmarks", given}, {"needed", needed}, {"genus", genus}, {"boundaryLoops", loops}});
    }

    Error not_reached(const std::string& why) const
    {
        return make_error(ErrorCode::templateNotReached,
                          "no layout on the " + counted(landmarks_.size(), "landmark") +
                              " was found by collapsing edges: " + why,
                          {{"landmarks", static_cast<std::int64_t>(landmarks_.size())}});
    }

    /// The only layout of a sphere with three vertices; a tetrahedron cannot be collapsed to it.
    DecimatedLayout two_triangles() const
    {
        DecimatedLayout result;
        for (const Index v : landmarks_) {
            result.mesh.positions.push_back(target_.position(v));
        }
        result.mesh.add_face(std::array<Index, 3>{0, 1, 2});
        result.mesh.add_face(std::array<Index, 3>{0, 2, 1});
        return result;
    }

    /// The target with a cone over each open loop, its apex in the loop's middle.
    TriangleMesh with_cones() const
    {
        PolygonMesh mesh;
        mesh.positions = target_.positions();
        mesh.corners = target_.corners();
        for (Index f = 0; f < target_.face_count(); ++f) {
            mesh.face_offsets.push_back(3 * f + 3);
        }
        for (const std::vector<Index>& loop : open_loops_) {
            const Index apex = mesh.vertex_count();
            Vec3 middle = Vec3::Zero();
            for (std::size_t i = 0; i < loop.size(); ++i) {
                middle += target_.position(loop[i]) / static_cast<double>(loop.size());
                const std::array<Index, 3> corners{loop[i], loop[(i + 1) % loop.size()], apex};
                mesh.add_face(corners);
            }
            mesh.positions.push_back(middle);
        }
        return TriangleMesh(mesh);
    }

    /// What is left, in landmark order and without cones.
    PolygonMesh layout_mesh(const EditableMesh& mesh) const
    {
        PolygonMesh layout;
        for (const Index v : landmarks_) {
            layout.positions.push_back(target_.position(v));
        }
        for (Index f = 0; f < mesh.face_capacity(); ++f) {
            if (!mesh.has_face(f)) {
                continue;
            }
            std::array<Index, 3> corners{};
            bool inside = true;
            for (Index i = 0; i < 3; ++i) {
                const Index v = mesh.tail(3 * f + i);
                inside = inside && v < target_.vertex_count();
                corners[i] = inside ? ids_[v] : kNone;
            }
            if (inside) {
                layout.add_face(corners);
            }
        }
        return layout;
    }

    const TriangleMesh& target_;
    std::span<const Index> landmarks_;
    /// Per target vertex: its landmark, kNone for the others.
    std::vector<Index> ids_;
    /// Boundary loops with fewer than three landmarks.
    std::vector<std::vector<Index>> open_loops_;
    /// The others, and the landmarks on them.
    long kept_loops_ = 0;
    long on_kept_loops_ = 0;
    /// Landmarks for all loops: three at least, all those on the loop.
    long at_least_ = 0;
};

}  // namespace

Result<DecimatedLayout> decimated_layout(const TriangleMesh& target,
                                         std::span<const Index> landmarks)
{
    if (Status valid = check_landmark_vertices(target, landmarks); !valid) {
        return valid.error();
    }
    if (landmarks.size() < 3) {
        return make_error(ErrorCode::tooFewLandmarks,
                          "a layout cannot have only " + counted(landmarks.size(), "landmark"),
                          {{"landmarks", static_cast<std::int64_t>(landmarks.size())}});
    }
    auto result = LayoutDecimation(target, landmarks).run();
    if (!result) {
        return result;
    }
    // Where holes with few landmarks come close to each other, their loops can meet.
    const auto layout = Layout::from_polygons(result->mesh, "it");
    if (!layout) {
        return make_error(ErrorCode::templateNotReached,
                          "the boundary loops with fewer than three landmarks leave no layout (" +
                              layout.error().message.substr(0, layout.error().message.find(';')) +
                              ")");
    }
    return result;
}

}  // namespace layout_embedding
