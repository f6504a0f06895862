// Template layouts: the API in both kinds of thread, and the command `layout`.
import { existsSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import path from "node:path";
import { embed, Session, templateLayout } from "layout-embedding";
import { createWorkerClient } from "layout-embedding/worker";
import { describe, expect, test } from "vitest";
import { inFolder, run } from "./command.js";
import { arrays, file, obj, sphere, torus } from "./meshes.js";

const target = arrays(sphere(3));
const landmarks = [40, 17, 91, 133, 250, 201, 5, 77];

/** The numbers of corners of the faces. */
function faceSizes(offsets: Uint32Array): number[] {
    return Array.from(offsets.slice(1), (end, face) => end - (offsets[face] ?? 0));
}

describe("templateLayout", () => {
    test("makes_a_layout_of_the_landmarks_that_embeds_at_them", async () => {
        for (const quads of [false, true]) {
            const layout = await templateLayout({ target, landmarks }, { quads });
            expect(layout.positions).toHaveLength(3 * landmarks.length);
            landmarks.forEach((vertex, i) => {
                expect(Array.from(layout.positions.subarray(3 * i, 3 * i + 3))).toEqual(
                    Array.from(target.positions.slice(3 * vertex, 3 * vertex + 3)),
                );
            });
            expect(Array.from(layout.landmarks)).toEqual(landmarks);
            const sizes = faceSizes(layout.offsets);
            // A triangulation of the sphere has 2V - 4 faces; a quad takes the place of two.
            const corners = sizes.reduce((sum, size) => sum + size - 2, 0);
            expect(corners).toBe(2 * landmarks.length - 4);
            expect(Math.max(...sizes)).toBe(quads ? 4 : 3);
            const { collapses, afterFlips, inAnyShape } = layout.removed;
            expect(collapses + afterFlips + inAnyShape).toBe(258 - landmarks.length);
            const result = await embed({ layout, target, landmarks });
            expect(result.refined).not.toBeNull();
            expect(result.edges).toHaveLength(landmarks.length + sizes.length - 2);
        }
    });

    test("gives_the_same_as_arrays_and_as_a_file", async () => {
        const layout = await templateLayout({ target, landmarks });
        const session = await Session.create();
        const read = await session.loadLayout({ bytes: layout.obj, format: "obj" });
        await session.dispose();
        expect(read.positions).toEqual(layout.positions);
        expect(read.corners).toEqual(layout.corners);
        expect(read.offsets).toEqual(layout.offsets);
    });

    test("gives_the_same_in_a_worker_and_again", async () => {
        const worker = await createWorkerClient();
        try {
            const here = await templateLayout({ target, landmarks }, { quads: true });
            const there = await worker.templateLayout({ target, landmarks }, { quads: true });
            expect(there).toEqual(here);
            expect(await templateLayout({ target, landmarks }, { quads: true })).toEqual(here);
        } finally {
            worker.terminate();
        }
    });

    test("changes_nothing_in_a_session_and_its_result_goes_into_it", async () => {
        const session = await Session.create();
        await expect(session.templateLayout(landmarks)).rejects.toMatchObject({
            code: "missingInput",
        });
        await session.loadTarget(target);
        const layout = await session.templateLayout(landmarks);
        await expect(session.solve()).rejects.toMatchObject({ code: "missingInput" });
        await session.loadLayout(layout);
        await session.setLandmarks(layout.landmarks, { numbering: "loaded" });
        expect((await session.solve()).refined).not.toBeNull();
        await session.dispose();
        await expect(session.templateLayout(landmarks)).rejects.toMatchObject({
            code: "disposed",
        });
    });

    test("takes_landmarks_through_a_repair_of_the_target", async () => {
        const ball = sphere(2);
        // A vertex in no face comes first, so that all ids shift.
        const loose = {
            positions: [9, 9, 9, ...ball.positions],
            corners: ball.faces.flat().map((vertex) => vertex + 1),
        };
        const given = [1, 12, 30, 44];
        const layout = await templateLayout({ target: loose, landmarks: given }, { repair: true });
        expect(Array.from(layout.landmarks)).toEqual(given.map((vertex) => vertex - 1));
        expect(layout.notes.length).toBeGreaterThan(0);
        expect(Array.from(layout.positions.subarray(0, 3))).toEqual(ball.positions.slice(0, 3));
    });

    test.each([
        ["too_few_landmarks", "tooFewLandmarks", [1, 2]],
        ["one_vertex_twice", "duplicateLandmark", [1, 2, 3, 1]],
        ["a_landmark_out_of_range", "landmarkOutOfRange", [1, 2, 3, 9999]],
        ["a_landmark_that_is_no_id", "landmarkOutOfRange", [1, 2, 3.5]],
    ])("%s_is_refused", async (_, code, bad) => {
        await expect(templateLayout({ target, landmarks: bad })).rejects.toMatchObject({ code });
    });
});

/** A folder with target.obj, torus.obj and landmarks.txt. */
function withInputs(body: (folder: string) => Promise<void>): () => Promise<void> {
    return () =>
        inFolder(async (folder) => {
            writeFileSync(path.join(folder, "target.obj"), obj(sphere(3)));
            writeFileSync(path.join(folder, "torus.obj"), obj(torus(16, 12)));
            writeFileSync(path.join(folder, "landmarks.txt"), landmarks.slice(0, 6).join("\n"));
            await body(folder);
        });
}

const inputs = ["target.obj", "--landmarks", "landmarks.txt", "--output", "layout.obj"];

describe("layout", () => {
    test(
        "writes_a_layout_that_embed_takes",
        withInputs(async (cwd) => {
            const made = await run(["layout", ...inputs], { cwd });
            expect(made).toMatchObject({ exitCode: 0, stderr: "" });
            expect(made.stdout).toContain("layout of 6 vertices, 8 triangles");
            expect(made.stdout).toContain("written: layout.obj");
            const expected = await templateLayout({
                target: file(sphere(3), "target.obj"),
                landmarks: landmarks.slice(0, 6),
            });
            expect(readFileSync(path.join(cwd, "layout.obj"))).toEqual(Buffer.from(expected.obj));
            const embedded = await run(
                ["embed", "layout.obj", ...inputs.slice(0, 3), "--output", "out"],
                { cwd },
            );
            expect(embedded).toMatchObject({ exitCode: 0, stderr: "" });
            const checked = await run(["check", "out", "layout.obj", "target.obj"], { cwd });
            expect(checked).toMatchObject({ exitCode: 0, stderr: "" });
        }),
    );

    test(
        "prints_one_json_object_and_merges_quads_on_request",
        withInputs(async (cwd) => {
            const made = await run(["layout", ...inputs, "--quads", "--json"], { cwd });
            expect(made).toMatchObject({ exitCode: 0, stderr: "" });
            const document = JSON.parse(made.stdout) as Record<string, number>;
            expect(document).toMatchObject({
                file: "layout.obj",
                vertices: 6,
                landmarks: landmarks.slice(0, 6),
                notes: [],
            });
            expect((document["triangles"] ?? 0) + 2 * (document["quads"] ?? 0)).toBe(8);
            const faces = readFileSync(path.join(cwd, "layout.obj"), "utf8").match(/^f /gm);
            expect(faces).toHaveLength((document["triangles"] ?? 0) + (document["quads"] ?? 0));
        }),
    );

    test(
        "is_silent_when_asked_to_be",
        withInputs(async (cwd) => {
            const made = await run(["layout", ...inputs, "--quiet"], { cwd });
            expect(made).toEqual({ exitCode: 0, stdout: "", stderr: "" });
            expect(existsSync(path.join(cwd, "layout.obj"))).toBe(true);
        }),
    );

    test(
        "says_why_there_is_no_layout_and_writes_nothing",
        withInputs(async (cwd) => {
            const made = await run(["layout", "torus.obj", ...inputs.slice(1)], { cwd });
            expect(made.exitCode).toBe(2);
            expect(made.stdout).toBe("");
            // Vertex 250 is beyond the torus.
            expect(made.stderr).toContain("landmark 4 is vertex 250");
            writeFileSync(path.join(cwd, "landmarks.txt"), "0\n30\n60\n90\n120\n150\n");
            const few = await run(["layout", "torus.obj", ...inputs.slice(1), "--json"], { cwd });
            expect(few.exitCode).toBe(2);
            expect(JSON.parse(few.stdout)).toMatchObject({
                error: {
                    code: "tooFewLandmarksForSurface",
                    details: { landmarks: 6, needed: 7, genus: 1, boundaryLoops: 0 },
                },
            });
            expect(readdirSync(cwd).sort()).toEqual(["landmarks.txt", "target.obj", "torus.obj"]);
        }),
    );

    test.each([
        ["no_target", ["layout", ...inputs.slice(1)], "TARGET is missing"],
        ["no_landmarks", ["layout", "target.obj", "--output", "a.obj"], "--landmarks FILE"],
        ["no_output", ["layout", ...inputs.slice(0, 3)], "--output LAYOUT.obj is missing"],
        ["two_targets", ["layout", "target.obj", ...inputs], "target.obj is one file too many"],
        ["an_unknown_option", ["layout", ...inputs, "--gap", "0"], "--gap"],
        ["a_missing_file", ["layout", "none.obj", ...inputs.slice(1)], "none.obj does not exist"],
        ["a_folder_as_output", ["layout", ...inputs.slice(0, 4), "."], "is a folder"],
        ["a_missing_folder", ["layout", ...inputs.slice(0, 4), "no/a.obj"], "cannot be written"],
    ])("%s_is_bad_usage", async (_, args, words) => {
        await withInputs(async (cwd) => {
            const finished = await run(args, { cwd });
            expect(finished.exitCode).toBe(2);
            expect(finished.stdout).toBe("");
            expect(finished.stderr).toContain(words);
        })();
    });
});
