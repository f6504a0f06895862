// The API in a worker thread: the same results, several jobs at a time, cancel, termination.
import { embed } from "layout-embedding";
import { createWorkerClient, LayoutError, type EmbeddingWorker } from "layout-embedding/worker";
import { afterAll, beforeAll, expect, test } from "vitest";
import { arrays, displacedLandmarks, octahedron, sphere } from "./meshes.js";

const problem = {
    layout: arrays(octahedron),
    target: arrays(sphere(3)),
    landmarks: displacedLandmarks,
};
const large = { layout: arrays(octahedron), target: arrays(sphere(5)) };

let worker: EmbeddingWorker;
beforeAll(async () => {
    worker = await createWorkerClient();
});
afterAll(() => {
    worker.terminate();
});

test("gives_the_results_of_the_calling_thread", async () => {
    const here = await embed(problem);
    const there = await worker.embed(problem);
    expect(there.refined).toEqual(here.refined);
    expect(there.edges).toEqual(here.edges);
    expect(there.exactCost).toBe(here.exactCost);
});

test("leaves_the_callers_arrays_alone", async () => {
    await worker.embed(problem);
    expect(problem.target.positions.length).toBeGreaterThan(0);
});

test("works_on_several_jobs_at_a_time_and_cancels_one_of_them", async () => {
    const abort = new AbortController();
    const cancelled = worker.embed(large, {
        signal: abort.signal,
        slice: { work: 100 },
        onProgress: () => {
            abort.abort();
        },
    });
    const finished = worker.embed(problem);
    expect((await finished).refined).not.toBeNull();
    expect((await cancelled).status).toBe("cancelled");
});

test("can_solve_and_export_again_in_one_session", async () => {
    const session = await worker.createSession();
    const layout = await session.loadLayout(problem.layout);
    expect(layout.edges).toHaveLength(24);
    await session.loadTarget(problem.target);
    await session.setLandmarks(problem.landmarks);
    const first = await session.solve();
    const files = await session.exportFiles();
    const again = await session.exportFiles();
    expect(again).toEqual(files);
    const even = await session.reshape("even", { onProgress: () => undefined });
    expect(even.refined).not.toEqual(first.refined);
    const second = await session.solve();
    expect(second.refined).toEqual(first.refined);
    expect(await session.check({ refined: first.refined!, edges: first.edges })).toEqual([]);
    await session.dispose();
    await expect(session.solve()).rejects.toMatchObject({ code: "disposed" });
});

test("hands_on_errors_with_code_and_details", async () => {
    const session = await worker.createSession();
    await session.loadLayout(problem.layout);
    await session.loadTarget(problem.target);
    const failure = session.setLandmarks([0, 1, 2, 3, 4, 9999]);
    await expect(failure).rejects.toBeInstanceOf(LayoutError);
    await expect(failure).rejects.toMatchObject({ code: "landmarkOutOfRange" });
    const { details } = (await failure.catch(
        (error: unknown) => error as LayoutError,
    )) as LayoutError;
    expect(Object.values(details)).toContain(9999);
    await session.dispose();
});

test("terminated_rejects_what_is_pending_and_what_comes_after", async () => {
    const other = await createWorkerClient();
    const pending = other.embed(large, { slice: { work: 10 } });
    const rejected = expect(pending).rejects.toMatchObject({ code: "workerTerminated" });
    other.terminate();
    await rejected;
    await expect(other.createSession()).rejects.toMatchObject({ code: "workerTerminated" });
});

test("says_that_the_module_could_not_be_loaded", async () => {
    const missing = createWorkerClient({ wasm: new URL("./no.wasm", import.meta.url) });
    await expect(missing).rejects.toMatchObject({ code: "moduleNotLoaded" });
});
