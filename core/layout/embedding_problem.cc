#include "layout/embedding_problem.hh"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

namespace layout_embedding {
namespace {

std::string holes_text(long loops)
{
    if (loops == 0) {
        return "no boundary";
    }
    return std::to_string(loops) + (loops == 1 ? " boundary loop" : " boundary loops");
}

/// The genus of a connected oriented surface once its holes are filled.
long genus(long euler_characteristic, long loops)
{
    return (2 - euler_characteristic - loops) / 2;
}

std::string topology_text(long euler_characteristic, long loops)
{
    return "Euler characteristic " + std::to_string(euler_characteristic) + " (genus " +
           std::to_string(genus(euler_characteristic, loops)) + ", " + holes_text(loops) + ")";
}

Status check_topology(const Layout& layout, const TriangleMesh& target)
{
    const long layout_euler = layout.euler_characteristic();
    const long target_euler = target.euler_characteristic();
    const auto layout_loops = static_cast<long>(layout.boundary_loops().size());
    const auto target_loops = static_cast<long>(target.boundary_loop_count());
    if (genus(layout_euler, layout_loops) == genus(target_euler, target_loops) &&
        (target_loops == 0 || target_loops == layout_loops)) {
        return {};
    }
    return make_error(ErrorCode::topologyMismatch,
                      "the layout has " + topology_text(layout_euler, layout_loops) +
                          " but the target has " + topology_text(target_euler, target_loops),
                      {{"layoutEulerCharacteristic", layout_euler},
                       {"layoutBoundaryLoops", layout_loops},
                       {"targetEulerCharacteristic", target_euler},
                       {"targetBoundaryLoops", target_loops}});
}

Status check_landmarks(const Layout& layout, const TriangleMesh& target,
                       const std::vector<Index>& landmarks)
{
    if (landmarks.size() != layout.vertex_count()) {
        return make_error(ErrorCode::landmarkCount,
                          "there are " + std::to_string(landmarks.size()) +
                              " landmarks for a layout of " +
                              std::to_string(layout.vertex_count()) + " vertices",
                          {{"landmarks", static_cast<std::int64_t>(landmarks.size())},
                           {"layoutVertices", layout.vertex_count()}});
    }
    return check_landmark_vertices(target, landmarks);
}

Status check_boundary(const Layout& layout, const TriangleMesh& target,
                      const std::vector<Index>& landmarks)
{
    for (Index v = 0; v < layout.vertex_count(); ++v) {
        if (!layout.is_boundary_vertex(v) && target.is_boundary_vertex(landmarks[v])) {
            return make_error(ErrorCode::landmarkOnBoundary,
                              "landmark " + std::to_string(v) + " is target vertex " +
                                  std::to_string(landmarks[v]) +
                                  " on the boundary of the target, but layout vertex " +
                                  std::to_string(v) + " lies inside the layout",
                              {{"landmark", v}, {"vertex", landmarks[v]}});
        }
    }
    return {};
}

}  // namespace

Status check_landmark_vertices(const TriangleMesh& target, std::span<const Index> landmarks)
{
    for (Index i = 0; i < landmarks.size(); ++i) {
        if (landmarks[i] >= target.vertex_count()) {
            return make_error(ErrorCode::landmarkOutOfRange,
                              "landmark " + std::to_string(i) + " is vertex " +
                                  std::to_string(landmarks[i]) +
                                  " but the target has only vertices 0 to " +
                                  std::to_string(target.vertex_count() - 1),
                              {{"landmark", i}, {"vertex", landmarks[i]}});
        }
    }
    std::vector<Index> order(landmarks.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
        return landmarks[a] != landmarks[b] ? landmarks[a] < landmarks[b] : a < b;
    });
    // The duplicate of the smallest number, so that the message is that of the first line.
    Index first = kNone;
    Index second = kNone;
    for (std::size_t i = 1; i < order.size(); ++i) {
        if (landmarks[order[i]] == landmarks[order[i - 1]] && order[i] < second) {
            first = order[i - 1];
            second = order[i];
        }
    }
    if (second != kNone) {
        return make_error(
            ErrorCode::duplicateLandmark,
            "landmarks " + std::to_string(first) + " and " + std::to_string(second) +
                " are both target vertex " + std::to_string(landmarks[first]),
            {{"landmark", first}, {"otherLandmark", second}, {"vertex", landmarks[first]}});
    }
    return {};
}

Result<EmbeddingProblem> make_problem(std::shared_ptr<const Layout> layout,
                                      std::shared_ptr<const TriangleMesh> target,
                                      std::vector<Index> landmarks)
{
    if (Status status = check_landmarks(*layout, *target, landmarks); !status) {
        return status.error();
    }
    if (landmarks.size() < 3) {
        return make_error(ErrorCode::tooFewLandmarks,
                          "the layout has only " + std::to_string(landmarks.size()) + " vertices",
                          {{"layoutVertices", layout->vertex_count()}});
    }
    if (Status status = check_topology(*layout, *target); !status) {
        return status.error();
    }
    if (Status status = check_boundary(*layout, *target, landmarks); !status) {
        return status.error();
    }
    return EmbeddingProblem{std::move(layout), std::move(target), std::move(landmarks)};
}

}  // namespace layout_embedding
