// Whatever a mesh or a list of landmarks holds, it is taken or refused with an error of the table, and
// the session goes on as before. Inputs are drawn by fast-check from a fixed seed.
import fc from "fast-check";
import { embed, errorInfos, LayoutError, Session } from "layout-embedding";
import { afterAll, beforeAll, expect, test } from "vitest";
import { arrays, obj, octahedron, sphere } from "./meshes.js";

const layout = arrays(octahedron);
const target = sphere(1);
const vertexCount = target.positions.length / 3;
const runs = { seed: 1, numRuns: 200 } as const;

let session: Session;
let codes: Set<string>;
beforeAll(async () => {
    session = await Session.create();
    codes = new Set((await errorInfos()).map(({ code }) => code));
});
afterAll(() => session.dispose());

/** Whether it was taken; anything but a LayoutError with a sentence is a failure. */
async function taken(attempt: Promise<unknown>): Promise<boolean> {
    try {
        await attempt;
        return true;
    } catch (reason) {
        expect(reason).toBeInstanceOf(LayoutError);
        const { code, message } = reason as LayoutError;
        expect(codes).toContain(code);
        expect(message).toMatch(/^[^\n]+\.$/);
        return false;
    }
}

/** The same session still gives what a fresh one gives. */
async function expectUsable(): Promise<void> {
    await session.loadLayout(layout);
    await session.loadTarget(arrays(target));
    const { refined } = await session.solve();
    expect(refined).toEqual((await embed({ layout, target: arrays(target) })).refined);
}

/** The text with pieces of it cut out, doubled, or replaced by something else. */
const damaged = (text: string) =>
    fc
        .array(
            fc.record({
                at: fc.nat(text.length),
                length: fc.nat(20),
                instead: fc.oneof(
                    fc.string({ maxLength: 8 }),
                    fc.constantFrom("f 1 2 3\n", "v 0 0\n", "-1", "1e999", "nan", "\n", " ", "#"),
                ),
            }),
            { minLength: 1, maxLength: 4 },
        )
        .map((edits) =>
            edits.reduce(
                (now, { at, length, instead }) =>
                    now.slice(0, at) + instead + now.slice(at + length),
                text,
            ),
        );

test("a_damaged_mesh_is_read_or_refused", async () => {
    const seen = { taken: 0, refused: 0 };
    await fc.assert(
        fc.asyncProperty(
            fc.constantFrom("layout", "target"),
            damaged(obj(target)),
            fc.boolean(),
            async (role, text, repair) => {
                const file = { bytes: new TextEncoder().encode(text), name: "mesh.obj" };
                const load = role === "layout" ? session.loadLayout(file) : null;
                const attempt = load ?? session.loadTarget(file, { repair });
                ++seen[(await taken(attempt)) ? "taken" : "refused"];
            },
        ),
        runs,
    );
    expect(Math.min(seen.taken, seen.refused)).toBeGreaterThan(5);
    await expectUsable();
});

test("bytes_of_any_kind_are_refused_or_read_in_every_format", async () => {
    await fc.assert(
        fc.asyncProperty(
            fc.uint8Array({ maxLength: 200 }),
            fc.constantFrom("obj", "off", "ply", "stl", "glb", undefined),
            async (bytes, format) => {
                const start = format === "ply" || format === "off" ? `${format}\n` : "";
                const all = new Uint8Array([...new TextEncoder().encode(start), ...bytes]);
                await taken(session.loadTarget({ bytes: all, ...(format && { format }) }));
            },
        ),
        runs,
    );
    await expectUsable();
});

test("landmarks_are_taken_exactly_where_they_are_different_vertices_of_the_target", async () => {
    await session.loadLayout(layout);
    await session.loadTarget(arrays(target));
    const ids = fc.oneof(
        fc.uniqueArray(fc.nat(vertexCount - 1), { minLength: 6, maxLength: 6 }),
        fc.array(
            fc.oneof({ weight: 20, arbitrary: fc.nat(vertexCount - 1) }, fc.integer(), fc.double()),
            { minLength: 5, maxLength: 7 },
        ),
    );
    await fc.assert(
        fc.asyncProperty(ids, async (landmarks) => {
            const valid =
                landmarks.length === 6 &&
                new Set(landmarks).size === 6 &&
                landmarks.every((id) => Number.isInteger(id) && id >= 0 && id < vertexCount);
            expect(await taken(session.setLandmarks(landmarks))).toBe(valid);
        }),
        runs,
    );
});
