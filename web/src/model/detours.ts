import type { EmbedResult } from "layout-embedding";

/** An edge of one embedding, and how many times as long it is as in another. */
export interface Detour {
    readonly edge: number;
    readonly ratio: number;
}

/** Detours shorter than this are no detours to the eye. */
const visible = 1.15;

function ratios(other: EmbedResult, result: EmbedResult): Detour[] {
    return other.edges.map(({ id, length }) => ({
        edge: id,
        ratio: length / (result.edges[id]?.length ?? length),
    }));
}

/** The edge that is relatively longest, compared with the same edge of the result. */
export function longestDetour(other: EmbedResult, result: EmbedResult): Detour | null {
    return ratios(other, result).reduce<Detour | null>(
        (best, one) => (best && best.ratio >= one.ratio ? best : one),
        null,
    );
}

/** The edges that visibly take a longer way than in the result. */
export function visibleDetours(other: EmbedResult, result: EmbedResult): ReadonlySet<number> {
    return new Set(
        ratios(other, result)
            .filter(({ ratio }) => ratio > visible)
            .map(({ edge }) => edge),
    );
}
