// Files as they come: chosen, dropped, swapped, refused, repaired, many at a time, and taken home.
import { unzipSync } from "fflate";
import {
    LayoutError,
    Session,
    type EmbeddingDocument,
    type LayoutInfo,
    type RefinedMapDocument,
    type TargetInfo,
} from "layout-embedding";
import { expect, inject, test } from "vitest";
import { aligned } from "../../web/src/model/alignment.js";
import {
    downloaded,
    drop,
    frames,
    numberIn,
    ready,
    solve,
    textFile,
    untilSolved,
    untilStatus,
    usePage,
} from "./browser.js";
import { ball, cube, toObj, toOff, toPly, toStl } from "./meshes.js";

const opened = usePage({ link: "shape=vase/tulip" });

const layoutText = toObj(cube);
const targetText = toObj(ball(3));

/** The sentence with which the package refuses a file, here in Node. */
async function refusal(
    role: "layout" | "target",
    name: string,
    text: string,
): Promise<LayoutError> {
    const session = await Session.create();
    const input = { name, bytes: Buffer.from(text) };
    const error: unknown = await (
        role === "layout" ? session.loadLayout(input) : session.loadTarget(input)
    ).catch((reason: unknown) => reason);
    await session.dispose();
    if (!(error instanceof LayoutError)) throw new Error(`${name} was not refused`);
    return error;
}

/** What the one problem on the page says, as one sentence again; dismisses it. */
async function dismissed(): Promise<{ code: string | null; message: string }> {
    const problem = opened().page.locator("[role=alert] .problem");
    await problem.waitFor();
    const code = await problem.locator("p code").textContent();
    const cause = (await problem.locator(".cause").textContent()) ?? "";
    const advice = (await problem.locator(".advice").textContent()) ?? "";
    await problem.getByRole("button", { name: /^Dismiss/ }).click();
    expect(await problem.count()).toBe(0);
    return { code, message: `${cause.replace(/\.$/, "")}; ${advice}` };
}

const withoutCase = (text: string) => text.replace(" (--repair)", "").toLowerCase();

let requestsAtFirst = 0;

test("a_bad_file_shows_cause_and_advice_of_the_core_and_keeps_what_was_loaded", async () => {
    const { page, requests } = opened();
    requestsAtFirst = requests.length;
    const cost = await page.textContent("#cost");
    const name = await page.textContent("#target-name");
    for (const [role, file, text] of [
        ["layout", "empty.obj", ""],
        ["target", "empty.off", ""],
        ["target", "text.obj", "this is no mesh\n"],
        ["target", "nan.off", "OFF\n3 1 0\nnan 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"],
        ["target", "range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"],
    ] as const) {
        const error = await refusal(role, file, text);
        await page.setInputFiles(`#${role}-file`, textFile(file, text));
        const { code, message } = await dismissed();
        expect(code).toBe(error.code);
        expect(withoutCase(message)).toBe(withoutCase(error.message));
    }
    expect(await page.textContent("#target-name")).toBe(name);
    expect(await page.textContent("#cost")).toBe(cost);
    await page.setInputFiles("#landmarks-file", textFile("short.txt", "0\n1\n"));
    expect((await dismissed()).code).toBe("landmarkCount");
    expect(await page.isEnabled("#solve")).toBe(true);
    await solve(page);
    expect(await page.textContent("#cost")).toBe(cost);
});

test("the_place_of_an_error_is_shown_on_the_mesh_that_was_refused", async () => {
    const { page } = opened();
    // The last face of the ball is there twice.
    const twice = `${targetText.trimEnd()}\n${targetText.trimEnd().split("\n").at(-1)}\n`;
    await page.setInputFiles("#target-file", textFile("twice.obj", twice));
    const show = page.getByRole("button", { name: "Show where" });
    await show.waitFor();
    expect(await show.getAttribute("aria-pressed")).toBe("true");
    expect(await page.textContent("#place-name")).toContain("twice.obj");
    await frames(page);
    const picture = await page.locator("#place-view canvas").screenshot();
    // Something is drawn: one colour alone is far smaller.
    expect(picture.length).toBeGreaterThan(4000);
    await show.click();
    expect(await page.isVisible("#place-view")).toBe(false);
    await show.click();
    expect(await page.isVisible("#place-view")).toBe(true);
    await dismissed();
    expect(await page.isVisible("#place-view")).toBe(false);
    // A line of the file is quoted.
    await page.setInputFiles("#target-file", textFile("line.obj", "v 0 0 0\nv 1 one 0\n"));
    expect(await page.locator(".problem pre").textContent()).toBe("v 1 one 0");
    await dismissed();
});

test("files_chosen_together_get_their_roles_and_can_be_solved", async () => {
    const { page } = opened();
    const chooser = page.waitForEvent("filechooser");
    await page.click("label:has(#any-file)");
    // The target comes first: the order must not matter.
    await (await chooser).setFiles([textFile("a.obj", targetText), textFile("b.obj", layoutText)]);
    await untilStatus(page, ready);
    expect(await page.textContent("#layout-name")).toBe("b.obj");
    expect(await page.textContent("#target-name")).toBe("a.obj");
    expect(await page.textContent("#notices")).toContain("b.obj was taken as the layout");
    expect(await page.textContent("#landmarks-name")).toBe("8, by proximity");
    await solve(page);
    expect(await page.textContent("#embedded")).toBe("12 of 12");
});

test("a_layout_that_lies_elsewhere_is_aligned_before_its_landmarks_are_placed", async () => {
    const { page } = opened();
    const cost = await page.textContent("#cost");
    const positions = cube.positions.map((x) => 100 * x + 4000);
    await page.setInputFiles("#layout-file", textFile("far.obj", toObj({ ...cube, positions })));
    await untilStatus(page, ready);
    expect(await page.textContent("#notices")).toContain("aligned");
    expect(await page.isChecked("#align")).toBe(true);
    await solve(page);
    expect(await page.textContent("#cost")).toBe(cost);
    await page.setInputFiles("#layout-file", textFile("b.obj", layoutText));
    await untilStatus(page, ready);
    expect(await page.isChecked("#align")).toBe(false);
    await solve(page);
    expect(await page.textContent("#cost")).toBe(cost);
});

test("aligning_finds_place_size_and_axes", () => {
    // The corners of a box, and the box's own corners under a rotation, a motion and a scaling.
    const box: number[] = [];
    for (const x of [0, 1]) for (const y of [0, 2]) for (const z of [0, 4]) box.push(x, y, z);
    const moved = box.map((_, i) => {
        const [x, y, z] = box.slice(i - (i % 3), i - (i % 3) + 3) as [number, number, number];
        return 10 * [y + 5, z, -x][i % 3]!;
    });
    const layout = { positions: Float64Array.from(box) } as LayoutInfo;
    const target = { positions: Float64Array.from(moved), vertexCount: 8 } as TargetInfo;
    const { positions } = aligned(layout, target);
    const corners = (points: ArrayLike<number>) =>
        Array.from({ length: 8 }, (_, v) =>
            [0, 1, 2].map((axis) => points[3 * v + axis]!.toFixed(9).replace("-0.0", "0.0")).join(),
        ).sort();
    expect(corners(positions)).toEqual(corners(moved));
});

test("the_files_taken_home_pass_the_checker", async () => {
    const { page } = opened();
    const zip = unzipSync(await downloaded(page, () => page.click("#download-all")));
    const get = (name: string) => Buffer.from(zip[name] ?? []).toString();
    const obj = get("refined.obj");
    const written = JSON.parse(get("embedding.json")) as EmbeddingDocument;
    const map = JSON.parse(get("refined_map.json")) as RefinedMapDocument;
    const numbers = (prefix: string) =>
        obj
            .split("\n")
            .filter((line) => line.startsWith(`${prefix} `))
            .flatMap((line) => line.split(/\s+/).slice(1).map(Number));
    // refined.obj lists its triangles patch by patch: the order of the map and the patches.
    const session = await Session.create();
    await session.loadLayout({ name: "cube.obj", bytes: Buffer.from(layoutText) });
    await session.loadTarget({ name: "ball.obj", bytes: Buffer.from(targetText) });
    await session.setLandmarks({ bytes: zip["landmarks.txt"] ?? new Uint8Array() });
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

test("layout_target_and_landmarks_can_be_dropped_together", async () => {
    const { page } = opened();
    await drop(page, [
        { name: "landmarks.txt", text: "0\n1\n2\n3\n4\n5\n6\n7\n" },
        { name: "target.off", text: toOff(ball(3)) },
        { name: "layout.off", text: toOff(cube) },
    ]);
    await untilStatus(page, ready);
    expect(await page.textContent("#layout-name")).toBe("layout.off");
    expect(await page.textContent("#target-name")).toBe("target.off");
    expect(await page.textContent("#landmarks-name")).toBe("8, landmarks.txt");
    await solve(page);
    expect(await page.textContent("#embedded")).toBe("12 of 12");
});

test("ply_stl_and_named_landmarks_are_known_by_their_endings", async () => {
    const { page } = opened();
    const landmarks = cube.faces.flat().length / 3;
    const points = Array.from({ length: landmarks }, (_, i) => ({
        name: `corner ${String(i)}`,
        position: cube.positions.slice(3 * i, 3 * i + 3),
    }));
    await drop(page, [
        { name: "a.json", text: JSON.stringify({ landmarks: points }) },
        { name: "b.stl", text: toStl(ball(3)) },
        { name: "c.ply", text: toPly(cube) },
    ]);
    await untilStatus(page, ready);
    expect(await page.textContent("#layout-name")).toBe("c.ply");
    expect(await page.textContent("#target-name")).toBe("b.stl");
    expect(await page.textContent("#landmarks-name")).toBe("8, a.json");
    await solve(page);
    expect(await page.textContent("#embedded")).toBe("12 of 12");
    // What it makes of them goes home in other programs' formats, too.
    const files = unzipSync(await downloaded(page, () => page.click("#download-all")));
    for (const name of ["refined.obj", "refined.ply", "refined.vtp", "refined.glb", "refined.svg"])
        expect(files[name]?.length).toBeGreaterThan(1000);
});

test("layout_and_target_can_be_swapped", async () => {
    const { page } = opened();
    await drop(page, [
        { name: "small.obj", text: toObj(ball(0)) },
        { name: "big.obj", text: toObj(ball(1)) },
    ]);
    await untilStatus(page, ready);
    expect(await page.textContent("#layout-name")).toBe("small.obj");
    await page.click("#swap");
    await page.waitForFunction(
        () => document.getElementById("target-name")?.textContent === "small.obj",
    );
    expect(await page.textContent("#layout-name")).toBe("big.obj");
    await untilStatus(page, /^Choose landmarks/);
});

test("a_repair_is_offered_where_it_helps_and_landmark_files_keep_the_given_numbers", async () => {
    const { page } = opened();
    const unused =
        "v 5 5 5\n" +
        targetText.replace(/^f .*$/gm, (line) =>
            line.replace(/\d+/g, (id) => String(Number(id) + 1)),
        );
    await page.setInputFiles("#layout-file", textFile("cube.obj", layoutText));
    await page.waitForFunction(
        () => document.getElementById("layout-name")?.textContent === "cube.obj",
    );
    await page.setInputFiles("#target-file", textFile("unused.obj", unused));
    await page.locator(".problem code", { hasText: "unusedVertex" }).waitFor();
    await page.getByRole("button", { name: "Repair and read again" }).click();
    await page.waitForFunction(
        () => document.getElementById("target-name")?.textContent === "unused.obj",
    );
    await untilStatus(page, ready);
    expect((await page.textContent("#notices"))?.length).toBeGreaterThan(0);
    await solve(page);
    // The repair has removed vertex 0 of the file: the numbers of both files differ by one.
    const zip = unzipSync(await downloaded(page, () => page.click("#download-all")));
    const text = (name: string) => Buffer.from(zip[name] ?? []).toString();
    const { landmarks } = JSON.parse(text("embedding.json")) as EmbeddingDocument;
    const given = text("landmarks.txt").trim().split("\n").map(Number);
    expect(given).toEqual([...landmarks].map((vertex) => vertex + 1));
    const saved = await downloaded(page, () => page.click("#save-landmarks"));
    expect(saved.toString()).toBe(text("landmarks.txt"));
    // They come back to the same places.
    const cost = await page.textContent("#cost");
    await page.setInputFiles("#landmarks-file", textFile("again.txt", saved.toString()));
    await untilStatus(page, ready);
    await solve(page);
    expect(await page.textContent("#cost")).toBe(cost);
    await page.uncheck("#repair");
});

test("one_layout_is_embedded_into_many_dropped_targets", async () => {
    const { page } = opened();
    await page.click("#batch-button");
    expect(await page.textContent("#batch-layout")).toBe("cube.obj");
    const landmarks = "0\n1\n2\n3\n4\n5\n6\n7\n";
    await drop(page, [
        { name: "b.obj", text: toObj(ball(2)) },
        { name: "c.off", text: "OFF\n" },
        { name: "b_landmarks.txt", text: landmarks },
        { name: "a.off", text: toOff(ball(3)) },
        { name: "z.txt", text: landmarks },
    ]);
    await page.waitForFunction(() =>
        /^3 of 3 done, /.test(document.getElementById("batch-count")?.textContent ?? ""),
    );
    expect(await page.textContent("#batch-note")).toContain("z.txt");
    const rows = await page
        .locator("#batch-rows tr")
        .evaluateAll((all) =>
            all.map((row) => [...row.children].map((cell) => cell.textContent ?? "")),
        );
    expect(rows.map(([name, from]) => [name, from])).toEqual([
        ["a.off", "by proximity"],
        ["b.obj", "b_landmarks.txt"],
        ["c.off", "by proximity"],
    ]);
    expect(rows[0]?.[2]).toMatch(/^Solved/);
    expect(rows[1]?.[2]).toMatch(/^Solved/);
    expect(rows[2]?.[2]).toMatch(/^The target c\.off .*\. [A-Z].*\.$/);
    const zip = unzipSync(await downloaded(page, () => page.click("#batch-zip")));
    expect(Object.keys(zip).sort()).toEqual([
        "a/embedding.json",
        "a/refined.obj",
        "a/refined_map.json",
        "b/embedding.json",
        "b/refined.obj",
        "b/refined_map.json",
        "summary.csv",
    ]);
    const table = Buffer.from(zip["summary.csv"] ?? []).toString();
    expect(table.split("\n")).toHaveLength(5);
    // One of them is opened in the views, with the same outcome.
    await page.getByRole("button", { name: "Open b.obj" }).click();
    await page.waitForFunction(
        () => document.getElementById("target-name")?.textContent === "b.obj",
    );
    await untilSolved(page);
    expect(await page.textContent("#cost")).toBe(rows[1]?.[3]);
    expect(await page.textContent("#landmarks-name")).toBe("8, b_landmarks.txt");
});

test("a_solve_can_be_cancelled_and_the_page_stays_usable", async () => {
    const { page } = opened();
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
});

test("the_seed_and_the_gap_reach_the_solver", async () => {
    const { page } = opened();
    await page.setInputFiles("#any-file", [
        textFile("cube.obj", layoutText),
        textFile("ball.obj", targetText),
    ]);
    await untilStatus(page, ready);
    await page.click("#options summary");
    await page.fill("#seed", "7");
    await page.fill("#gap", "20");
    await page.fill("#time-limit", "50");
    await solve(page);
    const text = await downloaded(page, () => page.click('button[data-file="embedding.json"]'));
    const written = JSON.parse(text.toString()) as EmbeddingDocument;
    expect(written.seed).toBe(7);
    expect(written.limits).toMatchObject({ gap: 0.2, timeLimit: 50 });
    expect(await numberIn(page, "#cost")).toBeGreaterThan(0);
});

test("nothing_has_left_the_browser", async () => {
    const { page, requests } = opened();
    // Not even its own files are asked for once the page has loaded.
    expect(requests.slice(requestsAtFirst).filter((url) => !url.startsWith("blob:"))).toEqual([]);
    expect(requests[0]).toContain(inject("pageUrl"));
    expect(await page.textContent("footer")).toContain("Nothing leaves your browser");
});
