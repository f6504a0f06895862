// Landmarks that are dragged: the paths follow.
#include "apps/landmark_drag.hh"
#include "boundary/boundary.hh"

namespace layout_embedding::boundary {

/// Begins to move the landmark of a layout vertex of a job that has ended with an embedding and
/// has to outlive the drag. Returns the drag's handle.
BOUNDARY_EXPORT(boundary_drag_create)
std::uint32_t boundary_drag_create(std::uint32_t job, std::uint32_t layout_vertex)
{
    return guarded(0U, [&] {
        const EmbedJob& embedding = handles<JobObject>().get(job).job;
        if (embedding.graph() == nullptr || !embedding.result().refined ||
            layout_vertex >= embedding.problem().landmarks.size()) {
            throw InvalidHandle("there is no embedding with such a landmark");
        }
        return handles<LandmarkDrag>().add(std::make_unique<LandmarkDrag>(
            embedding.problem(), *embedding.graph(), embedding.edge_costs(),
            embedding.result().weak, layout_vertex));
    });
}

/// Moves the landmark to a target vertex: 1 if the embedding follows, with its cost in view and its
/// paths to be drawn (paths.cc), 0 if it stays where it was, kFailed where something went wrong.
BOUNDARY_EXPORT(boundary_drag_move)
std::int32_t boundary_drag_move(std::uint32_t handle, std::uint32_t target_vertex)
{
    return guarded(kFailed, [&] {
        LandmarkDrag& drag = handles<LandmarkDrag>().get(handle);
        if (!drag.move_to(target_vertex)) {
            return 0;
        }
        drawn_paths() = drag.paths();
        set_owned_view(std::vector<double>{drag.cost()});
        return 1;
    });
}

}  // namespace layout_embedding::boundary
