// Every kind of bad input, through the API and through the command line: the same code, the same
// sentence, exit code 2.
import { writeFileSync } from "node:fs";
import path from "node:path";
import { embed, type MeshInput } from "layout-embedding";
import { describe, expect, test } from "vitest";
import { inFolder, run } from "./command.js";
import { cube, obj, octahedron, sphere, torus, type Mesh } from "./meshes.js";

interface BadInput {
    name: string;
    code: string;
    layout?: string;
    target?: string;
    landmarks?: string;
}

const ball = sphere(2);

/** The ball with its faces changed. */
function ballWith(change: (faces: number[][]) => number[][]): string {
    return obj({ positions: ball.positions, faces: change(structuredClone(ball.faces)) });
}

/** The ball with the x coordinate of vertex 7 replaced by other text. */
function ballAt(x: string): string {
    const lines = obj(ball).split("\n");
    lines[7] = `v ${x} 0 0`;
    return lines.join("\n");
}

/** Two meshes in one. */
function both(a: Mesh, b: Mesh): Mesh {
    const shift = a.positions.length / 3;
    return {
        positions: [...a.positions, ...b.positions.map((x) => x + 10)],
        faces: [...a.faces, ...b.faces.map((face) => face.map((vertex) => vertex + shift))],
    };
}

const manyCorners = `${"v 0 0 0\n".repeat(300)}f ${Array.from({ length: 256 }, (_, i) => i + 1).join(" ")}\n`;

const badInputs: BadInput[] = [
    { name: "empty_target", code: "fileEmpty", target: "" },
    { name: "empty_layout", code: "fileEmpty", layout: " \n\n" },
    { name: "empty_landmarks", code: "fileEmpty", landmarks: "\n" },
    { name: "not_a_mesh", code: "unknownFormat", target: "\x89PNG\r\n\x1a\n\0\0\0" },
    { name: "damaged_line", code: "syntaxError", target: ballAt("one") },
    {
        name: "index_out_of_range",
        code: "indexOutOfRange",
        target: ballWith((f) => [...f, [0, 1, 999]]),
    },
    { name: "no_faces", code: "noFaces", target: "v 0 0 0\nv 1 0 0\nv 0 1 0\n" },
    { name: "over_255_corners", code: "faceTooLarge", layout: manyCorners },
    { name: "quads", code: "notTriangles", target: obj(cube) },
    { name: "non_manifold_edge", code: "nonManifoldEdge", target: nonManifold() },
    { name: "non_manifold_vertex", code: "nonManifoldVertex", target: pinched() },
    {
        name: "inconsistent_orientation",
        code: "inconsistentOrientation",
        target: ballWith(([first, ...rest]) => [first!.reverse(), ...rest]),
    },
    { name: "several_components", code: "severalComponents", target: obj(both(ball, ball)) },
    { name: "disconnected_layout", code: "severalComponents", layout: obj(both(octahedron, cube)) },
    {
        name: "torus_target",
        code: "topologyMismatch",
        target: obj(torus(9, 7)),
        landmarks: "0\n9\n20\n31\n42\n55\n",
    },
    { name: "holed_target", code: "topologyMismatch", target: ballWith((faces) => faces.slice(1)) },
    { name: "landmark_out_of_range", code: "landmarkOutOfRange", landmarks: "0\n1\n2\n3\n4\n66\n" },
    { name: "negative_landmark", code: "landmarkOutOfRange", landmarks: "0\n1\n2\n3\n4\n-1\n" },
    { name: "landmark_that_is_no_number", code: "syntaxError", landmarks: "0\n1\n2\n3\n4\nfive\n" },
    { name: "duplicate_landmark", code: "duplicateLandmark", landmarks: "0\n1\n2\n3\n4\n2\n" },
    { name: "too_few_landmarks", code: "landmarkCount", landmarks: "0\n1\n2\n3\n4\n" },
    { name: "too_many_landmarks", code: "landmarkCount", landmarks: "0\n1\n2\n3\n4\n5\n6\n" },
    {
        name: "layout_with_a_loop",
        code: "layoutLoop",
        layout: "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 1 2 3\nf 3 2 1\n",
    },
    { name: "non_manifold_layout", code: "nonManifoldEdge", layout: nonManifold() },
    { name: "not_a_number", code: "nonFinitePosition", target: ballAt("nan") },
    { name: "infinite", code: "nonFinitePosition", target: ballAt("inf") },
    { name: "absurdly_large", code: "coordinateTooLarge", target: ballAt("1e200") },
    { name: "unused_vertex", code: "unusedVertex", target: `${obj(ball)}v 5 5 5\n` },
    { name: "degenerate_face", code: "degenerateFace", target: ballWith((f) => [...f, [0, 0, 1]]) },
    { name: "duplicate_face", code: "duplicateFace", target: ballWith((f) => [...f, f[3]!]) },
];

/** The ball with a fin: three faces at one edge. */
function nonManifold(): string {
    return obj({
        positions: [...ball.positions, 2, 2, 2],
        faces: [...ball.faces, [ball.faces[0]![0]!, ball.faces[0]![1]!, ball.positions.length / 3]],
    });
}

/** Two balls that touch in one vertex. */
function pinched(): string {
    const mesh = both(ball, ball);
    const shift = ball.positions.length / 3;
    const faces = mesh.faces.map((face) =>
        face.map((v) => (v === shift ? 0 : v > shift ? v - 1 : v)),
    );
    mesh.positions.splice(3 * shift, 3);
    return obj({ positions: mesh.positions, faces });
}

const good = { layout: obj(octahedron), target: obj(ball), landmarks: "0\n1\n2\n3\n4\n5\n" };

function inputs(bad: BadInput) {
    const { layout = good.layout, target = good.target, landmarks = good.landmarks } = bad;
    return { layout, target, landmarks };
}

describe.each(badInputs)("$name", (bad) => {
    test("has_its_code_and_one_sentence_everywhere", async () => {
        const texts = inputs(bad);
        const bytes = (role: keyof typeof texts, name: string) => ({
            bytes: new TextEncoder().encode(texts[role]),
            name,
        });
        const failure = (await embed({
            layout: bytes("layout", "layout.obj") satisfies MeshInput,
            target: bytes("target", "target.obj"),
            landmarks: bytes("landmarks", "landmarks.txt"),
        }).catch((error: unknown) => error)) as Error & { code: string };
        expect(failure).toMatchObject({ name: "LayoutError", code: bad.code });
        expect(failure.message).toMatch(/^[^\n]+; [^\n]+\.$/);

        await inFolder(async (folder) => {
            const paths = (Object.keys(texts) as (keyof typeof texts)[]).map((role) => {
                const file = path.join(
                    folder,
                    role === "landmarks" ? "landmarks.txt" : `${role}.obj`,
                );
                writeFileSync(file, texts[role]);
                return file;
            });
            const [layout, target, landmarks] = paths as [string, string, string];
            const output = path.join(folder, "out");
            const finished = await run([
                "embed",
                layout,
                target,
                "--landmarks",
                landmarks,
                "--output",
                output,
                "--json",
            ]);
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
