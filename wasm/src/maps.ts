// Maps between two targets of one layout, read out of the core. The reference is side 0.
import type { Core, Handle } from "./core.js";
import { LayoutError } from "./errors.js";
import { runToEnd } from "./slices.js";
import type { MapDistortion, SurfaceMap, SurfaceMapOptions, SurfacePoints } from "./types.js";

const sides = ["reference", "target"] as const;

/** Keeps a job's embedding in the core. */
export function keepEmbedding(core: Core, job: Handle): Handle {
    return core.call("boundary_embedding_create", job);
}

/**
 * Maps a kept embedding onto a job's; an aborted signal ends the optimisation. What happens to both
 * meanwhile does not matter.
 */
export async function makeMap(
    core: Core,
    reference: Handle,
    job: Handle,
    options: SurfaceMapOptions,
    isAlive: () => boolean,
): Promise<Handle> {
    const { rounds = 5, seamPasses = 8 } = options;
    for (const [name, value] of Object.entries({ rounds, seamPasses })) {
        if (!(Number.isInteger(value) && value >= 0 && value < 2 ** 31)) {
            throw new LayoutError(
                "invalidOption",
                `${name} is ${String(value)}; give a whole number that is not negative.`,
            );
        }
    }
    const making = core.call("boundary_map_job_create", reference, job, rounds, seamPasses);
    try {
        if (!(await runToEnd(core, "boundary_map_job", making, options, isAlive))) {
            core.call("boundary_map_job_end", making);
            await runToEnd(core, "boundary_map_job", making, {}, isAlive);
        }
        return core.call("boundary_map_job_take", making);
    } finally {
        core.destroy(making);
    }
}

export function readMap(core: Core, map: Handle): SurfaceMap {
    const images = (side: number) => {
        core.call("boundary_map_vertex_images", map, side);
        return shownPoints(core);
    };
    const ids = (name: string, ...args: number[]) => {
        core.call(`boundary_map_overlay_${name}`, map, ...args);
        return core.viewedIds(name === "corners" ? 3 : 1);
    };
    const weights = (side: number) => {
        core.call("boundary_map_overlay_weights", map, side);
        return core.viewedDoubles(3);
    };
    const positions = (side: number) => {
        core.call("boundary_map_overlay_points", map, side);
        core.call("boundary_map_point_positions", map, side);
        return core.viewedDoubles(3);
    };
    core.call("boundary_map_distortion", map);
    const numbers = Array.from(core.viewedDoubles());
    return {
        fromReference: images(0),
        toReference: images(1),
        overlay: {
            corners: ids("corners"),
            patches: ids("patches"),
            referenceFaces: ids("faces", 0),
            targetFaces: ids("faces", 1),
            referenceWeights: weights(0),
            targetWeights: weights(1),
            referencePositions: positions(0),
            targetPositions: positions(1),
        },
        distortion: distortion(numbers.slice(0, 4)),
        firstDistortion: distortion(numbers.slice(4)),
    };
}

function distortion(numbers: number[]): MapDistortion {
    const [meanEnergy = NaN, largestEnergy = NaN, meanConformal = NaN, meanArea = NaN] = numbers;
    return { meanEnergy, largestEnergy, meanConformal, meanArea };
}

/** The images of points of one side under a map. */
export function imagesOf(
    core: Core,
    map: Handle,
    from: (typeof sides)[number],
    points: SurfacePoints,
): SurfacePoints {
    const side = sides.indexOf(from);
    if (side < 0) {
        throw new LayoutError("invalidOption", `points are of the reference or the target.`);
    }
    if (points.barycentrics.length !== 3 * points.faces.length) {
        throw new LayoutError("invalidOption", "there are not 3 coordinates for every point.");
    }
    core.withCopies((copy) =>
        core.call(
            "boundary_map_images",
            map,
            side,
            copy(Int32Array.from(points.faces)),
            copy(Float64Array.from(points.barycentrics)),
            points.faces.length,
        ),
    );
    return shownPoints(core);
}

function shownPoints(core: Core): SurfacePoints {
    core.call("boundary_map_point_faces");
    // kNone, all bits set, becomes -1.
    const faces = new Int32Array(core.viewedIds().buffer);
    core.call("boundary_map_point_barycentrics");
    return { faces, barycentrics: core.viewedDoubles(3) };
}
