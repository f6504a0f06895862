import type { FileChooser } from "playwright-core";
import { expect, test } from "vitest";
import { colorsOf, frames, solved, untilSolvedAfter, untilStatus, useBrowser } from "./browser.js";

const open = useBrowser();

test("every_control_is_reached_by_tab_and_shows_its_focus", async () => {
    const { page, close } = await open();
    await untilStatus(page, solved);
    await page.locator("details").evaluateAll((all) => {
        for (const details of all) (details as HTMLDetailsElement).open = true;
    });
    const wanted = await page
        .locator("button:enabled, input:enabled, select, summary, canvas")
        .evaluateAll((all) =>
            all
                .filter((one) => one.checkVisibility() && !one.closest("dialog"))
                .map((one, i) => {
                    one.setAttribute("data-stop", String(i));
                    return i;
                }),
        );
    expect(wanted.length).toBeGreaterThan(20);
    const reached: number[] = [];
    for (let press = 0; press < wanted.length + 10; ++press) {
        await page.keyboard.press("Tab");
        const [stop, visible] = await page.evaluate(() => {
            const focused = document.activeElement;
            if (!focused || focused === document.body) return [null, true] as const;
            // A file input shows its focus on the label around it.
            const shown = focused.closest("label.file") ?? focused;
            const { outlineStyle, outlineWidth } = getComputedStyle(shown);
            return [
                focused.getAttribute("data-stop"),
                outlineStyle !== "none" && parseFloat(outlineWidth) >= 2,
            ] as const;
        });
        expect(visible, `focus of stop ${String(stop)}`).toBe(true);
        if (stop !== null) reached.push(Number(stop));
    }
    expect(wanted.filter((stop) => !reached.includes(stop))).toEqual([]);
    // In the order of the page.
    const first = reached.slice(0, wanted.length);
    expect(first).toEqual([...first].sort((a, b) => a - b));
    await close();
});

test("an_example_is_chosen_solved_and_taken_home_with_the_keyboard_alone", async () => {
    const { page, complaints, close } = await open();
    await untilStatus(page, solved);
    const before = await page.textContent("#target-name");
    await page.keyboard.press("g");
    const card = page.locator("#gallery-cards button", { hasText: "Pebble" });
    await card.waitFor();
    for (let press = 0; press < 60; ++press) {
        if (await card.evaluate((one) => one === document.activeElement)) break;
        await page.keyboard.press("Tab");
    }
    await page.keyboard.press("Enter");
    await untilSolvedAfter(page, before);
    const cost = await page.textContent("#cost");
    await page.keyboard.press("s");
    await page.waitForFunction(() => document.getElementById("cost")?.textContent === "–");
    await page.waitForFunction(() => document.getElementById("solve")?.textContent === "Solve");
    await untilStatus(page, solved);
    expect(await page.textContent("#cost")).toBe(cost);

    const names: string[] = [];
    page.on("download", (download) => names.push(download.suggestedFilename()));
    await page.keyboard.press("d");
    await expect
        .poll(() => [...names].sort())
        .toEqual(["embedding.json", "refined.obj", "refined_map.json"]);
    expect(complaints).toEqual([]);
    await close();
});

test("shortcuts_open_files_toggle_the_layout_and_show_the_keys", async () => {
    const { page, close } = await open();
    // Long before the key, for the browser has to be told to hand over its dialogs.
    const choosers: FileChooser[] = [];
    page.on("filechooser", (chooser) => choosers.push(chooser));
    await untilStatus(page, solved);
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
    await close();
});

test("shortcuts_rest_while_something_is_typed", async () => {
    const { page, close } = await open();
    await untilStatus(page, solved);
    await page.click("#options summary");
    const cost = await page.textContent("#cost");
    await page.focus("#seed");
    for (const key of ["s", "l", "o", "?"]) await page.keyboard.press(key);
    expect(await page.textContent("#solve")).toBe("Solve");
    expect(await page.textContent("#cost")).toBe(cost);
    expect(await page.isVisible("#layout-view")).toBe(true);
    expect(await page.isVisible("#help")).toBe(false);
    await close();
});

test("arrow_keys_turn_a_view_and_r_brings_it_back", async () => {
    const { page, close } = await open();
    await untilStatus(page, solved);
    await page.focus("#target-view canvas");
    const picture = async () => {
        await frames(page);
        return JSON.stringify([...(await colorsOf(page, "#target-view canvas"))].sort());
    };
    const before = await picture();
    for (const key of ["ArrowRight", "ArrowUp", "+"]) {
        const last = await picture();
        await page.keyboard.press(key);
        expect(await picture(), key).not.toBe(last);
    }
    await page.keyboard.press("r");
    expect(await picture()).toBe(before);
    await close();
});
