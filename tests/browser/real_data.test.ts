import { existsSync } from "node:fs";
import path from "node:path";
import { expect, test } from "vitest";
import { ready, solved, untilStatus, useBrowser } from "./browser.js";

const shared =
    process.env["LAYOUT_EMBEDDING_DATA"] ?? path.join(import.meta.dirname, "../../../shared");
const target = path.join(shared, "data/spot.obj");
const layout = path.join(shared, "data/spot_control_mesh.obj");

const open = useBrowser();

test("spot_and_its_control_mesh_are_embedded_in_the_page", async (context) => {
    if (!existsSync(target) || !existsSync(layout))
        context.skip(`the data is not there: ${target}`);
    const { page, complaints, close } = await open({ link: "shape=vase/tulip" });
    await untilStatus(page, solved);
    await page.setInputFiles("#any-file", [target, layout]);
    await untilStatus(page, ready);
    expect(await page.textContent("#layout-name")).toBe("spot_control_mesh.obj");
    expect(await page.textContent("#target-name")).toBe("spot.obj");
    await page.click("#solve");
    await untilStatus(page, solved);
    expect(await page.textContent("#embedded")).toMatch(/^(\d+) of \1$/);
    expect(await page.textContent("#gap-value")).toMatch(/^\d.* %$/);
    expect(complaints).toEqual([]);
    await close();
});
