// Points that correspond under a map between two targets, found in the overlay of both.
import type { SurfaceMap, TargetInfo } from "layout-embedding";
import { groupsOf, membersOf, type Groups } from "./groups.js";

export type Side = "a" | "b";
export const otherSide = (side: Side): Side => (side === "a" ? "b" : "a");

/** A point in a face of a target: barycentric coordinates in the order of the face's corners. */
export interface FacePoint {
    readonly face: number;
    readonly weights: readonly [number, number, number];
}

export class Correspondence {
    private readonly finders: Record<Side, OverlayFinder>;

    constructor(private readonly map: SurfaceMap) {
        this.finders = {
            a: new OverlayFinder(map.overlay.referenceFaces, map.overlay.referenceWeights),
            b: new OverlayFinder(map.overlay.targetFaces, map.overlay.targetWeights),
        };
    }

    /** The image of a point of one side on the other one; null where the layout does not reach. */
    image(from: Side, point: FacePoint): FacePoint | null {
        const found = this.finders[from].find(point);
        if (!found) return null;
        return this.finders[otherSide(from)].point(found.triangle, found.shares);
    }

    /** The image of a vertex. */
    imageOfVertex(from: Side, vertex: number): FacePoint | null {
        const { fromReference, toReference } = this.map;
        const { faces, barycentrics } = from === "a" ? fromReference : toReference;
        const face = faces[vertex] ?? -1;
        if (face < 0) return null;
        return { face, weights: three(barycentrics, 3 * vertex) };
    }
}

/** Where a point of a target lies in space; or what else is given per vertex, there. */
export function placeOf(
    {
        positions,
        corners,
    }: { readonly positions: ArrayLike<number>; readonly corners: Uint32Array },
    { face, weights }: FacePoint,
): [number, number, number] {
    const place: [number, number, number] = [0, 0, 0];
    weights.forEach((weight, k) => {
        const v = corners[3 * face + k]!;
        for (let i = 0; i < 3; ++i) place[i]! += weight * positions[3 * v + i]!;
    });
    return place;
}

/** The corner of a point's face that counts most in it. */
export function nearestVertex({ corners }: TargetInfo, { face, weights }: FacePoint): number {
    const corner = weights.indexOf(Math.max(...weights));
    return corners[3 * face + corner]!;
}

/** The overlay triangles of each face of one target. */
class OverlayFinder {
    private readonly triangles: Groups;

    constructor(
        private readonly faces: Uint32Array,
        /** 9 numbers per triangle. */
        private readonly weights: Float64Array,
    ) {
        const faceCount = faces.reduce((most, face) => Math.max(most, face + 1), 0);
        this.triangles = groupsOf(faces, faceCount);
    }

    /** The triangle that holds a point best, and the point's barycentric coordinates there. */
    find({ face, weights }: FacePoint): { triangle: number; shares: number[] } | null {
        let best: { triangle: number; shares: number[] } | null = null;
        let most = -Infinity;
        for (const triangle of membersOf(this.triangles, face)) {
            const shares = this.sharesIn(triangle, weights);
            const least = shares ? Math.min(...shares) : -Infinity;
            if (shares && least > most) [best, most] = [{ triangle, shares }, least];
        }
        if (!best) return null;
        // A point on an edge may be outside by a rounding error.
        const kept = best.shares.map((share) => Math.max(0, share));
        const sum = kept.reduce((a, b) => a + b, 0);
        return { triangle: best.triangle, shares: kept.map((share) => share / sum) };
    }

    point(triangle: number, shares: readonly number[]): FacePoint {
        const mixed = [0, 1, 2].map((i) =>
            shares.reduce(
                (sum, share, k) => sum + share * this.weights[9 * triangle + 3 * k + i]!,
                0,
            ),
        );
        return { face: this.faces[triangle]!, weights: three(mixed, 0) };
    }

    /** Null where the triangle has no area. */
    private sharesIn(triangle: number, at: FacePoint["weights"]): number[] | null {
        const x = (k: number) => this.weights[9 * triangle + 3 * k]!;
        const y = (k: number) => this.weights[9 * triangle + 3 * k + 1]!;
        const area = (ax: number, ay: number, bx: number, by: number) => ax * by - ay * bx;
        const whole = area(x(1) - x(0), y(1) - y(0), x(2) - x(0), y(2) - y(0));
        if (whole === 0) return null;
        const first = area(x(1) - at[0], y(1) - at[1], x(2) - at[0], y(2) - at[1]) / whole;
        const second = area(x(2) - at[0], y(2) - at[1], x(0) - at[0], y(0) - at[1]) / whole;
        return [first, second, 1 - first - second];
    }
}

const three = (from: ArrayLike<number>, at: number): [number, number, number] => [
    from[at]!,
    from[at + 1]!,
    from[at + 2]!,
];
