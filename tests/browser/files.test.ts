import { readFile } from "node:fs/promises";
import { unzipSync } from "fflate";
import { Session, LayoutError } from "layout-embedding";
import { expect, test } from "vitest";
import { drop, ready, solved, textFile, untilStatus, useBrowser } from "./browser.js";
import { ball, cube, toObj, toOff, toPly, toStl } from "./meshes.js";

const open = useBrowser();

const layoutText = toObj(cube);
const targetText = toObj(ball(4));

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

test("files_chosen_together_get_their_roles_and_can_be_solved", async () => {
    const { page, complaints, close } = await open();
    await untilStatus(page, solved);
    const chooser = page.waitForEvent("filechooser");
    await page.click("label:has(#any-file)");
    // The target comes first: the order must not matter.
    await (await chooser).setFiles([textFile("a.obj", targetText), textFile("b.obj", layoutText)]);
    await untilStatus(page, ready);
    expect(await page.textContent("#layout-name")).toBe("b.obj");
    expect(await page.textContent("#target-name")).toBe("a.obj");
    expect(await page.textContent("#notices")).toContain("b.obj was taken as the layout");
    expect(await page.textContent("#landmarks-name")).toBe("8, by proximity");
    await page.click("#solve");
    await untilStatus(page, solved);
    expect(await page.textContent("#embedded")).toBe("12 of 12");
    expect(complaints).toEqual([]);
    await close();
});

test("layout_target_and_landmarks_can_be_dropped_together", async () => {
    const { page, complaints, close } = await open();
    await untilStatus(page, solved);
    await drop(page, [
        { name: "landmarks.txt", text: "0\n1\n2\n3\n4\n5\n6\n7\n" },
        { name: "target.off", text: toOff(ball(4)) },
        { name: "layout.off", text: toOff(cube) },
    ]);
    await untilStatus(page, ready);
    expect(await page.textContent("#layout-name")).toBe("layout.off");
    expect(await page.textContent("#target-name")).toBe("target.off");
    expect(await page.textContent("#landmarks-name")).toBe("8, landmarks.txt");
    await page.click("#solve");
    await untilStatus(page, solved);
    expect(await page.textContent("#embedded")).toBe("12 of 12");
    expect(complaints).toEqual([]);
    await close();
});

test("ply_stl_and_named_landmarks_are_known_by_their_endings", async () => {
    const { page, complaints, close } = await open();
    await untilStatus(page, solved);
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
    await page.click("#solve");
    await untilStatus(page, solved);
    expect(await page.textContent("#embedded")).toBe("12 of 12");
    // What it makes of them goes home in other programs' formats, too.
    const download = page.waitForEvent("download");
    await page.click("#download-all");
    const files = unzipSync(await readFile(await (await download).path()));
    for (const name of ["refined.obj", "refined.ply", "refined.vtp", "refined.glb", "refined.svg"])
        expect(files[name]?.length).toBeGreaterThan(1000);
    expect(complaints).toEqual([]);
    await close();
});

test("layout_and_target_can_be_swapped", async () => {
    const { page, close } = await open();
    await untilStatus(page, solved);
    const triangles = toObj(ball(0));
    await drop(page, [
        { name: "small.obj", text: triangles },
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
    await close();
});

test("a_bad_file_shows_the_sentence_of_the_core_and_keeps_what_was_loaded", async () => {
    const { page, complaints, close } = await open();
    await untilStatus(page, solved);
    const cost = await page.textContent("#cost");
    const bad = toObj(cube);
    const error = await refusal("target", "quads.obj", bad);
    await page.setInputFiles("#target-file", textFile("quads.obj", bad));
    const alert = page.locator("[role=alert] .problem");
    await alert.waitFor();
    expect(await alert.locator(".message").textContent()).toBe(error.message);
    expect(await alert.locator("code").textContent()).toBe(error.code);
    // The example and its result are still there, and can be solved again.
    expect(await page.textContent("#target-name")).toBe("beast surface");
    expect(await page.textContent("#cost")).toBe(cost);
    await alert.getByRole("button", { name: /^Dismiss/ }).click();
    expect(await alert.count()).toBe(0);
    await page.click("#solve");
    await page.waitForFunction(() => document.getElementById("solve")?.textContent === "Solve");
    await untilStatus(page, solved);
    expect(await page.textContent("#cost")).toBe(cost);
    expect(complaints).toEqual([]);
    await close();
});

test.for([
    ["layout", "empty.obj", ""],
    ["target", "empty.off", ""],
    ["target", "text.obj", "this is no mesh\n"],
    ["target", "nan.off", "OFF\n3 1 0\nnan 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"],
    ["target", "range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"],
] as const)("the_page_refuses_as_the_package_does: %s %s", async ([role, name, text]) => {
    const error = await refusal(role, name, text);
    const { page, complaints, close } = await open();
    await untilStatus(page, solved);
    await page.setInputFiles(`#${role}-file`, textFile(name, text));
    const message = page.locator(".problem .message");
    await message.waitFor();
    expect(await message.textContent()).toBe(error.message);
    expect(complaints).toEqual([]);
    await close();
});

test("bad_landmarks_are_refused_and_the_old_ones_stay", async () => {
    const { page, close } = await open();
    await untilStatus(page, solved);
    const before = await page.textContent("#landmarks-name");
    await page.setInputFiles("#landmarks-file", textFile("short.txt", "0\n1\n"));
    await page.locator(".problem code", { hasText: "landmarkCount" }).waitFor();
    expect(await page.textContent("#landmarks-name")).toBe(before);
    expect(await page.isEnabled("#solve")).toBe(true);
    await close();
});

test("a_repair_is_offered_where_it_helps_and_says_what_it_did", async () => {
    const { page, close } = await open();
    await untilStatus(page, solved);
    const unused =
        "v 5 5 5\n" +
        targetText.replace(/^f .*$/gm, (line) =>
            line.replace(/\d+/g, (id) => String(Number(id) + 1)),
        );
    await page.setInputFiles("#layout-file", textFile("cube.obj", layoutText));
    await page.setInputFiles("#target-file", textFile("unused.obj", unused));
    await page.locator(".problem code", { hasText: "unusedVertex" }).waitFor();
    await page.getByRole("button", { name: "Repair and read again" }).click();
    await page.waitForFunction(
        () => document.getElementById("target-name")?.textContent === "unused.obj",
    );
    await untilStatus(page, ready);
    expect((await page.textContent("#notices"))?.length).toBeGreaterThan(0);
    await page.click("#solve");
    await untilStatus(page, solved);
    await close();
});
