// The API in a worker thread: the same results, several jobs at a time, cancel, termination.
import { embed } from "layout-embedding";
import { createWorkerClient, LayoutError, type EmbeddingWorker } from "layout-embedding/worker";
import { afterAll, beforeAll, expect, test } from "vitest";
import { arrays, creased, displacedLandmarks, octahedron, sphere } from "./meshes.js";

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

/** How much of a path lies on the edges of the octahedron, which are in the planes of the axes. */
function lengthOnEdges(path: Float64Array): number {
    let sum = 0;
    for (let i = 3; i < path.length; i += 3) {
        const [a, b] = [path.subarray(i - 3, i), path.subarray(i, i + 3)];
        if (a.some((x, axis) => Math.abs(x) + Math.abs(b[axis]!) < 1e-9)) {
            sum += Math.hypot(...a.map((x, axis) => b[axis]! - x));
        }
    }
    return sum;
}

test("an_embedding_is_taken_over_by_another_session_as_it_is", async () => {
    const load = async () => {
        const session = await worker.createSession();
        await session.loadLayout(arrays(octahedron));
        await session.loadTarget(arrays(sphere(3)));
        await session.setLandmarks(displacedLandmarks);
        return session;
    };
    const first = await load();
    const found = await first.solve({ gap: 0 });
    const second = await load();
    const taken = await second.solve({ given: found.edges });
    expect(taken).toMatchObject({ status: "feasible", gap: 1, exactCost: found.exactCost });
    expect(taken.counters).toMatchObject({ searches: 0, expansions: 0 });
    expect(taken.refined).toEqual(found.refined);
    expect(taken.edges).toEqual(found.edges);
    // Two paths that run where others do.
    const [a, b] = [found.edges[0]!, found.edges[1]!];
    const wrong = found.edges.map((edge) => (edge === b ? a : edge));
    await expect(second.solve({ given: wrong })).rejects.toMatchObject({ code: "invalidPath" });
    await expect(
        second.solve({ given: found.edges, excluded: [found.edges] }),
    ).rejects.toMatchObject({ code: "invalidOption" });
    await Promise.all([first.dispose(), second.dispose()]);
});

test("paths_that_follow_a_dragged_landmark_stay_on_the_sharp_edges_of_the_solve", async () => {
    const session = await worker.createSession();
    await session.loadLayout(problem.layout);
    await session.loadTarget(arrays(creased(3)));
    const options = { metric: { featureDiscount: 0.9 }, gap: 0, doubts: false };
    await session.setLandmarks(displacedLandmarks);
    await session.solve(options);
    const place = 42;
    const dragged = await session.dragLandmark(0, place);
    if (!dragged) throw new Error("no embedding follows");
    await session.setLandmarks([place, ...displacedLandmarks.slice(1)]);
    const { cost, refined, edges } = await session.solve(options);
    // Here it follows into the best embedding, so that the paths can be compared one by one.
    expect(dragged.cost).toBeCloseTo(cost, 9);
    const { points, offsets } = dragged.paths;
    let sum = 0;
    edges.forEach(({ chain }, i) => {
        const solved = Array.from(chain).flatMap((vertex) =>
            Array.from(refined!.positions.subarray(3 * vertex, 3 * vertex + 3)),
        );
        const onEdges = lengthOnEdges(points.subarray(3 * offsets[i]!, 3 * offsets[i + 1]!));
        expect(onEdges).toBeCloseTo(lengthOnEdges(Float64Array.from(solved)), 6);
        sum += onEdges;
    });
    expect(sum).toBeGreaterThan(5);
    await session.dispose();
});

test("shows_candidate_paths_and_has_an_embedding_follow_a_dragged_landmark", async () => {
    const session = await worker.createSession();
    await session.loadLayout(problem.layout);
    const target = await session.loadTarget(problem.target);
    const { landmarks } = await session.setLandmarks(problem.landmarks);
    await expect(session.candidatePaths()).rejects.toMatchObject({ code: "nothingToExport" });
    await expect(session.dragLandmark(0, 1)).rejects.toMatchObject({ code: "nothingToExport" });
    const best = await session.solve({ gap: 0 });

    const { lengths, paths, pairs, triples } = await session.candidatePaths();
    expect([...paths.layoutEdges]).toEqual(best.edges.map(({ id }) => id));
    for (const { id, cost } of best.edges) expect(lengths[id]).toBeLessThanOrEqual(cost + 1e-12);
    const sum = lengths.reduce((total, length) => total + length, 0);
    // Without a conflict they are the embedding.
    expect(sum < best.cost - 1e-9).toBe(pairs.length + triples.length > 0);

    // To the far corner of a triangle at the landmark.
    const taken = new Set(landmarks);
    const corner = target.corners.indexOf(landmarks[0]!);
    const near = [1, 2].map(
        (step) => target.corners[corner - (corner % 3) + ((corner + step) % 3)]!,
    );
    const place = near.find((vertex) => !taken.has(vertex))!;
    const dragged = await session.dragLandmark(0, place);
    if (!dragged) throw new Error("no embedding follows");
    expect([...dragged.paths.layoutEdges]).toEqual(best.edges.map(({ id }) => id));
    const at = target.positions.slice(3 * place, 3 * place + 3);
    for (const { id, layoutEdge } of best.edges) {
        const [first, after] = dragged.paths.offsets.subarray(id, id + 2);
        if (layoutEdge[0] === 0)
            expect(dragged.paths.points.slice(3 * first!, 3 * first! + 3)).toEqual(at);
        if (layoutEdge[1] === 0)
            expect(dragged.paths.points.slice(3 * after! - 3, 3 * after!)).toEqual(at);
    }
    expect(await session.dragLandmark(0, landmarks[1]!)).toBeNull();
    // The last embedding is still there; the one that was dragged is no better than the best.
    expect((await session.exportFiles())["refined.obj"].length).toBeGreaterThan(0);
    await session.setLandmarks([place, ...landmarks.subarray(1)]);
    const anew = await session.solve({ gap: 0 });
    expect(dragged.cost).toBeGreaterThanOrEqual(anew.lowerBound - 1e-9);
    expect(dragged.cost).toBeLessThan(1.1 * anew.cost);
    await session.dispose();
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
