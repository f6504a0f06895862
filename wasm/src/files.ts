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
    /** What it was given as. */
    role: "layout" | "target" | "landmarks";
    /** The file's name; null for arrays, and for landmarks by proximity. */
    name: string | null;
    /** Of the file's bytes, in hexadecimal digits; null where there is no file or no hashing. */
    sha256: string | null;
}

/** `embedding.json`. Infinite and unknown numbers are null. */
export interface EmbeddingDocument {
    /** Of this format. */
    version: number;
    /** What made it. */
    solver: {
        /** The package. */
        name: string;
        /** Its version. */
        version: string;
    };
    /** As in EmbedResult, like what follows up to `cpuSeconds`. */
    status: string;
    /** In the path-graph metric. */
    cost: number | null;
    /** In the path-graph metric. */
    lowerBound: number | null;
    /** (cost - lowerBound) / cost. */
    gap: number | null;
    /** Which embeddings the bound is for. */
    boundScope: string;
    /** An integer in decimal digits. */
    exactCost: string | null;
    /** An integer in decimal digits. */
    exactLowerBound: string;
    /** By the clock. */
    seconds: number;
    /** In CPU time. */
    cpuSeconds: number;
    /** As in SolveOptions, like shape, seed and limits. */
    algorithm: string;
    /** How the paths run. */
    shape: string;
    /** As in SolveOptions. */
    boundaryEdges: string;
    /** A non-negative integer. */
    seed: number;
    /** What was asked for; null for no limit. */
    limits: {
        /** The gap at which the search may stop. */
        gap: number;
        /** Seconds. */
        timeLimit: number | null;
        /** Units of work. */
        workLimit: number | null;
        /** Bytes. */
        memoryLimit: number | null;
    };
    /** What paths cost, where that is not their length. */
    metric: {
        /** Per target vertex. */
        vertexCosts: number[] | null;
        /** From 0 to 0.95. */
        featureDiscount: number;
        /** Per layout edge. */
        edgeWeights: number[] | null;
    };
    /** What was asked of single paths. */
    constraints: PathConstraint[];
    /** Embeddings that were not to be found, as a path per layout edge each. */
    excluded: WeakPoint[][][];
    /** Layout, target and landmarks. */
    inputs: InputRecord[];
    /** What was repaired or deserves attention. */
    notes: string[];
    /** What the input may have meant instead. */
    doubts: LandmarkDoubt[];
    /** Target vertex per layout vertex. */
    landmarks: number[];
    /** As EmbedResult.edges. */
    edges: {
        /** The layout edge. */
        id: number;
        /** Its two layout vertices. */
        layoutEdge: [number, number];
        /** Vertices of refined.obj, 0-based. */
        chain: number[];
        /** In the path-graph metric. */
        cost: number;
        /** On the surface. */
        length: number;
        /** The length in the shape `even`. */
        evenLength: number;
        /** The path in the path graph. */
        weakPath: WeakPoint[];
    }[];
    /** The smallest angle of refined.obj's triangles, in degrees, and their smallest area. */
    quality: {
        /** In degrees. */
        smallestAngle: number;
        /** In the target's units, squared. */
        smallestArea: number;
    } | null;
    /** Per triangle of refined.obj: the layout face, null outside all of them. */
    patches: (number | null)[];
    /** Layout edges in the order in which they were embedded. */
    insertionOrder: number[];
    /** The same on every machine. */
    counters: EmbedCounters;
    /** As EmbedResult.events. */
    events: {
        /** What happened. */
        kind: string;
        /** What the job was at. */
        phase: string;
        /** Since the job began. */
        seconds: number;
        /** Units of work since the job began. */
        work: number;
        /** Null while there was no embedding. */
        cost: number | null;
        /** In the path-graph metric. */
        lowerBound: number | null;
    }[];
}

/** `refined_map.json`: where the refined mesh lies in the target. */
export interface RefinedMapDocument {
    /** Of this format. */
    version: number;
    /** The target's vertices, which keep their ids. */
    targetVertexCount: number;
    /** Per new vertex of refined.obj, from that id on: a target face and coordinates in it. */
    newVertices: {
        /** The target face. */
        face: number;
        /** 3 coordinates, in the order of the face's corners. */
        barycentric: number[];
    }[];
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
        boundaryEdges: options.boundaryEdges,
        seed: options.seed,
        limits: {
            gap: options.gap,
            timeLimit: finite(options.timeLimit),
            workLimit: finite(options.workLimit),
            memoryLimit: finite(options.memoryLimit),
        },
        metric: {
            vertexCosts: listOrNull(options.metric.vertexCosts),
            featureDiscount: options.metric.featureDiscount,
            edgeWeights: listOrNull(options.metric.edgeWeights),
        },
        constraints: [...options.constraints],
        excluded: options.excluded.map((embedding) =>
            embedding.map(({ weakPath }) => weakPath.map((point) => [...point] as WeakPoint)),
        ),
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

function listOrNull(values: Float64Array): number[] | null {
    return values.length > 0 ? Array.from(values) : null;
}

function finite(value: number): number | null {
    return Number.isFinite(value) ? value : null;
}

export function jsonBytes(document: unknown): Uint8Array {
    return new TextEncoder().encode(`${JSON.stringify(document)}\n`);
}
