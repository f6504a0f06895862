import type { TargetInfo } from "layout-embedding";

/**
 * The landmarks as every reader of landmark files here takes them: one target vertex per line, in
 * the numbers of the target as it was given, before any repair.
 */
export function landmarkFile(ids: Uint32Array, target: TargetInfo): string {
    return `${Array.from(givenIds(ids, target)).join("\n")}\n`;
}

/** Of vertices that a repair has welded, the first one counts. */
function givenIds(ids: Uint32Array, { vertexMap, vertexCount }: TargetInfo): Uint32Array {
    if (!vertexMap) return ids;
    const given = new Uint32Array(vertexCount);
    for (let vertex = vertexMap.length - 1; vertex >= 0; --vertex) {
        const loaded = vertexMap[vertex]!;
        if (loaded >= 0) given[loaded] = vertex;
    }
    return ids.map((loaded) => given[loaded]!);
}
