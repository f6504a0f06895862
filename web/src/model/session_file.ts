// A session as one zip file: layout and target as they were given, and session.json for the rest.
import { strFromU8, strToU8, Unzip, UnzipInflate, unzipSync } from "fflate";
import type { Algorithm, MeshArrays, MeshFile, PathShape } from "layout-embedding";
import type { SavedSecond, SavedWork, Source } from "./sources.js";
import type { Landmarks } from "./landmarks.js";
import type { RouteRule } from "./routes.js";
import { initialState } from "./state.js";

const version = 1;
const description = "session.json";

interface SessionDocument {
    readonly version: number;
    readonly layout: { readonly name: string; readonly file: string } | null;
    readonly target: { readonly name: string; readonly file: string } | null;
    readonly landmarks: Landmarks | null;
    readonly making: boolean;
    readonly quads: boolean;
    readonly repair: boolean;
    readonly options: SavedWork["options"];
    readonly origin: SavedWork["origin"];
    /** Left out in sessions of earlier versions of the page. */
    readonly routes?: readonly RouteRule[];
    readonly second?:
        | { readonly shape: string }
        | { readonly files: readonly { readonly name: string; readonly file: string }[] }
        | null;
    readonly solved: boolean;
}

/** The files of a session, by name. */
export async function packSession(work: SavedWork): Promise<Record<string, Uint8Array>> {
    const files: Record<string, Uint8Array> = {};
    const pack = async (role: string, source: Source | null) => {
        if (!source) return null;
        const name = source.name ?? role;
        const ending = "corners" in source ? ".obj" : (/\.[^.]*$/.exec(name)?.[0] ?? "");
        const file = `${role}${ending}`;
        files[file] = await bytesOf(source);
        return { name, file };
    };
    const packSecond = async () => {
        const { second } = work;
        if (!second || "shape" in second) return second;
        const packed = [];
        for (const [place, file] of second.files.entries()) {
            const entry = await pack(place === 0 ? "second" : "second_landmarks", file);
            if (entry) packed.push(entry);
        }
        return { files: packed };
    };
    const { landmarks, making, quads, repair, options, origin, routes, solved } = work;
    const document: SessionDocument = {
        version,
        layout: await pack("layout", work.layout),
        target: await pack("target", work.target),
        landmarks,
        making,
        quads,
        repair,
        options,
        origin,
        routes,
        second: await packSecond(),
        solved,
    };
    return { [description]: strToU8(JSON.stringify(document, null, 1)), ...files };
}

/** What could be read of a session file. */
export interface UnpackedSession {
    readonly work: SavedWork;
    /** What could not, for people; empty for a sound file. */
    readonly lost: readonly string[];
}

/**
 * What a session file holds. Damage to a part of it leaves the others as they are; where there is no
 * mesh, throws an Error for people.
 */
export function unpackSession(name: string, bytes: Uint8Array): UnpackedSession {
    const broken = (why: string) =>
        new Error(`${name} is not a session of this page (${why}); choose another file.`);
    const files = readableFiles(bytes);
    if (Object.keys(files).length === 0) throw broken("it cannot be unpacked");
    const lost: string[] = [];
    const document = documentIn(files, broken, lost);
    /** A part, or `otherwise` where it is damaged. */
    const part = <T>(what: string, otherwise: T, read: () => T): T => {
        try {
            return read();
        } catch {
            lost.push(what);
            return otherwise;
        }
    };
    const unpack = (role: "layout" | "target"): MeshFile | null =>
        part(`the ${role}`, null, () => {
            const entry = document[role];
            if (!entry) return null;
            const content = contentOf(files, entry.file);
            return { name: String(entry.name), bytes: content, ...formatOf(entry) };
        });
    const target = unpack("target");
    const layout = unpack("layout");
    if (!target && !layout) throw broken("there is no mesh in it that could be read");
    const landmarks = part("the landmarks", null, () => checkedLandmarks(document.landmarks));
    const work: SavedWork = {
        layout,
        target,
        // Ids mean nothing without their mesh.
        landmarks: target ? landmarks : null,
        // Landmarks without their layout can still have one made of them.
        making: document.making === true || (!layout && landmarks !== null),
        quads: document.quads !== false,
        repair: document.repair === true,
        options: part("the settings", initialState.options, () =>
            checkedSettings(document.options),
        ),
        origin: lost.length === 0 ? checkedOrigin(document.origin) : null,
        routes: part("the rules for routes", [], () => checkedRoutes(document.routes)),
        second: part("the second target", null, () => secondIn(document.second, files)),
        solved: document.solved === true && layout !== null && target !== null,
    };
    return { work, lost };
}

/** All files in a zip that are whole, also where its list of them is damaged. */
function readableFiles(bytes: Uint8Array): Record<string, Uint8Array> {
    try {
        return unzipSync(bytes);
    } catch {
        // Each file has a header of its own.
    }
    const files: Record<string, Uint8Array> = {};
    const reader = new Unzip((file) => {
        const pieces: Uint8Array[] = [];
        file.ondata = (error, data, isLast) => {
            if (error) return;
            pieces.push(data);
            if (isLast) files[file.name] = concatenated(pieces);
        };
        file.start();
    });
    reader.register(UnzipInflate);
    try {
        reader.push(bytes, true);
    } catch {
        // What came before the damage is there.
    }
    return files;
}

function concatenated(pieces: readonly Uint8Array[]): Uint8Array {
    const whole = new Uint8Array(pieces.reduce((sum, { length }) => sum + length, 0));
    let at = 0;
    for (const piece of pieces) {
        whole.set(piece, at);
        at += piece.length;
    }
    return whole;
}

/** The description, or what the names of the files tell where it is damaged. */
function documentIn(
    files: Record<string, Uint8Array>,
    broken: (why: string) => Error,
    lost: string[],
): Partial<SessionDocument> {
    const text = files[description];
    let document: Partial<SessionDocument> | null = null;
    try {
        document = text ? (JSON.parse(strFromU8(text)) as Partial<SessionDocument> | null) : null;
    } catch {
        // Damaged.
    }
    if (document) {
        if (document.version !== version) throw broken("its version is unknown");
        return document;
    }
    const entry = (role: string) => {
        const file = Object.keys(files).find((name) => name.startsWith(`${role}.`));
        return file === undefined ? null : { name: file, file };
    };
    const found = { layout: entry("layout"), target: entry("target") };
    if (!found.layout && !found.target) throw broken(`it holds no ${description}`);
    lost.push("landmarks and options");
    return found;
}

function contentOf(files: Record<string, Uint8Array>, name: string): Uint8Array<ArrayBuffer> {
    // Any word may be asked for, also one that every object knows.
    const content = Object.hasOwn(files, name) ? files[name] : undefined;
    if (!content) throw new Error(`${name} is missing`);
    return new Uint8Array(content);
}

function secondIn(
    second: SessionDocument["second"],
    files: Record<string, Uint8Array>,
): SavedSecond | null {
    if (!second) return null;
    if ("shape" in second) return { shape: String(second.shape) };
    return {
        files: second.files.map(({ name, file }) => new File([contentOf(files, file)], name)),
    };
}

/** Names may have no ending, or another one than the format the mesh was packed in. */
const formatOf = ({ file, name }: { file: string; name: string }): Pick<MeshFile, "format"> =>
    file.endsWith(".obj") && !/\.obj$/i.test(name) ? { format: "obj" } : {};

function checkedLandmarks(landmarks: Landmarks | null | undefined): Landmarks | null {
    if (!landmarks) return null;
    const { places, names, source } = landmarks;
    const valid =
        Array.isArray(places) &&
        Array.isArray(names) &&
        places.length === names.length &&
        places.every((v) => v === null || (Number.isSafeInteger(v) && v >= 0)) &&
        names.every((text) => typeof text === "string");
    if (!valid) throw new Error("these are no landmarks");
    return { places, names, source: String(source) };
}

function checkedSettings(settings: SessionDocument["options"] | undefined): SavedWork["options"] {
    const { algorithm, gap, timeLimit, workLimit, seed, shape } = {
        ...initialState.options,
        ...settings,
    };
    const isAmount = (value: unknown) =>
        value === null || (typeof value === "number" && value >= 0);
    const valid =
        (algorithm === null || isOneOf(algorithms, algorithm)) &&
        isOneOf(shapes, shape) &&
        [gap, timeLimit, workLimit].every(isAmount) &&
        gap !== null &&
        gap <= 1 &&
        isId(seed);
    if (!valid) throw new Error("these are no settings");
    return { algorithm, gap, timeLimit, workLimit, seed, shape };
}

function checkedOrigin(origin: SavedWork["origin"] | undefined): SavedWork["origin"] {
    const { kind, name } = origin ?? {};
    return (kind === "example" || kind === "shape") && typeof name === "string"
        ? { kind, name }
        : null;
}

function checkedRoutes(routes: readonly RouteRule[] | undefined): readonly RouteRule[] {
    if (routes === undefined) return [];
    if (!isList(routes) || !routes.every(isRoute)) throw new Error("these are no rules");
    return routes;
}

const algorithms: readonly Algorithm[] = [
    "greedy",
    "praun",
    "kraevoy",
    "schreiner",
    "branch-and-bound",
    "exact",
];
const shapes: readonly PathShape[] = ["even", "short", "fair"];
const isOneOf = (list: readonly string[], value: string) => list.includes(value);
const isList = (value: unknown): boolean => Array.isArray(value);
const isId = (value: unknown) => Number.isSafeInteger(value) && (value as number) >= 0;
const isPoint = (point: readonly unknown[]) =>
    isList(point) && point.length > 0 && point.length < 4 && point.every(isId);

const isRoute = ({ rule, edge, path, edgeCost, costBefore }: Partial<RouteRule>): boolean =>
    (rule === "keep" || rule === "avoid") &&
    isId(edge) &&
    isList(path) &&
    (path ?? []).every(isPoint) &&
    typeof edgeCost === "number" &&
    (costBefore === null || typeof costBefore === "number");

async function bytesOf(source: Source): Promise<Uint8Array> {
    if (source instanceof File) return new Uint8Array(await source.arrayBuffer());
    return "corners" in source ? objOf(source) : new Uint8Array(source.bytes);
}

/** Every coordinate as it is: JavaScript writes numbers so that they read back the same. */
export function objOf({ positions, corners, offsets }: MeshArrays): Uint8Array {
    const lines: string[] = [];
    for (let v = 0; v < positions.length; v += 3)
        lines.push(`v ${positions[v]} ${positions[v + 1]} ${positions[v + 2]}`);
    const faceCount = offsets ? offsets.length - 1 : corners.length / 3;
    for (let f = 0; f < faceCount; ++f) {
        const [begin, end] = offsets ? [offsets[f]!, offsets[f + 1]!] : [3 * f, 3 * f + 3];
        const face: number[] = [];
        for (let i = begin; i < end; ++i) face.push(corners[i]! + 1);
        lines.push(`f ${face.join(" ")}`);
    }
    return strToU8(`${lines.join("\n")}\n`);
}
