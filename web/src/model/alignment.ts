// Brings a layout into the frame of a target, so that its landmarks can be placed by proximity.
import type { LayoutInfo, MeshArrays, TargetInfo } from "layout-embedding";

/** Target vertices that are compared with the layout's; more would only take longer. */
const samples = 1500;
/** How much better another rotation has to fit than none. */
const clearly = 0.7;
/** Beyond this ratio of sizes, or distance of centres in sizes, two meshes are in different frames. */
const farApart = 2.5;

type Points = Float64Array;

interface Frame {
    readonly center: readonly [number, number, number];
    /** Half the diagonal of the bounding box. */
    readonly size: number;
}

function frameOf(points: ArrayLike<number>): Frame {
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < points.length; ++i) {
        low[i % 3] = Math.min(low[i % 3]!, points[i]!);
        high[i % 3] = Math.max(high[i % 3]!, points[i]!);
    }
    const [a, b, c] = low.map((value, axis) => (value + high[axis]!) / 2);
    const size = Math.hypot(...low.map((value, axis) => high[axis]! - value)) / 2;
    return { center: [a!, b!, c!], size: size > 0 ? size : 1 };
}

/** Whether one lies far from the other, or is far larger: then proximity means nothing. */
export function areFarApart(layout: LayoutInfo, target: TargetInfo): boolean {
    const [a, b] = [frameOf(layout.positions), frameOf(target.positions)];
    const ratio = a.size / b.size;
    const distance = Math.hypot(...a.center.map((value, axis) => value - b.center[axis]!));
    return ratio > farApart || ratio < 1 / farApart || distance > Math.max(a.size, b.size);
}

/**
 * The layout moved and scaled into the target's bounding box, and turned by right angles where that
 * clearly fits better: modelling programs do not agree on which way is up.
 */
export function aligned(layout: LayoutInfo, target: TargetInfo): MeshArrays {
    const wanted = frameOf(target.positions);
    const from = frameOf(layout.positions);
    const scale = wanted.size / from.size;
    const stride = 3 * Math.max(1, Math.floor(target.vertexCount / samples));
    const candidates = rotations().map((rotation) => {
        const placed = layout.positions.slice();
        for (let v = 0; v < placed.length; v += 3)
            for (let axis = 0; axis < 3; ++axis) {
                const { of, sign } = rotation[axis]!;
                const offset = layout.positions[v + of]! - from.center[of]!;
                placed[v + axis] = wanted.center[axis]! + sign * scale * offset;
            }
        return { placed, misfit: misfit(placed, target.positions, stride) };
    });
    // The first one turns nothing.
    const [unturned] = candidates;
    const best = candidates.reduce((a, b) => (b.misfit < a.misfit ? b : a));
    const { placed } = best.misfit < clearly * unturned!.misfit ? best : unturned!;
    const { name, corners, offsets } = layout;
    return { name, positions: placed, corners, offsets };
}

/** Where each new axis comes from. */
type Rotation = readonly { readonly of: number; readonly sign: number }[];

/** The 24 rotations that map axes onto axes, the identity first. */
function rotations(): Rotation[] {
    const found: Rotation[] = [];
    for (const [order, parity] of [
        [[0, 1, 2], 1],
        [[1, 2, 0], 1],
        [[2, 0, 1], 1],
        [[0, 2, 1], -1],
        [[2, 1, 0], -1],
        [[1, 0, 2], -1],
    ] as const)
        for (let signs = 0; signs < 8; ++signs) {
            const sign = [0, 1, 2].map((axis) => ((signs >> axis) & 1 ? -1 : 1));
            if (sign[0]! * sign[1]! * sign[2]! * parity > 0)
                found.push(order.map((of, axis) => ({ of, sign: sign[axis]! })));
        }
    return found;
}

/** The sum of squared distances from the points to the nearest of some of the target's vertices. */
function misfit(points: Points, target: Float64Array, stride: number): number {
    let sum = 0;
    for (let v = 0; v < points.length; v += 3) {
        let nearest = Infinity;
        for (let t = 0; t < target.length; t += stride) {
            const [x, y, z] = [
                points[v]! - target[t]!,
                points[v + 1]! - target[t + 1]!,
                points[v + 2]! - target[t + 2]!,
            ];
            nearest = Math.min(nearest, x * x + y * y + z * z);
        }
        sum += nearest;
    }
    return sum;
}
