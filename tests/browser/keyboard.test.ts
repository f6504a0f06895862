import type { FileChooser } from "playwright-core";
import { expect, test } from "vitest";
import {
    downloaded,
    frames,
    ready,
    textFile,
    untilSolved,
    untilSolvedAfter,
    untilStatus,
    usePage,
} from "./browser.js";
import { ball, toObj } from "./meshes.js";

const opened = usePage({ link: "shape=vase/tulip" });

test("every_control_is_reached_by_tab_and_shows_its_focus", async () => {
    const { page } = opened();
    await page.locator("#options, #edges").evaluateAll((all) => {
        for (const details of all) (details as HTMLDetailsElement).open = true;
    });
    const count = await page
        .locator("button:enabled:not([tabindex='-1']), input:enabled, select, summary, canvas")
        .evaluateAll((all) => {
            const stops = all.filter((one) => one.checkVisibility() && !one.closest("dialog"));
            const reached: (readonly [stop: number, visible: boolean])[] = [];
            Object.assign(globalThis, { reached });
            document.addEventListener("focusin", ({ target }) => {
                const stop = stops.indexOf(target as HTMLElement);
                // A file input shows its focus on the label around it.
                const shown = (target as Element).closest("label.file") ?? (target as Element);
                const { outlineStyle, outlineWidth } = getComputedStyle(shown);
                const visible = outlineStyle !== "none" && parseFloat(outlineWidth) >= 2;
                reached.push([stop, visible]);
            });
            return stops.length;
        });
    expect(count).toBeGreaterThan(30);
    for (let press = 0; press < count + 10; ++press) await page.keyboard.press("Tab");
    const reached = await page.evaluate(
        () => (globalThis as unknown as { reached: [number, boolean][] }).reached,
    );
    expect(reached.filter(([, visible]) => !visible)).toEqual([]);
    const stops = reached.map(([stop]) => stop).filter((stop) => stop >= 0);
    expect(Array.from({ length: count }, (_, i) => i).filter((i) => !stops.includes(i))).toEqual(
        [],
    );
    // In the order of the page.
    const first = stops.slice(0, count);
    expect(first).toEqual([...first].sort((a, b) => a - b));
});

test("a_shape_is_chosen_solved_and_taken_home_with_the_keyboard_alone", async () => {
    const { page } = opened();
    const before = await page.textContent("#target-name");
    await page.keyboard.press("g");
    const card = page.locator("#gallery-cards button", { hasText: "Amphora" });
    await card.waitFor();
    for (let press = 0; press < 60; ++press) {
        if (await card.evaluate((one) => one === document.activeElement)) break;
        await page.keyboard.press("Tab");
    }
    await page.keyboard.press("Enter");
    await untilSolvedAfter(page, before);
    const cost = await page.textContent("#cost");
    // A quick solve shows no cost for less than a frame: its end alone would not tell it from none.
    const hadNoCost = await page.evaluateHandle(() => {
        const element = document.getElementById("cost")!;
        const seen = { empty: false };
        new MutationObserver(() => {
            seen.empty ||= element.textContent === "–";
        }).observe(element, { childList: true, characterData: true, subtree: true });
        return seen;
    });
    await page.keyboard.press("s");
    await page.waitForFunction((seen) => seen.empty, hadNoCost);
    await untilSolved(page);
    expect(await page.textContent("#cost")).toBe(cost);

    const names: string[] = [];
    page.on("download", (download) => names.push(download.suggestedFilename()));
    await page.keyboard.press("d");
    await expect
        .poll(() => [...names].sort())
        .toEqual(["embedding.json", "refined.obj", "refined_map.json"]);
});

test("a_layout_is_made_and_embedded_with_the_keyboard_alone", async () => {
    const { page } = opened();
    // Choosing a file is the system's dialog: here it is handed over.
    await page.setInputFiles("#target-file", textFile("ball.obj", toObj(ball(3))));
    await page.waitForFunction(
        () => document.getElementById("target-name")?.textContent === "ball.obj",
    );
    await page.focus("#make-layout-2");
    await page.keyboard.press("Enter");
    await page.focus("#target-view canvas");
    const placed = () => page.textContent("#landmarks-count");
    // A landmark in the middle of the view, from six sides.
    for (const turns of [
        ["ArrowRight", 0],
        ["ArrowRight", 9],
        ["ArrowRight", 9],
        ["ArrowRight", 9],
        ["ArrowUp", 6],
        ["ArrowDown", 12],
    ] as const) {
        const before = await placed();
        for (let press = 0; press < turns[1]; ++press) await page.keyboard.press(turns[0]);
        await page.keyboard.press("Enter");
        expect(await placed()).not.toBe(before);
    }
    await page.waitForFunction(() =>
        /^Layout of 6 landmarks/.test(document.getElementById("making-text")?.textContent ?? ""),
    );
    await page.focus("#making-done");
    await page.keyboard.press("Enter");
    await untilStatus(page, ready);
    await page.keyboard.press("s");
    await untilSolved(page);
    expect(await page.textContent("#embedded")).toMatch(/^(\d+) of \1$/);
    const saved = await downloaded(page, async () => {
        await page.focus("#save-landmarks");
        await page.keyboard.press("Enter");
    });
    expect(saved.toString().trim().split("\n")).toHaveLength(6);
});

test("shortcuts_open_files_toggle_the_layout_and_show_the_keys", async () => {
    const { page } = opened();
    await page.focus("#panel");
    const choosers: FileChooser[] = [];
    page.on("filechooser", (chooser) => choosers.push(chooser));
    // A round trip, for the browser has to be told to hand over its dialogs.
    await frames(page);
    await page.keyboard.press("o");
    await expect.poll(() => choosers.length, { timeout: 30_000 }).toBe(1);
    expect(choosers[0]?.isMultiple()).toBe(true);
    await page.keyboard.press("l");
    expect(await page.isVisible("#layout-view")).toBe(false);
    expect(await page.isChecked("#show-layout")).toBe(false);
    await page.keyboard.press("l");
    expect(await page.isVisible("#layout-view")).toBe(true);
    await page.keyboard.press("?");
    expect(await page.isVisible("#help")).toBe(true);
    // Under the dialog the page rests.
    await page.keyboard.press("l");
    await page.keyboard.press("Escape");
    expect(await page.isVisible("#help")).toBe(false);
    expect(await page.isVisible("#layout-view")).toBe(true);
});

test("shortcuts_rest_while_something_is_typed", async () => {
    const { page } = opened();
    const cost = await page.textContent("#cost");
    await page.focus("#seed");
    for (const key of ["s", "l", "o", "?"]) await page.keyboard.press(key);
    expect(await page.textContent("#solve")).toBe("Solve");
    expect(await page.textContent("#cost")).toBe(cost);
    expect(await page.isVisible("#layout-view")).toBe(true);
    expect(await page.isVisible("#help")).toBe(false);
});

test("arrow_keys_turn_a_view_and_r_brings_it_back", async () => {
    const { page } = opened();
    await page.focus("#target-view canvas");
    const picture = async () => {
        await frames(page);
        return (await page.locator("#target-view canvas").screenshot()).toString("base64");
    };
    await page.keyboard.press("r");
    const pictures = [await picture()];
    for (const key of ["ArrowRight", "ArrowUp", "+"]) {
        await page.keyboard.press(key);
        pictures.push(await picture());
    }
    expect(new Set(pictures).size).toBe(4);
    await page.keyboard.press("r");
    expect((await picture()) === pictures[0]).toBe(true);
});

test("quads_and_a_map_are_made_with_the_keyboard_alone", async () => {
    const { page } = opened();
    const focused = () => page.evaluate(() => document.activeElement?.id ?? "");
    const before = await page.textContent("#target-name");
    await page.keyboard.press("g");
    const card = page.locator("#gallery-cards button", { hasText: "Tulip" });
    await card.focus();
    await page.keyboard.press("Enter");
    await untilSolvedAfter(page, before);
    // The tabs are one stop; arrows go from one to the next.
    await page.focus("#tab-embedding");
    await page.keyboard.press("ArrowRight");
    expect(await focused()).toBe("tab-quads");
    await page.keyboard.press("Tab");
    expect(await focused()).toBe("density");
    await page.locator("#quad-figures dd").first().waitFor();
    const quads = await page.locator("#quad-figures dd").first().textContent();
    await page.keyboard.press("ArrowLeft");
    await page.waitForFunction(
        (count) => document.querySelector("#quad-figures dd")?.textContent !== count,
        quads,
    );
    await page.focus("#tab-quads");
    await page.keyboard.press("End");
    expect(await focused()).toBe("tab-map");
    await page.keyboard.press("Tab");
    await page.keyboard.press("Enter");
    await page.locator("#map-figures dd").first().waitFor();
    // The cursor begins in the middle of a view and goes on from vertex to vertex.
    await page.focus("#map-view canvas");
    await page.keyboard.press("Shift+ArrowUp");
    const first = await page.textContent("#announcement");
    expect(first).toMatch(
        /^Vertex \d+ of the second target corresponds to a point of triangle \d+/,
    );
    await page.keyboard.press("Shift+ArrowUp");
    expect(await page.textContent("#announcement")).not.toBe(first);
    await page.keyboard.press("1");
    expect(await page.isVisible("#embedding-tab")).toBe(true);
});
