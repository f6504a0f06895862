// What the target's file says besides places, on the refined mesh; and the embedding on the target
// as it is.
import { readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { facePatches, pathPoints, Session, type RefinedMapDocument } from "layout-embedding";
import { Mesh as ThreeMesh, Vector3, type BufferAttribute } from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { PLYLoader } from "three/examples/jsm/loaders/PLYLoader.js";
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

describe("attributes of a damaged target", () => {
    test("stay_with_their_faces_where_it_is_repaired", () =>
        inFolder(async (cwd) => {
            // A face twice, and a vertex in no face before all others, so that all ids change.
            const lines = painted().trimEnd().split("\n");
            const first = lines.findIndex((line) => line.startsWith("v "));
            lines.splice(first, 0, "v 9 9 9 0 0 0");
            const shifted = lines.map((line) =>
                line.startsWith("f ")
                    ? line.replace(/(\d+)\//g, (_, vertex) => `${String(Number(vertex) + 1)}/`)
                    : line,
            );
            const again = shifted.findLast((line) => line.startsWith("f "));
            writeFileSync(path.join(cwd, "layout.obj"), obj(octahedron));
            writeFileSync(path.join(cwd, "target.obj"), [...shifted, again, ""].join("\n"));
            const landmarks = displacedLandmarks.map((vertex) => vertex + 1);
            writeFileSync(path.join(cwd, "landmarks.txt"), landmarks.join("\n"));
            const args = ["layout.obj", "target.obj", "--landmarks", "landmarks.txt", "--repair"];
            const embedded = await run(["embed", ...args, "--attributes", "--output", "out"], {
                cwd,
            });
            expect(embedded.exitCode).toBe(0);
            expect(embedded.stderr).toContain("Dropped 1 duplicate face");
            const inputs = ["layout.obj", "target.obj", "--repair"];
            expect((await run(["check", "out", ...inputs], { cwd })).exitCode).toBe(0);
            const refined = read(readFileSync(path.join(cwd, "out", "refined.obj"), "utf8"));
            const map = JSON.parse(
                readFileSync(path.join(cwd, "out", "refined_map.json"), "utf8"),
            ) as RefinedMapDocument;
            refined.faces.forEach(({ corners, groups, material }, t) => {
                const origin = map.triangleFaces[t] ?? NaN;
                expect(groups.slice(1).join(" ")).toBe(groupOf(origin));
                expect(material).toBe(materialOf(origin));
                for (const [vertex, place] of corners) {
                    const [x, y, , r, g] = refined.vertices[vertex]!;
                    const [u, v] = refined.texture[place]!;
                    expect(Math.hypot(u! - x! - origin, v! - y!)).toBeLessThan(1e-9);
                    expect(Math.hypot(r! - x!, g! - y!)).toBeLessThan(1e-12);
                }
            });
        }));
});

/**
 * The target as text PLY: (x, y) as texture coordinates of corners, by one higher on every other
 * face; and the place, brought to [0, 1], as colour.
 */
function paintedPly(): Uint8Array {
    const { positions, faces } = target;
    const count = positions.length / 3;
    const names = ["x", "y", "z", "red", "green", "blue"];
    const lines = ["ply", "format ascii 1.0", `element vertex ${String(count)}`];
    lines.push(...names.map((name) => `property double ${name}`));
    lines.push(
        `element face ${String(faces.length)}`,
        "property list uchar int vertex_indices",
        "property list uchar double texcoord",
        "property int region",
        "end_header",
    );
    for (let i = 0; i < positions.length; i += 3) {
        const place = positions.slice(i, i + 3);
        lines.push([...place, ...place.map((x) => (x + 1) / 2)].join(" "));
    }
    faces.forEach((face, f) => {
        const texture = face.flatMap((vertex) => [
            (positions[3 * vertex] ?? 0) + (f % 2),
            positions[3 * vertex + 1] ?? 0,
        ]);
        lines.push([3, ...face, 6, ...texture, f % 2].join(" "));
    });
    return new TextEncoder().encode(`${lines.join("\n")}\n`);
}

describe("attributes of PLY", () => {
    test("are_seen_by_other_programs_in_every_export_and_only_on_demand", async () => {
        const session = await Session.create();
        await session.loadLayout(arrays(octahedron));
        const input = { bytes: paintedPly(), name: "target.ply" };
        const plain = await session.loadTarget(input);
        expect(plain.textureCoordinates).toBeNull();
        await session.setLandmarks(Uint32Array.from(displacedLandmarks));
        await session.solve();
        const without = await session.exportAs(["obj", "ply", "glb", "vtp", "lem"]);
        await session.loadTarget(input, { textureCoordinates: true });
        await session.setLandmarks(Uint32Array.from(displacedLandmarks));
        await session.solve();
        expect(await session.exportAs(["obj", "ply", "glb", "vtp", "lem"])).toEqual(without);

        const loaded = await session.loadTarget(input, {
            attributes: true,
            textureCoordinates: true,
            repair: true,
        });
        expect(loaded.notes).toEqual([]);
        expect(loaded.textureCoordinates).toHaveLength(6 * target.faces.length);
        await session.setLandmarks(Uint32Array.from(displacedLandmarks));
        const { refined, edges } = await session.solve();
        const files = await session.exportAs(["obj", "ply", "glb", "vtp", "lem"]);
        const { "refined.obj": exported } = await session.exportFiles();
        if (refined === null) {
            throw new Error("no embedding");
        }
        expect(await session.check({ refined, edges })).toEqual([]);
        await session.dispose();
        // The reference implementation gets nothing it does not know.
        expect(files["refined_target.obj"]).toEqual(without["refined_target.obj"]);
        expect(files["refined.obj"]).toEqual(exported);

        const { texture, faces } = read(new TextDecoder().decode(exported));
        faces.forEach(({ corners, groups }, t) => {
            const origin = refined.triangleFaces[t] ?? NaN;
            expect(groups[1]).toBe(`region_${String(origin % 2)}`);
            for (const [vertex, place] of corners) {
                const [x, y] = refined.positions.subarray(3 * vertex, 3 * vertex + 2);
                expect(texture[place]?.[0]).toBeCloseTo(x! + (origin % 2), 12);
                expect(texture[place]?.[1]).toBeCloseTo(y!, 12);
            }
        });

        const geometry = new PLYLoader().parse(files["refined.ply"]!.slice().buffer);
        expect(geometry.getAttribute("color").count).toBe(geometry.getAttribute("position").count);

        const { scene } = await new GLTFLoader().parseAsync(
            files["refined.glb"]!.slice().buffer,
            "",
        );
        scene.updateMatrixWorld(true);
        let corners = 0;
        scene.traverse((object) => {
            if (!(object instanceof ThreeMesh) || !object.name.startsWith("patch_")) {
                return;
            }
            const mesh = object as ThreeMesh;
            const [place, uv, colour] = ["position", "uv", "color"].map((name) =>
                mesh.geometry.getAttribute(name),
            ) as [BufferAttribute, BufferAttribute, BufferAttribute];
            for (const vertex of mesh.geometry.getIndex()?.array ?? []) {
                const at = new Vector3().fromBufferAttribute(place, vertex);
                at.applyMatrix4(mesh.matrixWorld);
                expect(colour.getX(vertex)).toBeCloseTo((at.x + 1) / 2, 5);
                expect(colour.getZ(vertex)).toBeCloseTo((at.z + 1) / 2, 5);
                expect(1 - uv.getY(vertex)).toBeCloseTo(at.y, 5);
                const chart = uv.getX(vertex) - at.x;
                expect(chart).toBeCloseTo(Math.round(chart), 5);
                ++corners;
            }
        });
        expect(corners).toBe(refined.corners.length);
    });

    test("that_make_no_sense_or_are_not_there_are_told", async () => {
        const session = await Session.create();
        const text = new TextDecoder().decode(paintedPly()).replace(/( 6 )(\S+)/, "$1nan");
        const input = { bytes: new TextEncoder().encode(text), name: "target.ply" };
        const { notes, textureCoordinates } = await session.loadTarget(input, {
            attributes: true,
            textureCoordinates: true,
        });
        expect(notes).toHaveLength(1);
        expect(notes[0]).toContain("the target target.ply: Left out");
        expect(notes[0]).toContain("of 1 corner");
        expect(textureCoordinates).toBeNull();
        const bare = file(target, "bare.obj");
        expect((await session.loadTarget(bare, { attributes: true })).notes).toEqual([
            "the target bare.obj: Found no texture coordinates, colours, groups or materials.",
        ]);
        expect((await session.loadTarget(bare)).notes).toEqual([]);
        await session.dispose();
    });
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
