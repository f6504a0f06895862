// Hands a claimed embedding to the core's checker. Shapes are checked here; whether the ids make
// sense is the checker's business.
import type { Core, Handle } from "./core.js";
import { javaScriptError } from "./errors.js";
import { idArray } from "./mesh.js";
import type { EmbeddingClaim, Violation } from "./types.js";
import { flattened, flattenedWeakPaths } from "./weak_paths.js";

/** The claim inside the core; the caller destroys it. */
export function claimInCore(core: Core, claim: EmbeddingClaim): Handle {
    const arrays = claimArrays(claim);
    const check = core.call("boundary_check_create");
    try {
        core.withCopies((copy) => {
            core.call(
                "boundary_check_set_vertices",
                check,
                copy(arrays.positions),
                arrays.positions.length / 3,
                copy(arrays.vertexFaces),
                copy(arrays.barycentrics),
                arrays.vertexFaces.length,
            );
        });
        core.withCopies((copy) => {
            core.call(
                "boundary_check_set_triangles",
                check,
                copy(arrays.corners),
                copy(arrays.triangleFaces),
                copy(arrays.patches),
                arrays.triangleFaces.length,
            );
        });
        core.withCopies((copy) => {
            core.call(
                "boundary_check_set_chains",
                check,
                copy(arrays.layoutEdges),
                copy(arrays.chains.items),
                copy(arrays.chains.offsets),
                arrays.count,
            );
            core.call(
                "boundary_check_set_weak_paths",
                check,
                copy(arrays.weakPaths.items),
                copy(arrays.weakPaths.offsets),
                arrays.count,
            );
        });
        return check;
    } catch (reason) {
        core.destroy(check);
        throw reason;
    }
}

export function checkClaim(
    core: Core,
    layoutMesh: Handle,
    targetMesh: Handle,
    landmarks: Uint32Array,
    claim: EmbeddingClaim,
): Violation[] {
    const check = claimInCore(core, claim);
    try {
        const count = core.withCopies((copy) =>
            core.count(
                "boundary_check_run",
                check,
                layoutMesh,
                targetMesh,
                copy(landmarks),
                landmarks.length,
            ),
        );
        return Array.from({ length: count }, (_, i) => {
            core.call("boundary_check_violation_code", check, i);
            const code = core.viewedText();
            core.call("boundary_check_violation_message", check, i);
            return { code, message: core.viewedText() };
        });
    } finally {
        core.destroy(check);
    }
}

/** The claim in flat arrays of fitting sizes; throws invalidInput. */
function claimArrays(claim: EmbeddingClaim) {
    const { refined, edges } = claim;
    const ids = (values: ArrayLike<number>, what: string) =>
        idArray(values, (place, value) =>
            javaScriptError("invalidInput", `${what} ${String(place)} is ${String(value)}, no id`),
        );
    const triangles = refined.triangleFaces.length;
    const newVertices = refined.vertexFaces.length;
    const sizes: [string, number, number][] = [
        ["corners", refined.corners.length, 3 * triangles],
        ["patches", refined.patches.length, triangles],
        ["vertexBarycentrics", refined.vertexBarycentrics.length, 3 * newVertices],
        ["positions", refined.positions.length % 3, 0],
    ];
    for (const [name, length, wanted] of sizes) {
        if (length !== wanted) {
            throw javaScriptError("invalidInput", `the refined mesh has ${name} of a wrong length`);
        }
    }
    return {
        count: edges.length,
        positions: Float64Array.from(refined.positions),
        corners: ids(refined.corners, "corner"),
        triangleFaces: ids(refined.triangleFaces, "triangle face"),
        // -1, outside all layout faces, becomes kNone.
        patches: Uint32Array.from(refined.patches, (patch) => patch >>> 0),
        vertexFaces: ids(refined.vertexFaces, "vertex face"),
        barycentrics: Float64Array.from(refined.vertexBarycentrics),
        layoutEdges: ids(
            edges.flatMap((edge) => edge.layoutEdge),
            "layout vertex",
        ),
        chains: flattened(
            edges.map((edge) => ids(edge.chain, "chain vertex")),
            1,
        ),
        weakPaths: flattenedWeakPaths(
            edges.map((edge) => edge.weakPath),
            (edge) =>
                javaScriptError(
                    "invalidInput",
                    `the weak path of edge ${String(edge)} has a point without 1, 2 or 3 target vertices`,
                ),
        ),
    };
}
