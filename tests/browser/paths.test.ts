// What paths cost and where they have to run: sharp edges, the target's boundary; as edits that can be
// taken back, and as parts of sessions and links.
import { strFromU8, unzipSync } from "fflate";
import type { EmbeddingDocument } from "layout-embedding";
import { expect, inject, test } from "vitest";
import {
    downloaded,
    drop,
    numberIn,
    ready,
    solve,
    solved,
    untilSolved,
    untilStatus,
    usePage,
} from "./browser.js";
import { toObj, type Polygons } from "./meshes.js";

const opened = usePage({
    link: "shape=machine_part/valve",
    permissions: ["clipboard-read", "clipboard-write"],
});

const embedding = async () => {
    const { page } = opened();
    const bytes = await downloaded(page, () => page.click('[data-file="embedding.json"]'));
    return JSON.parse(bytes.toString()) as EmbeddingDocument;
};

const rim = 24;
const rings = 4;

/** A round disk: the centre, then ring after ring; the last one is its boundary. */
function disk(): Polygons {
    const positions = [0, 0, 0];
    const faces: number[][] = [];
    const at = (ring: number, k: number) => (ring === 0 ? 0 : 1 + (ring - 1) * rim + (k % rim));
    for (let ring = 1; ring <= rings; ++ring)
        for (let k = 0; k < rim; ++k) {
            const angle = (2 * Math.PI * k) / rim;
            // A little out of round, so that no two paths are equally long.
            const radius = ring * (1 + 0.003 * Math.sin(5 * angle + ring));
            positions.push(radius * Math.cos(angle), radius * Math.sin(angle), 0);
            if (ring === 1) faces.push([0, at(1, k), at(1, k + 1)]);
            else
                faces.push(
                    [at(ring - 1, k), at(ring, k), at(ring, k + 1)],
                    [at(ring - 1, k), at(ring, k + 1), at(ring - 1, k + 1)],
                );
        }
    return { positions, faces };
}

/** Four triangles around a vertex. */
const umbrella: Polygons = {
    positions: [0, 0, 0, 4, 0, 0, 0, 4, 0, -4, 0, 0, 0, -4, 0],
    faces: [
        [0, 1, 2],
        [0, 2, 3],
        [0, 3, 4],
        [0, 4, 1],
    ],
};
const onRim = (quarter: number) => 1 + (rings - 1) * rim + (quarter * rim) / 4;

test("paths_follow_sharp_edges_that_cost_less_until_that_is_taken_back", async () => {
    const { page } = opened();
    expect(await page.isVisible("#boundary-row")).toBe(false);
    expect(await page.textContent("#features-text")).toBe("off");
    const cost = await page.textContent("#cost");
    await page.focus("#features");
    await page.keyboard.press("End");
    expect(await page.textContent("#features-text")).toBe("95 %");
    await untilSolved(page);
    expect(await numberIn(page, "#cost")).toBeLessThan(Number(cost?.replace(",", "")));
    expect(await page.textContent("#meaning")).toContain("sharp ones count up to 95 % less");
    expect((await embedding()).metric).toMatchObject({ featureDiscount: 0.95 });
    // The heuristics are measured with the same rule.
    await page.keyboard.press("c");
    await page.locator("#contenders tr").nth(3).waitFor();
    for (const text of await page.locator("#contenders td:nth-of-type(1)").allTextContents())
        expect(text).toMatch(/^\+|the same|dead end/);

    await page.click("#undo");
    await untilSolved(page);
    expect(await page.textContent("#features-text")).toBe("off");
    expect(await page.textContent("#cost")).toBe(cost);
    expect(await page.textContent("#meaning")).not.toContain("sharp");
    await page.click("#redo");
    await untilSolved(page);
    expect(await page.inputValue("#features")).toBe("95");
});

test("what_paths_cost_is_in_the_link_and_a_value_that_makes_no_sense_is_explained", async () => {
    const { page } = opened();
    await page.click("#copy-link");
    await page.locator("#notices li", { hasText: "clipboard" }).waitFor();
    const copied = await page.evaluate(() => navigator.clipboard.readText());
    expect(copied).toBe(`${inject("pageUrl")}#shape=machine_part/valve&features=0.95`);
    await page.goto("about:blank");
    await page.goto(`${inject("pageUrl")}#shape=cut_hand/open&features=7&boundary=follow`);
    await untilStatus(page, solved);
    expect(await page.locator("#notices li").allTextContents()).toEqual([
        "features=7 in the link was left out: it has to be a number from 0 to 0.95.",
    ]);
    expect(await page.textContent("#features-text")).toBe("off");
    expect(await page.isChecked("#boundary-edges")).toBe(true);
    expect((await embedding()).boundaryEdges).toBe("follow");
});

test("boundary_edges_follow_the_boundary_of_a_target_that_has_one", async () => {
    const { page } = opened();
    await drop(page, [
        { name: "umbrella.obj", text: toObj(umbrella) },
        { name: "disk.obj", text: toObj(disk()) },
        { name: "disk.txt", text: [0, ...[0, 1, 2, 3].map(onRim)].join("\n") },
    ]);
    await untilStatus(page, ready);
    await page.uncheck("#boundary-edges");
    await page.click("#options summary");
    await page.selectOption("#algorithm", "greedy");
    await solve(page);
    const free = await numberIn(page, "#cost");
    expect(await page.isVisible("#algorithm-note")).toBe(false);
    await page.check("#boundary-edges");
    await untilSolved(page);
    // Only the exact method can, and the page says so.
    expect(await page.isVisible("#algorithm-note")).toBe(true);
    expect(await numberIn(page, "#cost")).toBeGreaterThan(free);
    const { edges, algorithm } = await embedding();
    expect(algorithm).toBe("exact");
    const outer = edges.filter(({ layoutEdge }) => !layoutEdge.includes(0));
    expect(outer).toHaveLength(4);
    for (const { chain } of outer) {
        expect(chain).toHaveLength(rim / 4 + 1);
        for (const vertex of chain) expect(vertex).toBeGreaterThanOrEqual(onRim(0));
    }
    const session = unzipSync(await downloaded(page, () => page.click("#save-session")));
    expect(JSON.parse(strFromU8(session["session.json"]!))).toMatchObject({
        options: { boundaryEdges: "follow", featureDiscount: 0, algorithm: "greedy" },
    });
    await page.keyboard.press("Control+z");
    await untilSolved(page);
    expect(await numberIn(page, "#cost")).toBe(free);
    await page.selectOption("#algorithm", "");
});

test("boundary_edges_that_cannot_follow_say_where_and_run_freely_at_a_click", async () => {
    const { page } = opened();
    // The landmarks of two neighbours on the rim exchanged.
    await page.check("#boundary-edges");
    await page.setInputFiles("#landmarks-file", {
        name: "crossed.txt",
        mimeType: "text/plain",
        buffer: Buffer.from([0, ...[1, 0, 2, 3].map(onRim)].join("\n")),
    });
    await page.waitForFunction(() =>
        document.getElementById("landmarks-name")?.textContent?.includes("crossed.txt"),
    );
    await page.click("#solve");
    const problem = page.locator(".problem");
    await problem.waitFor();
    expect(await problem.locator("strong").textContent()).toBe("A setting does not fit");
    expect(await problem.locator(".cause").textContent()).toMatch(
        /^Layout edge \d+ cannot run along the target's boundary: the next landmark there/,
    );
    // One of the edge's landmarks is chosen.
    expect(await page.textContent("#selection-title")).toMatch(/^Landmark \d/);
    await problem.getByRole("button", { name: "Let boundary edges run freely" }).click();
    expect(await page.isChecked("#boundary-edges")).toBe(false);
    await page.waitForFunction(() =>
        /embedding|Solved/.test(document.getElementById("status")?.textContent ?? ""),
    );
    expect(await problem.count()).toBe(0);
});
