// A landmark that is dragged while the last embedding follows.
import type { Core, Handle } from "./core.js";
import { drawnPaths } from "./drawn_paths.js";
import type { DraggedPaths } from "./types.js";

/** The drag of one landmark of one job, which has to outlive it. */
export class LandmarkDrag {
    private readonly handle: Handle;

    constructor(
        private readonly core: Core,
        job: Handle,
        readonly landmark: number,
    ) {
        this.handle = core.call("boundary_drag_create", job, landmark);
    }

    /** Null where the embedding does not follow; it then stays where it was. */
    moveTo(vertex: number): DraggedPaths | null {
        const { core } = this;
        if (core.count("boundary_drag_move", this.handle, vertex) === 0) {
            return null;
        }
        const [cost = Infinity] = core.viewedDoubles();
        return { cost, paths: drawnPaths(core) };
    }

    end(): void {
        this.core.destroy(this.handle);
    }
}
