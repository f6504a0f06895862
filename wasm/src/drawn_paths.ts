// Paths to draw, read out of the core.
import type { Core } from "./core.js";
import type { Polylines } from "./types.js";

/** The paths that the last call made that makes some. */
export function drawnPaths(core: Core): Polylines {
    core.call("boundary_paths_offsets");
    const offsets = core.viewedIds();
    core.call("boundary_paths_points");
    const points = core.viewedDoubles();
    core.call("boundary_paths_edges");
    return { offsets, points, layoutEdges: core.viewedIds() };
}
