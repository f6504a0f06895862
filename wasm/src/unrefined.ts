// An embedding on the target as it is, for those who want no refined mesh.
import type { RefinedMesh, SurfacePoints } from "./types.js";

/**
 * Per target face, the layout face that most of its area belongs to, the lowest of several; -1
 * where most of it lies outside all patches.
 */
export function facePatches({
    positions,
    corners,
    patches,
    triangleFaces,
}: RefinedMesh): Int32Array {
    const faceCount = triangleFaces.reduce((most, face) => Math.max(most, face), -1) + 1;
    const areas = Array.from({ length: faceCount }, () => new Map<number, number>());
    triangleFaces.forEach((face, t) => {
        const patch = patches[t] ?? -1;
        const ofFace = areas[face];
        ofFace?.set(patch, (ofFace.get(patch) ?? 0) + area(positions, corners.subarray(3 * t)));
    });
    return Int32Array.from(areas, (ofFace) => {
        const [best] = [...ofFace].sort(([a, x], [b, y]) => y - x || a - b);
        return best?.[0] ?? -1;
    });
}

function area(positions: Float64Array, [a = 0, b = 0, c = 0]: Uint32Array): number {
    const along = (id: number, axis: number) =>
        (positions[3 * id + axis] ?? 0) - (positions[3 * a + axis] ?? 0);
    const [x, y, z] = [0, 1, 2].map((axis) => {
        const [i, j] = [(axis + 1) % 3, (axis + 2) % 3];
        return along(b, i) * along(c, j) - along(b, j) * along(c, i);
    });
    return Math.hypot(x ?? 0, y ?? 0, z ?? 0) / 2;
}

/**
 * A path (EmbeddedEdge.chain) as points of the target, each in a target face that holds it.
 * `targetCorners`: 3 vertex ids per target face.
 */
export function pathPoints(
    chain: Uint32Array,
    { positions, vertexFaces, vertexBarycentrics }: RefinedMesh,
    targetCorners: Uint32Array,
): SurfacePoints {
    const targetVertices = positions.length / 3 - vertexFaces.length;
    const faces = new Int32Array(chain.length);
    const barycentrics = new Float64Array(3 * chain.length);
    chain.forEach((vertex, i) => {
        if (vertex < targetVertices) {
            const corner = targetCorners.indexOf(vertex);
            faces[i] = Math.floor(corner / 3);
            barycentrics[3 * i + (corner % 3)] = 1;
        } else {
            const k = vertex - targetVertices;
            faces[i] = vertexFaces[k] ?? -1;
            barycentrics.set(vertexBarycentrics.subarray(3 * k, 3 * k + 3), 3 * i);
        }
    });
    return { faces, barycentrics };
}
