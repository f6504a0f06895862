// The data that go in and out of the package, the same in a thread of its own (client.ts) and in
// the caller's (session.ts). Units are the target's; all ids are 0-based.

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
    /** What deserves attention in target or landmarks. */
    notes: Notes;
}

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

/** How fine a quad mesh is. An aborted `signal` ends its relaxation; the mesh is as far as it is. */
export interface QuadOptions extends CallOptions {
    /** Wanted length of edges, in the target's units. Default: one that gives about 4000 quads. */
    edgeLength?: number;
    /** Pairs of a layout edge and its number of segments, which rule its whole loops of quads. */
    segments?: readonly (readonly [edge: number, segments: number])[];
    /**
     * The `segments` of another quad mesh of the same layout, to get the same connectivity; the options
     * above don't count then.
     */
    segmentsAs?: ArrayLike<number>;
    /** How often all vertices are moved to even the mesh out. Default: 30. */
    relaxation?: number;
}

/** A quad mesh on the target whose base complex is the layout. */
export interface QuadMesh {
    /** 3 coordinates per vertex. */
    positions: Float64Array;
    /** 4 vertex ids per quad, counter-clockwise. */
    quads: Uint32Array;
    /** The layout face of each quad. */
    faces: Uint32Array;
    /**
     * The base complex as chains of vertices: the layout's edges in their order, then edges inside
     * of faces where they were subdivided.
     */
    chains: Uint32Array[];
    /** Numbers of segments, for `segmentsAs`. */
    segments: Uint32Array;
    /** Two per layout edge: the dual loops of its halves, the same unless `subdivided`. */
    loops: Uint32Array;
    /** Whether the layout had a face without four sides, so that all were subdivided once. */
    subdivided: boolean;
    /** How good its quads are. */
    statistics: {
        /** Scaled Jacobians: 1 for a rectangle, not positive where a quad is flipped. */
        leastJacobian: number;
        /** The mean over all quads. */
        meanJacobian: number;
        /** Quads whose scaled Jacobian is not positive. */
        flipped: number;
        /** Degrees. */
        leastAngle: number;
        /** Degrees. */
        largestAngle: number;
        /** Root mean square of the differences to 90 degrees. */
        angleDeviation: number;
        /** Lengths of edges, in the target's units. */
        leastEdge: number;
        /** The mean of all edges. */
        meanEdge: number;
        /** The longest edge. */
        largestEdge: number;
    };
    /** As an OBJ file: faces in groups, the base complex as lines. */
    obj: Uint8Array;
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

/** Points of a triangle mesh. */
export interface SurfacePoints {
    /** Per point: a face, -1 for no point. */
    faces: Int32Array;
    /** Per point: 3 barycentric coordinates, in the order of the face's corners. */
    barycentrics: Float64Array;
}

/** How long a map is optimised. An aborted `signal` ends that; the map is as far as it is. */
export interface SurfaceMapOptions extends CallOptions {
    /** Rounds of optimisation at most; 0 leaves the maps of the patches as they are. Default: 5. */
    rounds?: number;
    /**
     * How often the paths of both targets are moved at most, so that points on a path need not be
     * mapped to a path of the other embedding; 0 keeps both embeddings as they are. Default: 2.
     */
    seamPasses?: number;
}

/**
 * How far a map is from an isometry, both targets scaled to area 1; means are over the area of the
 * reference.
 */
export interface MapDistortion {
    /** Symmetric Dirichlet energy, |J|^2 + |J^-1|^2: 4 for an isometry, else more. */
    meanEnergy: number;
    /** Of a single triangle of the overlay. */
    largestEnergy: number;
    /** Ratio of the larger to the smaller singular value: 1 where angles are kept. */
    meanConformal: number;
    /** Ratio of areas, the larger one over the smaller: 1 where areas are kept. */
    meanArea: number;
}

/**
 * A one-to-one map between the reference and another target of the same layout, piecewise linear
 * on the overlay of both meshes.
 */
export interface SurfaceMap {
    /** Per vertex of the reference its image on the target. */
    fromReference: SurfacePoints;
    /** Per vertex of the target its image on the reference. */
    toReference: SurfacePoints;
    /** The common refinement of both meshes: each triangle lies in one face of either. */
    overlay: {
        /** 3 vertex ids per triangle, counter-clockwise. */
        corners: Uint32Array;
        /** The layout face of each triangle. */
        patches: Uint32Array;
        /** The face of the reference and of the target that each triangle lies in. */
        referenceFaces: Uint32Array;
        /** The face of the target that each triangle lies in. */
        targetFaces: Uint32Array;
        /** 9 numbers per triangle: the barycentric coordinates of its corners in that face. */
        referenceWeights: Float64Array;
        /** The same for `targetFaces`. */
        targetWeights: Float64Array;
        /** 3 coordinates per vertex: where it lies on the reference and on the target. */
        referencePositions: Float64Array;
        /** The same on the target. */
        targetPositions: Float64Array;
    };
    /** Of the map as it is. */
    distortion: MapDistortion;
    /** Before optimisation. */
    firstDistortion: MapDistortion;
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

/** An `.inp` file of the paper's reference implementation. */
export interface ReferenceInput {
    /** The files of layout and target, relative to this one. */
    layoutFile: string;
    /** The file of the target, relative to this one. */
    targetFile: string;
    /** The target vertex of each layout vertex; throws landmarkCount where they don't fit. */
    landmarks: (vertexCount: number) => Uint32Array;
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

/** One layout, one target, landmarks, and what is solved with them. */
export interface EmbeddingSession {
    /** Reads a layout. A failed load changes nothing; a successful one forgets the landmarks. */
    loadLayout(input: MeshInput, options?: LoadOptions): Promise<LayoutInfo>;
    /** Reads a target. A failed load changes nothing; a successful one forgets the landmarks. */
    loadTarget(input: MeshInput, options?: TargetLoadOptions): Promise<TargetInfo>;
    /**
     * What loadLayout() or loadTarget() would read, without confirming that it is a surface: to show
     * the place that an error names. Changes nothing in the session.
     */
    inspect(
        role: "layout" | "target",
        input: MeshInput,
        options?: LoadOptions,
    ): Promise<UncheckedMesh>;
    /**
     * Sets the landmarks and confirms that layout, target and landmarks fit together. A failure
     * changes nothing.
     */
    setLandmarks(input: LandmarkInput, options?: LandmarkOptions): Promise<LandmarksInfo>;
    /**
     * Sets the landmarks to the one-to-one assignment of least total squared distance, for a layout
     * that lies in the frame of the target.
     */
    landmarksByProximity(): Promise<LandmarksInfo>;
    /**
     * Makes a layout of the target alone: collapses edges until only the landmarks are left. Changes
     * nothing in the session; hand the result to loadLayout() and its landmarks to setLandmarks().
     * Rejected with tooFewLandmarksForSurface or templateNotReached where there is none.
     */
    templateLayout(landmarks: LandmarkInput, options?: TemplateOptions): Promise<TemplateLayout>;
    /** Embeds the layout; without landmarks, those by proximity are set first. */
    solve(options?: SolveOptions): Promise<EmbedResult>;
    /**
     * Gives the paths of the last embedding that solve() returned another shape, without a new
     * search. Rejected with nothingToReshape where there is none.
     */
    reshape(shape: PathShape, options?: ReshapeOptions): Promise<EmbedResult>;
    /** The files of the last embedding that solve() returned. */
    exportFiles(): Promise<ExportedFiles>;
    /**
     * The last embedding in the formats of other programs: files by name, `refined.<format>`; for
     * "lem" refined.inp, refined.lem and the meshes they name. `view` is for pictures.
     */
    exportAs(
        formats: readonly ExportFormat[],
        view?: ExportView,
    ): Promise<Record<string, Uint8Array>>;
    /** A quad mesh whose base complex is the last embedding. */
    quads(options?: QuadOptions): Promise<QuadMesh>;
    /**
     * Keeps the last embedding as the reference for mapFromReference(), until another layout is
     * loaded. Load the next target, set its landmarks and solve then.
     */
    setReference(): Promise<void>;
    /**
     * Maps the reference onto the target of the last embedding, one to one and in the homotopy class
     * of the two embeddings. Rejected with noReference where there is none.
     */
    mapFromReference(options?: SurfaceMapOptions): Promise<SurfaceMap>;
    /**
     * The images of points under the last map: of points of the reference on the target, or the other
     * way round. Rejected with noReference where there is no map.
     */
    mapPoints(from: "reference" | "target", points: SurfacePoints): Promise<SurfacePoints>;
    /** How good the last embedding is. */
    qualityReport(): Promise<QualityReport>;
    /**
     * The candidate paths of the last problem that solve() found an embedding for, with their
     * conflicts: why an embedding is longer than the shortest paths.
     */
    candidatePaths(): Promise<CandidatePaths>;
    /**
     * For a landmark that is dragged: moves that of one layout vertex to a vertex of the target (after
     * a repair), and only the paths that have to follow are searched. Begins at the last embedding
     * that solve() returned; moves of the same landmark build on each other. The session's
     * landmarks and last embedding stay as they are. Null where no embedding follows: the landmark
     * stays where it was.
     */
    dragLandmark(layoutVertex: number, targetVertex: number): Promise<DraggedPaths | null>;
    /** What is wrong with a claimed embedding; empty if it is valid. */
    check(claim: EmbeddingClaim): Promise<Violation[]>;
    /** Frees everything; the session cannot be used any more. */
    dispose(): Promise<void>;
}

/** What templateLayout() makes a layout of. */
export interface TemplateProblem {
    /** A triangle mesh. */
    target: MeshInput;
    /** Which target vertices the layout has. */
    landmarks: LandmarkInput;
}

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

/** What mapSurfaces() maps onto each other: two targets of one layout. */
export interface SurfaceMapProblem {
    /** Embedded in both targets. */
    layout: MeshInput;
    /** What is mapped; default landmarks: by proximity. */
    reference: {
        /** A triangle mesh. */
        target: MeshInput;
        /** As for setLandmarks(). */
        landmarks?: LandmarkInput;
    };
    /** What it is mapped to. */
    target: {
        /** A triangle mesh. */
        target: MeshInput;
        /** As for setLandmarks(). */
        landmarks?: LandmarkInput;
    };
}

/** What embed() embeds where. */
export interface EmbedProblem {
    /** Polygons, read for their connectivity. */
    layout: MeshInput;
    /** A triangle mesh. */
    target: MeshInput;
    /** Default: by proximity. */
    landmarks?: LandmarkInput;
}

/**
 * The options of one embedding from beginning to end. Aborted before the search, it is rejected with
 * `cancelled`; after that, it ends with the best embedding so far, however long that is finished.
 */
export interface EmbedOptions extends SolveOptions, LoadOptions {
    signal?: AbortSignal;
}
