import { expect, test } from "vitest";
import { choose, solved, untilSolvedAfter, untilStatus, useBrowser } from "./browser.js";

const open = useBrowser();

test("a_shape_of_the_gallery_is_solved_and_its_landmarks_edited_in_the_table_with_undo", async () => {
    const { page, complaints, close } = await open();
    await untilStatus(page, solved);
    const before = await page.textContent("#target-name");
    await choose(page, "Tulip");
    await untilSolvedAfter(page, before);
    expect(await page.textContent("#embedded")).toMatch(/^(\d+) of \1$/);
    expect(await page.textContent("#landmarks-count")).toBe("14 of 14 placed");
    await page.uncheck("#live");

    await page.click("#landmark-table summary");
    const vertex = page.getByLabel("Target vertex of landmark 2", { exact: true });
    const original = await vertex.inputValue();
    await page.getByLabel("Remove landmark 2", { exact: true }).click();
    expect(await vertex.inputValue()).toBe("");
    expect(await page.textContent("#status")).toBe("Landmarks missing: 1.");
    expect(await page.isDisabled("#solve")).toBe(true);
    // A vertex that another landmark has is refused.
    const taken = await page
        .getByLabel("Target vertex of landmark 3", { exact: true })
        .inputValue();
    await vertex.fill(taken);
    await vertex.press("Enter");
    expect(await page.textContent("#landmarks-count")).toBe("13 of 14 placed");

    // The next missing one goes where the target is clicked.
    await page.click("#next-missing");
    expect(await page.textContent("#placing-text")).toContain("landmark 2");
    const canvas = page.locator("#target-view canvas");
    const box = await canvas.boundingBox();
    if (!box) throw new Error("the target is not shown");
    await canvas.click({ position: { x: box.width / 2, y: 0.55 * box.height } });
    expect(await page.textContent("#landmarks-count")).toBe("14 of 14 placed");
    expect(await vertex.inputValue()).not.toBe(original);

    await page.click("#undo");
    expect(await vertex.inputValue()).toBe("");
    await page.click("#undo");
    expect(await vertex.inputValue()).toBe(original);
    expect(await page.isDisabled("#undo")).toBe(true);
    await page.click("#redo");
    expect(await vertex.inputValue()).toBe("");
    await page.click("#undo");
    await page.click("#solve");
    await page.waitForFunction(() => document.getElementById("solve")?.textContent === "Solve");
    await untilStatus(page, solved);
    expect(await page.textContent("#embedded")).toMatch(/^(\d+) of \1$/);
    expect(complaints).toEqual([]);
    await close();
});
