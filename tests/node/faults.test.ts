// What goes wrong in the middle, and that the work goes on after it: cancelled jobs, workers that
// are killed, traps, memory that runs out, many jobs at once and one after the other.
import { syncBuiltinESMExports } from "node:module";
import threads from "node:worker_threads";
import { embed, init, Session, type EmbedProgress, type EmbedResult } from "layout-embedding";
import { coreBytes } from "layout-embedding/base64";
import { createWorkerClient } from "layout-embedding/worker";
import { afterEach, describe, expect, test } from "vitest";
import { arrays, displacedLandmarks, octahedron, sphere } from "./meshes.js";

const problem = {
    layout: arrays(octahedron),
    target: arrays(sphere(3)),
    landmarks: displacedLandmarks,
};

async function loaded(): Promise<Session> {
    const session = await Session.create();
    await session.loadLayout(problem.layout);
    await session.loadTarget(problem.target);
    await session.setLandmarks(problem.landmarks);
    return session;
}

/** What does not depend on the clock. */
const content = ({ refined, edges, exactCost, status, counters }: EmbedResult) => ({
    ...{ refined, edges, exactCost, status, counters },
});

describe("a job that is cancelled", () => {
    /** Cancels at the first report that `when` picks; the reports after it. */
    async function cancelledAt(when: (progress: EmbedProgress) => boolean) {
        const abort = new AbortController();
        const session = await loaded();
        const before: EmbedProgress[] = [];
        const after: EmbedProgress[] = [];
        const result = await session.solve({
            gap: 0,
            signal: abort.signal,
            // One step of whatever is done.
            slice: { work: 200, milliseconds: 1e-6 },
            onProgress: (progress) => {
                (abort.signal.aborted ? after : before).push(progress);
                if (when(progress)) abort.abort();
            },
        });
        expect(abort.signal.aborted).toBe(true);
        return { session, result, before, after };
    }

    test("in_the_search_ends_it_at_once_and_keeps_the_best_embedding", async () => {
        const found = await cancelledAt(({ cost }) => cost < Infinity);
        const { session, result, before, after } = found;
        expect(before.at(-1)!.phase).toBe("search");
        expect(after.filter(({ phase }) => phase === "search")).toEqual([]);
        expect(result.status).toBe("cancelled");
        expect(result.cost).toBe(before.at(-1)!.cost);
        expect(await session.check({ refined: result.refined!, edges: result.edges })).toEqual([]);
        await session.dispose();
    });

    test.each(["search", "realise", "check"] as const)(
        "in_the_phase_%s_ends_with_what_there_is_and_can_be_solved_again",
        async (phase) => {
            const { session, result, after } = await cancelledAt(
                (report) => report.phase === phase,
            );
            // Nothing but what finishes the best embedding: it is cut out, checked, and done.
            expect(after.length).toBeLessThan(5);
            const isComplete = phase === "realise" || phase === "check";
            expect(result.refined !== null).toBe(isComplete);
            if (result.refined) {
                const { refined, edges } = result;
                expect(await session.check({ refined, edges })).toEqual([]);
            }
            const again = await session.solve({ gap: 0 });
            expect(again.status).toBe("optimal");
            await session.dispose();
        },
    );

    test("while_paths_get_another_shape_keeps_a_valid_embedding", async () => {
        const session = await loaded();
        const first = await session.solve();
        const { status, refined, edges, exactCost } = await session.reshape("fair", {
            signal: AbortSignal.abort(),
        });
        expect({ status, exactCost }).toEqual({
            status: "cancelled",
            exactCost: first.exactCost,
        });
        expect(await session.check({ refined: refined!, edges })).toEqual([]);
        await session.dispose();
    });
});

test("jobs_that_run_at_the_same_time_do_not_disturb_each_other", async () => {
    const options = [{ seed: 1, gap: 0 }, { seed: 2, shape: "even" as const }, { seed: 3 }];
    const alone = [];
    for (const each of options) alone.push(content(await embed(problem, each)));
    const together = await Promise.all(
        options.map((each) => embed(problem, { ...each, slice: { work: 100 } })),
    );
    expect(together.map(content)).toEqual(alone);
});

describe("a worker that is killed", () => {
    const { Worker } = threads;
    afterEach(() => {
        threads.Worker = Worker;
        syncBuiltinESMExports();
    });

    test("rejects_what_is_pending_and_another_one_works", async () => {
        const started: threads.Worker[] = [];
        threads.Worker = class extends Worker {
            constructor(file: string | URL, options?: threads.WorkerOptions) {
                super(file, options);
                started.push(this);
            }
        };
        syncBuiltinESMExports();
        const worker = await createWorkerClient();
        const slow = { ...problem, target: arrays(sphere(5)), landmarks: [0, 1, 2, 3, 4, 5] };
        let kills = 0;
        const pending = worker.embed(slow, {
            slice: { work: 10 },
            onProgress: () => {
                if (kills++ === 0) void started[0]!.terminate();
            },
        });
        await expect(pending).rejects.toMatchObject({ name: "LayoutError", code: "workerFailed" });
        expect(started).toHaveLength(1);
        await expect(worker.createSession()).rejects.toMatchObject({ code: "workerTerminated" });
        const other = await createWorkerClient();
        expect((await other.embed(problem)).refined).not.toBeNull();
        other.terminate();
    });
});

describe("a module", () => {
    afterEach(async () => {
        await init({ wasm: await coreBytes() });
    });

    test("that_traps_says_so_and_a_new_session_works", async () => {
        // (module (memory (export "memory") 1) (func (export "_initialize"))
        //   (func (export "boundary_allocate") (param i32) (result i32) unreachable))
        const text = (word: string) => [word.length, ...Buffer.from(word)];
        const exports = [
            [3, ...text("memory"), 2, 0],
            [...text("_initialize"), 0, 0],
            [...text("boundary_allocate"), 0, 1],
        ].flat();
        await init({
            wasm: Uint8Array.from([
                ...[0, 0x61, 0x73, 0x6d, 1, 0, 0, 0],
                ...[1, 9, 2, 0x60, 0, 0, 0x60, 1, 0x7f, 1, 0x7f],
                ...[3, 3, 2, 0, 1],
                ...[5, 3, 1, 0, 1],
                ...[7, exports.length, ...exports],
                ...[10, 8, 2, 2, 0, 0x0b, 3, 0, 0, 0x0b],
            ]),
        });
        const session = await Session.create();
        for (let round = 0; round < 2; ++round) {
            await expect(session.loadTarget(problem.target)).rejects.toMatchObject({
                name: "LayoutError",
                code: "crashed",
            });
        }
        await session.dispose();
        await init({ wasm: await coreBytes() });
        expect((await embed(problem)).refined).not.toBeNull();
    });

    test("whose_memory_runs_out_says_so_and_goes_on", async () => {
        const here = content(await embed(problem));
        await init({ wasm: withAtMost(24, await coreBytes()) });
        const session = await loaded();
        for (const rounds of [6, 7]) {
            const target = arrays(sphere(rounds));
            const failure = (async () => {
                await session.loadTarget(target);
                await session.setLandmarks([0, 1, 2, 3, 4, 5]);
                return session.solve();
            })();
            await expect(failure).rejects.toMatchObject({
                name: "LayoutError",
                code: "memoryLimit",
            });
        }
        await session.loadTarget(problem.target);
        await session.setLandmarks(problem.landmarks);
        expect(content(await session.solve())).toEqual(here);
        await session.dispose();
    });

    /** The bytes of core.wasm with a memory of at most so many megabytes. */
    function withAtMost(megabytes: number, bytes: Uint8Array<ArrayBuffer>) {
        const number = (at: number) => {
            let value = 0;
            for (let shift = 0; ; shift += 7, ++at) {
                value |= (bytes[at]! & 0x7f) << shift;
                if (bytes[at]! < 0x80) return { value, next: at + 1 };
            }
        };
        for (let at = 8; at < bytes.length;) {
            const { value: size, next } = number(at + 1);
            if (bytes[at] === 5) {
                // One memory, with a maximum: after the smallest size comes the largest one.
                expect([...bytes.subarray(next, next + 2)]).toEqual([1, 1]);
                const largest = number(next + 2).next;
                const pages = megabytes * 16;
                expect(number(largest).next - largest).toBe(3);
                bytes.set([(pages & 0x7f) | 0x80, (pages >> 7) | 0x80, 0], largest);
                return bytes;
            }
            at = next + size;
        }
        throw new Error("the module has no memory");
    }
});

test("many_jobs_in_one_instance_take_no_more_memory_than_a_few", async () => {
    const memories: WebAssembly.Memory[] = [];
    const { instantiate } = WebAssembly;
    WebAssembly.instantiate = (async (...args: Parameters<typeof instantiate>) => {
        const instance = await instantiate(...args);
        memories.push(instance.exports["memory"] as WebAssembly.Memory);
        return instance;
    }) as typeof instantiate;
    const session = await Session.create();
    WebAssembly.instantiate = instantiate;
    const [memory] = memories;
    if (memory === undefined) throw new Error("no instance was seen");
    const size = () => memory.buffer.byteLength;

    const target = arrays(sphere(1));
    const once = async (seed: number) => {
        await session.loadLayout(problem.layout);
        await session.loadTarget(target);
        const { status } = await session.solve({ seed, slice: { milliseconds: 1000 } });
        expect(status).toBe("optimal");
        await expect(session.setLandmarks([0, 0, 0])).rejects.toMatchObject({
            code: "landmarkCount",
        });
    };
    for (let seed = 1; seed <= 3; ++seed) await once(seed);
    const before = size();
    for (let seed = 4; seed <= 1000; ++seed) await once(seed);
    expect(size()).toBe(before);
    await session.dispose();
});
