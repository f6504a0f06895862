// A session as one zip file: layout and target as they were given, and session.json for the rest.
import { strFromU8, strToU8, unzipSync } from "fflate";
import type { MeshArrays, MeshFile } from "layout-embedding";
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

/** What a session file holds; throws an Error for people where it is none. */
export function unpackSession(name: string, bytes: Uint8Array): SavedWork {
    const broken = (why: string) =>
        new Error(`${name} is not a session of this page (${why}); choose another file.`);
    let files: Record<string, Uint8Array>;
    try {
        files = unzipSync(bytes);
    } catch {
        throw broken("it cannot be unpacked");
    }
    const text = files[description];
    if (!text) throw broken(`it holds no ${description}`);
    let document: SessionDocument;
    try {
        document = JSON.parse(strFromU8(text)) as SessionDocument;
    } catch {
        throw broken(`its ${description} is no JSON`);
    }
    if (document.version !== version) throw broken("its version is unknown");
    const unpack = (entry: SessionDocument["layout"]): MeshFile | null => {
        if (!entry) return null;
        const content = files[entry.file];
        if (!content) throw broken(`${entry.file} is missing`);
        return { name: entry.name, bytes: new Uint8Array(content), ...formatOf(entry) };
    };
    const unpackSecond = (): SavedSecond | null => {
        const { second } = document;
        if (!second) return null;
        if ("shape" in second) return { shape: String(second.shape) };
        if (!isList(second.files)) throw broken("its second target is damaged");
        return {
            files: second.files.map(({ name: given, file }) => {
                const content = files[file];
                if (!content) throw broken(`${file} is missing`);
                return new File([new Uint8Array(content)], given);
            }),
        };
    };
    return {
        layout: unpack(document.layout),
        target: unpack(document.target),
        landmarks: checkedLandmarks(document.landmarks, broken),
        making: document.making === true,
        quads: document.quads !== false,
        repair: document.repair === true,
        options: { ...initialState.options, ...document.options },
        origin: document.origin ?? null,
        routes: checkedRoutes(document.routes, broken),
        second: unpackSecond(),
        solved: document.solved === true,
    };
}

/** Names may have no ending, or another one than the format the mesh was packed in. */
const formatOf = ({ file, name }: { file: string; name: string }): Pick<MeshFile, "format"> =>
    file.endsWith(".obj") && !/\.obj$/i.test(name) ? { format: "obj" } : {};

function checkedLandmarks(
    landmarks: Landmarks | null | undefined,
    broken: (why: string) => Error,
): Landmarks | null {
    if (!landmarks) return null;
    const { places, names, source } = landmarks;
    const valid =
        Array.isArray(places) &&
        Array.isArray(names) &&
        places.length === names.length &&
        places.every((v) => v === null || (Number.isSafeInteger(v) && v >= 0)) &&
        names.every((text) => typeof text === "string");
    if (!valid) throw broken("its landmarks are damaged");
    return { places, names, source: String(source) };
}

function checkedRoutes(
    routes: readonly RouteRule[] | undefined,
    broken: (why: string) => Error,
): readonly RouteRule[] {
    if (routes === undefined) return [];
    if (!isList(routes) || !routes.every(isRoute)) throw broken("its rules for routes are damaged");
    return routes;
}

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
