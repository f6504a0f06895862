// What can be done about meshes that are no single oriented surface, where a person agrees to it.
import type { MeshArrays, UncheckedMesh } from "layout-embedding";
import { formatCount, formatWhole } from "./describe.js";

export interface Mended {
    readonly mesh: MeshArrays;
    /** What was done, in a sentence. */
    readonly note: string;
}

/** What helps against an error, by its code: a button's words, and what it does. */
export const mends: Partial<
    Record<string, { readonly label: string; readonly mend: (mesh: UncheckedMesh) => Mended }>
> = {
    severalComponents: { label: "Keep the largest piece", mend: largestPiece },
    inconsistentOrientation: { label: "Turn all faces the same way", mend: turnedAlike },
};

/** The piece with the most faces; its vertices are numbered anew, in their order. */
export function largestPiece({ positions, corners, offsets }: UncheckedMesh): Mended {
    const faceCount = offsets.length - 1;
    const parent = Uint32Array.from({ length: positions.length / 3 }, (_, v) => v);
    const rootOf = (vertex: number): number => {
        let root = vertex;
        while (parent[root] !== root) root = parent[root] = parent[parent[root]!]!;
        return root;
    };
    for (let f = 0; f < faceCount; ++f)
        for (let i = offsets[f]! + 1; i < offsets[f + 1]!; ++i)
            parent[rootOf(corners[i]!)] = rootOf(corners[offsets[f]!]!);
    const faces = new Map<number, number[]>();
    for (let f = 0; f < faceCount; ++f) {
        const root = rootOf(corners[offsets[f]!]!);
        const piece = faces.get(root);
        if (piece) piece.push(f);
        else faces.set(root, [f]);
    }
    const kept = [...faces.values()].reduce((a, b) => (b.length > a.length ? b : a), []);
    const inside = kept.length > 0 ? rootOf(corners[offsets[kept[0]!]!]!) : -1;
    const number = new Int32Array(parent.length).fill(-1);
    const places: number[] = [];
    for (let v = 0; v < parent.length; ++v)
        if (rootOf(v) === inside) {
            number[v] = places.length / 3;
            places.push(positions[3 * v]!, positions[3 * v + 1]!, positions[3 * v + 2]!);
        }
    const keptOffsets = [0];
    const keptCorners: number[] = [];
    for (const f of kept) {
        for (const v of corners.subarray(offsets[f], offsets[f + 1])) keptCorners.push(number[v]!);
        keptOffsets.push(keptCorners.length);
    }
    return {
        mesh: { positions: places, corners: keptCorners, offsets: keptOffsets },
        note:
            `The largest of ${formatCount(faces.size, "piece")} was kept: ` +
            `${formatWhole(kept.length)} of ${formatCount(faceCount, "face")}. ` +
            "Its vertices are numbered anew.",
    };
}

/**
 * The same faces, neighbours turned alike: outwards where the surface is closed, else as most of its
 * faces are. Throws where the surface has one side only.
 */
export function turnedAlike({ positions, corners, offsets }: UncheckedMesh): Mended {
    const faceCount = offsets.length - 1;
    const sides = neighbours(corners, offsets, positions.length / 3);
    const turned = new Int8Array(faceCount).fill(-1);
    let count = 0;
    for (let seed = 0; seed < faceCount; ++seed) {
        if (turned[seed] !== -1) continue;
        const piece = [seed];
        turned[seed] = 0;
        let closed = true;
        for (const f of piece)
            for (let i = offsets[f]!; i < offsets[f + 1]!; ++i) {
                const { other, alike } = sides(i);
                if (other === null) {
                    closed = false;
                    continue;
                }
                const wanted = alike ? turned[f]! : 1 - turned[f]!;
                if (turned[other] === -1) {
                    turned[other] = wanted;
                    piece.push(other);
                } else if (turned[other] !== wanted) {
                    throw new Error(
                        "The faces cannot be turned the same way: the surface has one side only; " +
                            "choose another mesh.",
                    );
                }
            }
        const changed = piece.filter((f) => turned[f] === 1).length;
        const inwards = closed
            ? piece.reduce((sum, f) => sum + (turned[f] ? -1 : 1) * coneOf(f), 0) < 0
            : 2 * changed > piece.length;
        if (inwards) for (const f of piece) turned[f] = 1 - turned[f]!;
        count += inwards ? piece.length - changed : changed;
    }
    const result = corners.slice();
    for (let f = 0; f < faceCount; ++f)
        if (turned[f] === 1) result.subarray(offsets[f]! + 1, offsets[f + 1]).reverse();
    return {
        mesh: { positions, corners: result, offsets },
        note: `${formatWhole(count)} of ${formatCount(faceCount, "face")} were turned.`,
    };

    /** Six times the signed volume of the cone over a face from the origin. */
    function coneOf(face: number): number {
        const at = (i: number) =>
            [0, 1, 2].map((c) => positions[3 * corners[i]! + c]!) as [number, number, number];
        let volume = 0;
        const [ax, ay, az] = at(offsets[face]!);
        for (let i = offsets[face]! + 1; i + 1 < offsets[face + 1]!; ++i) {
            const [bx, by, bz] = at(i);
            const [cx, cy, cz] = at(i + 1);
            volume +=
                ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
        }
        return volume;
    }
}

/**
 * Per corner: the face on the other side of the edge that begins there, and whether both faces run
 * along it in opposite directions, as faces that are turned alike do.
 */
function neighbours(
    corners: Uint32Array,
    offsets: Uint32Array,
    vertexCount: number,
): (corner: number) => { other: number | null; alike: boolean } {
    const faceOf = new Uint32Array(corners.length);
    const next = new Uint32Array(corners.length);
    for (let f = 0; f + 1 < offsets.length; ++f)
        for (let i = offsets[f]!; i < offsets[f + 1]!; ++i) {
            faceOf[i] = f;
            next[i] = i + 1 < offsets[f + 1]! ? i + 1 : offsets[f]!;
        }
    const open = new Map<number, number>();
    const partner = new Int32Array(corners.length).fill(-1);
    for (let i = 0; i < corners.length; ++i) {
        const [a, b] = [corners[i]!, corners[next[i]!]!];
        const key = Math.min(a, b) * vertexCount + Math.max(a, b);
        const waiting = open.get(key);
        if (waiting === undefined) {
            open.set(key, i);
            continue;
        }
        open.delete(key);
        partner[i] = waiting;
        partner[waiting] = i;
    }
    return (corner) => {
        const other = partner[corner]!;
        return other < 0
            ? { other: null, alike: true }
            : { other: faceOf[other]!, alike: corners[other] !== corners[corner] };
    };
}
