// The map from the target to a second one, as the page shows it.
import type {
    EmbedResult,
    LandmarkInput,
    MeshInput,
    SurfaceMap,
    TargetInfo,
} from "layout-embedding";
import type { Correspondence, FacePoint, Side } from "./correspondence.js";
import type { SavedSecond } from "./sources.js";

/** A second target for the layout. */
export interface OtherTarget {
    readonly title: string;
    readonly saved: SavedSecond;
    readonly open: () => Promise<{
        readonly target: MeshInput;
        /** Null: by proximity. */
        readonly landmarks: LandmarkInput | null;
    }>;
}

/** What the map can carry from the first target to the second. */
export const textures = ["grid", "checker", "patches", "distortion", "file"] as const;
export type Texture = (typeof textures)[number];

/** A point on both targets. */
export interface MapCursor {
    readonly a: FacePoint | null;
    readonly b: FacePoint | null;
    /** Where it was put, and the vertex that it is on there, if any. */
    readonly from: Side;
    readonly vertex: number | null;
}

export interface MapState {
    readonly other: OtherTarget | null;
    /** The second target as it was read, and its landmarks. */
    readonly target: TargetInfo | null;
    readonly landmarks: Uint32Array | null;
    readonly map: SurfaceMap | null;
    readonly correspondence: Correspondence | null;
    /** The result whose embedding the map begins at. */
    readonly of: EmbedResult | null;
    /** `partly`: what there was when the optimisation was stopped. */
    readonly optimised: "no" | "partly" | "yes";
    /** What is going on, in words; null for nothing. */
    readonly phase: string | null;
    /** Share of it that is done; null while unknown. */
    readonly progress: number | null;
    /** Why there is no map. */
    readonly error: string | null;
    /** What is wanted; see shownTexture(). */
    readonly texture: Texture;
    /** Those of the first target, as in TargetInfo; null where it has none. */
    readonly coordinates: Float64Array | null;
    readonly cursor: MapCursor | null;
}

export const noMap: MapState = {
    other: null,
    target: null,
    landmarks: null,
    map: null,
    correspondence: null,
    of: null,
    optimised: "no",
    phase: null,
    progress: null,
    error: null,
    texture: "grid",
    coordinates: null,
    cursor: null,
};

/** What is carried: the texture that is wanted, where the first target has it. */
export const shownTexture = ({ texture, coordinates }: MapState): Texture =>
    texture === "file" && !coordinates ? "grid" : texture;
