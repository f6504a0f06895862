import { Session, type EmbeddingDocument, type RefinedMapDocument } from "layout-embedding";
import { expect, test } from "vitest";
import { examples } from "../../web/src/examples/index.js";
import {
    choose,
    downloaded,
    drop,
    ready,
    solved,
    untilSolvedAfter,
    untilStatus,
    useBrowser,
} from "./browser.js";
import { ball, cube, toObj } from "./meshes.js";

const open = useBrowser();

/** A document without what depends on the clock. */
function timeless(text: string): unknown {
    return JSON.parse(text, (key, value: unknown) =>
        ["seconds", "cpuSeconds"].includes(key) ? undefined : value,
    );
}

test("chromium_and_node_give_the_same_embedding_bit_for_bit", async () => {
    const { page, close } = await open();
    await untilStatus(page, solved);
    const files = new Map<string, string>();
    for (const name of ["refined.obj", "embedding.json", "refined_map.json"])
        files.set(
            name,
            (await downloaded(page, () => page.click(`button[data-file="${name}"]`))).toString(),
        );
    await close();

    const example = examples[0]?.make();
    if (!example) throw new Error("there is no example");
    const session = await Session.create();
    await session.loadLayout(example.layout);
    await session.loadTarget(example.target);
    await session.setLandmarks(example.landmarks);
    const result = await session.solve({ gap: 0.01, seed: 1 });
    const here = await session.exportFiles();
    const text = (bytes: Uint8Array) => Buffer.from(bytes).toString();
    expect(files.get("refined.obj")).toBe(text(here["refined.obj"]));
    expect(timeless(files.get("embedding.json") ?? "")).toEqual(
        timeless(text(here["embedding.json"])),
    );
    expect(files.get("refined_map.json")).toBe(text(here["refined_map.json"]));
    const written = JSON.parse(files.get("embedding.json") ?? "") as EmbeddingDocument;
    expect(written.cost).toBe(result.cost);
    expect(written.insertionOrder).toEqual([...result.insertionOrder]);
    await session.dispose();
});

test("the_files_taken_home_pass_the_checker", async () => {
    const layoutText = toObj(cube);
    const targetText = toObj(ball(4));
    const { page, close } = await open();
    await untilStatus(page, solved);
    await drop(page, [
        { name: "cube.obj", text: layoutText },
        { name: "ball.obj", text: targetText },
    ]);
    await untilStatus(page, ready);
    await page.click("#solve");
    await untilStatus(page, solved);
    const get = async (name: string) =>
        (await downloaded(page, () => page.click(`button[data-file="${name}"]`))).toString();
    const obj = await get("refined.obj");
    const written = JSON.parse(await get("embedding.json")) as EmbeddingDocument;
    const map = JSON.parse(await get("refined_map.json")) as RefinedMapDocument;
    await close();

    const numbers = (prefix: string) =>
        obj
            .split("\n")
            .filter((line) => line.startsWith(`${prefix} `))
            .flatMap((line) => line.split(/\s+/).slice(1).map(Number));
    // refined.obj lists its triangles patch by patch: the order of the map and the patches.
    const session = await Session.create();
    await session.loadLayout({ name: "cube.obj", bytes: Buffer.from(layoutText) });
    await session.loadTarget({ name: "ball.obj", bytes: Buffer.from(targetText) });
    await session.setLandmarks(written.landmarks);
    const claim = {
        refined: {
            positions: Float64Array.from(numbers("v")),
            corners: Uint32Array.from(numbers("f"), (id) => id - 1),
            patches: Int32Array.from(written.patches, (patch) => patch ?? -1),
            triangleFaces: Uint32Array.from(map.triangleFaces),
            vertexFaces: Uint32Array.from(map.newVertices, (vertex) => vertex.face),
            vertexBarycentrics: Float64Array.from(
                map.newVertices.flatMap((vertex) => vertex.barycentric),
            ),
        },
        edges: written.edges,
    };
    expect(await session.check(claim)).toEqual([]);
    expect(written.edges).toHaveLength(12);
    // The check can fail: with the first chain turned around it does.
    const [first, ...others] = written.edges;
    if (!first) throw new Error("there is no edge");
    const turned = { ...first, chain: [...first.chain].reverse() };
    expect(await session.check({ ...claim, edges: [turned, ...others] })).not.toEqual([]);
    await session.dispose();
});

test("a_solve_can_be_cancelled_and_the_page_stays_usable", async () => {
    const { page, complaints, close } = await open();
    await untilStatus(page, solved);
    await drop(page, [
        { name: "layout.obj", text: toObj(ball(2)) },
        { name: "ball.obj", text: toObj(ball(5)) },
    ]);
    await untilStatus(page, ready);
    // The second click comes as soon as the button reads "Cancel", from within the page, so that
    // nothing depends on how fast this test is: the worker hears of it before it searches.
    await page.evaluate(() => {
        const button = document.getElementById("solve");
        if (!button) return;
        new MutationObserver((_, observer) => {
            if (button.textContent !== "Cancel") return;
            observer.disconnect();
            button.click();
        }).observe(button, { childList: true });
        button.click();
    });
    await untilStatus(page, /^Cancelled/);
    expect(await page.textContent("#solve")).toBe("Solve");
    expect(await page.textContent("#target-name")).toBe("ball.obj");
    expect(await page.textContent("#landmarks-name")).toContain("by proximity");
    expect(await page.textContent("#embedded")).not.toMatch(/^(\d+) of \1$/);
    await choose(page, "Pebble");
    await untilSolvedAfter(page, "ball.obj");
    expect(await page.textContent("#embedded")).toBe("12 of 12");
    expect(complaints).toEqual([]);
    await close();
});

test("the_seed_and_the_gap_reach_the_solver", async () => {
    const { page, close } = await open();
    await untilStatus(page, solved);
    await page.click("#options summary");
    await page.fill("#seed", "7");
    await page.fill("#gap", "20");
    await page.fill("#time-limit", "50");
    await page.click("#solve");
    await page.waitForFunction(() => document.getElementById("solve")?.textContent === "Solve");
    await untilStatus(page, solved);
    const text = await downloaded(page, () => page.click('button[data-file="embedding.json"]'));
    const written = JSON.parse(text.toString()) as EmbeddingDocument;
    expect(written.seed).toBe(7);
    expect(written.limits).toMatchObject({ gap: 0.2, timeLimit: 50 });
    await close();
});
