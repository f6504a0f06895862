// Quad meshes of the result, as the page shows them.
import type { EmbedResult, QuadMesh, TargetInfo } from "layout-embedding";

/** The quad mesh of the result, and what it is made with. */
export interface QuadState {
    /** Wanted length of edges; null for the package's own. */
    readonly edgeLength: number | null;
    /** Pairs of a layout edge and its number of segments. */
    readonly segments: readonly (readonly [edge: number, segments: number])[];
    readonly mesh: QuadMesh | null;
    /** The result that the mesh belongs to. */
    readonly of: EmbedResult | null;
    /** Whether the mesh has been evened out, or is what the patches gave. */
    readonly isRelaxed: boolean;
    /** What is going on, in words; null for nothing. */
    readonly phase: string | null;
    /** Share of it that is done; null while unknown. */
    readonly progress: number | null;
    /** Why there is no mesh with these settings. */
    readonly error: string | null;
}

export const noQuads: QuadState = {
    edgeLength: null,
    segments: [],
    mesh: null,
    of: null,
    isRelaxed: false,
    phase: null,
    progress: null,
    error: null,
};

/** About the package's own edge length: that of 4000 squares with the area of the target. */
export function guessedEdgeLength({ positions, corners }: TargetInfo): number {
    let twice = 0;
    for (let t = 0; t < corners.length; t += 3) {
        const [a, b, c] = [3 * corners[t]!, 3 * corners[t + 1]!, 3 * corners[t + 2]!];
        const side = (from: number, to: number, axis: number) =>
            positions[to + axis]! - positions[from + axis]!;
        const cross = (i: number, j: number) =>
            side(a, b, i) * side(a, c, j) - side(a, b, j) * side(a, c, i);
        twice += Math.hypot(cross(1, 2), cross(2, 0), cross(0, 1));
    }
    return Math.sqrt(twice / 2 / 4000);
}

/** Layout edges that have the same dual loops, and so the same number of segments. */
export interface LoopGroup {
    readonly edges: readonly number[];
    readonly segments: number;
}

export function loopGroups({ loops, segments, subdivided }: QuadMesh): readonly LoopGroup[] {
    const groups = new Map<string, { edges: number[]; segments: number }>();
    for (let edge = 0; 2 * edge < loops.length; ++edge) {
        const pair = [loops[2 * edge]!, loops[2 * edge + 1]!].sort((a, b) => a - b).join();
        const count = subdivided ? segments[2 * edge]! + segments[2 * edge + 1]! : segments[edge]!;
        const group = groups.get(pair);
        if (group) group.edges.push(edge);
        else groups.set(pair, { edges: [edge], segments: count });
    }
    return [...groups.values()];
}
