#include "patches/straight_line.hh"

#include <algorithm>

#include "mesh/triangle_mesh.hh"

namespace layout_embedding {
namespace {

/// How near to the ends of an edge a crossing may come.
constexpr double kLeastShare = 1e-6;

TriangleMesh mesh_of(const Parametrisation& map)
{
    PolygonMesh polygons;
    for (const PlanePoint& point : map.points) {
        polygons.positions.emplace_back(point.x(), point.y(), 0);
    }
    for (const auto& corners : map.corners) {
        polygons.add_face(corners);
    }
    return TriangleMesh(polygons);
}

class LineWalk {
public:
    LineWalk(const Patch& patch, const Parametrisation& map, Index from, Index to)
        : map_(map), mesh_(mesh_of(map)), from_(from), to_(to), boundary_(patch.boundary_size())
    {}

    std::optional<std::vector<LineCrossing>> run()
    {
        Index h = first_edge();
        while (h != kNone) {
            crossings_.push_back(
                {TriangleMesh::face_of(h), mesh_.tail(h), mesh_.head(h), share_on(h)});
            const Index opposite = mesh_.opposite(h);
            if (opposite == kNone || crossings_.size() > mesh_.face_count()) {
                return std::nullopt;
            }
            // h runs from the right to the left of the line, and so does the next one.
            const Index apex = mesh_.head(TriangleMesh::next(opposite));
            if (apex == to_) {
                return std::move(crossings_);
            }
            h = is_left(apex) ? TriangleMesh::next(opposite) : TriangleMesh::previous(opposite);
        }
        return joined_ ? std::optional(std::move(crossings_)) : std::nullopt;
    }

private:
    /// The edge opposite to the start in the triangle that the line begins in, as a halfedge of it;
    /// kNone where an edge joins both ends, or there is no such triangle.
    Index first_edge()
    {
        Index found = kNone;
        for (Index h = mesh_.outgoing(from_); h != kNone; h = mesh_.rotated_ccw(h)) {
            const Index edge = TriangleMesh::next(h);
            const Index right = mesh_.tail(edge);
            const Index left = mesh_.head(edge);
            if (right == to_ || left == to_) {
                joined_ = true;
                return kNone;
            }
            if (found == kNone && !is_left(right) && is_left(left)) {
                found = edge;
            }
        }
        return found;
    }

    /// Positive on the left of the line.
    double offset(Index v) const
    {
        return cross(map_.points[to_] - map_.points[from_], map_.points[v] - map_.points[from_]);
    }

    bool is_left(Index v) const
    {
        if (v >= boundary_) {
            return offset(v) > 0;
        }
        // Counter-clockwise from the end to the start.
        return (v + boundary_ - to_) % boundary_ < (from_ + boundary_ - to_) % boundary_;
    }

    double share_on(Index h) const
    {
        const double right = std::min(offset(mesh_.tail(h)), 0.0);
        const double left = std::max(offset(mesh_.head(h)), 0.0);
        const double share = left > right ? -right / (left - right) : 0.5;
        return std::clamp(share, kLeastShare, 1 - kLeastShare);
    }

    const Parametrisation& map_;
    TriangleMesh mesh_;
    Index from_;
    Index to_;
    Index boundary_;
    bool joined_ = false;
    std::vector<LineCrossing> crossings_;
};

}  // namespace

std::optional<std::vector<LineCrossing>> straight_line(const Patch& patch,
                                                       const Parametrisation& map, Index from,
                                                       Index to)
{
    return LineWalk(patch, map, from, to).run();
}

}  // namespace layout_embedding
