import type { Polylines } from "layout-embedding";

/** Milliseconds in which paths glide from one shape to another. */
const duration = 450;
/** Points per path on the way. */
const samples = 48;

/**
 * Draws paths on their way from one shape to another, path by path of the same layout edge, and
 * ends with the paths themselves. Returns what ends it early.
 */
export function glide(
    from: Polylines,
    to: Polylines,
    draw: (paths: Polylines) => void,
): () => void {
    const start = resampled(from);
    const end = resampled(to);
    const between = { ...end, points: new Float64Array(end.points.length) };
    const begin = performance.now();
    let frame = requestAnimationFrame(function step(now) {
        const share = Math.min(1, Math.max(0, (now - begin) / duration));
        if (share === 1) {
            draw(to);
            return;
        }
        const eased = share * share * (3 - 2 * share);
        between.points.forEach((_, i) => {
            between.points[i] = (1 - eased) * start.points[i]! + eased * end.points[i]!;
        });
        draw({ ...between });
        frame = requestAnimationFrame(step);
    });
    return () => cancelAnimationFrame(frame);
}

/** Whether both have paths of the same layout edges. */
export const sameEdges = (a: Polylines, b: Polylines): boolean =>
    a.layoutEdges.length === b.layoutEdges.length &&
    a.layoutEdges.every((edge, i) => edge === b.layoutEdges[i]);

/** The paths with as many points each, at even distances. */
function resampled({ offsets, points, layoutEdges }: Polylines): Polylines {
    const count = layoutEdges.length;
    const sampled = new Float64Array(3 * samples * count);
    for (let p = 0; p < count; ++p) {
        const [begin, last] = [offsets[p]!, offsets[p + 1]! - 1];
        const along = new Float64Array(last - begin + 1);
        for (let i = begin; i < last; ++i)
            along[i - begin + 1] = along[i - begin]! + distance(points, i, i + 1);
        let segment = 0;
        for (let s = 0; s < samples; ++s) {
            const wanted = (along.at(-1)! * s) / (samples - 1);
            while (segment < along.length - 2 && along[segment + 1]! < wanted) ++segment;
            const length = along[segment + 1]! - along[segment]!;
            const t = length > 0 ? Math.min(1, (wanted - along[segment]!) / length) : 0;
            const [i, into] = [3 * (begin + segment), 3 * (p * samples + s)];
            for (let c = 0; c < 3; ++c)
                sampled[into + c] = (1 - t) * points[i + c]! + t * points[i + 3 + c]!;
        }
    }
    return {
        offsets: Uint32Array.from({ length: count + 1 }, (_, p) => p * samples),
        points: sampled,
        layoutEdges,
    };
}

function distance(points: Float64Array, i: number, j: number): number {
    return Math.hypot(
        points[3 * i]! - points[3 * j]!,
        points[3 * i + 1]! - points[3 * j + 1]!,
        points[3 * i + 2]! - points[3 * j + 2]!,
    );
}
