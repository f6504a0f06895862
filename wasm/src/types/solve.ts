// How an embedding is looked for, and how that goes.

/**
 * How the search goes. Four heuristics insert the layout edges one by one and differ in the order:
 * the shortest path first (greedy), or after [PSS01] (praun), [KSG03, KS04] (kraevoy) and [SAPH04]
 * (schreiner). Branch and bound looks for the best of all orders, and proves how good it is among
 * them. The exact method looks for the best embedding of all, and proves how good it is among all.
 */
export type Algorithm = "greedy" | "praun" | "kraevoy" | "schreiner" | "branch-and-bound" | "exact";

/**
 * How paths run within their homotopy classes. `even`: crossing the target's edges at even distances,
 * which looks jagged; `short`: as straight as neighbouring paths allow; `fair`: short, then traced anew
 * between the patches beside them where that makes thin patches rounder.
 */
export type PathShape = "even" | "short" | "fair";

/** Why a job ended. */
export type EmbedStatus =
    /** The gap is 0 in the stated scope. */
    | "optimal"
    /** The gap is at most the one asked for. */
    | "gapReached"
    /** The algorithm came to its end with an embedding, without proving the gap asked for. */
    | "feasible"
    | "timeLimit"
    | "workLimit"
    | "memoryLimit"
    | "cancelled"
    /** Proved: there is no embedding. */
    | "infeasible"
    /** The algorithm came to its end without an embedding. */
    | "noneFound";

/** What a lower bound bounds: every embedding, or only those made by inserting path after path. */
export type BoundScope = "embeddings" | "insertionSequences";

/** What a job does, in this order. */
export type EmbedPhase = "prepare" | "search" | "realise" | "check" | "done";

/**
 * What is asked of the path of one layout edge, on the target punctured at its landmarks and holes:
 * that it be homotopic to a path (`keep`), or not (`avoid`).
 */
export interface PathConstraint {
    /** Whether the path has to be homotopic to `path`, or must not be. */
    rule: "keep" | "avoid";
    /** The layout edge, as in LayoutInfo.edges. */
    edge: number;
    /**
     * As in EmbeddedEdge: as a rule of an earlier embedding with the same target and landmarks. Only
     * its homotopy class counts, not its length.
     */
    path: readonly WeakPoint[];
}

/**
 * An embedding by the path of every layout edge, in the order of LayoutInfo.edges: the edges of an
 * earlier result are one.
 */
export type EmbeddingPaths = readonly {
    /** As in EmbeddedEdge. Only its homotopy class counts. */
    weakPath: readonly WeakPoint[];
}[];

/**
 * What a unit of length costs, by which paths are kept away from places or drawn to them. Bounds and
 * proofs hold in it as for plain length. In every shape, a path that runs along a sharp edge in the
 * embedding stays on it (of several along the same edge only one, the others run beside it). Vertex
 * costs decide on the routes alone: `short` and `fair` shorten paths on the surface within them, so
 * that they come nearer to places where length is dear; `even` leaves them where they are.
 */
export interface PathMetric {
    /** Per target vertex, from 0.001 to 1000, linear in between. Default: 1 everywhere. */
    vertexCosts?: ArrayLike<number>;
    /**
     * How much less it costs to go along sharp edges of the target, from 0 to 0.95: all of it where
     * faces meet at 60 degrees from flat, nothing up to 20 degrees. Default 0.
     */
    featureDiscount?: number;
    /**
     * Per layout edge, in the order of LayoutInfo.edges, how much the length of its path counts,
     * from 0.001 to 1000; rounded to 1024ths of the largest. Where paths are in each other's way,
     * those that count more go straight. Default: 1 for all.
     */
    edgeWeights?: ArrayLike<number>;
}

/**
 * Whether layout boundary edges with both landmarks on the target's boundary run where they are
 * shortest, or along the boundary from one to the other.
 */
export type BoundaryEdges = "free" | "follow";

/** How the embedding is looked for, until when, and how that is told. */
export interface SolveOptions {
    /** Default: exact. */
    algorithm?: Algorithm;
    /** The gap to be reached, (cost - lowerBound) / cost; 0 asks for the optimum. Default 0.01. */
    gap?: number;
    /** Default: short. */
    shape?: PathShape;
    /**
     * Default: free. `follow` is for the exact method alone; costs and bounds are those of the
     * embeddings with these paths, all others being as short as they can. Where another landmark
     * lies between the two, that is refused with `invalidOption`.
     */
    boundaryEdges?: BoundaryEdges;
    /** Seconds for the search; results then depend on the machine. Default: no limit. */
    timeLimit?: number;
    /**
     * Units of work for the search, each about the expansion of a node; reproducible. Default: none
     * for the heuristics; the others stop 15 million units after their first embedding, a few
     * seconds. Infinity counts as not given.
     */
    workLimit?: number;
    /** Bytes the job may take, estimated before it starts. Default: what WebAssembly can address. */
    memoryLimit?: number;
    /** A non-negative integer; the same seed gives the same result on every machine. Default 1. */
    seed?: number;
    /** What paths cost besides their length; costs, bounds and the gap are in this metric. */
    metric?: PathMetric;
    /**
     * What is asked of single paths, for the exact method alone: costs and bounds are those of the
     * embeddings that comply, and all other paths follow. Another route for an edge is
     * `{ rule: "avoid", edge: e.id, path: e.weakPath }`, where e is one of the edges of a result.
     */
    constraints?: readonly PathConstraint[];
    /**
     * Embeddings that are not to be found again, for the exact method alone: bounds are those of all
     * others, which differ from each of these in the homotopy class of at least one path. With the
     * best ones here, the next best is found: `excluded: [first.edges, second.edges]`.
     */
    excluded?: readonly EmbeddingPaths[];
    /**
     * An embedding that is taken as it is, as a rule the edges of an earlier result for the same
     * target and landmarks: nothing is searched or proved, and the gap is 1. Where its paths cannot
     * be embedded together the status is `noneFound`. Not beside `constraints` and `excluded`.
     */
    given?: EmbeddingPaths;
    /** Whether to look for what the input may have meant instead (EmbedResult.doubts). Default: true. */
    doubts?: boolean;
    /**
     * Ends the search; the best embedding so far is still finished and returned, with the status
     * `cancelled`. Where that takes a worker more than a moment, as for targets of more than some ten
     * thousand triangles, the promise is rejected with a CancelledError, whose `late` is that result.
     */
    signal?: AbortSignal;
    /** Called between slices of work, whenever something happened. */
    onProgress?: (progress: EmbedProgress) => void;
    /**
     * How much the job does at a time before it lets other events be handled. Has no influence on
     * the result. Default 15 ms.
     */
    slice?: {
        /** By the clock. */
        milliseconds?: number;
        /** In units of work. */
        work?: number;
    };
}

/** How reshape() goes; as in SolveOptions. An aborted `signal` leaves the paths as far as they are. */
export type ReshapeOptions = Pick<SolveOptions, "signal" | "onProgress" | "slice">;

/** Paths as polylines, ready to draw. */
export interface Polylines {
    /** Per path: its first point; one more number than there are paths. */
    offsets: Uint32Array;
    /** 3 coordinates per point. */
    points: Float64Array;
    /** Per path: the layout edge. */
    layoutEdges: Uint32Array;
}

/** The state of a running job. */
export interface EmbedProgress {
    /** What the job is at. */
    phase: EmbedPhase;
    /** Share of the phase that is done, in [0, 1]. */
    progress: number;
    /** Since the job began, by the clock. */
    seconds: number;
    /** Units of work so far. */
    work: number;
    /** Infinity while there is no embedding. */
    cost: number;
    /** In the path-graph metric; 0 while nothing is proved. */
    lowerBound: number;
    /** The best embedding's paths, or those embedded so far; null while unchanged. */
    paths: Polylines | null;
}

/** Another phase began, the best embedding improved, the bound rose, or the work went on. */
export type EmbedEventKind = "phase" | "incumbent" | "bound" | "progress";

/** Something that happened, with the state after it. */
export interface EmbedEvent {
    /** What happened. */
    kind: EmbedEventKind;
    /** What the job was at. */
    phase: EmbedPhase;
    /** Since the job began, by the clock. */
    seconds: number;
    /** Units of work since the job began. */
    work: number;
    /** In the path-graph metric; Infinity while there was no embedding. */
    cost: number;
    /** In the path-graph metric; 0 while nothing was proved. */
    lowerBound: number;
    /** Share of the phase that was done, in [0, 1]. */
    progress: number;
}

/** Machine-independent counts. */
export interface EmbedCounters {
    /** Units of work: expansions, and what other operations count as. */
    work: number;
    /** Shortest-path searches in the cut surface. */
    searches: number;
    /** States of the cut surface expanded by them. */
    expansions: number;
    /** Nodes settled by the distance fields that guide them. */
    fieldNodes: number;
    /** Paths inserted into embeddings. */
    insertions: number;
    /** Questions for a shortest path answered without a search. */
    remembered: number;
    /** States of branch and bound that were put into its queue. */
    statesCreated: number;
    /** States taken from the queue and branched. */
    statesExpanded: number;
    /** States dropped by their bound. */
    statesPruned: number;
    /** States that had been met before. */
    statesRedundant: number;
    /** States in which some edge has no path left. */
    deadEnds: number;
    /** How often a tie made the job draw new perturbations. */
    ties: number;
}

/**
 * A point of a weak path: one target vertex id (that vertex), two (the midpoint of their edge) or
 * three (the centroid of their face).
 */
export type WeakPoint = number[];
