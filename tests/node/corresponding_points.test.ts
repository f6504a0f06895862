// What the page finds in a map by itself, against what the core says.
import { readFileSync } from "node:fs";
import { Session, type SurfaceMap, type TargetInfo } from "layout-embedding";
import { beforeAll, expect, test } from "vitest";
import { Correspondence, placeOf, type FacePoint } from "../../web/src/model/correspondence.js";
import { triangleEnergies } from "../../web/src/view3d/distortion.js";

const folder = new URL("../../web/public/shapes/vase/", import.meta.url);

function shape(name: string) {
    const landmarks = readFileSync(new URL(`${name}.txt`, folder), "utf8")
        .trim()
        .split(/\s+/)
        .map(Number);
    return { target: { name, bytes: readFileSync(new URL(`${name}.obj`, folder)) }, landmarks };
}

let session: Session;
let map: SurfaceMap;
let targets: Record<"a" | "b", TargetInfo>;

beforeAll(async () => {
    const [first, second] = [shape("tulip"), shape("amphora")];
    session = await Session.create();
    const a = await session.loadTarget(first.target);
    await session.loadLayout(await session.templateLayout(first.landmarks, { quads: true }));
    await session.setLandmarks(first.landmarks);
    await session.solve();
    await session.setReference();
    const b = await session.loadTarget(second.target);
    await session.setLandmarks(second.landmarks);
    await session.solve();
    map = await session.mapFromReference();
    targets = { a, b };
}, 120_000);

/** A point inside of each face, not the same one in all. */
const inside = (face: number): FacePoint => {
    const [u, v] = [0.1 + (0.4 * (face % 7)) / 7, 0.1 + (0.4 * (face % 11)) / 11];
    return { face, weights: [u, v, 1 - u - v] };
};

const distance = (p: readonly number[], q: readonly number[]) =>
    Math.hypot(...p.map((x, i) => x - (q[i] ?? NaN)));

test("images_of_points_are_those_of_the_core", async () => {
    const found = new Correspondence(map);
    for (const [side, other, from] of [
        ["a", "b", "reference"],
        ["b", "a", "target"],
    ] as const) {
        const points = Array.from({ length: targets[side].faceCount }, (_, face) => inside(face));
        const images = await session.mapPoints(from, {
            faces: Int32Array.from(points, ({ face }) => face),
            barycentrics: Float64Array.from(points.flatMap(({ weights }) => [...weights])),
        });
        const apart = points.map((point, i) => {
            const image = found.image(side, point);
            const [u = NaN, v = NaN, w = NaN] = images.barycentrics.subarray(3 * i, 3 * i + 3);
            const expected = { face: images.faces[i] ?? -1, weights: [u, v, w] as const };
            return image
                ? distance(placeOf(targets[other], image), placeOf(targets[other], expected))
                : Infinity;
        });
        expect(Math.max(...apart)).toBeLessThan(1e-9);
    }
});

test("the_image_of_an_image_is_the_point_itself", () => {
    const found = new Correspondence(map);
    const apart = Array.from({ length: targets.a.faceCount }, (_, face) => {
        const image = found.image("a", inside(face));
        const back = image && found.image("b", image);
        return back
            ? distance(placeOf(targets.a, back), placeOf(targets.a, inside(face)))
            : Infinity;
    });
    expect(Math.max(...apart)).toBeLessThan(1e-6);
});

test("energies_of_triangles_have_the_mean_that_the_core_reports", () => {
    const { corners, referencePositions } = map.overlay;
    const energies = triangleEnergies(map);
    let [sum, total] = [0, 0];
    energies.forEach((energy, t) => {
        const [p = [], q = [], r = []] = [0, 1, 2].map((k) => {
            const v = 3 * (corners[3 * t + k] ?? 0);
            return [...referencePositions.subarray(v, v + 3)];
        });
        // Heron's formula, which shares nothing with the code under test.
        const [x, y, z] = [distance(p, q), distance(q, r), distance(r, p)];
        const half = (x + y + z) / 2;
        const area = Math.sqrt(Math.max(0, half * (half - x) * (half - y) * (half - z)));
        if (!Number.isFinite(energy)) return;
        sum += area * energy;
        total += area;
    });
    expect(sum / total).toBeCloseTo(map.distortion.meanEnergy, 2);
});
