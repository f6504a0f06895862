// The same input, seed and work limit give the same result, however the work is sliced and in
// whatever instance it is done.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { embed, init, type EmbedResult } from "layout-embedding";
import { expect, test } from "vitest";
import { arrays, displacedLandmarks, octahedron, sphere } from "./meshes.js";

const problem = {
    layout: arrays(octahedron),
    target: arrays(sphere(3)),
    landmarks: displacedLandmarks,
};

/** A result without what time it took. */
function timeless(result: EmbedResult) {
    const events = result.events.map((event) => ({ ...event, seconds: 0 }));
    return { ...result, seconds: 0, cpuSeconds: 0, events };
}

test("slices_of_any_size_change_nothing_but_seconds", async () => {
    const whole = timeless(await embed(problem));
    for (const work of [1, 97, 1000]) {
        expect(timeless(await embed(problem, { slice: { work } })), String(work)).toEqual(whole);
    }
    const hasty = await embed(problem, { slice: { milliseconds: 0.01 } });
    expect(timeless(hasty)).toEqual(whole);
});

test("a_work_limit_cuts_at_the_same_place_in_any_slices", async () => {
    const limited = timeless(await embed(problem, { workLimit: 1234 }));
    const sliced = await embed(problem, { workLimit: 1234, slice: { work: 77 } });
    expect(timeless(sliced)).toEqual(limited);
});

test("two_instances_of_the_module_agree", async () => {
    const first = timeless(await embed(problem));
    const bytes = readFileSync(
        createRequire(import.meta.url).resolve("layout-embedding/core.wasm"),
    );
    await init({ wasm: bytes });
    expect(timeless(await embed(problem))).toEqual(first);
});

test("another_seed_changes_the_perturbation_only", async () => {
    const one = await embed(problem, { seed: 1, gap: 0 });
    const two = await embed(problem, { seed: 2, gap: 0 });
    expect(two.exactCost).not.toBe(one.exactCost);
    expect(two.lowerBound).toBeCloseTo(one.lowerBound, 4);
});
