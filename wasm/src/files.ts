// The two JSON files of an embedding: what is in them, writing them. README.md describes them for
// users; src/cli/read_embedding.ts reads them back.
import type { JobOptions } from "./job.js";
import type {
    EmbedCounters,
    EmbedResult,
    ExportedFiles,
    LandmarkDoubt,
    PathConstraint,
    RefinedMesh,
    WeakPoint,
} from "./types.js";

/** The version of the file formats; it changes when old readers could misread them. */
export const fileVersion = 1;

/** An input as it was given. */
export interface InputRecord {
    role: "layout" | "target" | "landmarks";
    /** The file's name; null for arrays, and for landmarks by proximity. */
    name: string | null;
    /** Of the file's bytes, in hexadecimal digits; null where there is no file or no hashing. */
    sha256: string | null;
}

/** `embedding.json`. Infinite and unknown numbers are null. */
export interface EmbeddingDocument {
    version: number;
    solver: { name: string; version: string };
    status: string;
    cost: number | null;
    lowerBound: number | null;
    gap: number | null;
    boundScope: string;
    exactCost: string | null;
    exactLowerBound: string;
    seconds: number;
    cpuSeconds: number;
    algorithm: string;
    shape: string;
    seed: number;
    limits: {
        gap: number;
        timeLimit: number | null;
        workLimit: number | null;
        memoryLimit: number | null;
    };
    /** What paths cost, where that is not their length. */
    metric: { vertexCosts: number[] | null; featureDiscount: number };
    /** What was asked of single paths. */
    constraints: PathConstraint[];
    inputs: InputRecord[];
    /** What was repaired or deserves attention. */
    notes: string[];
    /** What the input may have meant instead. */
    doubts: LandmarkDoubt[];
    /** Target vertex per layout vertex. */
    landmarks: number[];
    edges: {
        id: number;
        layoutEdge: [number, number];
        /** Vertices of refined.obj, 0-based. */
        chain: number[];
        cost: number;
        length: number;
        evenLength: number;
        weakPath: WeakPoint[];
    }[];
    /** The smallest angle of refined.obj's triangles, in degrees, and their smallest area. */
    quality: { smallestAngle: number; smallestArea: number } | null;
    /** Per triangle of refined.obj: the layout face, null outside all of them. */
    patches: (number | null)[];
    insertionOrder: number[];
    counters: EmbedCounters;
    events: {
        kind: string;
        phase: string;
        seconds: number;
        work: number;
        cost: number | null;
        lowerBound: number | null;
    }[];
}

/** `refined_map.json`: where the refined mesh lies in the target. */
export interface RefinedMapDocument {
    version: number;
    /** The target's vertices, which keep their ids. */
    targetVertexCount: number;
    /** Per new vertex of refined.obj, from that id on: a target face and coordinates in it. */
    newVertices: { face: number; barycentric: number[] }[];
    /** Per triangle of refined.obj: its target face. */
    triangleFaces: number[];
}

export interface Exportable {
    result: EmbedResult;
    options: JobOptions;
    inputs: InputRecord[];
    notes: string[];
    /** The solver's. */
    version: string;
}

/** The JSON files' bytes. */
export function exportedFiles(exportable: Exportable): Omit<ExportedFiles, "refined.obj"> {
    const { refined } = exportable.result;
    const map = refined === null ? null : refinedMapDocument(refined);
    return {
        "refined_map.json": jsonBytes(map),
        "embedding.json": jsonBytes(embeddingDocument(exportable)),
    };
}

export function embeddingDocument(exportable: Exportable): EmbeddingDocument {
    const { result, options } = exportable;
    return {
        version: fileVersion,
        solver: { name: "layout-embedding", version: exportable.version },
        status: result.status,
        cost: finite(result.cost),
        lowerBound: finite(result.lowerBound),
        gap: finite(result.gap),
        boundScope: result.boundScope,
        exactCost: result.exactCost?.toString() ?? null,
        exactLowerBound: result.exactLowerBound.toString(),
        seconds: result.seconds,
        cpuSeconds: result.cpuSeconds,
        algorithm: options.algorithm,
        shape: options.shape,
        seed: options.seed,
        limits: {
            gap: options.gap,
            timeLimit: finite(options.timeLimit),
            workLimit: finite(options.workLimit),
            memoryLimit: finite(options.memoryLimit),
        },
        metric: {
            vertexCosts:
                options.metric.vertexCosts.length > 0
                    ? Array.from(options.metric.vertexCosts)
                    : null,
            featureDiscount: options.metric.featureDiscount,
        },
        constraints: [...options.constraints],
        inputs: exportable.inputs,
        notes: exportable.notes,
        doubts: result.doubts,
        landmarks: Array.from(result.landmarks),
        edges: result.edges.map((edge) => ({ ...edge, chain: Array.from(edge.chain) })),
        quality: result.quality,
        patches: Array.from(result.refined?.patches ?? [], (patch) => (patch < 0 ? null : patch)),
        insertionOrder: Array.from(result.insertionOrder),
        counters: result.counters,
        events: result.events.map((event) => ({
            kind: event.kind,
            phase: event.phase,
            seconds: event.seconds,
            work: event.work,
            cost: finite(event.cost),
            lowerBound: finite(event.lowerBound),
        })),
    };
}

function refinedMapDocument(refined: RefinedMesh): RefinedMapDocument {
    const newCount = refined.vertexFaces.length;
    return {
        version: fileVersion,
        targetVertexCount: refined.positions.length / 3 - newCount,
        newVertices: Array.from(refined.vertexFaces, (face, i) => ({
            face,
            barycentric: Array.from(refined.vertexBarycentrics.subarray(3 * i, 3 * i + 3)),
        })),
        triangleFaces: Array.from(refined.triangleFaces),
    };
}

function finite(value: number): number | null {
    return Number.isFinite(value) ? value : null;
}

export function jsonBytes(document: unknown): Uint8Array {
    return new TextEncoder().encode(`${JSON.stringify(document)}\n`);
}
