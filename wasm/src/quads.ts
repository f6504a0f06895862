// Quad meshes of an embedding, read out of the core.
import type { Core, Handle } from "./core.js";
import { LayoutError } from "./errors.js";
import { runToEnd } from "./slices.js";
import type { QuadMesh, QuadOptions } from "./types.js";

/**
 * Makes a quad mesh of a job's embedding, whatever becomes of the job meanwhile; an aborted signal
 * ends the relaxation.
 */
export async function makeQuads(
    core: Core,
    job: Handle,
    options: QuadOptions,
    isAlive: () => boolean,
): Promise<QuadMesh> {
    const { edgeLength = 0, segments = [], segmentsAs = [], relaxation = 30 } = options;
    if (options.edgeLength !== undefined && !(edgeLength > 0)) {
        throw new LayoutError(
            "invalidOption",
            `edgeLength is ${String(edgeLength)}; give a positive length.`,
        );
    }
    const numbers = [...segments.flat(), ...Array.from(segmentsAs), relaxation];
    if (!numbers.every((number) => Number.isInteger(number) && number >= 0 && number < 2 ** 31)) {
        throw new LayoutError(
            "invalidOption",
            "segments or relaxation hold something that is no whole number; correct the option.",
        );
    }
    const making = core.withCopies((copy) =>
        core.call(
            "boundary_quads_job_create",
            job,
            edgeLength,
            copy(Uint32Array.from(segments.flat())),
            segments.length,
            copy(Uint32Array.from(segmentsAs)),
            segmentsAs.length,
            relaxation,
        ),
    );
    try {
        await runToEnd(core, "boundary_quads_job", making, options, isAlive);
        const mesh = core.call("boundary_quads_job_take", making);
        try {
            return readQuads(core, mesh);
        } finally {
            core.destroy(mesh);
        }
    } finally {
        core.destroy(making);
    }
}

function readQuads(core: Core, mesh: Handle): QuadMesh {
    core.call("boundary_quads_positions", mesh);
    const positions = core.viewedDoubles(3);
    core.call("boundary_quads_corners", mesh);
    const quads = core.viewedIds(4);
    core.call("boundary_quads_faces", mesh);
    const faces = core.viewedIds();
    core.call("boundary_quads_loops", mesh);
    const loops = core.viewedIds(2);
    core.call("boundary_quads_segments", mesh);
    const segments = core.viewedIds();
    const chains: Uint32Array[] = [];
    for (let i = 0; core.test("boundary_quads_chain", mesh, i); ++i) {
        chains.push(core.viewedIds());
    }
    core.call("boundary_quads_statistics", mesh);
    const [
        leastJacobian = 0,
        meanJacobian = 0,
        flipped = 0,
        leastAngle = 0,
        largestAngle = 0,
        angleDeviation = 0,
        leastEdge = 0,
        meanEdge = 0,
        largestEdge = 0,
        subdivided = 0,
        defaultEdgeLength = 0,
    ] = core.viewedDoubles();
    core.call("boundary_quads_write_obj", mesh);
    return {
        positions,
        quads,
        faces,
        chains,
        loops,
        segments,
        subdivided: subdivided !== 0,
        defaultEdgeLength,
        statistics: {
            leastJacobian,
            meanJacobian,
            flipped,
            leastAngle,
            largestAngle,
            angleDeviation,
            leastEdge,
            meanEdge,
            largestEdge,
        },
        obj: core.viewedBytes(),
    };
}
