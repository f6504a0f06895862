import type { MeshArrays } from "layout-embedding";
import { beast } from "./beast.js";
import { knot } from "./knot.js";
import { pebble } from "./pebble.js";
import { flattened, rounded, type Polygons } from "./polygons.js";

/** A layout, a target and landmarks made by the page itself. */
export interface Example {
    /** For links and file names. */
    readonly name: string;
    readonly title: string;
    readonly description: string;
    readonly make: () => {
        readonly layout: MeshArrays;
        readonly target: MeshArrays;
        readonly landmarks: Uint32Array;
    };
}

function arrays(name: string, polygons: Polygons): MeshArrays {
    return {
        name,
        positions: rounded(polygons.positions),
        ...flattened(polygons.faces),
    };
}

function example(
    name: string,
    title: string,
    description: string,
    build: () => { layout: Polygons; target: Polygons; landmarks: number[] },
): Example {
    return {
        name,
        title,
        description,
        make: () => {
            const { layout, target, landmarks } = build();
            return {
                layout: arrays(`${name} layout`, layout),
                target: arrays(`${name} surface`, target),
                landmarks: Uint32Array.from(landmarks),
            };
        },
    };
}

export const examples: readonly Example[] = [
    example("beast", "Beast", "a cage on a smooth animal", beast),
    example("pebble", "Pebble", "a cube, twisted", pebble),
    example("knot", "Knot", "a ring, tied", knot),
];
