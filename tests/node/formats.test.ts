import { mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import path from "node:path";
import { Session, type EmbedResult, type ExportFormat, type QualityReport } from "layout-embedding";
import { Mesh, type BufferAttribute } from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
import { PLYLoader } from "three/examples/jsm/loaders/PLYLoader.js";
import { afterAll, beforeAll, describe, expect, it } from "vitest";
import { run } from "./command.js";
import { cube, obj, sphere } from "./meshes.js";

// Exports as other programs see them: three's own loaders, and an XML walk of our own.

let folder = "";
let session: Session;
let result: EmbedResult;
let files: Record<string, Uint8Array>;

beforeAll(async () => {
    folder = await mkdtemp(path.join(tmpdir(), "formats-"));
    await writeFile(path.join(folder, "cube.obj"), obj(cube));
    await writeFile(path.join(folder, "sphere.obj"), obj(sphere(3)));
    session = await Session.create();
    await session.loadLayout({ bytes: await readFile(path.join(folder, "cube.obj")) });
    await session.loadTarget({ bytes: await readFile(path.join(folder, "sphere.obj")) });
    result = await session.solve();
    files = await session.exportAs(["obj", "ply", "vtp", "glb", "svg", "lem"]);
});

afterAll(async () => {
    await session.dispose();
    await rm(folder, { recursive: true });
});

function refined() {
    if (result.refined === null) {
        throw new Error("no embedding");
    }
    return result.refined;
}

describe("exports", () => {
    it("are all there and not empty", () => {
        expect(Object.keys(files).sort()).toEqual([
            "refined.glb",
            "refined.inp",
            "refined.lem",
            "refined.obj",
            "refined.ply",
            "refined.svg",
            "refined.vtp",
            "refined_layout.obj",
            "refined_target.obj",
            "refined_target_input.obj",
        ]);
        for (const bytes of Object.values(files)) {
            expect(bytes.length).toBeGreaterThan(50);
        }
    });

    it("open in three's PLY loader with the same vertices and triangles", () => {
        const bytes = files["refined.ply"] ?? new Uint8Array();
        const geometry = new PLYLoader().parse(bytes.slice().buffer);
        // Since faces have colours, every corner has a vertex of its own there.
        const read = geometry.getAttribute("position").array;
        const { positions, corners } = refined();
        expect(read.length).toBe(3 * corners.length);
        corners.forEach((vertex, i) => {
            for (let axis = 0; axis < 3; ++axis) {
                expect(read[3 * i + axis]).toBeCloseTo(positions[3 * vertex + axis] ?? NaN, 5);
            }
        });
    });

    it("open in three's GLTF loader: a node per patch and path, triangles as they are", async () => {
        const bytes = files["refined.glb"] ?? new Uint8Array();
        const { scene } = await new GLTFLoader().parseAsync(bytes.slice().buffer, "");
        scene.updateMatrixWorld(true);
        const meshes = new Map<string, Mesh>();
        scene.traverse((object) => {
            if (object instanceof Mesh) {
                meshes.set(object.name, object as Mesh);
            }
        });
        const { patches, corners, positions } = refined();
        let colours = 0;
        const seen = new Set<string>();
        for (let patch = 0; patch < 6; ++patch) {
            const mesh = meshes.get(`patch_${String(patch)}`);
            const wanted = Array.from(patches.keys()).filter((t) => patches[t] === patch);
            const index = Array.from(mesh?.geometry.getIndex()?.array ?? []);
            expect(index).toEqual(
                wanted.flatMap((t) => Array.from(corners.subarray(3 * t, 3 * t + 3))),
            );
            const material = mesh?.material as { color?: { getHexString(): string } } | undefined;
            seen.add(material?.color?.getHexString() ?? "");
            ++colours;
        }
        expect(colours).toBe(6);
        expect(seen.size).toBeGreaterThanOrEqual(3);
        const attribute = meshes.get("patch_0")?.geometry.getAttribute("position") as
            BufferAttribute | undefined;
        const offset = meshes.get("patch_0")?.matrixWorld.elements ?? [];
        for (let v = 0; v < positions.length / 3; ++v) {
            for (let axis = 0; axis < 3; ++axis) {
                expect(
                    (attribute?.array[3 * v + axis] ?? NaN) + (offset[12 + axis] ?? 0),
                ).toBeCloseTo(positions[3 * v + axis] ?? NaN, 5);
            }
        }
        for (const { id } of result.edges) {
            expect(meshes.has(`edge_${String(id)}`)).toBe(true);
        }
        expect(meshes.has("landmarks")).toBe(true);
    });

    it("are well-formed XML with arrays of the announced length", () => {
        const vtp = new TextDecoder().decode(files["refined.vtp"]);
        const arrays = new Map<string, number>();
        const open: string[] = [];
        for (const [, close, name = "", attributes = "", single, text = ""] of vtp.matchAll(
            /<(\/?)([A-Za-z]+)([^<>]*?)(\/?)>([^<]*)/g,
        )) {
            if (close === "/") {
                expect(open.pop()).toBe(name);
            } else if (single !== "/") {
                open.push(name);
            }
            const array = /Name="(\w+)"/.exec(attributes)?.[1];
            if (name === "DataArray" && array !== undefined && close === "") {
                arrays.set(`${open.at(-2) ?? ""}/${array}`, text.trim().split(/\s+/).length);
            }
        }
        expect(open).toEqual([]);
        const triangles = refined().patches.length;
        expect(arrays.get("CellData/patch")).toBe(12 + triangles);
        expect(arrays.get("Points/Points")).toBe(refined().positions.length);
        expect(arrays.get("Polys/connectivity")).toBe(3 * triangles);
        expect(arrays.get("Lines/offsets")).toBe(12);
    });

    it("go back in as targets", async () => {
        const again = await Session.create();
        for (const format of ["obj", "ply"] as const) {
            const bytes = files[`refined.${format}`] ?? new Uint8Array();
            const target = await again.loadTarget({ bytes, format });
            expect(Array.from(target.positions)).toEqual(Array.from(refined().positions));
        }
        await again.dispose();
    });

    it("refuse unknown formats and empty sessions", async () => {
        await expect(session.exportAs(["dxf" as ExportFormat])).rejects.toMatchObject({
            code: "invalidOption",
        });
        await expect(session.exportAs(["svg"], { direction: [0, 0, 0] })).rejects.toMatchObject({
            code: "invalidOption",
        });
        const empty = await Session.create();
        await expect(empty.exportAs(["ply"])).rejects.toMatchObject({ code: "nothingToExport" });
        await empty.dispose();
    });
});

describe("landmark files", () => {
    it("carry names, as JSON and from MeshLab", async () => {
        const ids = Array.from(result.landmarks);
        const json = JSON.stringify({
            landmarks: ids.map((vertex, i) => ({ name: `corner ${String(i)}`, vertex })),
        });
        const encode = (text: string) => new TextEncoder().encode(text);
        const info = await session.setLandmarks({ bytes: encode(json), name: "a.json" });
        expect(Array.from(info.landmarks)).toEqual(ids);
        expect(info.names[3]).toBe("corner 3");
        const { positions } = refined();
        const points = ids.map((id, i) => {
            const [x, y, z] = positions.subarray(3 * id, 3 * id + 3);
            return `<point x="${String(x)}" y="${String(y)}" z="${String(z)}" name="p${String(i)}"/>`;
        });
        const picked = await session.setLandmarks({
            bytes: encode(`<PickedPoints>${points.join("\n")}</PickedPoints>`),
        });
        expect(Array.from(picked.landmarks)).toEqual(ids);
        expect(picked.names[7]).toBe("p7");
    });
});

describe("the command line", () => {
    it("writes further formats, converts, and reads the reference implementation's input", async () => {
        const out = path.join(folder, "out");
        const embed = await run(
            ["embed", "cube.obj", "sphere.obj", "--output", "out", "--format", "glb,vtp,lem"],
            { cwd: folder },
        );
        expect(embed.exitCode).toBe(0);
        const convert = await run(["convert", "out", "picture.svg", "--view", "1,2,3"], {
            cwd: folder,
        });
        expect(convert.exitCode).toBe(0);
        expect(await readFile(path.join(folder, "picture.svg"), "utf8")).toMatch(/^<svg /);
        await run(["convert", "out", "again.glb"], { cwd: folder });
        expect(await readFile(path.join(folder, "again.glb"))).toEqual(
            await readFile(path.join(out, "refined.glb")),
        );
        const mesh = await run(["convert", "sphere.obj", "sphere.ply"], { cwd: folder });
        expect(mesh.exitCode).toBe(0);
        const again = await run(["embed", "out/refined.inp", "--json"], { cwd: folder });
        expect(again.exitCode).toBe(0);
        expect((JSON.parse(again.stdout) as { cost: number }).cost).toBeCloseTo(result.cost, 12);
        const wrong = await run(["convert", "out", "picture.dxf"], { cwd: folder });
        expect(wrong.exitCode).toBe(2);
        const usage = await run(["embed", "cube.obj", "sphere.ply", "--format", "glb"], {
            cwd: folder,
        });
        expect(usage.exitCode).toBe(2);
    });
});

describe("quads", () => {
    it("conform, keep the base complex, and take prescribed numbers of segments", async () => {
        const quads = await session.quads({ edgeLength: 0.2, segments: [[0, 7]] });
        expect(quads.subdivided).toBe(false);
        expect(quads.chains[0]?.length).toBe(8);
        const edges = new Map<string, number>();
        for (let i = 0; i < quads.quads.length; ++i) {
            const a = quads.quads[i] ?? 0;
            const b = quads.quads[i % 4 === 3 ? i - 3 : i + 1] ?? 0;
            const edge = `${String(Math.min(a, b))} ${String(Math.max(a, b))}`;
            edges.set(edge, (edges.get(edge) ?? 0) + 1);
        }
        expect([...edges.values()].every((count) => count === 2)).toBe(true);
        const count = quads.faces.length;
        expect(quads.positions.length / 3 - edges.size + count).toBe(2);
        expect(quads.statistics.flipped).toBe(0);
        const read = await Session.create();
        const layout = await read.loadLayout({ bytes: quads.obj, format: "obj" });
        expect(layout.faceCount).toBe(count);
        await read.dispose();
        await expect(session.quads({ edgeLength: -1 })).rejects.toMatchObject({
            code: "invalidOption",
        });
        await expect(session.quads({ segments: [[99, 2]] })).rejects.toMatchObject({
            code: "invalidOption",
        });
    });

    it("are written by the command line", async () => {
        const args = [
            "quads",
            "cube.obj",
            "sphere.obj",
            "--output",
            "q",
            "--segments",
            "0=6",
            "--json",
        ];
        const { exitCode, stdout } = await run(args, { cwd: folder });
        expect(exitCode).toBe(0);
        const { quads } = JSON.parse(stdout) as { quads: { count: number; flipped: number } };
        expect(quads.flipped).toBe(0);
        const written = await readFile(path.join(folder, "q", "quads.obj"), "utf8");
        expect(written.match(/^f /gm)?.length).toBe(quads.count);
        const none = await run(["quads", "cube.obj", "sphere.obj"], { cwd: folder });
        expect(none.exitCode).toBe(2);
    });
});

describe("the shape fair and the quality report", () => {
    const total = (values: { length: number }[]) =>
        values.reduce((sum, { length }) => sum + length, 0);

    it("go together: no patch is thinner than the thinnest of short paths", async () => {
        const short = await session.reshape("short");
        const before = await session.qualityReport();
        const fair = await session.reshape("fair");
        const after = await session.qualityReport();
        expect(await session.check({ refined: fair.refined!, edges: fair.edges })).toEqual([]);
        expect(fair.exactCost).toBe(short.exactCost);
        for (const [result, report] of [
            [short, before],
            [fair, after],
        ] as const) {
            expect(report.overall.length).toBeCloseTo(total(result.edges), 9);
            expect(report.overall.cost).toBeCloseTo(result.cost, 9);
            expect(report.patches).toHaveLength(6);
            // The patches of a closed layout cover the sphere, which has about 4 pi.
            expect(report.overall.area).toBeGreaterThan(11);
            expect(report.overall.area).toBeLessThan(4 * Math.PI);
            for (const { isoperimetricQuotient, stretch } of report.patches) {
                expect(isoperimetricQuotient).toBeGreaterThan(0);
                expect(isoperimetricQuotient).toBeLessThan(1.5);
                expect(stretch).toBeGreaterThan(1);
            }
        }
        expect(after.overall.leastQuotient).toBeGreaterThanOrEqual(
            before.overall.leastQuotient * (1 - 1e-9),
        );
    });

    it("are options of the command line", async () => {
        const args = ["embed", "cube.obj", "sphere.obj", "--shape", "fair", "--report"];
        const { exitCode, stdout } = await run([...args, "--output", "fair", "--json"], {
            cwd: folder,
        });
        expect(exitCode).toBe(0);
        const document = JSON.parse(stdout) as { shape: string; report: QualityReport };
        expect(document.shape).toBe("fair");
        expect(document.report.edges).toHaveLength(12);
        const written = await readFile(path.join(folder, "fair", "report.json"), "utf8");
        expect(JSON.parse(written)).toEqual(document.report);
    });
});
