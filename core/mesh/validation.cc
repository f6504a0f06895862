#include "mesh/validation.hh"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "mesh/duplicate_faces.hh"
#include "mesh/polygon_halfedges.hh"
#include "mesh/weld.hh"

namespace layout_embedding {
namespace {

constexpr double kLargestCoordinate = 1e60;
constexpr double kSmallestDiagonal = 1e-60;

std::string number(std::size_t n)
{
    return std::to_string(n);
}

std::string corner_list(std::span<const Index> corners)
{
    constexpr std::size_t kShown = 6;
    std::string text;
    for (std::size_t i = 0; i < std::min(corners.size(), kShown); ++i) {
        text += i == 0 ? "" : " ";
        text += number(corners[i]);
    }
    return corners.size() > kShown ? text + " ..." : text;
}

class SurfaceCheck {
public:
    SurfaceCheck(const PolygonMesh& mesh, SurfaceKind kind, std::string_view subject)
        : mesh_(mesh), target_(kind == SurfaceKind::target), subject_(subject)
    {}

    Status run() const
    {
        if (Status status = check_faces(); !status) {
            return status;
        }
        if (Status status = check_finite(); !status) {
            return status;
        }
        if (target_) {
            if (Status status = check_positions(); !status) {
                return status;
            }
        }
        if (Status status = check_unused(); !status) {
            return status;
        }
        if (Status status = check_duplicates(); !status) {
            return status;
        }
        const PolygonHalfedges halfedges(mesh_);
        if (Status status = check_edges(halfedges); !status) {
            return status;
        }
        if (Status status = check_vertices(halfedges); !status) {
            return status;
        }
        return check_components(halfedges);
    }

private:
    Error fail(ErrorCode code, const std::string& what,
               std::vector<std::pair<std::string, std::int64_t>> details = {}) const
    {
        return make_error(code, subject_ + " " + what, std::move(details));
    }

    std::string face_text(Index f) const
    {
        return "face " + number(f) + " (vertices " + corner_list(mesh_.face(f)) + ")";
    }

    Status check_faces() const
    {
        const auto& offsets = mesh_.face_offsets;
        if (offsets.empty() || offsets.front() != 0 || offsets.back() != mesh_.corners.size() ||
            !std::is_sorted(offsets.begin(), offsets.end())) {
            return fail(ErrorCode::indexOutOfRange,
                        "has face offsets that do not lead from 0 to its " +
                            number(mesh_.corners.size()) + " corners in ascending order");
        }
        if (mesh_.face_count() == 0) {
            return fail(ErrorCode::noFaces,
                        "has " + number(mesh_.vertex_count()) + " vertices but no face");
        }
        if (mesh_.face_count() > kMaxFaces) {
            return fail(ErrorCode::tooLarge, "has " + number(mesh_.face_count()) + " faces where " +
                                                 number(kMaxFaces) + " can be numbered");
        }
        for (Index f = 0; f < mesh_.face_count(); ++f) {
            for (const Index v : mesh_.face(f)) {
                if (v >= mesh_.vertex_count()) {
                    return fail(ErrorCode::indexOutOfRange,
                                "has face " + number(f) + " with the vertex " + number(v) + " of " +
                                    number(mesh_.vertex_count()) + " (counted from 0)",
                                {{"face", f}, {"vertex", v}});
                }
            }
        }
        std::vector<Index> sorted;
        for (Index f = 0; f < mesh_.face_count(); ++f) {
            if (Status status = check_corners(f, sorted); !status) {
                return status;
            }
        }
        return check_triangles();
    }

    Status check_corners(Index f, std::vector<Index>& sorted) const
    {
        const auto face = mesh_.face(f);
        if (face.size() < 3) {
            return fail(ErrorCode::degenerateFace,
                        "has face " + number(f) + " with only " + number(face.size()) + " corners",
                        {{"face", f}});
        }
        if (!target_) {
            for (std::size_t i = 0; i < face.size(); ++i) {
                if (face[i] == face[(i + 1) % face.size()]) {
                    return fail(ErrorCode::layoutLoop,
                                "has " + face_text(f) + " with an edge from vertex " +
                                    number(face[i]) + " to itself",
                                {{"face", f}, {"vertex", face[i]}});
                }
            }
            return {};
        }
        sorted.assign(face.begin(), face.end());
        std::sort(sorted.begin(), sorted.end());
        const auto repeated = std::adjacent_find(sorted.begin(), sorted.end());
        if (repeated != sorted.end()) {
            return fail(ErrorCode::degenerateFace,
                        "has " + face_text(f) + " with vertex " + number(*repeated) + " twice",
                        {{"face", f}, {"vertex", *repeated}});
        }
        return {};
    }

    Status check_triangles() const
    {
        for (Index f = 0; target_ && f < mesh_.face_count(); ++f) {
            if (mesh_.face(f).size() != 3) {
                return fail(
                    ErrorCode::notTriangles,
                    "has face " + number(f) + " with " + number(mesh_.face(f).size()) + " corners",
                    {{"face", f}});
            }
        }
        return {};
    }

    Status check_finite() const
    {
        for (Index v = 0; v < mesh_.vertex_count(); ++v) {
            for (int i = 0; i < 3; ++i) {
                const double x = mesh_.positions[v][i];
                if (!std::isfinite(x)) {
                    return fail(ErrorCode::nonFinitePosition,
                                "has vertex " + number(v) + " with a coordinate that is " +
                                    (std::isnan(x) ? "not a number" : "infinite"),
                                {{"vertex", v}});
                }
            }
        }
        return {};
    }

    Status check_positions() const
    {
        double largest = 0;
        Index where = 0;
        for (Index v = 0; v < mesh_.vertex_count(); ++v) {
            const double x = mesh_.positions[v].cwiseAbs().maxCoeff();
            if (x > largest) {
                largest = x;
                where = v;
            }
        }
        if (largest > kLargestCoordinate) {
            return fail(ErrorCode::coordinateTooLarge,
                        "has vertex " + number(where) + " with a coordinate beyond 1e60",
                        {{"vertex", where}});
        }
        Vec3 low = mesh_.positions[mesh_.corners[0]];
        Vec3 high = low;
        for (const Index v : mesh_.corners) {
            low = low.cwiseMin(mesh_.positions[v]);
            high = high.cwiseMax(mesh_.positions[v]);
        }
        // The largest side stands for the diagonal: it cannot underflow.
        if ((high - low).maxCoeff() < kSmallestDiagonal) {
            return fail(ErrorCode::coordinateTooLarge,
                        "is smaller than 1e-60 from vertex " + number(mesh_.corners[0]) +
                            " to the one farthest from it",
                        {{"vertex", mesh_.corners[0]}});
        }
        for (Index f = 0; f < mesh_.face_count(); ++f) {
            const auto face = mesh_.face(f);
            if (has_no_area(mesh_.positions[face[0]], mesh_.positions[face[1]],
                            mesh_.positions[face[2]])) {
                return fail(ErrorCode::degenerateFace, "has " + face_text(f) + " without area",
                            {{"face", f}});
            }
        }
        return {};
    }

    Status check_unused() const
    {
        std::vector<bool> used(mesh_.vertex_count(), false);
        for (const Index v : mesh_.corners) {
            used[v] = true;
        }
        const auto unused = std::count(used.begin(), used.end(), false);
        if (unused == 0) {
            return {};
        }
        const auto first = std::find(used.begin(), used.end(), false) - used.begin();
        return fail(ErrorCode::unusedVertex,
                    "has vertex " + std::to_string(first) + " in no face" +
                        (unused > 1 ? " (" + std::to_string(unused) + " vertices in all)" : ""),
                    {{"vertex", first}});
    }

    Status check_duplicates() const
    {
        const std::vector<std::array<Index, 2>> duplicates = duplicate_faces(mesh_);
        if (duplicates.empty() || (!target_ && mesh_.face_count() == 2 &&
                                   same_direction(mesh_.face(0), mesh_.face(1)) == false)) {
            return {};
        }
        const auto [first, second] = duplicates.front();
        return fail(ErrorCode::duplicateFace,
                    "has faces " + number(first) + " and " + number(second) +
                        " with the same vertices " + corner_list(mesh_.face(first)),
                    {{"face", first}, {"otherFace", second}});
    }

    Status check_edges(const PolygonHalfedges& halfedges) const
    {
        const auto edge_error = [&](ErrorCode code, std::array<Index, 2> pair,
                                    const std::string& what) {
            const Index a = halfedges.tail(pair[0]);
            const Index b = halfedges.head(pair[0]);
            return fail(code,
                        "has the edge from vertex " + number(a) + " to vertex " + number(b) + what,
                        {{"vertex", a},
                         {"otherVertex", b},
                         {"face", halfedges.face(pair[0])},
                         {"otherFace", halfedges.face(pair[1])}});
        };
        if (halfedges.non_manifold()[0] != kNone) {
            return edge_error(ErrorCode::nonManifoldEdge, halfedges.non_manifold(),
                              " with more than two faces, faces " +
                                  number(halfedges.face(halfedges.non_manifold()[0])) + " and " +
                                  number(halfedges.face(halfedges.non_manifold()[1])) +
                                  " among them");
        }
        if (halfedges.inconsistent()[0] != kNone) {
            return edge_error(ErrorCode::inconsistentOrientation, halfedges.inconsistent(),
                              " in the same direction in face " +
                                  number(halfedges.face(halfedges.inconsistent()[0])) +
                                  " and face " +
                                  number(halfedges.face(halfedges.inconsistent()[1])));
        }
        return {};
    }

    /// Every vertex has one fan of faces.
    Status check_vertices(const PolygonHalfedges& halfedges) const
    {
        std::vector<bool> seen(halfedges.count(), false);
        std::vector<Index> fans(mesh_.vertex_count(), 0);
        // A fan turns counter-clockwise from a halfedge that has no face to its right, or is a
        // cycle.
        const auto turn = [&](Index start) {
            ++fans[halfedges.tail(start)];
            for (Index h = start; h != kNone && !seen[h];
                 h = halfedges.opposite(halfedges.previous(h))) {
                seen[h] = true;
            }
        };
        for (Index h = 0; h < halfedges.count(); ++h) {
            if (halfedges.opposite(h) == kNone) {
                turn(h);
            }
        }
        for (Index h = 0; h < halfedges.count(); ++h) {
            if (!seen[h]) {
                turn(h);
            }
        }
        for (Index v = 0; v < mesh_.vertex_count(); ++v) {
            if (fans[v] > 1) {
                return fail(ErrorCode::nonManifoldVertex,
                            "has vertex " + number(v) + " where " + number(fans[v]) +
                                " separate fans of faces meet",
                            {{"vertex", v}});
            }
        }
        return {};
    }

    Status check_components(const PolygonHalfedges& halfedges) const
    {
        const std::vector<Index> components = halfedges.components();
        const Index count = *std::max_element(components.begin(), components.end()) + 1;
        if (target_ && (count > 1 || halfedges.unpaired_count() > 0)) {
            if (Status status = check_coincidence(); !status) {
                return status;
            }
        }
        if (count > 1) {
            const auto other = std::find(components.begin(), components.end(), 1U);
            const Index first = mesh_.face(0)[0];
            const Index second = mesh_.face(static_cast<Index>(other - components.begin()))[0];
            return fail(ErrorCode::severalComponents,
                        "has " + number(count) + " components: no chain of faces joins vertex " +
                            number(first) + " to vertex " + number(second),
                        {{"components", count}, {"vertex", first}, {"otherVertex", second}});
        }
        return {};
    }

    /// Whether there are gaps that welding would close.
    Status check_coincidence() const
    {
        const std::vector<Index> classes = weld_classes(mesh_);
        Index first = kNone;
        Index count = 0;
        for (Index v = 0; v < classes.size(); ++v) {
            if (classes[v] != v) {
                first = std::min(first, v);
                ++count;
            }
        }
        if (count == 0 || !welding_helps(mesh_, classes)) {
            return {};
        }
        return fail(ErrorCode::coincidentVertices,
                    "is cut open between vertices " + number(classes[first]) + " and " +
                        number(first) + " at the same position (" + number(count) +
                        " such vertices in all)",
                    {{"vertex", classes[first]}, {"otherVertex", first}});
    }

    const PolygonMesh& mesh_;
    bool target_;
    std::string subject_;
};

}  // namespace

Status check_surface(const PolygonMesh& mesh, SurfaceKind kind, std::string_view subject)
{
    return SurfaceCheck(mesh, kind, subject).run();
}

bool has_no_area(const Vec3& a, const Vec3& b, const Vec3& c)
{
    Vec3 first = b - a;
    Vec3 second = c - a;
    const double scale = std::max(first.cwiseAbs().maxCoeff(), second.cwiseAbs().maxCoeff());
    if (scale == 0) {
        return true;
    }
    // Scaled, so that the products of a small triangle do not underflow.
    first /= scale;
    second /= scale;
    return first.cross(second) == Vec3::Zero();
}

}  // namespace layout_embedding
