// A session as one zip file: layout and target as they were given, and session.json for the rest.
import { strFromU8, strToU8, Unzip, UnzipInflate, unzipSync } from "fflate";
import type { MeshArrays, MeshFile } from "layout-embedding";
import {
    checkedRest,
    partsReader,
    type SavedMeshes,
    type SavedRest,
    type SavedWork,
} from "./saved_work.js";
import type { SavedSecond, Source } from "./sources.js";

const version = 1;
const description = "session.json";

/** A file in the zip, and the name it came with. */
interface Entry {
    readonly name: string;
    readonly file: string;
}

/** Where the meshes lie in the zip. */
type Entries = {
    readonly [Role in "layout" | "target"]: Entry | null;
} & {
    /** Left out in sessions of earlier versions of the page, like parts of SavedRest. */
    readonly second?: { readonly shape: string } | { readonly files: readonly Entry[] } | null;
};

type SessionDocument = { readonly version: number } & Entries & SavedRest;

/** The files of a session, by name. */
export async function packSession({
    layout,
    target,
    second,
    ...rest
}: SavedWork): Promise<Record<string, Uint8Array>> {
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
        if (!second || "shape" in second) return second;
        const packed = [];
        for (const [place, file] of second.files.entries()) {
            const entry = await pack(place === 0 ? "second" : "second_landmarks", file);
            if (entry) packed.push(entry);
        }
        return { files: packed };
    };
    const document: SessionDocument = {
        version,
        layout: await pack("layout", layout),
        target: await pack("target", target),
        second: await packSecond(),
        ...rest,
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
    const part = partsReader(lost);
    const unpack = (role: "layout" | "target"): MeshFile | null =>
        part(`the ${role}`, null, () => {
            const entry = document[role];
            if (!entry) return null;
            const content = contentOf(files, entry.file);
            return { name: String(entry.name), bytes: content, ...formatOf(entry) };
        });
    const meshes: SavedMeshes = {
        target: unpack("target"),
        layout: unpack("layout"),
        second: part("the second target", null, () => secondIn(document.second, files)),
    };
    const { target, layout } = meshes;
    if (!target && !layout) throw broken("there is no mesh in it that could be read");
    const rest = checkedRest(document, part);
    const { landmarks, making, origin, solved } = rest;
    const work: SavedWork = {
        ...meshes,
        ...rest,
        // Ids mean nothing without their mesh.
        landmarks: target ? landmarks : null,
        // Landmarks without their layout can still have one made of them.
        making: making || (!layout && landmarks !== null),
        origin: lost.length === 0 ? origin : null,
        solved: solved && layout !== null && target !== null,
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
    second: Entries["second"],
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
