// Every kind of bad input, through the API and through the command line: the same code, the same
// sentence, exit code 2.
import { writeFileSync } from "node:fs";
import path from "node:path";
import { embed, mapSurfaces, type MeshInput } from "layout-embedding";
import { describe, expect, test } from "vitest";
import { badInputs, ball, filesOf } from "./bad_inputs.js";
import { inFolder, run } from "./command.js";
import { octahedron } from "./meshes.js";

describe.each(badInputs)("$name", (bad) => {
    test("has_its_code_and_one_sentence_everywhere", async () => {
        const files = filesOf(bad);
        const { repair = false } = bad;
        const bytes = ({ name, text }: { name: string; text: string }) => ({
            bytes: new TextEncoder().encode(text),
            name,
        });
        const failure = (await embed(
            {
                layout: bytes(files.layout) satisfies MeshInput,
                target: bytes(files.target),
                landmarks: bytes(files.landmarks),
            },
            { repair },
        ).catch((error: unknown) => error)) as Error & { code: string };
        expect(failure).toMatchObject({ name: "LayoutError", code: bad.code });
        expect(failure.message).toMatch(/^[^\n]+; [^\n]+\.$/);

        await inFolder(async (cwd) => {
            for (const { name, text } of Object.values(files)) {
                writeFileSync(path.join(cwd, name), text);
            }
            const { layout, target, landmarks } = files;
            const args = ["embed", layout.name, target.name, "--landmarks", landmarks.name];
            const finished = await run(
                [...args, "--output", "out", "--json", ...(repair ? ["--repair"] : [])],
                { cwd },
            );
            expect(finished.exitCode).toBe(2);
            expect(finished.stderr).toBe("");
            expect(JSON.parse(finished.stdout)).toMatchObject({
                error: { code: bad.code, message: failure.message },
            });
        });
    });
});

describe("arrays of a wrong shape", () => {
    const target = { positions: ball.positions, corners: ball.faces.flat() };
    const layout = { positions: octahedron.positions, corners: octahedron.faces.flat() };
    test.each([
        ["positions_not_3_per_vertex", { ...target, positions: ball.positions.slice(1) }],
        ["corners_not_3_per_triangle", { ...target, corners: ball.faces.flat().slice(1) }],
        ["a_corner_that_is_no_id", { ...target, corners: [0, 1, 2.5] }],
        ["a_negative_corner", { ...target, corners: [0, 1, -2] }],
        ["offsets_that_fall", { ...target, corners: [0, 1, 2, 3, 4, 5], offsets: [0, 4, 3, 6] }],
        ["offsets_that_end_early", { ...target, offsets: [0, 3] }],
        ["no_mesh", {} as MeshInput],
    ])("%s_is_refused", async (_, bad) => {
        await expect(embed({ layout, target: bad })).rejects.toMatchObject({
            code: "invalidInput",
        });
    });

    test("a_corner_beyond_the_vertices_is_refused_by_the_core", async () => {
        const bad = { ...target, corners: [0, 1, 9999] };
        await expect(embed({ layout, target: bad })).rejects.toMatchObject({
            code: "indexOutOfRange",
        });
    });
});

test("a_map_without_both_embeddings_is_refused", async () => {
    const target = { positions: ball.positions, corners: ball.faces.flat() };
    const layout = { positions: octahedron.positions, corners: octahedron.faces.flat() };
    const side = { target, landmarks: [0, 1, 2, 3, 4, 5] };
    const map = mapSurfaces({ layout, reference: side, target: side }, { workLimit: 1 });
    await expect(map).rejects.toMatchObject({ name: "LayoutError", code: "noEmbedding" });
});

test.each([
    [{ vertexCosts: [1, 1] }, /^2 vertex costs are given for the \d+ vertices/],
    [{ vertexCosts: ball.positions.map(() => 0) }, /vertexCosts/],
    [{ featureDiscount: 1 }, /featureDiscount/],
    [{ edgeWeights: [1, 1] }, /^2 weights are given for the 12 edges/],
    [{ edgeWeights: Array<number>(12).fill(NaN) }, /edgeWeights/],
])("a_metric_that_makes_no_sense_is_refused: %#", async (metric, message) => {
    const target = { positions: ball.positions, corners: ball.faces.flat() };
    const layout = { positions: octahedron.positions, corners: octahedron.faces.flat() };
    const embedding = embed({ layout, target, landmarks: [0, 1, 2, 3, 4, 5] }, { metric });
    await expect(embedding).rejects.toMatchObject({ name: "LayoutError", code: "invalidOption" });
    await expect(embedding).rejects.toThrow(message);
});
