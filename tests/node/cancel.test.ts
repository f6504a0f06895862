// Calls that are aborted, in whatever they are at: they end with the best there is, and the session
// goes on. How soon is measured by the benchmark (npm run bench -- --check).
import { Session, type EmbeddingSession, type EmbedResult } from "layout-embedding";
import { CancelledError, createWorkerClient, type EmbeddingWorker } from "layout-embedding/worker";
import { afterAll, afterEach, beforeAll, beforeEach, describe, expect, test } from "vitest";
import { arrays, displacedLandmarks, octahedron, sphere } from "./meshes.js";

const layout = arrays(octahedron);
const target = arrays(sphere(4));
const other = arrays(sphere(2));

/** The result of an aborted call, at once or late. */
async function best<Result>(call: Promise<Result>): Promise<Result> {
    try {
        return await call;
    } catch (error) {
        if (!(error instanceof CancelledError)) throw error;
        return (await error.late) as Result;
    }
}

async function expectEmbedding(session: EmbeddingSession, { refined, edges }: EmbedResult) {
    if (refined === null) throw new Error("there is no embedding");
    expect(await session.check({ refined, edges })).toEqual([]);
}

let worker: EmbeddingWorker;
beforeAll(async () => {
    worker = await createWorkerClient();
});
afterAll(() => {
    worker.terminate();
});

describe.each([
    ["here", () => Session.create()],
    ["in_a_worker", () => worker.createSession()],
] as [string, () => Promise<EmbeddingSession>][])("%s", (_, create) => {
    let session: EmbeddingSession;
    beforeEach(async () => {
        session = await create();
        await session.loadLayout(layout);
        await session.loadTarget(target);
        await session.setLandmarks(displacedLandmarks);
    });
    afterEach(() => session.dispose());

    test("an_aborted_load_changes_nothing", async () => {
        const signal = AbortSignal.abort();
        await expect(session.loadTarget(other, { signal })).rejects.toMatchObject({
            name: "LayoutError",
            code: "cancelled",
        });
        await expect(session.loadLayout(other, { signal })).rejects.toBeInstanceOf(CancelledError);
        // Also while it is under way.
        const abort = new AbortController();
        const loading = session.loadTarget(other, { signal: abort.signal });
        setTimeout(() => {
            abort.abort();
        }, 0);
        const loaded = await loading.catch((error: unknown) => error);
        if (loaded instanceof CancelledError) {
            await loaded.late.catch(() => undefined);
            await expectEmbedding(session, await session.solve());
        } else {
            expect(loaded).toMatchObject({ vertexCount: other.positions.length / 3 });
        }
    });

    test.each(["search", "realise", "check"] as const)(
        "an_embedding_aborted_in_the_phase_%s_is_kept_and_can_be_solved_again",
        async (phase) => {
            const abort = new AbortController();
            const result = await best(
                session.solve({
                    gap: 0,
                    signal: abort.signal,
                    slice: { work: 200, milliseconds: 1e-6 },
                    onProgress: (progress) => {
                        if (progress.phase === phase && progress.cost < Infinity) abort.abort();
                    },
                }),
            );
            expect(abort.signal.aborted).toBe(true);
            await expectEmbedding(session, result);
            const files = await session.exportFiles();
            expect(files["refined.obj"].length).toBeGreaterThan(0);
            expect((await session.solve({ gap: 0 })).status).toBe("optimal");
        },
    );

    test("quads_and_maps_aborted_while_they_are_optimised_are_as_far_as_they_are", async () => {
        await session.loadTarget(arrays(sphere(3)));
        await session.setLandmarks([0, 1, 2, 3, 4, 5]);
        await session.solve();
        const edgeLength = 0.3;
        const plain = await session.quads({ edgeLength, relaxation: 0 });
        const shares: number[] = [];
        const onProgress = (share: number) => shares.push(share);
        const whole = await session.quads({ edgeLength, onProgress });
        expect(shares.at(-1)).toBe(1);
        expect(shares).toEqual([...shares].sort((a, b) => a - b));
        const untouched = await best(session.quads({ edgeLength, signal: AbortSignal.abort() }));
        expect(untouched.positions).toEqual(plain.positions);
        expect(untouched.quads).toEqual(whole.quads);

        await session.setReference();
        await session.loadTarget(target);
        await session.setLandmarks(displacedLandmarks);
        await session.solve();
        const abort = new AbortController();
        const seen: number[] = [];
        const seamPasses = 3;
        const map = await best(
            session.mapFromReference({
                seamPasses,
                signal: abort.signal,
                onProgress: (share) => {
                    seen.push(share);
                    if (share > 0.5) abort.abort();
                },
            }),
        );
        expect(seen.at(-1)).toBeLessThan(1);
        const complete = await session.mapFromReference({ seamPasses });
        expect(map.firstDistortion).toEqual(complete.firstDistortion);
        expect(map.distortion.meanEnergy).toBeLessThan(map.firstDistortion.meanEnergy);
        expect(map.distortion.meanEnergy).toBeGreaterThan(complete.distortion.meanEnergy);
    });
});

test("a_call_aborted_while_the_worker_is_busy_is_settled_before_the_worker_answers", async () => {
    const busy = await worker.createSession();
    await busy.loadLayout(layout);
    await busy.loadTarget(arrays(sphere(6)));
    await busy.setLandmarks([0, 1, 2, 3, 4, 5]);
    const session = await worker.createSession();
    await session.loadLayout(layout);
    await session.loadTarget(target);
    await session.setLandmarks(displacedLandmarks);

    const events: string[] = [];
    // One slice from beginning to end.
    const slow = busy.solve({ slice: { milliseconds: 1e9 }, algorithm: "greedy" }).then(() => {
        events.push("the other session is done");
    });
    const abort = new AbortController();
    const solving = session.solve({ signal: abort.signal });
    abort.abort();
    const error = await solving.catch((reason: unknown) => reason);
    events.push("settled");
    if (!(error instanceof CancelledError)) throw new Error("it has a result");
    // Whatever comes next waits for its turn.
    const late = error.late as Promise<EmbedResult>;
    const again = session.solve();
    const aborted = session.quads({ signal: AbortSignal.abort() });
    await expect(aborted).rejects.toMatchObject({ code: "cancelled" });
    events.push("settled as well");
    await slow;
    expect(events).toEqual(["settled", "settled as well", "the other session is done"]);
    expect((await late).status).toBe("cancelled");
    const result = await again;
    expect(result.status).not.toBe("cancelled");
    await expectEmbedding(session, result);
    await busy.dispose();
    await session.dispose();
});
