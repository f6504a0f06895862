// What of a person's work is put away, in a session file or in this browser, and opened again: each
// part with what makes sense of it.
import { algorithmNames, pathShapeNames } from "layout-embedding/worker";
import type { Side } from "./correspondence.js";
import type { Landmarks } from "./landmarks.js";
import { textures, type Texture } from "./maps.js";
import type { QuadState } from "./quads.js";
import type { RouteRule } from "./routes.js";
import type { SavedSecond, Source } from "./sources.js";
import {
    boundaryEdgesNames,
    initialState,
    largestDiscount,
    tabs,
    type AppState,
    type Origin,
    type SolveSettings,
    type Tab,
} from "./state.js";

/** What is large and changes seldom. */
export interface SavedMeshes {
    readonly layout: Source | null;
    readonly target: Source | null;
    /** What the target is mapped to. */
    readonly second: SavedSecond | null;
}

/** All else, as it goes into a file. */
export interface SavedRest {
    readonly landmarks: Landmarks | null;
    readonly making: boolean;
    readonly quads: boolean;
    readonly repair: boolean;
    readonly options: AppState["options"];
    readonly origin: Origin | null;
    readonly routes: readonly RouteRule[];
    /** How fine quad meshes are. */
    readonly quadMesh: Pick<QuadState, "edgeLength" | "segments">;
    /** What a map carries, and the vertex that its cursor is on, if any. */
    readonly map: {
        readonly texture: Texture;
        readonly cursor: { readonly from: Side; readonly vertex: number } | null;
    };
    readonly tab: Tab;
    /** Whether there was an embedding: then it is looked for again. */
    readonly solved: boolean;
}

export type SavedWork = SavedMeshes & SavedRest;

/** What is open now, but for the meshes. */
export function savedRest(state: AppState): SavedRest {
    const { landmarks, making, quads, repair, options, origin, routes, tab } = state;
    const { edgeLength, segments } = state.quadMesh;
    const { texture, cursor } = state.map;
    const vertex = cursor?.vertex ?? null;
    return {
        landmarks,
        making,
        quads,
        repair,
        options,
        origin,
        routes,
        quadMesh: { edgeLength, segments },
        map: { texture, cursor: cursor && vertex !== null ? { from: cursor.from, vertex } : null },
        tab,
        solved: state.result !== null,
    };
}

/** Reads a part; what is damaged is `otherwise`, and noted. */
type ReadPart = <Value>(words: string, otherwise: Value, read: () => Value) => Value;

/** Notes in `lost`, in words, which parts could not be read. */
export const partsReader =
    (lost: string[]): ReadPart =>
    (words, otherwise, read) => {
        try {
            return read();
        } catch {
            lost.push(words);
            return otherwise;
        }
    };

/** Of what was put away everything that makes sense. Earlier versions of the page had less of it. */
export function checkedRest(given: Partial<SavedRest>, part: ReadPart): SavedRest {
    return {
        landmarks: part("the landmarks", null, () => checkedLandmarks(given.landmarks)),
        making: given.making === true,
        quads: given.quads !== false,
        repair: given.repair === true,
        options: part("the settings", initialState.options, () => checkedSettings(given.options)),
        origin: checkedOrigin(given.origin),
        routes: part("the rules for routes", [], () => checkedRoutes(given.routes)),
        quadMesh: part("the density of quads", usualQuads, () => checkedQuads(given.quadMesh)),
        map: part("what the map shows", usualMap, () => checkedMap(given.map)),
        tab: tabs.find((name) => name === given.tab) ?? initialState.tab,
        solved: given.solved === true,
    };
}

const usualQuads: SavedRest["quadMesh"] = { edgeLength: null, segments: [] };
const usualMap: SavedRest["map"] = { texture: initialState.map.texture, cursor: null };

function checkedLandmarks(landmarks: Landmarks | null | undefined): Landmarks | null {
    if (!landmarks) return null;
    const { places, names, source } = landmarks;
    const valid =
        isList(places) &&
        isList(names) &&
        places.length === names.length &&
        places.every((v) => v === null || isId(v)) &&
        names.every((text) => typeof text === "string");
    if (!valid) throw new Error("these are no landmarks");
    return { places, names, source: String(source) };
}

function checkedSettings(given: Partial<SolveSettings> | undefined): SolveSettings {
    const settings = { ...initialState.options, ...given };
    const { algorithm, gap, timeLimit, workLimit, seed, shape } = settings;
    const { featureDiscount, boundaryEdges } = settings;
    const isAmount = (value: unknown) =>
        value === null || (typeof value === "number" && value >= 0);
    const valid =
        (algorithm === null || isOneOf(algorithmNames, algorithm)) &&
        isOneOf(pathShapeNames, shape) &&
        isOneOf(boundaryEdgesNames, boundaryEdges) &&
        [gap, timeLimit, workLimit, featureDiscount].every(isAmount) &&
        gap !== null &&
        gap <= 1 &&
        featureDiscount !== null &&
        featureDiscount <= largestDiscount &&
        isId(seed);
    if (!valid) throw new Error("these are no settings");
    // Nothing else that stands there.
    return {
        algorithm,
        gap,
        timeLimit,
        workLimit,
        seed,
        shape,
        featureDiscount,
        boundaryEdges,
    };
}

function checkedOrigin(origin: Origin | null | undefined): Origin | null {
    const { kind, name } = origin ?? {};
    return (kind === "example" || kind === "shape") && typeof name === "string"
        ? { kind, name }
        : null;
}

function checkedRoutes(routes: readonly RouteRule[] | undefined): readonly RouteRule[] {
    if (routes === undefined) return [];
    if (!isList(routes) || !routes.every(isRoute)) throw new Error("these are no rules");
    return routes;
}

function checkedQuads(quadMesh: SavedRest["quadMesh"] | undefined): SavedRest["quadMesh"] {
    if (quadMesh === undefined) return usualQuads;
    const { edgeLength, segments } = quadMesh;
    const valid =
        (edgeLength === null || (Number.isFinite(edgeLength) && edgeLength > 0)) &&
        isList(segments) &&
        segments.every((pair) => isList(pair) && pair.length === 2 && pair.every(isId)) &&
        segments.every(([, count]) => count > 0);
    if (!valid) throw new Error("this is no density");
    return { edgeLength, segments };
}

function checkedMap(map: SavedRest["map"] | undefined): SavedRest["map"] {
    if (map === undefined) return usualMap;
    const { texture, cursor } = map;
    const valid =
        isOneOf(textures, texture) &&
        (cursor === null || (isOneOf(["a", "b"], cursor.from) && isId(cursor.vertex)));
    if (!valid) throw new Error("this is nothing a map shows");
    return { texture, cursor: cursor && { from: cursor.from, vertex: cursor.vertex } };
}

const isOneOf = (list: readonly string[], value: string) => list.includes(value);
const isList = (value: unknown): boolean => Array.isArray(value);
const isId = (value: unknown) => Number.isSafeInteger(value) && (value as number) >= 0;
const isPoint = (point: readonly unknown[]) =>
    isList(point) && point.length > 0 && point.length < 4 && point.every(isId);

const isRoute = ({ rule, edge, path, edgeCost, costBefore }: Partial<RouteRule>): boolean =>
    (rule === "keep" || rule === "avoid") &&
    isId(edge) &&
    isList(path) &&
    (path ?? []).every(isPoint) &&
    typeof edgeCost === "number" &&
    (costBefore === null || typeof costBefore === "number");
