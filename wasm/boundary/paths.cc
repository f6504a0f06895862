// Paths to draw: whoever makes some puts them here, and they are read with the views below.
#include "boundary/boundary.hh"

namespace layout_embedding::boundary {

Polylines& drawn_paths()
{
    static Polylines paths;
    return paths;
}

/// Views the points of the paths that were made last, 3 doubles each.
BOUNDARY_EXPORT(boundary_paths_points) std::uint32_t boundary_paths_points()
{
    return guarded(0U, [&] {
        std::vector<double> coordinates;
        coordinates.reserve(3 * drawn_paths().points.size());
        for (const Vec3& point : drawn_paths().points) {
            coordinates.insert(coordinates.end(), {point.x(), point.y(), point.z()});
        }
        set_owned_view(coordinates);
        return 1U;
    });
}

/// Views the first point of each path, and the number of points.
BOUNDARY_EXPORT(boundary_paths_offsets) std::uint32_t boundary_paths_offsets()
{
    set_view(drawn_paths().offsets);
    return 1;
}

/// Views the layout edge of each path.
BOUNDARY_EXPORT(boundary_paths_edges) std::uint32_t boundary_paths_edges()
{
    set_view(drawn_paths().layout_edges);
    return 1;
}

}  // namespace layout_embedding::boundary
