// The native build makes byte for byte what the package makes, in WebAssembly.
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import path from "node:path";
import { Session, templateLayout } from "layout-embedding";
import { describe, expect, test } from "vitest";
import { inFolder, runProgram } from "./command.js";
import { hasShared, realMeshes, sphereCubes } from "./data.js";
import { cube, displacedLandmarks, obj, octahedron, sphere, torus } from "./meshes.js";

const program = path.resolve(import.meta.dirname, "../../build/release/tests/core/native_embed");
const layoutProgram = path.resolve(path.dirname(program), "native_layout");
const isBuilt = existsSync(program) && existsSync(layoutProgram);
if (!isBuilt) {
    console.warn(`skipping comparisons with the native build: no ${program} (run npm test)`);
}

interface Files {
    layout: string;
    target: string;
    landmarks: string;
}

/** Some instances are proved by then, others end at the limit. */
const workLimit = 3_000_000;

async function expectAgreement({ layout, target, landmarks }: Files, seed: number): Promise<void> {
    const numbers = [seed, workLimit, 1000].map(String);
    const native = await runProgram(program, [layout, target, landmarks, ...numbers]);
    expect(native.stderr).toBe("");
    expect(native.exitCode).toBe(0);
    const lineEnd = native.stdout.indexOf("\n");

    const session = await Session.create();
    const file = (name: string) => ({ bytes: readFileSync(name), name });
    await session.loadLayout(file(layout));
    await session.loadTarget(file(target));
    await session.setLandmarks(file(landmarks));
    const result = await session.solve({ seed, workLimit });
    const files = await session.exportFiles();
    await session.dispose();
    expect({
        exactCost: String(result.exactCost),
        exactLowerBound: String(result.exactLowerBound),
        insertionOrder: Array.from(result.insertionOrder),
        searches: result.counters.searches,
        expansions: result.counters.expansions,
    }).toEqual(JSON.parse(native.stdout.slice(0, lineEnd)));
    const refined = new TextDecoder().decode(files["refined.obj"]);
    // Not toBe(): a difference would print megabytes.
    expect(refined === native.stdout.slice(lineEnd + 1)).toBe(true);
}

describe.skipIf(!isBuilt)("the native build agrees with the package", () => {
    const small = [
        {
            name: "octahedron",
            layout: octahedron,
            target: sphere(3),
            landmarks: displacedLandmarks,
        },
        {
            name: "cube",
            layout: cube,
            target: sphere(3),
            landmarks: [3, 50, 99, 120, 160, 201, 77, 12],
        },
        { name: "torus", layout: torus(4, 3), target: torus(16, 12), landmarks: onTorus() },
    ];
    test.each(small)("on_the_$name", ({ layout, target, landmarks }) =>
        inFolder(async (folder) => {
            const write = (name: string, text: string) => {
                const file = path.join(folder, name);
                writeFileSync(file, text);
                return file;
            };
            const files = {
                layout: write("layout.obj", obj(layout)),
                target: write("target.obj", obj(target)),
                landmarks: write("landmarks.txt", landmarks.join("\n")),
            };
            await expectAgreement(files, 1);
            await expectAgreement(files, 7);
        }),
    );

    const named = sphereCubes.filter(({ name }) =>
        /^sphere5_seed[147]$|^sphere6_seed[45]$/.test(name),
    );
    test.skipIf(!hasShared).each(named)("on_$name", ({ layout, target, landmarks }) =>
        expectAgreement({ layout, target, landmarks: landmarks! }, 1),
    );
});

/** Compares template layouts on `count` vertices spread over the numbering. */
async function expectSameTemplate(target: string, count: number): Promise<void> {
    const bytes = readFileSync(target);
    const vertices = bytes.toString("latin1").match(/^v /gm)?.length ?? 0;
    const landmarks = Array.from({ length: count }, (_, i) => Math.floor((i * vertices) / count));
    await inFolder(async (folder) => {
        const list = path.join(folder, "landmarks.txt");
        writeFileSync(list, landmarks.join("\n"));
        for (const kind of ["triangles", "quads"]) {
            const native = await runProgram(layoutProgram, [target, list, kind]);
            expect(native.stderr).toBe("");
            const { obj } = await templateLayout(
                { target: { bytes, name: target }, landmarks },
                { quads: kind === "quads" },
            );
            expect(new TextDecoder().decode(obj)).toBe(native.stdout);
        }
    });
}

describe.skipIf(!isBuilt)("native template layouts agree with the package's", () => {
    test.each([
        { name: "sphere", target: sphere(4), count: 12 },
        { name: "torus", target: torus(24, 18), count: 11 },
    ])("on_the_$name", ({ target, count }) =>
        inFolder(async (folder) => {
            const file = path.join(folder, "target.obj");
            writeFileSync(file, obj(target));
            await expectSameTemplate(file, count);
        }),
    );

    test.skipIf(!hasShared).each(realMeshes)("on_$name", async ({ target }) => {
        await expectSameTemplate(target, 12);
        await expectSameTemplate(target, 33);
    });
});

/** The corners of torus(4, 3) on torus(16, 12). */
function onTorus(): number[] {
    return Array.from({ length: 12 }, (_, i) => Math.floor(i / 3) * 4 * 12 + (i % 3) * 4);
}
