// What is done in one call, without a session.
import type { LandmarkInput, LoadOptions, MeshInput } from "./input.js";
import type { SolveOptions } from "./solve.js";

/** What templateLayout() makes a layout of. */
export interface TemplateProblem {
    /** A triangle mesh. */
    target: MeshInput;
    /** Which target vertices the layout has. */
    landmarks: LandmarkInput;
}

/** What mapSurfaces() maps onto each other: two targets of one layout. */
export interface SurfaceMapProblem {
    /** Embedded in both targets. */
    layout: MeshInput;
    /** What is mapped; default landmarks: by proximity. */
    reference: {
        /** A triangle mesh. */
        target: MeshInput;
        /** As for setLandmarks(). */
        landmarks?: LandmarkInput;
    };
    /** What it is mapped to. */
    target: {
        /** A triangle mesh. */
        target: MeshInput;
        /** As for setLandmarks(). */
        landmarks?: LandmarkInput;
    };
}

/** What embed() embeds where. */
export interface EmbedProblem {
    /** Polygons, read for their connectivity. */
    layout: MeshInput;
    /** A triangle mesh. */
    target: MeshInput;
    /** Default: by proximity. */
    landmarks?: LandmarkInput;
}

/**
 * The options of one embedding from beginning to end. Aborted before the search, it is rejected with
 * `cancelled`; after that, it ends with the best embedding so far, however long that is finished.
 */
export interface EmbedOptions extends SolveOptions, LoadOptions {
    signal?: AbortSignal;
}
