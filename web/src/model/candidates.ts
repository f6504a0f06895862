import type { CandidatePaths } from "layout-embedding";

/** The layout edges that are in each other's way, each conflict with its two or three edges. */
export function conflictsOf({ pairs, triples }: CandidatePaths): readonly (readonly number[])[] {
    const conflicts: number[][] = [];
    for (let i = 0; i < pairs.length; i += 2) conflicts.push([...pairs.subarray(i, i + 2)]);
    for (let i = 0; i < triples.length; i += 3) conflicts.push([...triples.subarray(i, i + 3)]);
    return conflicts;
}

export const edgesInConflict = (candidates: CandidatePaths): ReadonlySet<number> =>
    new Set([...candidates.pairs, ...candidates.triples]);

/** The edges that share a conflict with one, ascending. */
export function opponentsOf(candidates: CandidatePaths, edge: number): readonly number[] {
    const opponents = new Set(
        conflictsOf(candidates)
            .filter((edges) => edges.includes(edge))
            .flat(),
    );
    opponents.delete(edge);
    return [...opponents].sort((a, b) => a - b);
}
