import type { SurfaceMap } from "layout-embedding";

/**
 * Symmetric Dirichlet energy |J|^2 + |J^-1|^2 of each triangle of a map's overlay, both targets
 * scaled to area 1: 4 for an isometry, Infinity where a triangle has no area.
 */
export function triangleEnergies({ overlay }: SurfaceMap): Float64Array {
    const { corners, referencePositions, targetPositions } = overlay;
    const count = corners.length / 3;
    const before = Array.from({ length: count }, (_, t) => gram(corners, referencePositions, t));
    const after = Array.from({ length: count }, (_, t) => gram(corners, targetPositions, t));
    const area = (all: readonly Gram[]) => all.reduce((sum, g) => sum + Math.sqrt(g.squared), 0);
    const ratio = area(after) / area(before);
    return Float64Array.from(before, (p, t) => {
        const q = after[t]!;
        // |J|^2 is the trace of the inverse of one matrix of scalar products times the other.
        const trace = p.vv * q.uu - 2 * p.uv * q.uv + p.uu * q.vv;
        if (p.squared <= 0 || q.squared <= 0) return Infinity;
        return trace / p.squared / ratio + (trace / q.squared) * ratio;
    });
}

/** Scalar products of two sides of a triangle, and the square of twice its area. */
interface Gram {
    readonly uu: number;
    readonly uv: number;
    readonly vv: number;
    readonly squared: number;
}

function gram(corners: Uint32Array, positions: Float64Array, triangle: number): Gram {
    const [a, b, c] = [0, 1, 2].map((k) => 3 * corners[3 * triangle + k]!) as [
        number,
        number,
        number,
    ];
    let [uu, uv, vv] = [0, 0, 0];
    for (let i = 0; i < 3; ++i) {
        const u = positions[b + i]! - positions[a + i]!;
        const v = positions[c + i]! - positions[a + i]!;
        uu += u * u;
        uv += u * v;
        vv += v * v;
    }
    return { uu, uv, vv, squared: Math.max(0, uu * vv - uv * uv) };
}
