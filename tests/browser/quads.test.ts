// The tab of quad meshes: density, figures, segments of loops, the file.
import { readFile } from "node:fs/promises";
import { Session } from "layout-embedding";
import { unzipSync } from "fflate";
import { expect, test } from "vitest";
import { colorsOf, downloaded, frames, numberIn, solved, untilStatus, usePage } from "./browser.js";

const opened = usePage({ link: "shape=vase/tulip" });

/** Waits until the mesh has been evened out; returns the number of quads that the page tells. */
async function untilRelaxed(): Promise<number> {
    const { page } = opened();
    await page.waitForFunction(() =>
        /, evened out/.test(document.getElementById("quads-status")?.textContent ?? ""),
    );
    return numberIn(page, "#quad-figures dd >> nth=0");
}

const savedMesh = async () => {
    const { page } = opened();
    return (await downloaded(page, () => page.click("#quads-obj"))).toString();
};

const linesOf = (obj: string, keyword: string) =>
    obj.split("\n").filter((line) => line.startsWith(`${keyword} `));

/** The segments of a layout edge in an OBJ file: the base complex comes in the layout's order. */
const segmentsOf = (obj: string, edge: number) =>
    (linesOf(obj, "l")[edge]?.split(" ").length ?? 0) - 2;

test("the_quads_tab_shows_the_mesh_that_the_package_makes", async () => {
    const { page } = opened();
    const before = await colorsOf(page, "#target-view canvas");
    await page.click("#tab-quads");
    const count = await untilRelaxed();
    const obj = await savedMesh();
    expect(linesOf(obj, "f").length).toBe(count);
    await frames(page);
    expect(await colorsOf(page, "#target-view canvas")).not.toEqual(before);

    const folder = new URL("../../web/public/shapes/vase/", import.meta.url);
    const landmarks = (await readFile(new URL("tulip.txt", folder), "utf8"))
        .trim()
        .split(/\s+/)
        .map(Number);
    const session = await Session.create();
    await session.loadTarget({
        name: "tulip.obj",
        bytes: await readFile(new URL("tulip.obj", folder)),
    });
    await session.loadLayout(await session.templateLayout(landmarks, { quads: true }));
    await session.setLandmarks(landmarks);
    await session.solve();
    const { obj: expected, statistics } = await session.quads();
    await session.dispose();
    expect(obj).toBe(Buffer.from(expected).toString());
    const figures = await page.locator("#quad-figures dd").allTextContents();
    expect(Number(figures[1])).toBe(statistics.flipped);
    expect(Number(figures[2])).toBeCloseTo(statistics.leastJacobian, 3);
    expect(Number(figures[3])).toBeCloseTo(statistics.meanJacobian, 3);
    // Taken home with everything else.
    await page.click("#tab-embedding");
    const zip = unzipSync(await downloaded(page, () => page.click("#download-all")));
    expect(Buffer.from(zip["quads.obj"] ?? []).toString()).toBe(obj);
});

test("a_newer_density_takes_the_place_of_an_older_one", async () => {
    const { page } = opened();
    await page.keyboard.press("2");
    const before = await untilRelaxed();
    // While the finest mesh is still being made or evened out, a coarse one is asked for.
    await page.focus("#density");
    await page.keyboard.press("End");
    const fine = await page.inputValue("#edge-length");
    await page.locator("#quads-running").waitFor();
    await page.keyboard.press("Home");
    expect(Number(await page.inputValue("#edge-length"))).toBeGreaterThan(Number(fine));
    const coarse = await untilRelaxed();
    expect(coarse).toBeLessThan(before);
    expect(linesOf(await savedMesh(), "f").length).toBe(coarse);
    // The mesh is there before it is evened out, and stays as it is when that is stopped.
    await page.focus("#density");
    await page.keyboard.press("End");
    await page.waitForFunction(
        (count) =>
            Number(
                document.querySelector("#quad-figures dd")?.textContent?.replace(/\D/g, "") ?? 0,
            ) > count,
        before,
    );
    await page.waitForFunction(
        () => document.getElementById("quads-status")?.textContent === "Evening the quads out …",
    );
    await page.click("#quads-stop");
    expect(await page.textContent("#quads-status")).toMatch(/, not evened out\.$/);
    expect(linesOf(await savedMesh(), "f").length).toBeGreaterThan(before);
    await page.fill("#edge-length", "");
    await page.press("#edge-length", "Enter");
    expect(await untilRelaxed()).toBe(before);
});

test("a_loop_gets_the_number_of_segments_that_is_asked_for", async () => {
    const { page } = opened();
    await page.click("#loops summary");
    const input = page.locator("#loop-rows input").first();
    const edge = Number((await input.getAttribute("id"))?.replace("segments-", ""));
    const usual = segmentsOf(await savedMesh(), edge);
    expect(Number(await input.inputValue())).toBe(usual);
    const wanted = 2 * Math.ceil(usual / 2) + 4;
    await input.fill(String(wanted));
    await input.press("Enter");
    await page.waitForFunction(
        () => !/evened out/.test(document.getElementById("quads-status")?.textContent ?? ""),
    );
    await untilRelaxed();
    expect(segmentsOf(await savedMesh(), edge)).toBe(wanted);
    // This layout has triangles: an odd number cannot be halved.
    await input.fill(String(wanted + 1));
    await input.press("Enter");
    await page.locator("#quads-status", { hasText: "segments" }).waitFor();
    await page.getByRole("button", { name: /^Segments of edges .* by density$/ }).click();
    await untilRelaxed();
    expect(segmentsOf(await savedMesh(), edge)).toBe(usual);
});

test("the_mesh_follows_another_embedding", async () => {
    const { page } = opened();
    const before = await savedMesh();
    await page.click("#tab-embedding");
    await page.click("#landmark-table summary");
    await page.getByLabel("Remove landmark 2", { exact: true }).click();
    await page.keyboard.press("2");
    expect(await page.textContent("#quads-status")).toBe("Quads need an embedding: solve first.");
    expect(await page.isDisabled("#quads-obj")).toBe(true);
    await page.click("#undo");
    await page.focus("#tab-quads");
    await page.keyboard.press("s");
    await untilStatus(page, solved);
    await untilRelaxed();
    expect(await savedMesh()).toBe(before);
});
