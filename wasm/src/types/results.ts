// What comes out: embeddings, what is told of them, and claims of some.
import type {
    BoundScope,
    EmbedCounters,
    EmbedEvent,
    EmbedStatus,
    Polylines,
    WeakPoint,
} from "./solve.js";

/** A layout edge on the target. */
export interface EmbeddedEdge {
    /** The layout edge, as in LayoutInfo.edges. */
    id: number;
    /** Its two layout vertices: start and end of the chain. */
    layoutEdge: [number, number];
    /** Vertex ids of the refined mesh, from landmark to landmark. */
    chain: Uint32Array;
    /** Its share of the embedding's cost, in the path-graph metric. */
    cost: number;
    /** The chain's length on the surface. */
    length: number;
    /** What `length` is in the shape `even`. */
    evenLength: number;
    /** The path in the path graph, whose length counts in `cost`. */
    weakPath: WeakPoint[];
}

/**
 * The target, subdivided so that every layout edge is a chain of mesh edges and every layout face
 * a patch of triangles. The target's vertices keep their ids, new ones follow.
 */
export interface RefinedMesh {
    /** 3 coordinates per vertex. */
    positions: Float64Array;
    /** 3 vertex ids per triangle, counter-clockwise. */
    corners: Uint32Array;
    /** Per triangle: the layout face, -1 outside all of them (a layout with boundary). */
    patches: Int32Array;
    /** Per triangle: the target face it lies in. */
    triangleFaces: Uint32Array;
    /** Per new vertex: a target face that holds it ... */
    vertexFaces: Uint32Array;
    /** ... and its 3 barycentric coordinates there, in the order of the face's corners. */
    vertexBarycentrics: Float64Array;
}

/**
 * A small change of the input that makes the embedding far shorter (three quarters of the cost or
 * less), or possible at all: most likely the input is not what was meant.
 */
export interface LandmarkDoubt {
    /**
     * `mirrored`: the mirror image of the layout fits, so layout or target are inside out.
     * `exchanged`: two layout vertices fit with their landmarks exchanged.
     */
    kind: "mirrored" | "exchanged";
    /** The two layout vertices; null for `mirrored`. */
    vertices: [number, number] | null;
    /** The cost of an embedding after the change. */
    cost: number;
    /** One sentence that says so. */
    message: string;
}

/** What a job has found when it ends, with an embedding or without. */
export interface EmbedResult {
    /** Why the job ended. */
    status: EmbedStatus;
    /** In the path-graph metric (see the README); Infinity without an embedding. */
    cost: number;
    /** Of the costs of all embeddings in `boundScope`. */
    lowerBound: number;
    /** (cost - lowerBound) / cost; 1 without an embedding. */
    gap: number;
    /** Which embeddings `lowerBound` bounds. */
    boundScope: BoundScope;
    /** The cost as the solver adds it up, an integer; null without an embedding. */
    exactCost: bigint | null;
    /** The lower bound in the same integers. */
    exactLowerBound: bigint;
    /** One per layout edge, in the layout's order; empty without an embedding. */
    edges: EmbeddedEdge[];
    /** Null without an embedding. */
    refined: RefinedMesh | null;
    /** The smallest angle of the refined triangles, in degrees, and their smallest area. */
    quality: {
        /** In degrees. */
        smallestAngle: number;
        /** In the target's units, squared. */
        smallestArea: number;
    } | null;
    /** Target vertex id per layout vertex. */
    landmarks: Uint32Array;
    /** Layout edges in the order in which they were embedded. */
    insertionOrder: Uint32Array;
    /** All that happened, oldest first. */
    events: EmbedEvent[];
    /** The same on every machine, but for a time limit. */
    counters: EmbedCounters;
    /**
     * What the input may have meant instead, at most one doubt. Not looked for after a heuristic,
     * an aborted solve, or the time limit, and where `doubts` is false.
     */
    doubts: LandmarkDoubt[];
    /** From beginning to end, by the clock. */
    seconds: number;
    /** The same in CPU time. */
    cpuSeconds: number;
    /** One sentence where the status does not say it all: what did not fit into memory. */
    message: string | null;
}

/** The files of a finished embedding; their formats are described in the README. */
export interface ExportedFiles {
    /** The refined mesh: patches as groups, edges as lines. */
    "refined.obj": Uint8Array;
    /** Where its vertices and triangles lie in the target (RefinedMapDocument). */
    "refined_map.json": Uint8Array;
    /** All else that is known of the embedding (EmbeddingDocument). */
    "embedding.json": Uint8Array;
}

/**
 * What an embedding can be exported as: OBJ, PLY, VTP (VTK), GLB, a picture as SVG, or the files of
 * the paper's reference implementation (.inp, .lem and three meshes).
 */
export type ExportFormat = "obj" | "ply" | "vtp" | "glb" | "svg" | "lem";

/** From where a picture is taken, without perspective. */
export interface ExportView {
    /** From the surface towards the eye. Default: z. */
    direction?: readonly [number, number, number];
    /** What is up in the picture. Default: y. */
    up?: readonly [number, number, number];
    /** In pixels. Default: 800. */
    width?: number;
}

/**
 * The path that each layout edge would take if it were alone, and what keeps these candidate paths
 * from being embedded together. No embedding is shorter than all of them together, and without a
 * conflict they are one.
 */
export interface CandidatePaths {
    /** One per layout edge that has a path past the other landmarks. */
    paths: Polylines;
    /** Per layout edge: the length in the path-graph metric, Infinity without a path. */
    lengths: Float64Array;
    /** Two layout edges each whose candidates cross (or leave a landmark on the rim out of order). */
    pairs: Uint32Array;
    /** Three layout edges each whose candidates leave a common landmark in the wrong cyclic order. */
    triples: Uint32Array;
}

/** The paths of an embedding that follows a dragged landmark: an embedding, but not a proved one. */
export interface DraggedPaths {
    /** In the path-graph metric. */
    cost: number;
    /** One per layout edge, pulled straight for the eye. */
    paths: Polylines;
}

/** How good the paths and patches of an embedding are, in the target's units. */
export interface QualityReport {
    /** Per layout edge. */
    edges: {
        /** The layout edge, as in LayoutInfo.edges. */
        id: number;
        /** In the path-graph metric. */
        cost: number;
        /** The length of the chain on the surface in the shape `even`, before smoothing. */
        evenLength: number;
        /** The length of the chain on the surface as it is. */
        length: number;
        /**
         * How far it is from straight, in degrees: over its inner vertices, the sum of what the
         * smaller of the two angles between it and itself lacks to 180 degrees; 0 for a locally
         * shortest path.
         */
        turning: number;
    }[];
    /** Per layout face. */
    patches: {
        /** The layout face. */
        face: number;
        /** In the target's units, squared. */
        area: number;
        /** In the target's units. */
        perimeter: number;
        /** 4 pi area / perimeter squared: 1 for a flat disk, near 0 for a thin patch. */
        isoperimetricQuotient: number;
        /**
         * Root mean square stretch of the patch's map onto a rectangle (four sides) or a regular
         * polygon: 1 for an isometry, else larger; null where there is no such map in double
         * precision.
         */
        stretch: number | null;
    }[];
    /** Sums over edges and patches, and the worst of the patches. */
    overall: {
        /** The sum over all edges. */
        cost: number;
        /** The sum over all edges. */
        evenLength: number;
        /** The sum over all edges. */
        length: number;
        /** The sum over all edges, in degrees. */
        turning: number;
        /** The sum over all patches. */
        area: number;
        /** The least isoperimetric quotient. */
        leastQuotient: number;
        /** The mean isoperimetric quotient. */
        meanQuotient: number;
        /** Null if that of a patch is. */
        largestStretch: number | null;
    };
}

/** A claimed embedding, to be checked against the session's layout, target and landmarks. */
export interface EmbeddingClaim {
    /** As in EmbedResult. */
    refined: RefinedMesh;
    /** Each layout edge once, in any order. */
    edges: {
        /** Its two layout vertices. */
        layoutEdge: [number, number];
        /** Vertex ids of the refined mesh, from landmark to landmark. */
        chain: ArrayLike<number>;
        /** As in EmbeddedEdge; both are to be homotopic. */
        weakPath: WeakPoint[];
    }[];
}

/** A reason to refuse an embedding. */
export interface Violation {
    /** A stable camelCase name. */
    code: string;
    /** One sentence with the ids concerned. */
    message: string;
}
