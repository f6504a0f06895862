// Session files of the page: whatever is damaged of one, all else is read, and what is read is of the
// right kind. Damage is drawn by fast-check from a fixed seed.
import fc from "fast-check";
import { unzipSync, zipSync } from "fflate";
import type { MeshFile } from "layout-embedding";
import { expect, test } from "vitest";
import { packSession, unpackSession } from "../../web/src/model/session_file.js";
import type { SavedWork } from "../../web/src/model/saved_work.js";
import { initialState } from "../../web/src/model/state.js";
import { arrays, file, octahedron, sphere } from "./meshes.js";

const work: SavedWork = {
    layout: file(octahedron, "octahedron.obj"),
    target: { ...arrays(sphere(1)), name: "sphere" },
    landmarks: { places: [0, 1, null, 3], names: ["a", "", "b", "c"], source: "a file" },
    making: false,
    quads: true,
    repair: true,
    options: { ...initialState.options, gap: 0.5, seed: 7, featureDiscount: 0.4 },
    origin: { kind: "shape", name: "hand/victory" },
    routes: [{ rule: "avoid", edge: 2, path: [[1], [1, 2], [3]], edgeCost: 2, costBefore: null }],
    second: { files: [new File(["v 0 0 0"], "other.obj")] },
    quadMesh: { edgeLength: 0.25, segments: [[3, 8]] },
    map: { texture: "checker", cursor: { from: "b", vertex: 5 } },
    tab: "quads",
    solved: true,
};
const packed = zipSync(await packSession(work));
const runs = { seed: 1, numRuns: 500 } as const;

const isId = (value: unknown) => Number.isSafeInteger(value) && (value as number) >= 0;

/** What is read, or null where it is refused with a sentence; anything else is a failure. */
function read(bytes: Uint8Array): ReturnType<typeof unpackSession> | null {
    let session;
    try {
        session = unpackSession("a.zip", bytes);
    } catch (error) {
        const pattern = /^a\.zip is not a session of this page \(.+\); choose another file\.$/;
        expect((error as Error).message).toMatch(pattern);
        return null;
    }
    const { layout, target, landmarks, options, origin, routes, second } = session.work;
    const { quadMesh, map, tab } = session.work;
    expect(layout ?? target).not.toBeNull();
    for (const mesh of [layout, target]) {
        if (mesh === null) continue;
        const { name, bytes: content } = mesh as MeshFile;
        expect(typeof name).toBe("string");
        // Nothing but the files that were packed.
        expect(content).toBeInstanceOf(Uint8Array);
        expect(content.byteLength).toBeGreaterThan(0);
    }
    if (landmarks !== null) {
        expect(landmarks.places.every((place) => place === null || isId(place))).toBe(true);
        expect(landmarks.names.map((name) => typeof name)).toEqual(
            landmarks.places.map(() => "string"),
        );
    }
    expect(Object.keys(options).sort()).toEqual(Object.keys(initialState.options).sort());
    expect(options.gap >= 0 && options.gap <= 1 && isId(options.seed)).toBe(true);
    expect(["even", "short", "fair"]).toContain(options.shape);
    if (origin !== null) expect(Object.values(origin).map((v) => typeof v)).not.toContain("object");
    for (const { edge, path } of routes) expect(isId(edge) && path.flat().every(isId)).toBe(true);
    expect(options.featureDiscount >= 0 && options.featureDiscount <= 0.95).toBe(true);
    expect(["free", "follow"]).toContain(options.boundaryEdges);
    expect(quadMesh.edgeLength === null || quadMesh.edgeLength > 0).toBe(true);
    expect(quadMesh.segments.every((pair) => pair.length === 2 && pair.every(isId))).toBe(true);
    expect(["grid", "checker", "patches", "distortion", "file"]).toContain(map.texture);
    if (map.cursor !== null) expect(["a", "b"]).toContain(map.cursor.from);
    expect(map.cursor === null || isId(map.cursor.vertex)).toBe(true);
    expect(["embedding", "quads", "map"]).toContain(tab);
    if (second && "files" in second)
        expect(second.files.every((each) => each instanceof File)).toBe(true);
    return session;
}

test("a_sound_session_comes_back", () => {
    const session = read(packed);
    expect(session?.lost).toEqual([]);
    const { second, layout, target } = session!.work;
    expect({ ...session!.work, second: null, layout: null, target: null }).toEqual({
        ...{ ...work, second: null, layout: null, target: null },
    });
    expect(second).toMatchObject({ files: [{ name: "other.obj" }] });
    expect(layout).toMatchObject({ name: "octahedron.obj" });
    expect(target).toMatchObject({ name: "sphere", format: "obj" });
});

test("of_damaged_bytes_all_that_is_whole_is_read", () => {
    const seen = { read: 0, refused: 0 };
    const edit = fc.record({
        at: fc.nat(packed.length - 1),
        length: fc.nat(30),
        instead: fc.uint8Array({ maxLength: 30 }),
    });
    fc.assert(
        fc.property(fc.array(edit, { minLength: 1, maxLength: 4 }), (edits) => {
            const bytes = edits.reduce(
                (now, { at, length, instead }) =>
                    Uint8Array.from([
                        ...now.subarray(0, at),
                        ...instead,
                        ...now.subarray(at + length),
                    ]),
                packed,
            );
            ++seen[read(bytes) === null ? "refused" : "read"];
        }),
        runs,
    );
    expect(Math.min(seen.read, seen.refused)).toBeGreaterThan(20);
});

test("of_a_damaged_description_all_that_makes_sense_is_read", () => {
    const files = unzipSync(packed);
    const description = JSON.parse(new TextDecoder().decode(files["session.json"])) as object;
    /** All places in the description, as lists of keys. */
    const places = (value: unknown, path: string[] = []): string[][] =>
        typeof value === "object" && value !== null
            ? [path, ...Object.entries(value).flatMap(([key, v]) => places(v, [...path, key]))]
            : [path];
    const replaced = (value: unknown, [key, ...rest]: string[], instead: unknown): unknown => {
        if (key === undefined) return instead;
        if (typeof value !== "object" || value === null) return value;
        const copy = (Array.isArray(value) ? [...(value as unknown[])] : { ...value }) as Record<
            string,
            unknown
        >;
        copy[key] = replaced(copy[key], rest, instead);
        return copy;
    };
    const anything = fc.oneof(
        fc.jsonValue(),
        fc.constantFrom("constructor", "__proto__", "layout.obj", "keep", -1, 0.5, 1e300, "exact"),
    );
    let taken = 0;
    fc.assert(
        fc.property(
            fc.array(fc.tuple(fc.constantFrom(...places(description)), anything), {
                minLength: 1,
                maxLength: 3,
            }),
            (edits) => {
                const document = edits.reduce<unknown>(
                    (now, [path, instead]) => replaced(now, path, instead),
                    description,
                );
                const bytes = new TextEncoder().encode(JSON.stringify(document) ?? "");
                if (read(zipSync({ ...files, "session.json": bytes }, { level: 0 }))) ++taken;
            },
        ),
        runs,
    );
    expect(taken).toBeGreaterThan(runs.numRuns / 2);
});
