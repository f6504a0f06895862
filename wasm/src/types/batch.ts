// One layout in many targets.
import type { CallOptions, LandmarkInput, LoadOptions, MeshInput } from "./input.js";
import type { SurfaceMap, SurfaceMapOptions } from "./maps.js";
import type { QuadMesh, QuadOptions } from "./quads.js";
import type { EmbedResult, ExportedFiles } from "./results.js";
import type { EmbedStatus, SolveOptions } from "./solve.js";

/** A target of a batch. */
export interface BatchMember {
    /** Different from all others. */
    name: string;
    /** Called when it is its turn; may reject. */
    load: () => Promise<{
        /** A triangle mesh. */
        target: MeshInput;
        /** As for setLandmarks(). */
        landmarks: LandmarkInput;
    }>;
}

/** What a batch makes, and how. */
export interface BatchOptions extends Omit<LoadOptions, "signal"> {
    /** For all members. */
    solve?: Omit<SolveOptions, "signal" | "onProgress">;
    /** Numbers of segments follow from the reference. */
    quads?: Omit<QuadOptions, "segments" | "segmentsAs" | keyof CallOptions>;
    /** For the maps from the reference. */
    map?: Omit<SurfaceMapOptions, keyof CallOptions>;
    /**
     * The member that all others are mapped from. Default: the first one that is embedded. While
     * there is none, members are embedded and get quads of their own.
     */
    reference?: string | null;
    /** Ends the batch; the member at work gets no row. */
    signal?: AbortSignal;
    /** The row of a member that was done before, or null; it is not done again. */
    known?: (name: string) => BatchRow | null;
    /** Called after each member; products are null where it failed. */
    onMember?: (row: BatchRow, products: BatchProducts | null) => void | Promise<void>;
}

/** What is known of a member, as far as it came; energies etc. as in MapDistortion. */
export interface BatchRow {
    /** The member's. */
    name: string;
    /** Whether all others are mapped from this one. */
    isReference: boolean;
    /** What went wrong, as in LayoutError; null if nothing did. */
    error: {
        /** Stable, camelCase. */
        code: string;
        /** One sentence. */
        message: string;
    } | null;
    /** Of the target. */
    vertexCount?: number;
    /** Why the search ended. */
    status?: EmbedStatus;
    /** In the path-graph metric. */
    cost?: number;
    /** In the path-graph metric. */
    lowerBound?: number;
    /** As in EmbedResult. */
    gap?: number;
    /** Of all chains, on the surface. */
    length?: number;
    /** CPU seconds of the embedding. */
    seconds?: number;
    /** How many there are. */
    quads?: number;
    /** As in QuadMesh.statistics, like the next two. */
    flippedQuads?: number;
    /** The least of all quads. */
    leastJacobian?: number;
    /** The mean of all quads. */
    meanJacobian?: number;
    /** Before and after optimisation. */
    firstEnergy?: number;
    /** The mean energy after optimisation. */
    energy?: number;
    /** As MapDistortion.meanConformal. */
    conformal?: number;
    /** As MapDistortion.meanArea. */
    area?: number;
}

/** What was made of a member; no map for the reference. */
export interface BatchProducts {
    /** The embedding. */
    result: EmbedResult;
    /** What exportFiles() gives. */
    files: ExportedFiles;
    /** With the connectivity that all members have. */
    quads: QuadMesh;
    /** From the reference. */
    map: SurfaceMap | null;
}
