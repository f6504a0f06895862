// Maps between targets: the API in both kinds of thread, and the commands `map` and `batch`.
import { existsSync, mkdirSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import path from "node:path";
import {
    batch,
    batchTable,
    mapSurfaces,
    Session,
    type SurfaceMap,
    type SurfacePoints,
} from "layout-embedding";
import { createWorkerClient } from "layout-embedding/worker";
import { describe, expect, test } from "vitest";
import { inFolder, run } from "./command.js";
import { arrays, obj, sphere, type Mesh } from "./meshes.js";

const layout = {
    positions: [0, 0, 1, 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0, 0, 0, -1],
    faces: [
        [0, 1, 2],
        [0, 2, 3],
        [0, 3, 4],
        [0, 4, 1],
        [5, 2, 1],
        [5, 3, 2],
        [5, 4, 3],
        [5, 1, 4],
    ],
};

/** The sphere, stretched along one axis, and its vertices nearest to the layout's. */
function stretched(levels: number, factor: number) {
    const mesh = sphere(levels);
    const landmarks = Array.from({ length: 6 }, (_, v) => {
        const distances = Array.from({ length: mesh.positions.length / 3 }, (_place, i) =>
            Math.hypot(
                ...[0, 1, 2].map(
                    (k) => (mesh.positions[3 * i + k] ?? 0) - (layout.positions[3 * v + k] ?? 0),
                ),
            ),
        );
        return distances.indexOf(Math.min(...distances));
    });
    const positions = mesh.positions.map((x, i) => (i % 3 === 2 ? factor * x : x));
    return { mesh: { ...mesh, positions }, landmarks };
}

const a = stretched(3, 1);
const b = stretched(2, 1.5);
const problem = {
    layout: arrays(layout),
    reference: { target: arrays(a.mesh), landmarks: a.landmarks },
    target: { target: arrays(b.mesh), landmarks: b.landmarks },
};

function position(mesh: Mesh, face: number, weights: ArrayLike<number>): number[] {
    return [0, 1, 2].map((axis) =>
        [0, 1, 2].reduce(
            (sum, k) =>
                sum +
                (weights[k] ?? 0) *
                    (mesh.positions[3 * (mesh.faces[face]?.[k] ?? 0) + axis] ?? NaN),
            0,
        ),
    );
}

function distance(p: number[], q: number[]): number {
    return Math.hypot(...p.map((x, i) => x - (q[i] ?? NaN)));
}

/** Landmarks go to landmarks, and the overlay lies on both targets. */
function expectSound(map: SurfaceMap): void {
    expect(map.fromReference.faces).toHaveLength(a.mesh.positions.length / 3);
    expect(map.toReference.faces).toHaveLength(b.mesh.positions.length / 3);
    a.landmarks.forEach((landmark, i) => {
        const image = position(
            b.mesh,
            map.fromReference.faces[landmark] ?? -1,
            map.fromReference.barycentrics.subarray(3 * landmark, 3 * landmark + 3),
        );
        const to = b.landmarks[i] ?? 0;
        expect(distance(image, b.mesh.positions.slice(3 * to, 3 * to + 3))).toBe(0);
    });
    const { overlay } = map;
    expect(overlay.corners).toHaveLength(3 * overlay.patches.length);
    expect(overlay.referencePositions).toHaveLength(overlay.targetPositions.length);
    for (let t = 0; t < overlay.patches.length; t += 7) {
        for (let k = 0; k < 3; ++k) {
            const vertex = overlay.corners[3 * t + k] ?? 0;
            const weights = [overlay.referenceWeights, overlay.targetWeights].map((all) =>
                all.subarray(9 * t + 3 * k, 9 * t + 3 * k + 3),
            );
            const there = (positions: Float64Array) =>
                Array.from(positions.subarray(3 * vertex, 3 * vertex + 3));
            expect(
                distance(
                    position(a.mesh, overlay.referenceFaces[t] ?? -1, weights[0] ?? []),
                    there(overlay.referencePositions),
                ),
            ).toBeLessThan(1e-9);
            expect(
                distance(
                    position(b.mesh, overlay.targetFaces[t] ?? -1, weights[1] ?? []),
                    there(overlay.targetPositions),
                ),
            ).toBeLessThan(1e-9);
        }
    }
}

describe("mapSurfaces", () => {
    test("maps_landmarks_onto_landmarks_and_lowers_the_energy", async () => {
        const map = await mapSurfaces(problem, { rounds: 5, seamPasses: 1 });
        expectSound(map);
        expect(map.distortion.meanEnergy).toBeLessThan(map.firstDistortion.meanEnergy);
        expect(map.distortion.meanEnergy).toBeGreaterThan(4);
        const plain = await mapSurfaces(problem, { rounds: 0, seamPasses: 0 });
        expect(plain.distortion).toEqual(map.firstDistortion);
    });

    test("gives_the_same_in_a_worker", async () => {
        const worker = await createWorkerClient();
        try {
            expect(await worker.mapSurfaces(problem, { rounds: 1, seamPasses: 0 })).toEqual(
                await mapSurfaces(problem, { rounds: 1, seamPasses: 0 }),
            );
        } finally {
            worker.terminate();
        }
    });

    test("maps_points_there_and_back", async () => {
        const session = await Session.create();
        await session.loadLayout(problem.layout);
        await session.loadTarget(problem.reference.target);
        await expect(session.setReference()).rejects.toMatchObject({ code: "nothingToExport" });
        await session.setLandmarks(a.landmarks);
        await session.solve();
        await expect(session.mapFromReference()).rejects.toMatchObject({ code: "noReference" });
        await session.setReference();
        await session.loadTarget(problem.target.target);
        await session.setLandmarks(b.landmarks);
        await session.solve();
        const points = {
            faces: Int32Array.from([0, 17, 111]),
            barycentrics: Float64Array.from([0.2, 0.3, 0.5, 1, 0, 0, 0.6, 0.3, 0.1]),
        };
        await expect(session.mapPoints("reference", points)).rejects.toMatchObject({
            code: "noReference",
        });
        await session.mapFromReference({ rounds: 2 });
        const there = await session.mapPoints("reference", points);
        const back = await session.mapPoints("target", there);
        points.faces.forEach((face, i) => {
            const at = (list: SurfacePoints, of: number) =>
                position(a.mesh, of, list.barycentrics.subarray(3 * i, 3 * i + 3));
            expect(distance(at(back, back.faces[i] ?? -1), at(points, face))).toBeLessThan(1e-9);
        });
        await expect(
            session.mapPoints("reference", { ...points, faces: Int32Array.from([0, 1, 9999]) }),
        ).rejects.toMatchObject({ code: "indexOutOfRange" });
        await expect(session.mapFromReference({ seamPasses: -1 })).rejects.toMatchObject({
            code: "invalidOption",
        });
        // Another layout, and there is nothing to map between.
        await session.loadLayout(problem.layout);
        await expect(session.mapFromReference()).rejects.toMatchObject({ code: "noReference" });
        await session.dispose();
    });
});

describe("map", () => {
    test("writes_images_overlays_and_texture_coordinates", async () => {
        await inFolder(async (folder) => {
            const at = (name: string) => path.join(folder, name);
            writeFileSync(at("layout.obj"), obj(layout));
            // Texture coordinates x and y: 2 per vertex of a.
            const texture = Array.from(
                { length: a.mesh.positions.length / 3 },
                (_, v) => `vt ${a.mesh.positions.slice(3 * v, 3 * v + 2).join(" ")}\n`,
            );
            const withTexture = obj(a.mesh)
                .replace(/^f .*$/gm, (line) => line.replace(/\d+/g, "$&/$&"))
                .replace(/^f /m, `${texture.join("")}f `);
            writeFileSync(at("a.obj"), withTexture);
            writeFileSync(at("b.obj"), obj(b.mesh));
            writeFileSync(at("a.txt"), a.landmarks.join("\n"));
            writeFileSync(at("b.txt"), b.landmarks.join("\n"));
            const { exitCode, stdout } = await run([
                ...["map", at("layout.obj"), at("a.obj"), at("b.obj"), "--rounds", "2", "--json"],
                ...["--seam-passes", "1"],
                ...["--landmarks-a", at("a.txt"), "--landmarks-b", at("b.txt")],
                ...["--output", at("out")],
            ]);
            expect(exitCode).toBe(0);
            const document = JSON.parse(stdout) as { files: string[]; overlayTriangles: number };
            for (const file of document.files) {
                expect(existsSync(file)).toBe(true);
            }
            const read = (name: string) => readFileSync(at(path.join("out", name)), "utf8");
            const map = JSON.parse(read("map.json")) as { aToB: unknown[]; bToA: unknown[] };
            expect(map.aToB).toHaveLength(a.mesh.positions.length / 3);
            expect(map.bToA).toHaveLength(b.mesh.positions.length / 3);
            const lines = (name: string, keyword: string) =>
                read(name)
                    .split("\n")
                    .filter((line) => line.startsWith(`${keyword} `));
            const numbers = (line = "") => line.split(" ").slice(1).map(Number);
            expect(lines("overlay_b.obj", "f")).toEqual(lines("overlay_a.obj", "f"));
            expect(lines("overlay_b.obj", "vt")).toEqual(lines("overlay_a.obj", "vt"));
            expect(lines("overlay_a.obj", "f")).toHaveLength(document.overlayTriangles);
            // On a itself they are x and y.
            const positions = lines("overlay_a.obj", "v").map(numbers);
            const coordinates = lines("overlay_a.obj", "vt").map(numbers);
            for (const line of lines("overlay_a.obj", "f")) {
                for (const word of line.split(" ").slice(1)) {
                    const [v = 0, t = 0] = word.split("/").map(Number);
                    expect(
                        distance(coordinates[t - 1] ?? [], positions[v - 1]?.slice(0, 2) ?? []),
                    ).toBeLessThan(1e-9);
                }
            }
            for (const name of ["a", "b"]) {
                const check = await run([
                    ...["check", at(path.join("out", name)), at("layout.obj"), at(`${name}.obj`)],
                    ...["--landmarks", at(`${name}.txt`)],
                ]);
                expect(check.exitCode).toBe(0);
            }
            const missing = await run(["map", at("layout.obj"), at("a.obj"), at("b.obj")]);
            expect(missing.exitCode).toBe(2);
        });
    });
});

describe("batch", () => {
    test("goes_on_where_it_stopped_and_reports_bad_members", async () => {
        await inFolder(async (folder) => {
            const at = (...names: string[]) => path.join(folder, ...names);
            mkdirSync(at("shapes"));
            writeFileSync(at("layout.obj"), obj(layout));
            for (const [name, shape] of Object.entries({ one: a, two: b, broken: a, bare: b })) {
                writeFileSync(at("shapes", `${name}.obj`), obj(shape.mesh));
                if (name !== "bare") {
                    writeFileSync(at("shapes", `${name}.txt`), shape.landmarks.join("\n"));
                }
            }
            writeFileSync(at("shapes", "broken.txt"), "1\n2\n");
            const command = [
                ...["batch", at("layout.obj"), at("shapes"), "--output", at("out"), "--json"],
                ...[
                    "--rounds",
                    "1",
                    "--seam-passes",
                    "0",
                    "--reference",
                    "one",
                    "--edge-length",
                    "0.2",
                ],
            ];
            interface Summary {
                members: { name: string; error: { code: string } | null; quads?: number }[];
            }
            const first = await run(command);
            expect(first.exitCode).toBe(1);
            const { members } = JSON.parse(first.stdout) as Summary;
            expect(members.map(({ name, error }) => [name, error?.code ?? null])).toEqual([
                ["bare", "fileNotFound"],
                ["broken", "landmarkCount"],
                ["one", null],
                ["two", null],
            ]);
            expect(members[2]?.quads).toBe(members[3]?.quads);
            expect(members[2]).toMatchObject({ isReference: true });
            expect(members[3]).toHaveProperty("energy");
            expect(readFileSync(at("out", "summary.csv"), "utf8").split("\n")).toHaveLength(6);
            const faces = (name: string) =>
                readFileSync(at("out", name, "quads.obj"), "utf8")
                    .split("\n")
                    .filter((line) => line.startsWith("f "));
            expect(faces("two")).toEqual(faces("one"));
            // A second run does what was bad, and only that; the reference is needed for it.
            const modified = () => statSync(at("out", "two", "map.json")).mtimeMs;
            const before = modified();
            writeFileSync(at("shapes", "broken.txt"), a.landmarks.join("\n"));
            rmSync(at("shapes", "bare.obj"));
            const second = await run(command);
            expect(second.exitCode).toBe(0);
            const again = JSON.parse(second.stdout) as Summary;
            expect(again.members.map(({ name }) => name)).toEqual(["broken", "one", "two"]);
            expect(again.members[2]).toEqual(members[3]);
            expect(modified()).toBe(before);
            // With another option everything is done anew.
            const third = await run([...command, "--seed", "2"]);
            expect(third.exitCode).toBe(0);
            expect(modified()).not.toBe(before);
        });
    });

    test("runs_over_arrays_too", async () => {
        const member = (name: string, shape: typeof a) => ({
            name,
            load: () => Promise.resolve({ target: arrays(shape.mesh), landmarks: shape.landmarks }),
        });
        const seen: string[] = [];
        const rows = await batch(
            problem.layout,
            [
                member("a", a),
                { name: "bad", load: () => Promise.reject(new Error("no such shape")) },
                member("b", b),
            ],
            {
                map: { rounds: 1, seamPasses: 0 },
                quads: { edgeLength: 0.3 },
                onMember: (row, products) => {
                    seen.push(`${row.name} ${String(products?.map?.overlay.patches.length ?? 0)}`);
                },
            },
        );
        expect(rows.map(({ name, error }) => [name, error === null])).toEqual([
            ["a", true],
            ["bad", false],
            ["b", true],
        ]);
        expect(seen[0]).toBe("a 0");
        expect(Number(seen[2]?.slice(2))).toBeGreaterThan(100);
        expect(batchTable(rows).split("\n")[2]).toContain("no such shape");
        await expect(
            batch(problem.layout, [member("a", a)], { reference: "c" }),
        ).rejects.toMatchObject({ code: "invalidInput" });
    });
});
