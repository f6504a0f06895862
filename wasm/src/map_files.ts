// What is written of a map: the images of vertices as JSON, the overlay as OBJ on either target.
import { jsonBytes } from "./files.js";
import type { SurfaceMap, SurfacePoints } from "./types.js";

/** The version of map.json. */
const fileVersion = 1;

/**
 * The files of a map, by name; the reference is `a`. `texture`: 6 texture coordinates per face of the
 * reference, two for each corner, which go along on both sides.
 */
export function mapFiles(
    map: SurfaceMap,
    texture: Float64Array | null = null,
): Record<"map.json" | "overlay_a.obj" | "overlay_b.obj", Uint8Array> {
    return {
        "map.json": jsonBytes(mapDocument(map)),
        "overlay_a.obj": overlayObj(map, "reference", texture),
        "overlay_b.obj": overlayObj(map, "target", texture),
    };
}

/** map.json: `a` is the reference. */
export function mapDocument(map: SurfaceMap) {
    return {
        version: fileVersion,
        distortion: map.distortion,
        firstDistortion: map.firstDistortion,
        overlayTriangles: map.overlay.patches.length,
        aToB: pointList(map.fromReference),
        bToA: pointList(map.toReference),
    };
}

function pointList({ faces, barycentrics }: SurfacePoints) {
    return Array.from(faces, (face, i) =>
        face < 0
            ? null
            : { face, barycentric: Array.from(barycentrics.subarray(3 * i, 3 * i + 3)) },
    );
}

/**
 * The overlay on one of its targets as OBJ, patches as groups. `texture`: 6 texture coordinates per
 * face of the reference, two for each corner, or null.
 */
export function overlayObj(
    map: SurfaceMap,
    side: "reference" | "target",
    texture: Float64Array | null,
): Uint8Array {
    const { corners, patches, referenceFaces, referenceWeights } = map.overlay;
    const positions =
        side === "reference" ? map.overlay.referencePositions : map.overlay.targetPositions;
    const lines: string[] = [];
    for (let i = 0; i < positions.length; i += 3) {
        lines.push(`v ${positions.subarray(i, i + 3).join(" ")}`);
    }
    const ids = new Map<string, number>();
    const faces: string[] = [];
    let patch = -1;
    for (let t = 0; t < patches.length; ++t) {
        if (patches[t] !== patch) {
            patch = patches[t] ?? -1;
            faces.push(`g patch_${String(patch)}`);
        }
        const words = [0, 1, 2].map((k) => {
            const vertex = String((corners[3 * t + k] ?? 0) + 1);
            if (texture === null) {
                return vertex;
            }
            const weights = referenceWeights.subarray(9 * t + 3 * k, 9 * t + 3 * k + 3);
            const line = `vt ${interpolated(texture, referenceFaces[t] ?? 0, weights).join(" ")}`;
            let id = ids.get(line);
            if (id === undefined) {
                id = ids.size + 1;
                ids.set(line, id);
                lines.push(line);
            }
            return `${vertex}/${String(id)}`;
        });
        faces.push(`f ${words.join(" ")}`);
    }
    return new TextEncoder().encode([...lines, ...faces, ""].join("\n"));
}

function interpolated(texture: Float64Array, face: number, weights: Float64Array): number[] {
    return [0, 1].map((axis) => {
        let sum = 0;
        weights.forEach((weight, k) => {
            sum += weight * (texture[6 * face + 2 * k + axis] ?? 0);
        });
        return sum;
    });
}
