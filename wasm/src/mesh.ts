// Meshes on their way into the core: files as bytes, or arrays whose shape is checked here.
import type { Core, Handle } from "./core.js";
import { javaScriptError, LayoutError } from "./errors.js";
import type { MeshArrays, MeshFile, MeshInput, Notes } from "./types.js";

/** A mesh inside the core, as it was read or repaired. */
export interface LoadedMesh {
    handle: Handle;
    /** What messages call it, for example "the target spot.obj". */
    subject: string;
    /** Per vertex of the input: its id now, -1 where removed; null without a repair. */
    vertexMap: Int32Array<ArrayBuffer> | null;
    notes: Notes;
}

// In the order of the core's MeshFormat (core/mesh/mesh_reader.hh).
const formats = ["detect", "obj", "off", "ply", "stl", "glb"];

/**
 * Reads a mesh, with what else its file says of vertices and faces where that is asked for, and
 * repairs it where asked to; validation comes later.
 */
export function readMesh(
    core: Core,
    role: "layout" | "target",
    input: MeshInput,
    { repair = false, attributes = false }: { repair?: boolean; attributes?: boolean },
): LoadedMesh {
    const subject = input.name === undefined ? `the ${role}` : `the ${role} ${input.name}`;
    const read =
        "bytes" in input
            ? readFile(core, subject, input, attributes)
            : readArrays(core, subject, input);
    if (!repair) {
        return { handle: read, subject, vertexMap: null, notes: notesOn(core, read, subject) };
    }
    try {
        const handle = core.call("boundary_mesh_repair", read, role === "target" ? 0 : 1);
        const notes = notesOn(core, handle, subject);
        core.call("boundary_mesh_vertex_map", handle);
        // kNone, all bits set, becomes -1.
        return { handle, subject, vertexMap: new Int32Array(core.viewedIds().buffer), notes };
    } finally {
        core.destroy(read);
    }
}

function notesOn(core: Core, mesh: Handle, subject: string): Notes {
    const notes: Notes = [];
    for (let i = 0; core.test("boundary_mesh_note", mesh, i); ++i) {
        notes.push(`${subject}: ${core.viewedText()}`);
    }
    return notes;
}

/** A mesh from the bytes of a file, exactly as it stands there. */
export function readFile(core: Core, subject: string, input: MeshFile, attributes = false): Handle {
    const bytes = byteArray(input.bytes, subject);
    const format = formats.indexOf(input.format ?? "detect");
    if (format < 0) {
        throw new LayoutError(
            "invalidOption",
            `the format ${String(input.format)} of ${subject} is unknown; give obj, off, ply, stl or glb.`,
        );
    }
    return core.withCopies((copy) => {
        const name = new TextEncoder().encode(input.name ?? "");
        const subjectText = new TextEncoder().encode(subject);
        return core.call(
            "boundary_mesh_read",
            copy(bytes),
            bytes.length,
            format,
            copy(name),
            name.length,
            copy(subjectText),
            subjectText.length,
            attributes ? 1 : 0,
        );
    });
}

function readArrays(core: Core, subject: string, input: MeshArrays): Handle {
    const wrong = (what: string) => javaScriptError("invalidInput", `${subject}: ${what}`);
    if (!isList(input.positions) || !isList(input.corners)) {
        throw wrong("a mesh needs bytes, or positions and corners");
    }
    if (input.positions.length % 3 !== 0) {
        throw wrong(`${String(input.positions.length)} coordinates are not 3 per vertex`);
    }
    const positions = Float64Array.from(input.positions);
    const corners = idArray(input.corners, (place, value) =>
        wrong(`corner ${String(place)} is ${String(value)}, which is no vertex id`),
    );
    const offsets = offsetArray(input.offsets, corners.length, wrong);
    return core.withCopies((copy) =>
        core.call(
            "boundary_mesh_from_arrays",
            copy(positions),
            positions.length / 3,
            copy(corners),
            corners.length,
            copy(offsets),
            offsets.length,
        ),
    );
}

function offsetArray(
    given: ArrayLike<number> | undefined,
    cornerCount: number,
    wrong: (what: string) => LayoutError,
): Uint32Array {
    if (given === undefined) {
        if (cornerCount % 3 !== 0) {
            throw wrong(`${String(cornerCount)} corners are not 3 per triangle`);
        }
        return Uint32Array.from({ length: cornerCount / 3 + 1 }, (_, face) => 3 * face);
    }
    const offsets = idArray(given, (place, value) =>
        wrong(`offset ${String(place)} is ${String(value)}, which is no place among the corners`),
    );
    const rises = offsets.every(
        (offset, place) => place === 0 || offset >= (offsets[place - 1] ?? 0),
    );
    if (offsets[0] !== 0 || offsets.at(-1) !== cornerCount || !rises) {
        throw wrong("the offsets don't rise from 0 to the number of corners");
    }
    return offsets;
}

function isList(value: unknown): value is ArrayLike<number> {
    return typeof value === "object" && value !== null && "length" in value;
}

/** 6 numbers per triangle; null where some corner has none, or they were not read. */
export function textureCoordinatesOf(core: Core, mesh: Handle): Float64Array<ArrayBuffer> | null {
    core.call("boundary_mesh_texture_coordinates", mesh);
    const coordinates = core.viewedDoubles();
    return coordinates.length > 0 ? coordinates : null;
}

/** Copies of a mesh's arrays. */
export function arraysOf(core: Core, mesh: Handle) {
    core.call("boundary_mesh_positions", mesh);
    const positions = core.viewedDoubles(3);
    core.call("boundary_mesh_corners", mesh);
    const corners = core.viewedIds();
    core.call("boundary_mesh_offsets", mesh);
    return { positions, corners, offsets: core.viewedIds() };
}

/** The numbers as 32-bit ids; `refuse` makes the error for one that isn't. */
export function idArray(
    values: ArrayLike<number>,
    refuse: (place: number, value: number) => LayoutError,
): Uint32Array<ArrayBuffer> {
    const ids = Uint32Array.from(values);
    for (let i = 0; i < ids.length; ++i) {
        if (ids[i] !== values[i]) {
            throw refuse(i, values[i] ?? NaN);
        }
    }
    return ids;
}

/** The bytes of a file given as either kind of buffer. */
export function byteArray(
    bytes: Uint8Array | ArrayBuffer,
    subject: string,
): Uint8Array<ArrayBuffer> {
    if (bytes instanceof Uint8Array) {
        return bytes as Uint8Array<ArrayBuffer>;
    }
    if (bytes instanceof ArrayBuffer) {
        return new Uint8Array(bytes);
    }
    throw javaScriptError(
        "invalidInput",
        `${subject}: bytes are neither Uint8Array nor ArrayBuffer`,
    );
}
