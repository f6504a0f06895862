import { expect, test } from "vitest";
import { choose, colorsOf, solved, untilSolvedAfter, untilStatus, useBrowser } from "./browser.js";

const open = useBrowser();

/** Colours that fill more than a thousandth of a picture. */
const common = (colors: Map<number, number>): number => {
    const total = [...colors.values()].reduce((sum, count) => sum + count, 0);
    return [...colors.values()].filter((count) => count > total / 1000).length;
};

test("the_page_opens_with_a_solved_example_and_shows_it_in_colours", async () => {
    const { page, complaints, close } = await open();
    await untilStatus(page, solved);
    expect(await page.textContent("#embedded")).toMatch(/^(\d+) of \1$/);
    // Background, clay shades and text alone make fewer.
    expect(common(await colorsOf(page, "#target-view canvas"))).toBeGreaterThan(10);
    expect(common(await colorsOf(page, "#layout-view canvas"))).toBeGreaterThan(10);
    await page.uncheck("#show-patches");
    const plain = await colorsOf(page, "#target-view canvas");
    await page.check("#show-patches");
    expect(common(await colorsOf(page, "#target-view canvas"))).toBeGreaterThan(common(plain));
    expect(complaints).toEqual([]);
    await close();
});

test("every_example_can_be_chosen_and_is_solved", async () => {
    const { page, complaints, close } = await open();
    await untilStatus(page, solved);
    for (const title of ["Pebble", "Knot"]) {
        const before = await page.textContent("#target-name");
        await choose(page, title);
        await untilSolvedAfter(page, before);
        expect(await page.textContent("#embedded")).toMatch(/^(\d+) of \1$/);
    }
    expect(complaints).toEqual([]);
    await close();
});

test("nothing_is_drawn_while_nothing_changes", async () => {
    const { page, close } = await open();
    await untilStatus(page, solved);
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
    await page.evaluate(async () => {
        for (let frame = 0; frame < 20; ++frame)
            await new Promise((resolve) => requestAnimationFrame(resolve));
    });
    expect(await draws()).toBe(0);
    await page.focus("#target-view canvas");
    await page.keyboard.press("ArrowLeft");
    await page.evaluate(() => new Promise((resolve) => requestAnimationFrame(resolve)));
    expect(await draws()).toBeGreaterThan(0);
    await close();
});

test("the_picture_that_is_taken_home_shows_the_target", async () => {
    const { page, close } = await open();
    await untilStatus(page, solved);
    const [download] = await Promise.all([
        page.waitForEvent("download"),
        page.click("#screenshot"),
    ]);
    expect(download.suggestedFilename()).toMatch(/\.png$/);
    const { readFile } = await import("node:fs/promises");
    const png = await readFile(await download.path());
    expect(png.subarray(1, 4).toString()).toBe("PNG");
    // A blank picture of this size compresses to a few kilobytes.
    expect(png.length).toBeGreaterThan(20_000);
    await close();
});
