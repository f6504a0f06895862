// What outlives a visit: sessions as files, the last work in the browser, links.
import { strFromU8, strToU8, unzipSync, zipSync } from "fflate";
import { expect, inject, test } from "vitest";
import { downloaded, drop, ready, solve, solved, untilStatus, usePage } from "./browser.js";
import { ball, cube, toObj } from "./meshes.js";

const opened = usePage({
    link: "shape=vase/tulip",
    permissions: ["clipboard-read", "clipboard-write"],
});

/** What a person sees of the input. */
async function input() {
    const { page } = opened();
    const text = (id: string) => page.textContent(`#${id}`);
    return {
        layout: await text("layout-name"),
        target: await text("target-name"),
        landmarks: await text("landmarks-name"),
        seed: await page.inputValue("#seed"),
    };
}

test("the_last_work_is_there_again_after_a_reload", async () => {
    const { page } = opened();
    await drop(page, [
        { name: "cube.obj", text: toObj(cube) },
        { name: "ball.obj", text: toObj(ball(2)) },
        { name: "places.txt", text: "0\n1\n2\n3\n4\n5\n6\n7\n" },
    ]);
    await untilStatus(page, ready);
    await page.click("#options summary");
    await solve(page);
    const cost = await page.textContent("#cost");
    // Whoever leaves right after an edit finds it again.
    await page.fill("#seed", "3");
    await page.press("#seed", "Enter");
    const before = await input();
    expect(before.seed).toBe("3");
    // Without a link in the address.
    await page.goto(inject("pageUrl").replace(/\/$/, "/index.html"));
    // What was solved is solved again.
    await untilStatus(page, solved);
    expect(await input()).toEqual(before);
    expect(await page.textContent("#notices")).toContain("last visit");
    expect(await page.textContent("#cost")).toBe(cost);
});

test("a_session_is_saved_as_a_file_and_opened_again", async () => {
    const { page } = opened();
    const before = await input();
    const session = await downloaded(page, () => page.click("#save-session"));
    expect(Object.keys(unzipSync(session)).sort()).toEqual([
        "layout.obj",
        "session.json",
        "target.obj",
    ]);
    await page.click("#options summary");
    await page.fill("#seed", "9");
    await drop(page, [{ name: "other.obj", text: toObj(ball(3)) }]);
    await page.waitForFunction(
        () => document.getElementById("target-name")?.textContent === "other.obj",
    );
    await page.setInputFiles("#any-file", {
        name: "session.zip",
        mimeType: "application/zip",
        buffer: session,
    });
    await page.waitForFunction(
        () => document.getElementById("target-name")?.textContent === "ball.obj",
    );
    await untilStatus(page, solved);
    expect(await input()).toEqual(before);
    // What is no session says so.
    await page.setInputFiles("#any-file", {
        name: "broken.zip",
        mimeType: "application/zip",
        buffer: Buffer.from("no zip"),
    });
    await page.locator(".problem .cause", { hasText: "broken.zip" }).waitFor();
    await page.getByRole("button", { name: /^Dismiss/ }).click();
    expect(await input()).toEqual(before);
});

test("of_a_damaged_session_everything_is_opened_that_can_be_read", async () => {
    const { page } = opened();
    const before = await input();
    const session = await downloaded(page, () => page.click("#save-session"));
    const files = unzipSync(session);
    const open = async (bytes: Uint8Array, notice: string | null) => {
        await drop(page, [{ name: "other.obj", text: toObj(ball(3)) }]);
        await page.waitForFunction(
            () => document.getElementById("target-name")?.textContent === "other.obj",
        );
        const file = { name: "old.zip", mimeType: "application/zip", buffer: Buffer.from(bytes) };
        await page.setInputFiles("#any-file", file);
        await page.waitForFunction(
            () => document.getElementById("target-name")?.textContent !== "other.obj",
        );
        if (notice !== null)
            await page.locator("#notices li", { hasText: `lost are ${notice}.` }).waitFor();
    };

    // Without the end, where the list of the files is.
    await open(session.subarray(0, -40), null);
    await untilStatus(page, solved);
    expect(await input()).toEqual(before);

    const saved = JSON.parse(strFromU8(files["session.json"]!)) as object;
    const withDocument = (other: string) => zipSync({ ...files, "session.json": strToU8(other) });
    await open(withDocument(JSON.stringify({ ...saved, routes: [7] })), "the rules for routes");
    await untilStatus(page, solved);
    expect(await input()).toEqual(before);

    await open(withDocument('{ "version": 1, "layo'), "landmarks and options");
    expect(await page.textContent("#layout-name")).toBe("layout.obj");
    expect(await page.textContent("#target-name")).toBe("target.obj");

    // Without the layout one is made of the landmarks.
    delete files["layout.obj"];
    await open(zipSync(files), "the layout");
    await page.waitForFunction(
        (name) => document.getElementById("landmarks-name")?.textContent === name,
        before.landmarks,
    );
    expect(await page.textContent("#target-name")).toBe(before.target);
    expect(await page.textContent("#layout-caption")).toMatch(/^8 vertices/);
});

test("tabs_are_as_they_were_left_also_with_a_shape_that_nobody_edited", async () => {
    const { page } = opened();
    const home = inject("pageUrl").replace(/\/$/, "/index.html");
    await page.goto("about:blank");
    await page.goto(`${inject("pageUrl")}#shape=vase/tulip`);
    await untilStatus(page, solved);
    await page.click("#tab-quads");
    await page.locator("#quad-figures dd").first().waitFor();
    await page.fill("#edge-length", "0.5");
    await page.press("#edge-length", "Enter");
    await page.click("#loops summary");
    const loop = page.locator("#loop-rows input").first();
    await loop.fill("8");
    await loop.press("Enter");
    await page.click("#tab-map");
    await page.click("#map-shapes button");
    await page.locator("#map-figures dd").first().waitFor();
    await page.selectOption("#texture", "checker");
    await page.fill("#map-vertex", "300");
    await page.press("#map-vertex", "Enter");
    const second = await page.textContent("#map-caption");
    const points = () => page.locator("#map-points dd").allTextContents();
    const first = await points();
    await page.goto(home);
    await page.locator("#map-figures dd").first().waitFor();
    expect(await page.getAttribute("#tab-map", "aria-selected")).toBe("true");
    expect(await page.textContent("#map-caption")).toBe(second);
    expect(await page.inputValue("#texture")).toBe("checker");
    expect((await points())[0]).toBe(first[0]);
    expect((await points())[1]).toMatch(/^near vertex/);
    await page.click("#tab-quads");
    await page.click("#loops summary");
    expect(await page.inputValue("#edge-length")).toBe("0.5");
    expect(await loop.inputValue()).toBe("8");
    await page.click("#tab-map");
    // It is still there after another visit in which nothing was done but looked at.
    await page.waitForTimeout(700);
    await page.goto("about:blank");
    await page.goto(home);
    await page.waitForFunction(
        (caption) => document.getElementById("map-caption")?.textContent === caption,
        second,
    );
    await page.click("#tab-embedding");
    expect(await page.textContent("#target-name")).toBe("tulip.obj");
});

test("a_link_opens_a_shape_with_its_settings", async () => {
    const { page } = opened();
    await page.goto("about:blank");
    await page.goto(`${inject("pageUrl")}#shape=vase/tulip&seed=7&gap=0.05`);
    await untilStatus(page, solved);
    expect(await page.textContent("#target-name")).toBe("tulip.obj");
    expect(await page.inputValue("#seed")).toBe("7");
    expect(await page.inputValue("#gap")).toBe("5");
    await page.click("#copy-link");
    await page.locator("#notices li", { hasText: "clipboard" }).waitFor();
    const copied = await page.evaluate(() => navigator.clipboard.readText());
    expect(copied).toBe(`${inject("pageUrl")}#shape=vase/tulip&seed=7&gap=0.05`);
});
