// The tab of maps: a second target, what is carried across, corresponding points, files.
import { readFile } from "node:fs/promises";
import { mapFiles, Session } from "layout-embedding";
import { unzipSync } from "fflate";
import { expect, inject, test } from "vitest";
import {
    colorsOf,
    downloaded,
    drop,
    frames,
    ready,
    solve,
    solved,
    textFile,
    untilStatus,
    usePage,
} from "./browser.js";
import { ball, cube, toObj } from "./meshes.js";

const opened = usePage({ link: "shape=vase/tulip" });

/** The part of map.json that is looked at here. */
interface MapDocument {
    aToB: ({ face: number; barycentric: number[] } | null)[];
}

async function untilMapped(pattern = /, optimised/): Promise<void> {
    await opened().page.waitForFunction(
        (source) =>
            new RegExp(source).test(document.getElementById("map-status")?.textContent ?? ""),
        pattern.source,
    );
}

async function shapeOf(name: string) {
    const file = (ending: string) =>
        readFile(new URL(`../../web/public/shapes/vase/${name}.${ending}`, import.meta.url));
    const landmarks = (await file("txt")).toString().trim().split(/\s+/).map(Number);
    return { target: { name: `${name}.obj`, bytes: await file("obj") }, landmarks };
}

/** What the card of corresponding points says. */
const points = () => opened().page.locator("#map-points dd").allTextContents();

test("the_other_shape_of_a_class_is_mapped_at_a_click_as_the_package_maps_it", async () => {
    const { page } = opened();
    await page.keyboard.press("3");
    expect(await page.isVisible("#map-empty")).toBe(true);
    await page.getByRole("button", { name: "Amphora", exact: true }).click();
    await untilMapped();
    const zip = unzipSync(await downloaded(page, () => page.click("#map-zip")));

    const [a, b] = [await shapeOf("tulip"), await shapeOf("amphora")];
    const session = await Session.create();
    await session.loadTarget(a.target);
    await session.loadLayout(await session.templateLayout(a.landmarks, { quads: true }));
    await session.setLandmarks(a.landmarks);
    await session.solve();
    await session.setReference();
    await session.loadTarget(b.target);
    await session.setLandmarks(b.landmarks);
    await session.solve();
    const map = await session.mapFromReference();
    await session.dispose();
    const text = (bytes?: Uint8Array) => Buffer.from(bytes ?? []).toString();
    for (const [name, bytes] of Object.entries(mapFiles(map)))
        expect(text(zip[name]), name).toBe(text(bytes));
    const [energy] = await page.locator("#map-figures dd").allTextContents();
    const figure = ({ meanEnergy }: { meanEnergy: number }) =>
        String(Number(meanEnergy.toPrecision(4)));
    expect(energy).toBe(`${figure(map.distortion)} (from ${figure(map.firstDistortion)})`);
});

test("a_texture_is_drawn_on_both_targets", async () => {
    const { page } = opened();
    const seen = [];
    for (const texture of ["grid", "checker", "patches", "distortion"]) {
        await page.selectOption("#texture", texture);
        await frames(page);
        const [first, second] = [
            await colorsOf(page, "#target-view canvas"),
            await colorsOf(page, "#map-view canvas"),
        ];
        // Both show a good part of the same colours.
        const common = [...first.keys()].filter((key) => second.has(key)).length;
        expect(common).toBeGreaterThan(first.size / 3);
        seen.push(JSON.stringify([...first]));
    }
    expect(new Set(seen).size).toBe(4);
    await page.selectOption("#texture", "grid");
    // Both are on the picture.
    const png = await downloaded(page, () => page.click('[data-picture="map.png"]'));
    const widthOf = async (view: string) => (await page.locator(view).boundingBox())?.width ?? 0;
    const widths = (await widthOf("#target-view canvas")) + (await widthOf("#map-view canvas"));
    expect(Math.abs(png.readUInt32BE(16) - widths)).toBeLessThan(3);
});

test("a_vertex_and_its_image_are_shown_by_number_by_key_and_under_the_pointer", async () => {
    const { page } = opened();
    const { aToB } = JSON.parse(
        (await downloaded(page, () => page.click('[data-map-file="map.json"]'))).toString(),
    ) as MapDocument;
    const b = await shapeOf("amphora");
    const session = await Session.create();
    const { positions, corners } = await session.loadTarget(b.target);
    await session.dispose();
    /** The nearest corner of the triangle that the image of a vertex lies in. */
    const imageOf = (vertex: number) => {
        const { face, barycentric } = aToB[vertex] ?? { face: 0, barycentric: [] };
        const place = [0, 1, 2].map((i) =>
            barycentric.reduce(
                (sum, weight, k) =>
                    sum + weight * (positions[3 * (corners[3 * face + k] ?? 0) + i] ?? 0),
                0,
            ),
        );
        return `(${place.map((x) => Number(x.toPrecision(4))).join(", ")})`;
    };
    await page.fill("#map-vertex", "300");
    await page.press("#map-vertex", "Enter");
    expect((await points())[0]).toMatch(/^near vertex 300 /);
    expect((await points())[1]).toContain(imageOf(300));
    expect(await page.textContent("#announcement")).toMatch(/^Vertex 300 of the first target/);
    await page.fill("#map-vertex", "999999");
    await page.press("#map-vertex", "Enter");
    expect(await page.textContent("#announcement")).toBe("There is no vertex 999999.");

    // From vertex to vertex with the keys, the image with it; no landmark moves.
    await page.focus("#target-view canvas");
    const landmarks = await page.textContent("#landmarks-name");
    await page.keyboard.press("Shift+ArrowRight");
    const [first, image] = await points();
    const vertex = Number(/near vertex (\d+)/.exec(first ?? "")?.[1]);
    expect(vertex).not.toBe(300);
    expect(image).toContain(imageOf(vertex));
    expect(await page.textContent("#landmarks-name")).toBe(landmarks);

    // The other way round under the pointer.
    const before = await points();
    const box = await page.locator("#map-view canvas").boundingBox();
    if (!box) throw new Error("the second target is not shown");
    await page.mouse.move(box.x + 0.5 * box.width, box.y + 0.5 * box.height);
    await frames(page);
    const after = await points();
    expect(after).not.toEqual(before);
    expect(after).not.toContain("–");
});

test("both_targets_are_seen_from_the_same_side", async () => {
    const { page } = opened();
    const picture = () => page.locator("#target-view canvas").screenshot();
    const before = await picture();
    await page.focus("#map-view canvas");
    await page.keyboard.press("ArrowLeft");
    await frames(page);
    expect((await picture()).equals(before)).toBe(false);
    await page.keyboard.press("ArrowRight");
});

test("a_map_is_stopped_without_losing_anything_and_gone_on_with", async () => {
    const { page } = opened();
    await page.getByRole("button", { name: "Amphora", exact: true }).click();
    await untilMapped(/^Optimising/);
    await page.click("#map-stop");
    // As far as it has come, with the figures of that.
    await untilMapped(/, partly optimised/);
    expect(await page.isVisible("#map-running")).toBe(false);
    expect(await page.locator("#map-figures dd").count()).toBe(4);
    expect(await page.textContent("#embedded")).toMatch(/^(\d+) of \1$/);
    await page.click("#map-again");
    await untilMapped();
    // The embedding is there as before, with its files.
    await page.click("#tab-embedding");
    expect(
        (await downloaded(page, () => page.click('[data-file="refined.obj"]'))).length,
    ).toBeGreaterThan(1000);
});

test("a_second_target_is_dropped_with_its_landmarks", async () => {
    const { page } = opened();
    await drop(page, [
        { name: "cube.obj", text: toObj(cube) },
        { name: "ball.obj", text: toObj(ball(2)) },
    ]);
    await untilStatus(page, ready);
    await page.click("#tab-map");
    expect(await page.textContent("#map-status")).toMatch(/solve first\.$/);
    await page.click("#tab-embedding");
    await solve(page);
    await page.click("#tab-map");
    await drop(page, [
        { name: "egg.obj", text: toObj(stretched(ball(2))) },
        { name: "egg.txt", text: "0\n1\n2\n3\n4\n5\n6\n7\n" },
    ]);
    await untilMapped();
    expect(await page.textContent("#map-caption")).toBe("egg.obj, 192 triangles");
    expect(await page.textContent("#target-name")).toBe("ball.obj");
    // What does not fit says why, and the page goes on.
    await drop(page, [
        { name: "open.obj", text: toObj({ ...ball(2), faces: ball(2).faces.slice(1) }) },
        { name: "open.txt", text: "0\n1\n2\n3\n4\n5\n6\n7\n" },
    ]);
    await untilMapped(/boundary|do not fit|Euler/);
    expect(await page.textContent("#embedded")).toBe("12 of 12");
});

test("texture_coordinates_of_the_first_targets_file_go_along", async () => {
    const { page } = opened();
    const own = page.locator("#texture option[value=file]");
    expect(await own.isDisabled()).toBe(true);
    await page.click("#tab-embedding");
    const textured = ball(2);
    const lines = Array.from(
        { length: textured.positions.length / 3 },
        (_, v) => `vt ${textured.positions.slice(3 * v, 3 * v + 2).join(" ")}`,
    );
    const faces = textured.faces.map(
        (face) => `f ${face.map((v) => `${v + 1}/${v + 1}`).join(" ")}`,
    );
    const vertices = toObj(textured)
        .split("\n")
        .filter((line) => line.startsWith("v "));
    await page.setInputFiles(
        "#target-file",
        textFile("ball.obj", [...vertices, ...lines, ...faces, ""].join("\n")),
    );
    await untilStatus(page, ready);
    await solve(page);
    await page.click("#tab-map");
    await drop(page, [
        { name: "egg.obj", text: toObj(stretched(ball(2))) },
        { name: "egg.txt", text: "0\n1\n2\n3\n4\n5\n6\n7\n" },
    ]);
    await untilMapped();
    const pictureOf = async (texture: string) => {
        await page.selectOption("#texture", texture);
        await frames(page);
        return colorsOf(page, "#map-view canvas");
    };
    const grid = await pictureOf("grid");
    expect(await pictureOf("file")).not.toEqual(grid);
    expect(await page.textContent("#texture-text")).toContain("texture coordinates");
    for (const name of ["overlay_a.obj", "overlay_b.obj"]) {
        const bytes = await downloaded(page, () => page.click(`[data-map-file="${name}"]`));
        const overlay = bytes.toString().split("\n");
        const corners = overlay.filter((line) => line.startsWith("f "));
        expect(corners.length).toBeGreaterThan(textured.faces.length);
        expect(corners.every((line) => /^f( \d+\/\d+){3}$/.test(line))).toBe(true);
        // The texture is the place on the first target: u and v of the vertices there.
        const [u] = overlay.filter((line) => line.startsWith("vt ")).map((line) => line.split(" "));
        expect(Math.abs(Number(u?.[1]))).toBeLessThanOrEqual(1);
    }
    await page.selectOption("#texture", "grid");
});

test("a_second_target_is_saved_with_a_session_and_is_there_after_a_reload", async () => {
    const { page } = opened();
    await drop(page, [
        { name: "egg.obj", text: toObj(stretched(ball(2))) },
        { name: "egg.txt", text: "0\n1\n2\n3\n4\n5\n6\n7\n" },
    ]);
    await untilMapped();
    const figures = () => page.locator("#map-figures dd").allTextContents();
    const before = await figures();
    await page.click("#tab-embedding");
    const session = await downloaded(page, () => page.click("#save-session"));
    expect(Object.keys(unzipSync(session)).sort()).toEqual([
        "layout.obj",
        "second.obj",
        "second_landmarks.txt",
        "session.json",
        "target.obj",
    ]);
    const mappedAgain = async () => {
        await untilStatus(page, solved);
        await page.click("#tab-map");
        await untilMapped(/^Mapped to egg\.obj, optimised/);
        expect(await figures()).toEqual(before);
    };
    await page.goto(inject("pageUrl").replace(/\/$/, "/index.html"));
    await mappedAgain();
    await page.click("#tab-embedding");
    await page.setInputFiles("#target-file", textFile("other.obj", toObj(ball(1))));
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
    await mappedAgain();
});

/** Longer in one direction. */
function stretched({ positions, faces }: ReturnType<typeof ball>) {
    return { positions: positions.map((x, i) => (i % 3 === 1 ? 1.6 * x : x)), faces };
}
