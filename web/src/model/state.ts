import type { EmbedResult, LayoutInfo, Polylines, TargetInfo } from "layout-embedding";

export interface Landmarks {
    /** Target vertex per layout vertex. */
    readonly ids: Uint32Array;
    /** Where they come from, for people: "by proximity", a file name, "from the example". */
    readonly source: string;
}

export interface SolveOptions {
    /** (cost - lower bound) / cost at which the search may stop. */
    readonly gap: number;
    /** Seconds; null for none. */
    readonly timeLimit: number | null;
    readonly seed: number;
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

/** One problem, for people. */
export interface Problem {
    readonly id: number;
    readonly code: string;
    readonly title: string;
    /** The core's own sentence. */
    readonly message: string;
    /** What may help, as a button; null where nothing here does. */
    readonly remedy: { readonly label: string; readonly apply: () => void } | null;
}

/** A layout edge or a layout vertex (which is a landmark on the target). */
export type Item = { readonly kind: "edge" | "vertex"; readonly id: number };

export interface AppState {
    readonly layout: LayoutInfo | null;
    readonly target: TargetInfo | null;
    readonly landmarks: Landmarks | null;
    readonly options: SolveOptions;
    /** Mend what can be mended safely when a file is read. */
    readonly repair: boolean;
    readonly activity: Activity | null;
    /** Paths of the running search, or of a search that ended without a result. */
    readonly livePaths: Polylines | null;
    readonly result: EmbedResult | null;
    /** Newest last. */
    readonly problems: readonly Problem[];
    /** What was done with dropped files, what a repair did; the latest only. */
    readonly notices: readonly string[];
    readonly highlight: Item | null;
    readonly layoutShown: boolean;
    readonly patchesShown: boolean;
    readonly wireframe: boolean;
    readonly camerasLinked: boolean;
}

export const initialState: AppState = {
    layout: null,
    target: null,
    landmarks: null,
    options: { gap: 0.01, timeLimit: null, seed: 1 },
    repair: false,
    activity: null,
    livePaths: null,
    result: null,
    problems: [],
    notices: [],
    highlight: null,
    layoutShown: true,
    patchesShown: true,
    wireframe: false,
    camerasLinked: true,
};
