// Meshes that are no single oriented surface, and the offers to make one of them.
import { expect, test } from "vitest";
import { drop, numberIn, ready, solve, textFile, untilStatus, usePage } from "./browser.js";
import { ball, cube, toObj, type Polygons } from "./meshes.js";

const opened = usePage({ link: "shape=vase/tulip" });

const target = ball(2);
const layout = { name: "cube.obj", text: toObj(cube) };

/** A tetrahedron far off, before the other mesh. */
function withCrumb({ positions, faces }: Polygons): Polygons {
    const crumb = [9, 9, 9, 9.1, 9, 9, 9, 9.1, 9, 9, 9, 9.1];
    const tetrahedron = [
        [0, 2, 1],
        [0, 1, 3],
        [1, 2, 3],
        [2, 0, 3],
    ];
    return {
        positions: [...crumb, ...positions],
        faces: [...tetrahedron, ...faces.map((face) => face.map((v) => v + 4))],
    };
}

/** Cost of the cube in the target that is open. */
async function cost(): Promise<number> {
    await untilStatus(opened().page, ready);
    await solve(opened().page);
    return numberIn(opened().page, "#cost");
}

let whole = 0;

test("of_several_pieces_the_largest_one_is_kept_on_demand", async () => {
    const { page } = opened();
    await drop(page, [layout, { name: "ball.obj", text: toObj(target) }]);
    whole = await cost();
    const text = toObj(withCrumb(target));
    await page.setInputFiles("#target-file", textFile("crumb.obj", text));
    await page.locator(".problem code", { hasText: "severalComponents" }).waitFor();
    await page.getByRole("button", { name: "Keep the largest piece" }).click();
    await page.locator("#notices li", { hasText: "The largest of 2 pieces was kept" }).waitFor();
    expect(await page.textContent("#target-caption")).toBe(`${target.faces.length} triangles`);
    expect(await page.locator(".problem").count()).toBe(0);
    expect(await cost()).toBe(whole);
});

test("faces_turned_against_each_other_are_turned_outwards_on_demand", async () => {
    const { page } = opened();
    const turned = target.faces.map((face, f) => (f % 3 === 0 ? face : [...face].reverse()));
    const text = toObj({ ...target, faces: turned });
    await page.setInputFiles("#target-file", textFile("mixed.obj", text));
    await page.locator(".problem code", { hasText: "inconsistentOrientation" }).waitFor();
    await page.getByRole("button", { name: "Turn all faces the same way" }).click();
    await page.locator("#notices li", { hasText: "128 of 192 faces were turned." }).waitFor();
    expect(await cost()).toBe(whole);
});

test("a_surface_with_one_side_only_is_said_to_be_one", async () => {
    const { page } = opened();
    // A Möbius strip: the last square is glued to the first one upside down.
    const count = 9;
    const positions: number[] = [];
    for (let i = 0; i < count; ++i)
        for (const side of [-1, 1]) {
            const angle = (2 * Math.PI * i) / count;
            const radius = 2 + 0.5 * side * Math.cos(angle / 2);
            const height = 0.5 * side * Math.sin(angle / 2);
            positions.push(radius * Math.cos(angle), height, radius * Math.sin(angle));
        }
    const faces: number[][] = [];
    for (let i = 0; i < count; ++i) {
        const last = i + 1 === count;
        const [a, b] = [2 * i, 2 * i + 1];
        const [c, d] = last ? [0, 1] : [b + 2, a + 2];
        faces.push([a, b, c], [a, c, d]);
    }
    await page.setInputFiles("#target-file", textFile("strip.obj", toObj({ positions, faces })));
    await page.locator(".problem code", { hasText: "inconsistentOrientation" }).waitFor();
    await page.getByRole("button", { name: "Turn all faces the same way" }).click();
    await page.locator(".problem .cause", { hasText: "one side only" }).waitFor();
    // What was open before still is.
    expect(await page.textContent("#target-name")).toBe("mixed.obj");
});
