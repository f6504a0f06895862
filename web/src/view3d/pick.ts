import { Vector3, type PerspectiveCamera, type Plane } from "three";
import type { Polylines } from "layout-embedding";
import type { Item } from "../model/state.js";
import type { Dot } from "./dots.js";

/** Pixels around the pointer in which something is found. */
const reach = 10;

/** What can be pointed at. */
export interface Pickable {
    readonly dots: readonly Dot[];
    /** Cosine between normal and line of sight below which a dot is on the far side. */
    readonly horizon: number;
    readonly paths: Polylines | null;
    /** Distance from the eye to the surface under the pointer: what lies behind does not count. */
    readonly surface: number;
    /** What lies on its negative side is cut away; null for nothing. */
    readonly cut: Plane | null;
}

/**
 * The landmark or path nearest to the pointer. What is hidden does not count. Linear in the number
 * of points.
 */
export function pick(
    { dots, horizon, paths, surface, cut }: Pickable,
    slack: number,
    camera: PerspectiveCamera,
    canvas: HTMLCanvasElement,
    x: number,
    y: number,
): Item | null {
    const { clientWidth, clientHeight } = canvas;
    const point = new Vector3();
    const normal = new Vector3();
    const screen = { x: 0, y: 0, depth: 0 };
    const project = () => {
        screen.depth = point.distanceTo(camera.position);
        point.project(camera);
        screen.x = ((point.x + 1) / 2) * clientWidth;
        screen.y = ((1 - point.y) / 2) * clientHeight;
    };

    const isCutAway = () => cut !== null && cut.distanceToPoint(point) < 0;

    let best: Item | null = null;
    let bestDepth = surface + slack;
    for (const dot of dots) {
        point.set(dot.place[0]!, dot.place[1]!, dot.place[2]);
        normal.set(dot.normal[0]!, dot.normal[1]!, dot.normal[2]);
        const sight = camera.position.clone().sub(point).normalize();
        if (normal.dot(sight) < horizon || isCutAway()) continue;
        project();
        if (Math.hypot(screen.x - x, screen.y - y) > reach || screen.depth >= bestDepth) continue;
        best = { kind: "vertex", id: dot.id };
        bestDepth = screen.depth;
    }
    if (best || !paths) return best;

    for (let p = 0; p + 1 < paths.offsets.length; ++p) {
        let from: { x: number; y: number } | null = null;
        for (let i = paths.offsets[p]!; i < paths.offsets[p + 1]!; ++i) {
            point.set(paths.points[3 * i]!, paths.points[3 * i + 1]!, paths.points[3 * i + 2]);
            if (isCutAway()) {
                from = null;
                continue;
            }
            project();
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
