import type {
    Algorithm,
    BoundaryEdges,
    BoundScope,
    CandidatePaths,
    DraggedPaths,
    EmbedResult,
    EmbedStatus,
    LayoutInfo,
    PathShape,
    Polylines,
    TargetInfo,
    UncheckedMesh,
} from "layout-embedding";
import type { Landmarks } from "./landmarks.js";
import { noMap, type MapState } from "./maps.js";
import { noQuads, type QuadState } from "./quads.js";
import type { RouteRule } from "./routes.js";
import type { Trace } from "./trace.js";

/** What makes another problem of the same meshes and landmarks: edits, which can be taken back. */
export interface PathSettings {
    /** How much less it costs to go along sharp edges of the target, up to `largestDiscount`. */
    readonly featureDiscount: number;
    /** Whether layout boundary edges run along the target's boundary where they can. */
    readonly boundaryEdges: BoundaryEdges;
}

export const largestDiscount = 0.95;
export const boundaryEdgesNames: readonly BoundaryEdges[] = ["free", "follow"];

export interface SolveSettings extends PathSettings {
    /** Null for the package's default. */
    readonly algorithm: Algorithm | null;
    /** (cost - lower bound) / cost at which the search may stop. */
    readonly gap: number;
    /** Seconds; null for none. */
    readonly timeLimit: number | null;
    /** Units of work; null for the algorithm's own limit. */
    readonly workLimit: number | null;
    readonly seed: number;
    /** How paths run within their classes; another one needs no new search. */
    readonly shape: PathShape;
}

/** What the worker is doing, as shown while it does it. */
export interface Activity {
    readonly kind: "loading" | "solving";
    /** What is going on in words, for example "Reading spot.obj". */
    readonly phase: string;
    /** Share of the work that is done, in [0, 1]; null while unknown. */
    readonly progress: number | null;
    /** performance.now() at its start. */
    readonly startedAt: number;
    /** Infinity while there is no embedding. */
    readonly cost: number;
    readonly lowerBound: number;
    readonly cancelling: boolean;
}

/** Where a problem lies: in a mesh that was refused, or at landmarks on the target. */
export type Place =
    | {
          readonly kind: "mesh";
          readonly role: "layout" | "target";
          readonly name: string;
          readonly mesh: UncheckedMesh;
          readonly vertices: readonly number[];
          readonly faces: readonly number[];
      }
    | { readonly kind: "landmarks"; readonly ids: readonly number[] };

/** One problem, for people. */
export interface Problem {
    readonly id: number;
    readonly code: string;
    readonly title: string;
    /** What is wrong, and where; with the advice, the core's own sentence. */
    readonly cause: string;
    /** What to do about it; empty where nobody knows. */
    readonly advice: string;
    /** The line of the file that it is about; null where it is about none. */
    readonly line: string | null;
    readonly place: Place | null;
    /** What was being read; null for everything else. */
    readonly about: "layout" | "target" | null;
    /** What may help, as a button; null where nothing here does. */
    readonly remedy: { readonly label: string; readonly apply: () => void } | null;
}

/** A layout edge, a layout vertex (a landmark on the target), or a layout face (a patch there). */
export interface Item {
    readonly kind: "edge" | "vertex" | "face";
    readonly id: number;
}

/** What one of the heuristics made of the problem. */
export interface Contender {
    readonly algorithm: Algorithm;
    /** Null while it has not been run. */
    readonly result: EmbedResult | null;
}

export interface Comparison {
    readonly contenders: readonly Contender[];
    /** The one shown beside the result; null for none. */
    readonly shown: number | null;
}

/** The paths that the edges would take alone. */
export interface Candidates {
    readonly found: CandidatePaths;
    /** Whether they are drawn instead of the embedding's. */
    readonly shown: boolean;
}

/** What a target of a batch came to; lengths as in EmbedResult. */
export interface BatchFigures {
    readonly status: EmbedStatus;
    readonly cost: number;
    readonly lowerBound: number;
    readonly gap: number;
    readonly boundScope: BoundScope;
    /** On the surface; null without an embedding. */
    readonly length: number | null;
    readonly seconds: number;
}

/** A target of a batch. */
export interface BatchEntry {
    readonly target: File;
    /** Null: by proximity. */
    readonly landmarks: File | null;
    readonly state: "waiting" | "running" | "done" | "failed";
    readonly figures: BatchFigures | null;
    readonly error: string | null;
}

/** One layout in many targets. */
export interface BatchState {
    readonly layoutName: string;
    readonly entries: readonly BatchEntry[];
    readonly running: boolean;
    /** What was noticed about the files, for people; empty for nothing. */
    readonly note: string;
}

/** Where the input came from, for links and for other targets of the same class. */
export interface Origin {
    readonly kind: "example" | "shape";
    /** The example's name, or "class/member" of the shape that is the target. */
    readonly name: string;
}

/** What the panel is about, and the target's view with it. */
export const tabs = ["embedding", "quads", "map"] as const;
export type Tab = (typeof tabs)[number];

export type Theme = "system" | "light" | "dark";

/** What is drawn, and how. */
export interface Display {
    readonly layoutShown: boolean;
    readonly patchesShown: boolean;
    readonly pathsShown: boolean;
    readonly dotsShown: boolean;
    readonly wireframe: boolean;
    readonly camerasLinked: boolean;
    readonly orthographic: boolean;
    /** Share of the target cut away from the front, in [0, 1). */
    readonly clip: number;
    readonly theme: Theme;
}

export interface AppState {
    readonly layout: LayoutInfo | null;
    readonly target: TargetInfo | null;
    readonly origin: Origin | null;
    /** Null while layout or target is missing, unless a layout is being made. */
    readonly landmarks: Landmarks | null;
    /** Whether the layout's faces are turned around, after an edit that can be taken back. */
    readonly flipped: boolean;
    /** What is asked of single paths, in the order in which it was asked. */
    readonly routes: readonly RouteRule[];
    /** Whether the layout is made from the landmarks on the target. */
    readonly making: boolean;
    /** Whether a layout that is made here gets quads where that is possible. */
    readonly quads: boolean;
    /** Why no layout could be made of the landmarks so far; null if one was. */
    readonly makingHint: string | null;
    /** The layout vertex that the next click on the target places. */
    readonly placing: number | null;
    readonly undoable: boolean;
    readonly redoable: boolean;
    /** Whether the embedding follows while a landmark is dragged. */
    readonly live: boolean;
    /** Whether the layout is aligned to the target before landmarks are placed by proximity. */
    readonly align: boolean;
    readonly options: SolveSettings;
    /** Mend what can be mended safely when a file is read. */
    readonly repair: boolean;
    readonly activity: Activity | null;
    /** Paths of the running search, or of a search that ended without a result. */
    readonly livePaths: Polylines | null;
    readonly trace: Trace;
    /** The improvement that is shown instead of the result; null for the result. */
    readonly step: number | null;
    /** A quick embedding for the landmarks as they are being dragged. */
    readonly preview: EmbedResult | null;
    /** The paths that follow the landmark that is being dragged, where they can: quicker still. */
    readonly follow: DraggedPaths | null;
    readonly result: EmbedResult | null;
    readonly comparison: Comparison | null;
    /** Null until they were asked for. */
    readonly candidates: Candidates | null;
    /** Null until one was started. */
    readonly batch: BatchState | null;
    /** Newest last. */
    readonly problems: readonly Problem[];
    /** The problem whose place is shown; null for none. */
    readonly shownPlace: number | null;
    /** What was done with dropped files, what a repair did; the latest only. */
    readonly notices: readonly string[];
    /** What an edit did, for screen readers. */
    readonly announcement: string;
    /** Under the pointer. */
    readonly highlight: Item | null;
    /** Chosen with a click or a key. */
    readonly selected: Item | null;
    readonly tab: Tab;
    readonly quadMesh: QuadState;
    readonly map: MapState;
    readonly display: Display;
}

/** An activity at its beginning. */
export const startedActivity = (kind: Activity["kind"], phase: string): Activity => ({
    kind,
    phase,
    progress: null,
    startedAt: performance.now(),
    cost: Infinity,
    lowerBound: 0,
    cancelling: false,
});

export const initialState: AppState = {
    layout: null,
    target: null,
    origin: null,
    landmarks: null,
    flipped: false,
    routes: [],
    making: false,
    quads: true,
    makingHint: null,
    placing: null,
    undoable: false,
    redoable: false,
    live: true,
    align: false,
    options: {
        algorithm: null,
        gap: 0.01,
        timeLimit: null,
        workLimit: null,
        seed: 1,
        shape: "short",
        featureDiscount: 0,
        boundaryEdges: "free",
    },
    repair: false,
    activity: null,
    livePaths: null,
    trace: { points: [], incumbents: [] },
    step: null,
    preview: null,
    follow: null,
    result: null,
    comparison: null,
    candidates: null,
    batch: null,
    problems: [],
    shownPlace: null,
    notices: [],
    announcement: "",
    highlight: null,
    selected: null,
    tab: "embedding",
    quadMesh: noQuads,
    map: noMap,
    display: {
        layoutShown: true,
        patchesShown: true,
        pathsShown: true,
        dotsShown: true,
        wireframe: false,
        camerasLinked: true,
        orthographic: false,
        clip: 0,
        theme: "system",
    },
};
