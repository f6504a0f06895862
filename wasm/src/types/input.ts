// What goes in: meshes, landmarks, templates, and what is told of them.

/** A mesh as typed arrays; they are copied, never kept. */
export interface MeshArrays {
    /** 3 coordinates per vertex. */
    positions: ArrayLike<number>;
    /** Vertex ids, counter-clockwise around each face. */
    corners: ArrayLike<number>;
    /**
     * One more number than there are faces: face f has the corners from `offsets[f]` up to, not
     * including, `offsets[f + 1]`. Left out, every face is a triangle.
     */
    offsets?: ArrayLike<number>;
    /** What messages call the mesh. */
    name?: string;
}

/** A mesh as the content of a file. */
export interface MeshFile {
    /** The content; it is copied, never kept. */
    bytes: Uint8Array | ArrayBuffer;
    /** The file's name: what messages call the mesh, and its ending gives the format. */
    name?: string;
    /** The format, where the name doesn't tell. Left out, it is guessed from name and content. */
    format?: MeshFormat;
}

/** A format of mesh files. */
export type MeshFormat = "obj" | "off" | "ply" | "stl" | "glb";

/** A layout or a target, as a file or as arrays. */
export type MeshInput = MeshArrays | MeshFile;

/**
 * The content of a landmark file: one target vertex id per line, `id x y z` per line (.vts), JSON
 * with names, picked points of MeshLab (.pp) or markups of 3D Slicer (.mrk.json). Points without an
 * id go to the nearest vertices of the target.
 */
export interface LandmarkFile {
    /** The content. */
    bytes: Uint8Array | ArrayBuffer;
    /** What messages call the file. */
    name?: string;
}

/** One target vertex id per layout vertex, in the order of the layout's vertices. */
export type LandmarkInput = ArrayLike<number> | LandmarkFile;

/** How a long call is ended and followed. */
export interface CallOptions {
    /**
     * Ends the call: within 100 ms in a worker, whatever it is at. It rejects with `cancelled` (a
     * CancelledError, whose `late` is what there is to come) unless it has a result by then.
     */
    signal?: AbortSignal;
    /** Called between slices of work with the share that is done, in [0, 1]. */
    onProgress?: (progress: number) => void;
}

/** How a mesh is read. An aborted load changes nothing. */
export interface LoadOptions extends Pick<CallOptions, "signal"> {
    /**
     * Mends what can be mended safely: exactly coincident vertices are welded, unused vertices and
     * degenerate or duplicate faces removed; `notes` says what was done. Off by default.
     */
    repair?: boolean;
}

/** How a target is read. */
export interface TargetLoadOptions extends LoadOptions {
    /**
     * Whether texture coordinates are looked for in the file (TargetInfo.textureCoordinates). Off by
     * default.
     */
    textureCoordinates?: boolean;
    /**
     * Whether exports of embeddings are to have what an OBJ, OFF, PLY or GLB file says besides places,
     * also where a repair changed the mesh: texture coordinates, vertex colours, groups (behind
     * those of the patches) and names of materials. Off by default.
     */
    attributes?: boolean;
}

/** What was done to an input, or what deserves attention; one sentence each. */
export type Notes = string[];

/** A mesh as it stands in its file, or as a repair left it; nothing is confirmed of it. */
export interface UncheckedMesh {
    /** 3 coordinates per vertex. */
    positions: Float64Array;
    /** Vertex ids per face, and where each face begins (as in MeshArrays). */
    corners: Uint32Array;
    /** One more number than there are faces. */
    offsets: Uint32Array;
}

/** A layout as it was read (and repaired). */
export interface LayoutInfo {
    /** The file's name, or the one given. */
    name: string;
    /** After a repair; so are all counts. */
    vertexCount: number;
    /** Each edge counts once, whatever its faces. */
    edgeCount: number;
    /** Polygons of any number of sides. */
    faceCount: number;
    /** V - E + F. */
    eulerCharacteristic: number;
    /** 0 for a closed surface. */
    boundaryLoopCount: number;
    /** 3 coordinates per vertex. */
    positions: Float64Array;
    /** Vertex ids per face, and where each face begins (as in MeshArrays). */
    corners: Uint32Array;
    /** One more number than there are faces. */
    offsets: Uint32Array;
    /** Two vertex ids per edge; results list edges in this order and direction. */
    edges: Uint32Array;
    /** Per vertex of the input: its id here, -1 where it was removed; null without a repair. */
    vertexMap: Int32Array | null;
    /** What was repaired, or deserves attention. */
    notes: Notes;
}

/** A target as it was read (and repaired). */
export interface TargetInfo {
    /** The file's name, or the one given. */
    name: string;
    /** After a repair; so are all counts. */
    vertexCount: number;
    /** Each edge counts once, whatever its faces. */
    edgeCount: number;
    /** Triangles. */
    faceCount: number;
    /** V - E + F. */
    eulerCharacteristic: number;
    /** 0 for a closed surface. */
    boundaryLoopCount: number;
    /** 3 coordinates per vertex. */
    positions: Float64Array;
    /** 3 vertex ids per triangle, counter-clockwise. */
    corners: Uint32Array;
    /**
     * 6 numbers per triangle, two for each corner, v upwards, for mapFiles(); null where they were
     * not asked for, and where the file does not have some at every corner.
     */
    textureCoordinates: Float64Array | null;
    /** Per vertex of the input: its id here, -1 where it was removed; null without a repair. */
    vertexMap: Int32Array | null;
    /** What was repaired, or deserves attention. */
    notes: Notes;
}

/** How landmarks are understood. */
export interface LandmarkOptions {
    /**
     * Whose ids the landmarks are, which matters after a repair: those of the target as it was
     * given (the default), or as it was loaded (TargetInfo.positions).
     */
    numbering?: "given" | "loaded";
}

/** Landmarks as a session holds them. */
export interface LandmarksInfo {
    /** Target vertex id (after a repair) per layout vertex. */
    landmarks: Uint32Array;
    /** Their names, "" for none; empty where the input has no names. */
    names: string[];
    /** What deserves attention, for example how far points were from their vertices. */
    notes: Notes;
}

/** How a layout is made of a target. */
export interface TemplateOptions extends LandmarkOptions, Pick<CallOptions, "signal"> {
    /** Merges pairs of triangles into well-shaped quads. Default: triangles only. */
    quads?: boolean;
}

/** A layout made of a target: its vertex i is landmark i. Goes into loadLayout() as it is. */
export interface TemplateLayout {
    /** 3 coordinates per vertex. */
    positions: Float64Array;
    /** Vertex ids per face, and where each face begins (as in MeshArrays). */
    corners: Uint32Array;
    /** One more number than there are faces. */
    offsets: Uint32Array;
    /** The same as the content of an OBJ file. */
    obj: Uint8Array;
    /** Target vertex id (after a repair) per layout vertex. */
    landmarks: Uint32Array;
    /**
     * How the target's other vertices were removed: by collapses, after edge flips, and with no
     * regard to the shape of faces, since nothing else was left. Many of the last kind mean that
     * the landmarks hardly describe the shape.
     */
    removed: {
        /** Vertices removed by collapses. */
        collapses: number;
        /** Vertices removed after edge flips. */
        afterFlips: number;
        /** Vertices removed with no regard to the shape of faces. */
        inAnyShape: number;
    };
    /**
     * Edges flipped afterwards: other paths would have forced theirs away from the shortest one,
     * and the other diagonal is shorter.
     */
    flips: number;
    /** What deserves attention in target or landmarks. */
    notes: Notes;
}

/** An `.inp` file of the paper's reference implementation. */
export interface ReferenceInput {
    /** The files of layout and target, relative to this one. */
    layoutFile: string;
    /** The file of the target, relative to this one. */
    targetFile: string;
    /** The target vertex of each layout vertex; throws landmarkCount where they don't fit. */
    landmarks: (vertexCount: number) => Uint32Array;
}
