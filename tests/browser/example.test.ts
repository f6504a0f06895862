// The page as it opens: a solved example, pictures, and what it asks the network for.
import { readdir, readFile } from "node:fs/promises";
import { gzipSync } from "node:zlib";
import { Session, type EmbeddingDocument } from "layout-embedding";
import { unzipSync } from "fflate";
import { expect, inject, test } from "vitest";
import { examples } from "../../web/src/examples/index.js";
import {
    choose,
    colorsOf,
    downloaded,
    frames,
    numberIn,
    untilSolvedAfter,
    usePage,
} from "./browser.js";

const opened = usePage();

/** Colours that fill more than a thousandth of a picture. */
const common = (colors: Map<number, number>): number => {
    const total = [...colors.values()].reduce((sum, count) => sum + count, 0);
    return [...colors.values()].filter((count) => count > total / 1000).length;
};

test("the_page_opens_with_a_solved_example_and_shows_it_in_colours", async () => {
    const { page } = opened();
    expect(await page.textContent("#embedded")).toMatch(/^(\d+) of \1$/);
    // Background, clay shades and text alone make fewer.
    const colored = common(await colorsOf(page, "#target-view canvas"));
    expect(colored).toBeGreaterThan(10);
    expect(common(await colorsOf(page, "#layout-view canvas"))).toBeGreaterThan(10);
    await page.uncheck("#show-patches");
    await frames(page);
    expect(common(await colorsOf(page, "#target-view canvas"))).toBeLessThan(colored);
    await page.check("#show-patches");
});

test("only_the_pages_own_files_are_asked_for", () => {
    const { requests } = opened();
    const origin = new URL(inject("pageUrl")).origin;
    expect(requests.length).toBeGreaterThan(2);
    expect(requests.filter((url) => new URL(url).origin !== origin)).toEqual([]);
});

test("the_pages_own_scripts_are_small", async () => {
    const folder = new URL("../../web/dist/assets/", import.meta.url);
    let bytes = 0;
    for (const name of await readdir(folder))
        if (name.endsWith(".js") && !name.startsWith("three-"))
            bytes += gzipSync(await readFile(new URL(name, folder))).length;
    expect(bytes).toBeGreaterThan(30_000);
    expect(bytes).toBeLessThan(300_000);
});

/** A document without what depends on the clock. */
function timeless(text: string): unknown {
    return JSON.parse(text, (key, value: unknown) =>
        ["seconds", "cpuSeconds"].includes(key) ? undefined : value,
    );
}

test("chromium_and_node_give_the_same_embedding_bit_for_bit", async () => {
    const { page } = opened();
    const zip = unzipSync(await downloaded(page, () => page.click("#download-all")));
    const example = examples[0]?.make();
    if (!example) throw new Error("there is no example");
    const session = await Session.create();
    await session.loadLayout(example.layout);
    await session.loadTarget(example.target);
    await session.setLandmarks(example.landmarks);
    const result = await session.solve({ gap: 0.01, seed: 1 });
    const here = await session.exportFiles();
    await session.dispose();
    const text = (bytes: Uint8Array | undefined) => Buffer.from(bytes ?? []).toString();
    expect(text(zip["refined.obj"])).toBe(text(here["refined.obj"]));
    expect(timeless(text(zip["embedding.json"]))).toEqual(timeless(text(here["embedding.json"])));
    expect(text(zip["refined_map.json"])).toBe(text(here["refined_map.json"]));
    const written = JSON.parse(text(zip["embedding.json"])) as EmbeddingDocument;
    expect(written.cost).toBe(result.cost);
    expect(written.insertionOrder).toEqual([...result.insertionOrder]);
    expect(text(zip["landmarks.txt"]).trim().split("\n").map(Number)).toEqual([
        ...result.landmarks,
    ]);
});

test("nothing_is_drawn_while_nothing_changes", async () => {
    const { page } = opened();
    await frames(page);
    await page.evaluate(() => {
        const counter = globalThis as unknown as { draws: number };
        counter.draws = 0;
        for (const name of ["drawElements", "drawArrays", "drawArraysInstanced"] as const) {
            const context = WebGL2RenderingContext.prototype;
            // eslint-disable-next-line @typescript-eslint/unbound-method -- wrapped, called below
            const original = context[name] as (...args: unknown[]) => void;
            Object.assign(context, {
                [name](this: WebGL2RenderingContext, ...args: unknown[]) {
                    counter.draws += 1;
                    original.apply(this, args);
                },
            });
        }
    });
    const draws = () => page.evaluate(() => (globalThis as unknown as { draws: number }).draws);
    // Frames go by; none of them draws.
    await frames(page, 20);
    expect(await draws()).toBe(0);
    await page.focus("#target-view canvas");
    await page.keyboard.press("ArrowLeft");
    await frames(page, 1);
    expect(await draws()).toBeGreaterThan(0);
});

test("the_picture_that_is_taken_home_shows_the_target", async () => {
    const { page } = opened();
    const png = await downloaded(page, () => page.click("#screenshot"));
    expect(png.subarray(1, 4).toString()).toBe("PNG");
    // A blank picture of this size compresses to a few kilobytes.
    expect(png.length).toBeGreaterThan(15_000);
    const glb = await downloaded(page, () => page.click('button[data-format="glb"]'));
    expect(glb.subarray(0, 4).toString()).toBe("glTF");
});

test("paths_get_another_shape_without_a_new_search", async () => {
    const { page } = opened();
    const figures = async () => ({
        cost: await page.textContent("#cost"),
        length: await page.textContent("#length"),
        gap: await page.textContent("#gap-value"),
    });
    const straight = await figures();
    const differs = (length: string | null) =>
        page.waitForFunction(
            (before) => document.getElementById("length")?.textContent !== before,
            length,
        );
    await page.selectOption("#shape", "even");
    await differs(straight.length);
    const even = await figures();
    expect(even).toMatchObject({ cost: straight.cost, gap: straight.gap });
    expect(Number(even.length?.replace(",", ""))).toBeGreaterThan(
        Number(straight.length?.replace(",", "")),
    );
    const text = await downloaded(page, () => page.click('button[data-file="embedding.json"]'));
    expect(JSON.parse(text.toString())).toMatchObject({ shape: "even" });
    await page.selectOption("#shape", "short");
    await differs(even.length);
    expect(await figures()).toEqual(straight);
});

test("paths_glide_into_another_shape_but_not_where_motion_is_to_be_reduced", async () => {
    const { page } = opened();
    /** How many times the picture changed on the way to a shape. */
    const picturesTo = async (shape: string) => {
        const length = await page.textContent("#length");
        await page.evaluate(() => {
            const counter = globalThis as unknown as { uploads: number };
            counter.uploads = 0;
            const context = WebGL2RenderingContext.prototype as unknown as {
                bufferData: (...args: unknown[]) => void;
                counted?: boolean;
            };
            if (context.counted) return;
            context.counted = true;

            const original = context.bufferData;
            context.bufferData = function (this: unknown, ...args: unknown[]) {
                counter.uploads += 1;
                original.apply(this, args);
            };
        });
        await page.selectOption("#shape", shape);
        await page.waitForFunction(
            (before) => document.getElementById("length")?.textContent !== before,
            length,
        );
        // Longer than paths glide.
        await page.waitForTimeout(800);
        return page.evaluate(() => (globalThis as unknown as { uploads: number }).uploads);
    };
    const gliding = await picturesTo("even");
    await page.emulateMedia({ reducedMotion: "reduce" });
    const still = await picturesTo("short");
    await page.emulateMedia({ reducedMotion: null });
    expect(gliding).toBeGreaterThan(still);
});

test("every_example_can_be_chosen_and_is_solved", async () => {
    const { page } = opened();
    for (const title of ["Pebble", "Knot"]) {
        const before = await page.textContent("#target-name");
        await choose(page, title);
        await untilSolvedAfter(page, before);
        expect(await page.textContent("#embedded")).toMatch(/^(\d+) of \1$/);
    }
});

test("a_shape_of_the_gallery_is_solved_with_a_layout_of_its_landmarks", async () => {
    const { page } = opened();
    const before = await page.textContent("#target-name");
    await choose(page, "Resting");
    await untilSolvedAfter(page, before);
    expect(await page.textContent("#target-name")).toBe("resting.obj");
    expect(await page.textContent("#embedded")).toMatch(/^(\d+) of \1$/);
});

test("improvements_can_be_gone_through_with_the_slider", async () => {
    const { page } = opened();
    const slider = page.locator("#step");
    expect(await slider.isVisible()).toBe(true);
    const last = (await page.textContent("#step-text")) ?? "";
    const count = Number(/ of (\d+):/.exec(last)?.[1]);
    expect(last).toMatch(new RegExp(`^${count} of ${count}: `));
    const cost = (text: string) => Number(/: ([\d.]+) after/.exec(text)?.[1]);
    const picture = () => page.locator("#target-view canvas").screenshot();
    const result = await picture();
    await slider.press("Home");
    const first = (await page.textContent("#step-text")) ?? "";
    expect(first).toMatch(new RegExp(`^1 of ${count}: `));
    expect(cost(first)).toBeGreaterThan(cost(last));
    await frames(page);
    expect((await picture()).equals(result)).toBe(false);
    await slider.press("End");
    expect(await page.textContent("#step-text")).toBe(last);
});

test("the_heuristics_are_put_beside_the_result", async () => {
    const { page } = opened();
    await page.keyboard.press("c");
    const rows = page.locator("#contenders tr");
    await rows.nth(3).waitFor();
    expect(await rows.count()).toBe(4);
    const shown = page.locator("#contenders button[aria-pressed=true]");
    expect(await shown.count()).toBe(1);
    const name = (await shown.getAttribute("aria-label"))?.replace("Show ", "");
    expect(await page.textContent("#compare-title")).toBe(name);
    expect(await page.isVisible("#compare-view canvas")).toBe(true);
    expect(await page.isVisible("#layout-view")).toBe(false);
    // What is shown is the worst; no heuristic is better than what was proved.
    const excess = (await page.textContent("#compare-caption")) ?? "";
    expect(excess).toMatch(/\(\+[\d.]+ %\)$/);
    for (const text of await rows.locator("td:nth-of-type(1)").allTextContents())
        expect(text).toMatch(/\+|the same|dead end/);
    const other = rows.locator("button[aria-pressed=false]:enabled").first();
    const otherName = (await other.getAttribute("aria-label"))?.replace("Show ", "");
    await other.click();
    expect(await page.textContent("#compare-title")).toBe(otherName);
    await page.click("#compare-close");
    expect(await page.isVisible("#layout-view")).toBe(true);
});

test("candidate_paths_show_which_edges_are_in_each_others_way", async () => {
    const { page } = opened();
    const button = page.locator("#candidates");
    const picture = () => page.locator("#target-view canvas").screenshot();
    await frames(page);
    const embedding = await picture();
    await page.keyboard.press("a");
    await page.waitForFunction(() => document.getElementById("candidates-text")?.textContent);
    expect(await button.getAttribute("aria-pressed")).toBe("true");
    const words = (await page.textContent("#candidates-text")) ?? "";
    const [, sum, less] = /: ([\d.,]+) in all, ([\d.]+) % less/.exec(words) ?? [];
    const cost = await numberIn(page, "#cost");
    const alone = Number(sum?.replace(",", ""));
    // The octopus's arms make some paths conflict: the embedding is longer than they are.
    expect(alone).toBeLessThan(cost);
    expect(Number(less)).toBeCloseTo((100 * (cost - alone)) / cost, 1);
    expect(words).toMatch(/\d+ paths?, in red/);
    await frames(page);
    expect((await picture()).equals(embedding)).toBe(false);
    await button.click();
    expect(await button.getAttribute("aria-pressed")).toBe("false");
    await frames(page);
    expect((await picture()).equals(embedding)).toBe(true);
});

test("the_content_security_policy_stops_requests_to_other_places", async () => {
    const { page, complaints } = opened();
    const violated = await page.evaluate(async () => {
        const report = new Promise<string>((resolve) =>
            document.addEventListener("securitypolicyviolation", (event) =>
                resolve(event.effectiveDirective),
            ),
        );
        await fetch("https://example.com/").catch(() => undefined);
        return report;
    });
    expect(violated).toBe("connect-src");
    // The browser says so on the console, too.
    expect(complaints.splice(0).join()).toMatch(/Content Security Policy/);
});
