import { Vector3, type PerspectiveCamera } from "three";
import type { Polylines } from "layout-embedding";
import type { Item } from "../model/state.js";

/** Pixels around the pointer in which something is found. */
const reach = 10;

/** What can be pointed at: points and paths with the surface's normals where they lie. */
export interface Pickable {
    /** 3 coordinates per layout vertex. */
    readonly places: Float32Array;
    /** 3 per place; empty where everything is visible. */
    readonly placeNormals: Float32Array;
    readonly paths: Polylines | null;
}

/**
 * The landmark or path nearest to the pointer. What faces away from the eye does not count.
 * Linear in the number of points.
 */
export function pick(
    { places, placeNormals, paths }: Pickable,
    camera: PerspectiveCamera,
    canvas: HTMLCanvasElement,
    x: number,
    y: number,
): Item | null {
    const { clientWidth, clientHeight } = canvas;
    const point = new Vector3();
    const screen = { x: 0, y: 0, depth: 0 };
    const project = (source: ArrayLike<number>, i: number) => {
        point.set(source[i]!, source[i + 1]!, source[i + 2]);
        screen.depth = point.distanceTo(camera.position);
        point.project(camera);
        screen.x = ((point.x + 1) / 2) * clientWidth;
        screen.y = ((1 - point.y) / 2) * clientHeight;
    };

    let best: Item | null = null;
    let bestDepth = Infinity;
    for (let v = 0; 3 * v < places.length; ++v) {
        if (placeNormals.length > 0) {
            const i = 3 * v;
            const facing =
                placeNormals[i]! * (camera.position.x - places[i]!) +
                placeNormals[i + 1]! * (camera.position.y - places[i + 1]!) +
                placeNormals[i + 2]! * (camera.position.z - places[i + 2]!);
            if (facing < 0) continue;
        }
        project(places, 3 * v);
        if (Math.hypot(screen.x - x, screen.y - y) > reach || screen.depth >= bestDepth) continue;
        best = { kind: "vertex", id: v };
        bestDepth = screen.depth;
    }
    if (best || !paths) return best;

    for (let p = 0; p + 1 < paths.offsets.length; ++p) {
        let from: { x: number; y: number } | null = null;
        for (let i = paths.offsets[p]!; i < paths.offsets[p + 1]!; ++i) {
            project(paths.points, 3 * i);
            const to = { x: screen.x, y: screen.y };
            if (
                from &&
                screen.depth < bestDepth &&
                distanceToSegment(x, y, from, to) <= reach / 2
            ) {
                best = { kind: "edge", id: paths.layoutEdges[p]! };
                bestDepth = screen.depth;
            }
            from = to;
        }
    }
    return best;
}

function distanceToSegment(
    x: number,
    y: number,
    a: { x: number; y: number },
    b: { x: number; y: number },
): number {
    const [dx, dy] = [b.x - a.x, b.y - a.y];
    const squared = dx * dx + dy * dy;
    const t =
        squared > 0 ? Math.max(0, Math.min(1, ((x - a.x) * dx + (y - a.y) * dy) / squared)) : 0;
    return Math.hypot(a.x + t * dx - x, a.y + t * dy - y);
}
