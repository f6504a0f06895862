// Other routes for single edges, and routes that stay: asked for on an edge's card or with the keys.
import type { EmbeddingDocument } from "layout-embedding";
import { unzipSync } from "fflate";
import { beforeAll, expect, inject, test } from "vitest";
import {
    downloaded,
    drop,
    numberIn,
    ready,
    solve,
    solved,
    textFile,
    untilSolved,
    untilStatus,
    usePage,
} from "./browser.js";
import { ball, cube, toObj } from "./meshes.js";

const opened = usePage({ link: "shape=vase/tulip" });

/** The rules in force, in words. */
const rules = () => opened().page.locator("#route-rules span").allTextContents();

/** The figures on the card, by name. */
async function figures(): Promise<Record<string, string>> {
    const rows = opened().page.locator("#selection-figures > div");
    return Object.fromEntries(
        await rows.evaluateAll((all) =>
            all.map((row) => [
                row.querySelector("dt")?.textContent ?? "",
                row.querySelector("dd")?.textContent ?? "",
            ]),
        ),
    );
}

async function embedding(): Promise<EmbeddingDocument> {
    const { page } = opened();
    const file = await downloaded(page, () => page.click('[data-file="embedding.json"]'));
    return JSON.parse(file.toString()) as EmbeddingDocument;
}

const edge = 4;

beforeAll(async () => {
    const { page } = opened();
    await drop(page, [
        { name: "cube.obj", text: toObj(cube) },
        { name: "ball.obj", text: toObj(ball(2)) },
    ]);
    await untilStatus(page, ready);
    // Two routes away, proofs take seconds.
    await page.click("#options summary");
    await page.fill("#work-limit", "1");
    await page.press("#work-limit", "Enter");
    await solve(page);
    await page.click("#edges summary");
    await page.click("#landmark-table summary");
    await page.getByRole("button", { name: `Show edge ${edge}`, exact: true }).click();
});

test("an_edge_takes_another_route_and_its_card_tells_the_price", async () => {
    const { page } = opened();
    const before = await embedding();
    await page.click("#route-another");
    await untilSolved(page);
    const after = await embedding();
    expect(after.cost).toBeGreaterThan(before.cost ?? Infinity);
    expect(after.constraints).toEqual([
        { rule: "avoid", edge, path: before.edges[edge]?.weakPath },
    ]);
    expect(after.edges[edge]?.weakPath).not.toEqual(before.edges[edge]?.weakPath);
    const shown = await figures();
    expect(Number(shown["All edges before"])).toBeCloseTo(before.cost ?? NaN, 4);
    expect(Number(shown["All edges now"])).toBeCloseTo(after.cost ?? NaN, 4);
    const price = 100 * ((after.cost ?? NaN) / (before.cost ?? NaN) - 1);
    expect(shown["Price of the route"]).toBe(`+${price.toFixed(2)} %`);
    expect(await page.textContent("#announcement")).toContain(`+${price.toFixed(2)} %`);
    expect(await page.textContent("#meaning")).toContain("rules for routes");
    expect(await rules()).toHaveLength(1);
    // The same button goes on to the next route.
    await page.click("#route-another");
    await untilSolved(page);
    expect(await rules()).toHaveLength(2);
    const third = await embedding();
    expect(third.cost).toBeGreaterThanOrEqual(after.cost ?? Infinity);

    await page.click("#undo");
    await untilSolved(page);
    await page.click("#undo");
    await untilSolved(page);
    expect(await rules()).toEqual([]);
    expect((await embedding()).cost).toBe(before.cost);
    expect(await figures()).not.toHaveProperty("Price of the route");
    await page.click("#redo");
    await untilSolved(page);
    expect((await embedding()).cost).toBe(after.cost);
    expect((await figures())["Price of the route"]).toBe(`+${price.toFixed(2)} %`);
    // Without the rule everything is as it was.
    await page.getByRole("button", { name: `Remove: edge ${edge}` }).click();
    await untilSolved(page);
    expect((await embedding()).cost).toBe(before.cost);
});

test("a_route_that_is_kept_stays_when_other_landmarks_move_and_ends_with_its_own", async () => {
    const { page } = opened();
    const vertexOf = (id: number) =>
        page.getByLabel(`Target vertex of landmark ${id}`, { exact: true });
    const moveTo = async (id: number, vertex: number, outcome = solved) => {
        await vertexOf(id).fill(String(vertex));
        await vertexOf(id).press("Enter");
        await untilStatus(page, outcome);
    };
    const { layoutEdge } = (await embedding()).edges[edge] ?? { layoutEdge: [0, 0] };
    // By keyboard: another route for the chosen edge, which then stays.
    await page.locator("#target-view canvas").focus();
    await page.keyboard.press("x");
    await untilSolved(page);
    await page.keyboard.press("k");
    expect(await page.getAttribute("#route-keep", "aria-pressed")).toBe("true");
    expect(await rules()).toHaveLength(2);
    const kept = (await embedding()).edges[edge]?.weakPath;
    await moveTo(1, neighbour(1));
    expect(await rules()).toHaveLength(2);
    expect((await embedding()).constraints.map(({ rule }) => rule)).toEqual(["avoid", "keep"]);
    expect((await embedding()).edges[edge]?.weakPath).toEqual(kept);
    expect(await figures()).not.toHaveProperty("Price of the route");

    // On the other side of the kept route there is no room.
    await moveTo(0, neighbour(0), /there is no embedding with these rules for routes/);
    await page.click("#undo");
    await untilSolved(page);
    await moveTo(layoutEdge[0], neighbour(layoutEdge[0]));
    expect(await rules()).toEqual([]);
    expect(await page.locator("#notices li").last().textContent()).toMatch(
        new RegExp(`^The rule for the route of edge ${edge} ended`),
    );
    await page.click("#undo");
    await untilSolved(page);
    expect(await rules()).toHaveLength(2);
    expect((await embedding()).edges[edge]?.weakPath).toEqual(kept);
});

/** A vertex of the ball beside a corner of the cube, which has the same number on both. */
function neighbour(corner: number): number {
    const face = ball(2).faces.find((corners) => corners.includes(corner)) ?? [];
    return face.find((v) => v !== corner) ?? 0;
}

test("rules_for_routes_are_saved_with_a_session_and_are_there_after_a_reload", async () => {
    const { page } = opened();
    const before = await rules();
    const cost = await page.textContent("#cost");
    expect(before).toHaveLength(2);
    const session = await downloaded(page, () => page.click("#save-session"));
    expect(Buffer.from(unzipSync(session)["session.json"] ?? []).toString()).toContain('"keep"');
    await page.goto(inject("pageUrl").replace(/\/$/, "/index.html"));
    await untilStatus(page, solved);
    expect(await rules()).toEqual(before);
    expect(await page.textContent("#cost")).toBe(cost);

    // Another target ends them, and says so.
    await page.setInputFiles("#target-file", textFile("other.obj", toObj(ball(1))));
    await page.locator("#notices li", { hasText: "there is another target" }).waitFor();
    expect(await rules()).toEqual([]);
    await page.setInputFiles("#any-file", {
        name: "session.zip",
        mimeType: "application/zip",
        buffer: session,
    });
    await page.waitForFunction(
        () => document.getElementById("target-name")?.textContent === "ball.obj",
    );
    await untilSolved(page);
    expect(await rules()).toEqual(before);
    expect(await numberIn(page, "#cost")).toBe(Number(cost));
});
