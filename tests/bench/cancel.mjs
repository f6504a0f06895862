// How long calls in a worker take from their abort until they are settled, by the clock: an abort in
// every kind of call and in every phase of an embedding, on a target of half a million triangles, or
// a smaller one for what takes long on any.
//
//   node tests/bench/cancel.mjs
import { pathToFileURL } from "node:url";
import { CancelledError, createWorkerClient } from "layout-embedding/worker";
import { nearestVertices, randomDirections, sphere, withBumps } from "./generate.mjs";

const arrays = ({ positions, faces }) => ({
    positions: Float64Array.from(positions.flat()),
    corners: Uint32Array.from(faces.flat()),
});
const octahedron = {
    positions: [1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1],
    corners: [0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5],
};

/** A target of 20 n^2 triangles, with landmarks anywhere. */
function problem(n, seed) {
    const mesh = sphere(n);
    const positions = withBumps(mesh.positions, seed);
    return {
        target: arrays({ ...mesh, positions }),
        landmarks: nearestVertices(mesh.positions, randomDirections(6, seed)),
    };
}

/**
 * Milliseconds from the abort of a call to its end. `call` gets a signal and a function that aborts;
 * without `atOnce` it is to call this one. What is late is waited for, and must be there if `isKept`.
 */
async function settled(call, { atOnce = 0, isKept = false } = {}) {
    const controller = new AbortController();
    let start = null;
    const abort = () => {
        start ??= performance.now();
        controller.abort();
    };
    const timer = atOnce > 0 ? setTimeout(abort, atOnce) : undefined;
    let result = null;
    let late = null;
    try {
        result = await call(controller.signal, abort);
    } catch (error) {
        if (!(error instanceof CancelledError)) throw error;
        late = error.late;
    }
    const milliseconds = start === null ? NaN : performance.now() - start;
    clearTimeout(timer);
    result ??= await late?.catch(() => null);
    if (Number.isNaN(milliseconds)) throw new Error("a call ended before it was aborted");
    if (isKept && (result ?? null) === null) throw new Error("the best result was lost");
    return milliseconds;
}

/** One { name, value } per kind of call, in milliseconds. */
export async function cancelTimes() {
    const cases = [];
    const add = async (name, measured) => cases.push({ name, value: await measured });
    const worker = await createWorkerClient();
    const session = await worker.createSession();
    await session.loadLayout(octahedron);
    const large = problem(160, 1);
    const load = (signal) => session.loadTarget(large.target, { signal });
    await add("load", settled(load, { atOnce: 20 }));
    await session.loadTarget(large.target);
    await session.setLandmarks(large.landmarks);
    const solve = (phase) => (signal, abort) =>
        session.solve({
            gap: 0,
            workLimit: 3e6,
            signal,
            onProgress: (progress) => {
                if (progress.phase === phase && (phase !== "search" || progress.cost < Infinity))
                    abort();
            },
        });
    await add("prepare", settled(solve("prepare"), { atOnce: 5 }));
    for (const phase of ["search", "realise", "check"]) {
        await add(phase, settled(solve(phase), { isKept: true }));
    }
    await session.solve({ workLimit: 3e6 });
    const fair = (signal) => session.reshape("fair", { signal });
    await add("reshape", settled(fair, { atOnce: 100, isKept: true }));
    const quads = (signal) => session.quads({ signal });
    await add("quads", settled(quads, { atOnce: 200, isKept: true }));
    const template = (signal) => session.templateLayout(large.landmarks, { signal });
    await add("template", settled(template, { atOnce: 100 }));

    const [one, other] = [problem(24, 1), problem(24, 2)];
    await session.loadTarget(one.target);
    await session.setLandmarks(one.landmarks);
    await session.solve();
    await session.setReference();
    await session.loadTarget(other.target);
    await session.setLandmarks(other.landmarks);
    await session.solve();
    const map = (signal) => session.mapFromReference({ signal });
    await add("map", settled(map, { atOnce: 100, isKept: true }));
    worker.terminate();
    return cases;
}

if (import.meta.url === pathToFileURL(process.argv[1]).href) {
    for (const { name, value } of await cancelTimes()) {
        console.log(`${name.padEnd(10)} ${value.toFixed(1)} ms`);
    }
}
