// A session, in the caller's thread or in a worker.
import type {
    LandmarkInput,
    LandmarkOptions,
    LandmarksInfo,
    LayoutInfo,
    LoadOptions,
    MeshInput,
    TargetInfo,
    TargetLoadOptions,
    TemplateLayout,
    TemplateOptions,
    UncheckedMesh,
} from "./input.js";
import type { SurfaceMap, SurfaceMapOptions, SurfacePoints } from "./maps.js";
import type { QuadMesh, QuadOptions } from "./quads.js";
import type {
    CandidatePaths,
    DraggedPaths,
    EmbedResult,
    EmbeddingClaim,
    ExportFormat,
    ExportView,
    ExportedFiles,
    QualityReport,
    Violation,
} from "./results.js";
import type { PathShape, ReshapeOptions, SolveOptions } from "./solve.js";

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
