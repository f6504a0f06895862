// Landmarks as people edit them: in the table, with the pointer, with the keys; layouts made here;
// and input that was not what it should be.
import { expect, test } from "vitest";
import {
    choose,
    colorsOf,
    downloaded,
    drop,
    findInTarget,
    frames,
    numberIn,
    ready,
    solve,
    textFile,
    untilSolved,
    untilSolvedAfter,
    untilStatus,
    usePage,
} from "./browser.js";
import { ball, cube, toObj, type Polygons } from "./meshes.js";

const opened = usePage({ link: "shape=vase/tulip" });

const vertexOf = async (id: number) => {
    const input = opened().page.getByLabel(`Target vertex of landmark ${id}`, { exact: true });
    return Number(await input.inputValue());
};

/** About where the cube's foremost corner is seen on the ball. */
const nearCorner = { x: 0.52, y: 0.4 };

/** The number of the landmark, edge or patch in what the page says of it. */
const numberOf = (said: string) => Number(/^\w+ (\d+)/.exec(said)?.[1]);

test("landmarks_of_a_shape_are_edited_in_the_table_with_undo", async () => {
    const { page } = opened();
    expect(await page.textContent("#embedded")).toMatch(/^(\d+) of \1$/);
    expect(await page.textContent("#landmarks-count")).toBe("14 of 14 placed");
    await page.uncheck("#live");

    await page.click("#landmark-table summary");
    const vertex = page.getByLabel("Target vertex of landmark 2", { exact: true });
    const original = await vertex.inputValue();
    await page.getByLabel("Remove landmark 2", { exact: true }).click();
    expect(await vertex.inputValue()).toBe("");
    // Said a moment after the edit, since a solve could have begun at once.
    await untilStatus(page, /^Landmarks missing: 1\.$/);
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
    await solve(page);
    expect(await page.textContent("#embedded")).toMatch(/^(\d+) of \1$/);
    await page.check("#live");
});

test("the_layout_of_one_shape_is_embedded_into_another_of_its_class", async () => {
    const { page } = opened();
    const layout = await page.textContent("#layout-name");
    const before = await page.textContent("#target-name");
    const others = await page
        .locator("#family option:not(:checked)")
        .evaluateAll((all) => all.map((one) => (one as HTMLOptionElement).value));
    expect(others.length).toBeGreaterThan(0);
    await page.selectOption("#family", others[0] ?? "");
    await untilSolvedAfter(page, before);
    expect(await page.textContent("#layout-name")).toBe(layout);
    expect(await page.textContent("#embedded")).toMatch(/^(\d+) of \1$/);
});

test("an_embedding_follows_a_dragged_landmark_and_is_proved_when_the_hand_rests", async () => {
    const { page } = opened();
    await drop(page, [
        { name: "cube.obj", text: toObj(cube) },
        { name: "ball.obj", text: toObj(ball(3)) },
    ]);
    await untilStatus(page, ready);
    await solve(page);
    const cost = await page.textContent("#cost");
    const { x, y, said } = await findInTarget(page, /^Landmark/, nearCorner);
    const id = numberOf(said);
    const vertex = await vertexOf(id);
    await page.mouse.move(x, y);
    await page.mouse.down();
    for (let step = 1; step <= 5; ++step) {
        await page.mouse.move(x + 10 * step, y + 6 * step);
        await frames(page, 1);
    }
    // The hand still holds it, and another embedding is there.
    await page.waitForFunction(
        (before) =>
            document.getElementById("meaning")?.textContent?.startsWith("Quick") &&
            document.getElementById("cost")?.textContent !== before,
        cost,
    );
    expect(await page.textContent("#embedded")).toBe("12 of 12");
    // The embedding that there was follows, without a search of its own.
    expect(await page.textContent("#lower-bound")).toBe("–");
    expect(await vertexOf(id)).not.toBe(vertex);
    // The patches from before have faded, but are there.
    const faded = await colorsOf(page, "#target-view canvas");
    await page.keyboard.press("p");
    await frames(page);
    const bare = await colorsOf(page, "#target-view canvas");
    await page.keyboard.press("p");
    expect(faded.size).toBeGreaterThan(bare.size);
    await page.mouse.up();
    await untilSolved(page);
    expect(await page.textContent("#meaning")).toMatch(/^Measured along/);
    const moved = await page.textContent("#cost");
    expect(moved).not.toBe(cost);
    // The whole drag is one step.
    await page.keyboard.press("Control+z");
    await untilSolved(page);
    expect(await vertexOf(id)).toBe(vertex);
    expect(await page.textContent("#cost")).toBe(cost);
    expect(await page.isEnabled("#redo")).toBe(true);
});

test("landmarks_patches_and_paths_show_their_figures_at_a_click", async () => {
    const { page } = opened();
    const title = () => page.textContent("#selection-title");
    const figures = () => page.locator("#selection-figures > div").allTextContents();
    const patch = await findInTarget(page, /^Patch/);
    await page.mouse.click(patch.x, patch.y);
    expect(await title()).toBe(patch.said);
    const [corners, area, share] = await figures();
    expect(corners).toMatch(/^Corners(\d, ){3}\d$/);
    expect(area).toMatch(/^Area[\d.]+$/);
    expect(share).toMatch(/^Share[\d.]+ %$/);
    const edge = await findInTarget(page, /^Edge/);
    await page.mouse.click(edge.x, edge.y);
    expect(await title()).toBe(`Edge ${numberOf(edge.said)}`);
    expect((await figures())[1]).toMatch(/^Length[\d.]+$/);
    await page.keyboard.press("Escape");
    expect(await page.isVisible("#selection")).toBe(false);
});

test("the_chosen_landmark_moves_to_its_neighbour_with_the_keys", async () => {
    const { page } = opened();
    const { x, y, said } = await findInTarget(page, /^Landmark/, nearCorner);
    const id = numberOf(said);
    const vertex = await vertexOf(id);
    await page.mouse.click(x, y);
    await page.focus("#target-view canvas");
    await page.keyboard.press("Shift+ArrowRight");
    await untilSolved(page);
    const right = await vertexOf(id);
    expect(right).not.toBe(vertex);
    expect(await page.textContent("#selection-title")).toBe(`Landmark ${id}`);
    await page.keyboard.press("Shift+ArrowLeft");
    await untilSolved(page);
    expect(await vertexOf(id)).not.toBe(right);
    for (let step = 0; step < 2; ++step) await page.keyboard.press("Control+z");
    await untilSolved(page);
    expect(await vertexOf(id)).toBe(vertex);
    await page.keyboard.press("Escape");
});

/** The cube with all faces turned around. */
const insideOut: Polygons = { ...cube, faces: cube.faces.map((face) => [...face].reverse()) };

/** Mends the one doubt, which makes the embedding far shorter; takes it back and does it again. */
async function mended(name: string): Promise<void> {
    const { page } = opened();
    const cost = await numberIn(page, "#cost");
    expect(await page.textContent("#doubts p")).toMatch(/^The .* instead of .*\.$/);
    await page.getByRole("button", { name }).click();
    await untilSolved(page);
    const after = await numberIn(page, "#cost");
    expect(after).toBeLessThan(0.75 * cost);
    expect(await page.locator("#doubts button").count()).toBe(0);
    await page.click("#undo");
    await untilSolved(page);
    expect(await numberIn(page, "#cost")).toBe(cost);
    await page.click("#redo");
    await untilSolved(page);
    expect(await numberIn(page, "#cost")).toBe(after);
}

test("a_layout_inside_out_is_turned_at_a_click", async () => {
    const { page } = opened();
    await drop(page, [
        { name: "layout.obj", text: toObj(insideOut) },
        { name: "target.obj", text: toObj(ball(3)) },
        { name: "landmarks.txt", text: "0\n1\n2\n3\n4\n5\n6\n7\n" },
    ]);
    await untilStatus(page, ready);
    await solve(page);
    await mended("Turn the layout inside out");
    expect(await page.textContent("#embedded")).toBe("12 of 12");
});

test("exchanged_landmarks_are_put_right_at_a_click", async () => {
    const { page } = opened();
    const before = await page.textContent("#target-name");
    await choose(page, "Tulip");
    await untilSolvedAfter(page, before);
    const cost = await page.textContent("#cost");
    const saved = await downloaded(page, () => page.click("#save-landmarks"));
    const ids = saved.toString().trim().split("\n");
    [ids[2], ids[3]] = [ids[3] ?? "", ids[2] ?? ""];
    await page.setInputFiles("#landmarks-file", textFile("swapped.txt", ids.join("\n")));
    await untilStatus(page, ready);
    await solve(page);
    await mended("Exchange these landmarks");
    expect(await page.textContent("#cost")).toBe(cost);
});

test("a_layout_is_made_of_landmarks_on_the_target", async () => {
    const { page } = opened();
    const canvas = page.locator("#target-view canvas");
    await page.uncheck("#quads");
    await page.click("#make-layout-2");
    const box = await canvas.boundingBox();
    if (!box) throw new Error("the target is not shown");
    const place = async (x: number, y: number) => {
        const before = await page.textContent("#landmarks-count");
        await canvas.click({ position: { x: x * box.width, y: y * box.height } });
        expect(await page.textContent("#landmarks-count")).not.toBe(before);
    };
    for (const [x, y] of [
        [0.5, 0.5],
        [0.42, 0.6],
        [0.58, 0.6],
        [0.5, 0.38],
    ] as const)
        await place(x, y);
    // The other side of the ball.
    await page.focus("#target-view canvas");
    for (let press = 0; press < 24; ++press) await page.keyboard.press("ArrowRight");
    await frames(page);
    await place(0.45, 0.55);
    await place(0.55, 0.5);
    await page.waitForFunction(() =>
        /^Layout of 6 landmarks/.test(document.getElementById("making-text")?.textContent ?? ""),
    );
    await page.click("#undo");
    await page.waitForFunction(() =>
        /^Layout of 5 landmarks/.test(document.getElementById("making-text")?.textContent ?? ""),
    );
    await page.click("#redo");
    await page.waitForFunction(() =>
        /^Layout of 6 landmarks/.test(document.getElementById("making-text")?.textContent ?? ""),
    );
    await page.click("#making-done");
    await untilStatus(page, ready);
    // A triangulation of a sphere with 6 vertices.
    expect(await page.textContent("#layout-caption")).toBe("6 vertices, 12 edges, 8 faces");
    await solve(page);
    expect(await page.textContent("#embedded")).toBe("12 of 12");
    const saved = await downloaded(page, () => page.click("#save-landmarks"));
    expect(new Set(saved.toString().trim().split("\n")).size).toBe(6);
});
