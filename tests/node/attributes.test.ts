// What the target's file says besides places, on the refined mesh; and the embedding on the target
// as it is.
import { readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { facePatches, pathPoints, Session, type RefinedMapDocument } from "layout-embedding";
import { describe, expect, test } from "vitest";
import { inFolder, run } from "./command.js";
import { arrays, displacedLandmarks, file, obj, octahedron, sphere } from "./meshes.js";

const target = sphere(3);
const groupOf = (face: number) => (face % 3 === 0 ? "" : face % 3 === 1 ? "head left" : "tail");
const materialOf = (face: number) => `paint${String(face % 2)}`;

/**
 * The target with attributes that are linear on every face: texture coordinates (x + face, y),
 * with other numbers on either side of an edge, and the place as colour.
 */
function painted(): string {
    const { positions, faces } = target;
    const lines = ["mtllib paint.mtl"];
    for (let i = 0; i < positions.length; i += 3) {
        const place = positions.slice(i, i + 3);
        lines.push(`v ${[...place, ...place].join(" ")}`);
    }
    faces.forEach((face, f) => {
        for (const vertex of face) {
            const [x = 0, y = 0] = positions.slice(3 * vertex, 3 * vertex + 2);
            lines.push(`vt ${String(x + f)} ${String(y)}`);
        }
        // The texture coordinates just given, counted back.
        const words = face.map((vertex, k) => `${String(vertex + 1)}/${String(k - 3)}`);
        lines.push(`g ${groupOf(f)}`, `usemtl ${materialOf(f)}`, `f ${words.join(" ")}`);
    });
    return `${lines.join("\n")}\n`;
}

interface Face {
    /** Vertices and texture coordinates, 0-based. */
    corners: [number, number][];
    groups: string[];
    material: string;
}

function read(text: string) {
    const vertices: number[][] = [];
    const texture: number[][] = [];
    const faces: Face[] = [];
    const lines: string[] = [];
    let groups: string[] = [];
    let material = "";
    for (const line of text.trim().split("\n")) {
        const [keyword, ...words] = line.split(" ");
        if (keyword === "v") {
            vertices.push(words.map(Number));
        } else if (keyword === "vt") {
            texture.push(words.map(Number));
        } else if (keyword === "g") {
            groups = words;
        } else if (keyword === "usemtl") {
            material = words.join(" ");
        } else if (keyword === "f") {
            const corners = words.map((word) => {
                const [vertex = 0, place = 0] = word.split("/").map(Number);
                return [vertex - 1, place - 1] as [number, number];
            });
            faces.push({ corners, groups, material });
        } else {
            lines.push(line);
        }
    }
    return { vertices, texture, faces, lines };
}

describe("attributes", () => {
    test("are_carried_to_refined_obj_on_demand_and_pass_check", () =>
        inFolder(async (cwd) => {
            writeFileSync(path.join(cwd, "layout.obj"), obj(octahedron));
            writeFileSync(path.join(cwd, "target.obj"), painted());
            writeFileSync(path.join(cwd, "landmarks.txt"), displacedLandmarks.join("\n"));
            const inputs = ["layout.obj", "target.obj", "--landmarks", "landmarks.txt"];
            for (const [name, more] of [
                ["plain", []],
                ["with", ["--attributes"]],
            ] as const) {
                const args = ["embed", ...inputs, "--output", name, "--quiet", ...more];
                expect(await run(args, { cwd })).toMatchObject({ exitCode: 0, stderr: "" });
                const checked = await run(["check", name, "layout.obj", "target.obj"], { cwd });
                expect(checked.exitCode).toBe(0);
            }
            const text = (folder: string, name: string) =>
                readFileSync(path.join(cwd, folder, name), "utf8");
            const plain = read(text("plain", "refined.obj"));
            const refined = read(text("with", "refined.obj"));
            expect(plain.texture).toEqual([]);
            expect(plain.vertices.every((vertex) => vertex.length === 3)).toBe(true);
            expect(refined.lines).toEqual(["mtllib paint.mtl", ...plain.lines]);
            expect(refined.vertices.map((vertex) => vertex.slice(0, 3))).toEqual(plain.vertices);
            for (const [x, y, z, r, g, b] of refined.vertices) {
                expect(Math.hypot(r! - x!, g! - y!, b! - z!)).toBeLessThan(1e-12);
            }
            const map = JSON.parse(text("with", "refined_map.json")) as RefinedMapDocument;
            expect(refined.faces.length).toBeGreaterThan(target.faces.length);
            refined.faces.forEach(({ corners, groups, material }, t) => {
                const origin = map.triangleFaces[t] ?? NaN;
                expect(corners.map(([vertex]) => vertex)).toEqual(
                    plain.faces[t]?.corners.map(([vertex]) => vertex),
                );
                for (const [vertex, place] of corners) {
                    const [x, y] = refined.vertices[vertex]!;
                    const [u, v] = refined.texture[place]!;
                    expect(Math.hypot(u! - x! - origin, v! - y!)).toBeLessThan(1e-9);
                }
                const [patch = "", ...others] = groups;
                expect(patch).toBe(plain.faces[t]?.groups[0]);
                expect(others.join(" ")).toBe(groupOf(origin));
                expect(material).toBe(materialOf(origin));
            });
        }));
});

describe("on the target as it is", () => {
    test("faces_have_the_patch_of_most_of_their_area_and_paths_their_points", async () => {
        const session = await Session.create();
        await session.loadLayout(arrays(octahedron));
        await session.loadTarget(file(target, "target.obj"));
        await session.setLandmarks(Uint32Array.from(displacedLandmarks));
        const { refined, edges } = await session.solve();
        await session.dispose();
        if (refined === null) {
            throw new Error("no embedding");
        }
        const patches = facePatches(refined);
        expect(patches.length).toBe(target.faces.length);
        const corner = (i: number) => {
            const vertex = refined.corners[i] ?? 0;
            return Array.from(refined.positions.subarray(3 * vertex, 3 * vertex + 3));
        };
        const shares = target.faces.map(() => new Float64Array(octahedron.faces.length));
        refined.triangleFaces.forEach((face, t) => {
            const [a, b, c] = [corner(3 * t), corner(3 * t + 1), corner(3 * t + 2)];
            const length = (p: number[], q: number[]) =>
                Math.hypot(...p.map((x, axis) => x - (q[axis] ?? 0)));
            const [x, y, z] = [length(a, b), length(b, c), length(c, a)];
            const half = (x + y + z) / 2; // Heron
            shares[face]![refined.patches[t]!]! += Math.sqrt(
                Math.max(0, half * (half - x) * (half - y) * (half - z)),
            );
        });
        patches.forEach((patch, face) => {
            expect(shares[face]![patch]).toBeGreaterThanOrEqual(0.999 * Math.max(...shares[face]!));
        });
        expect(new Set(patches).size).toBe(octahedron.faces.length);

        const corners = Uint32Array.from(target.faces.flat());
        for (const { chain } of edges) {
            const points = pathPoints(chain, refined, corners);
            chain.forEach((vertex, i) => {
                for (let axis = 0; axis < 3; ++axis) {
                    let place = 0;
                    for (let k = 0; k < 3; ++k) {
                        const at = 3 * corners[3 * points.faces[i]! + k]! + axis;
                        place += points.barycentrics[3 * i + k]! * target.positions[at]!;
                    }
                    expect(place).toBeCloseTo(refined.positions[3 * vertex + axis]!, 12);
                }
            });
        }
    });
});
