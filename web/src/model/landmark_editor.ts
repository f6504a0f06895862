import { History } from "./history.js";
import {
    landmarkLabel,
    landmarkOn,
    nextMissing,
    noLandmarks,
    withName,
    withoutLandmark,
    withoutPlace,
    withPlace,
    type Landmarks,
} from "./landmarks.js";
import { droppedWords, fits, type RouteRule } from "./routes.js";
import type { AppState, PathSettings } from "./state.js";
import type { Store } from "./store.js";

/** Changed landmarks make everything solved before meaningless. */
export const unsolved = {
    result: null,
    preview: null,
    follow: null,
    livePaths: null,
    trace: { points: [], incumbents: [] },
    step: null,
    comparison: null,
    candidates: null,
} as const;

export interface EditListener {
    /** A landmark moved under the hand, and will move again. */
    dragged: (id: number) => void;
    /** An edit is complete; `wasSolved` tells whether there was an embedding before it. */
    edited: (wasSolved: boolean) => void;
}

/** What edits change, and undo brings back. */
interface Edited {
    readonly landmarks: Landmarks;
    readonly flipped: boolean;
    readonly routes: readonly RouteRule[];
    readonly settings: PathSettings;
}

/** Every way to edit landmarks by hand; each edit can be taken back. */
export class LandmarkEditor {
    private readonly history = new History<Edited>();
    private beforeDrag: Landmarks | null = null;
    private solvedBeforeDrag = false;

    constructor(
        private readonly store: Store<AppState>,
        private readonly listener: EditListener,
    ) {}

    /** Chooses the layout vertex that the next click on the target places; null for none. */
    startPlacing(id: number | null): void {
        const { landmarks, layout, making } = this.store.get();
        const count = landmarks?.places.length ?? 0;
        const valid = id !== null && id >= 0 && (id < count || (making && id === count));
        if (id !== null && (!valid || (!layout && !making))) return;
        this.store.update({
            placing: id,
            selected: id === null || id === count ? null : { kind: "vertex", id },
            announcement:
                id === null ? "" : `Click where landmark ${landmarkLabel(landmarks, id)} goes.`,
        });
    }

    /** Goes on to the next landmark that is missing, or where none is to the next one. */
    placeNext(): void {
        const { landmarks, placing, selected, making } = this.store.get();
        if (!landmarks) return;
        const count = landmarks.places.length;
        if (making) return this.startPlacing(count);
        const current = placing ?? (selected?.kind === "vertex" ? selected.id : -1);
        const next = nextMissing(landmarks, current);
        if (next !== null) this.startPlacing(next);
        else if (count > 0) this.store.update({ announcement: "No landmark is missing." });
    }

    /**
     * Puts the landmark that is being placed on a target vertex, and goes on to the next missing
     * one. While a layout is being made, a click adds a landmark.
     */
    placeOn(vertex: number): void {
        const { landmarks, placing, making } = this.store.get();
        if (!landmarks) return;
        const id = placing ?? (making ? landmarks.places.length : null);
        if (id === null || !this.place(id, vertex)) return;
        const placed = this.store.get().landmarks ?? landmarks;
        const next = making ? placed.places.length : nextMissing(placed, id);
        this.store.update({
            placing: next,
            selected: { kind: "vertex", id },
            announcement:
                `Landmark ${landmarkLabel(placed, id)} is on target vertex ${vertex}.` +
                (next === null ? "" : ` Next: landmark ${landmarkLabel(placed, next)}.`),
        });
    }

    /** Puts one landmark on a target vertex; false if that vertex has another landmark. */
    place(id: number, vertex: number): boolean {
        const { landmarks, target } = this.store.get();
        if (!landmarks || !target || landmarks.places[id] === vertex) return false;
        if (!Number.isInteger(vertex) || vertex < 0 || vertex >= target.vertexCount) {
            this.store.update({
                announcement: `There is no target vertex ${vertex}; the last is ${target.vertexCount - 1}.`,
            });
            return false;
        }
        const other = landmarkOn(landmarks, vertex);
        if (other !== null) {
            this.store.update({
                announcement: `Landmark ${landmarkLabel(landmarks, other)} is already on target vertex ${vertex}.`,
            });
            return false;
        }
        this.apply(withPlace(landmarks, id, vertex));
        return true;
    }

    /** Moves a landmark while it is dragged; the whole drag is one edit. */
    drag(id: number, vertex: number): void {
        const { landmarks, live, preview, follow, result } = this.store.get();
        if (!landmarks || landmarkOn(landmarks, vertex) !== null) return;
        if (!this.beforeDrag) {
            this.beforeDrag = landmarks;
            this.solvedBeforeDrag = this.isSolved();
        }
        this.store.update({
            ...unsolved,
            // Shown until the first embedding for the new place is there.
            preview: live ? (preview ?? result) : null,
            follow: live ? follow : null,
            landmarks: withPlace(landmarks, id, vertex),
        });
        this.listener.dragged(id);
    }

    endDrag(): void {
        const before = this.beforeDrag;
        this.beforeDrag = null;
        if (!before || before === this.store.get().landmarks) return;
        this.history.record({ ...this.current(), landmarks: before });
        this.adaptRoutes();
        this.changed(this.solvedBeforeDrag);
    }

    /** Takes a landmark off the target; while a layout is being made, out altogether. */
    remove(id: number): void {
        const { landmarks, making } = this.store.get();
        if (!landmarks || landmarks.places[id] === undefined || landmarks.places[id] === null)
            return;
        this.apply(making ? withoutLandmark(landmarks, id) : withoutPlace(landmarks, id));
        this.store.update({
            selected: null,
            ...(making ? { placing: this.store.get().landmarks?.places.length ?? null } : {}),
            announcement: `Landmark ${landmarkLabel(landmarks, id)} was taken off the target.`,
        });
    }

    rename(id: number, name: string): void {
        const { landmarks } = this.store.get();
        if (!landmarks || landmarks.names[id] === name.trim()) return;
        // A name changes nothing that was solved.
        this.history.record(this.current());
        this.store.update({ landmarks: withName(landmarks, id, name.trim()) });
        this.tellHistory();
    }

    /** Two layout vertices get each other's landmarks. */
    exchange(a: number, b: number): void {
        const { landmarks } = this.store.get();
        const [placeA, placeB] = [landmarks?.places[a] ?? null, landmarks?.places[b] ?? null];
        if (!landmarks || placeA === null || placeB === null) return;
        this.apply(withPlace(withPlace(landmarks, a, placeB), b, placeA));
        const [first, second] = [a, b].map((id) => landmarkLabel(landmarks, id));
        this.store.update({
            announcement: `Landmarks ${first} and ${second} have changed places.`,
        });
    }

    /** Turns all faces of the layout around. */
    flip(): void {
        const wasSolved = this.isSolved();
        this.history.record(this.current());
        this.store.update({
            ...unsolved,
            flipped: !this.store.get().flipped,
            announcement: "The layout was turned inside out.",
        });
        this.dropRoutes(() => false, "the layout was turned");
        this.changed(wasSolved);
    }

    /** All landmarks at once, from a file or by proximity. */
    replace(landmarks: Landmarks): void {
        this.apply(landmarks, false);
    }

    clear(): void {
        const { landmarks, making } = this.store.get();
        if (!landmarks) return;
        this.apply(
            making
                ? noLandmarks
                : { ...landmarks, places: landmarks.places.map(() => null), source: "none yet" },
        );
        this.store.update({ selected: null, placing: 0 });
    }

    /** Other rules for routes: what was solved is shown until it is solved again. */
    setRoutes(routes: readonly RouteRule[], announcement: string): void {
        const { result } = this.store.get();
        const wasSolved = this.isSolved();
        this.history.record(this.current());
        this.store.update({ ...unsolved, routes, preview: result, announcement });
        this.changed(wasSolved);
    }

    /** Other costs of paths, or other edges along the boundary: another problem, solved anew. */
    setPathSettings(change: Partial<PathSettings>, announcement: string): void {
        const { result, options, landmarks, live } = this.store.get();
        const changed = { ...options, ...change };
        if (!landmarks) return this.store.update({ options: changed });
        const wasSolved = this.isSolved();
        this.history.record(this.current());
        this.store.update({
            ...unsolved,
            options: changed,
            // Shown until the new embedding is there.
            preview: live ? result : null,
            announcement,
        });
        this.adaptRoutes();
        this.changed(wasSolved);
    }

    /** Rules that the embedding there is complies with. */
    keepRoutes(routes: readonly RouteRule[], announcement: string): void {
        this.history.record(this.current());
        this.store.update({ routes, announcement });
        this.tellHistory();
    }

    undo(): void {
        this.go(this.history.back(this.current()), "Taken back.");
    }

    redo(): void {
        this.go(this.history.forth(this.current()), "Done again.");
    }

    /** New input: earlier edits belong to something else. */
    forget(): void {
        this.history.clear();
        this.beforeDrag = null;
        this.tellHistory();
    }

    private current(): Edited {
        const { landmarks, flipped, routes, options } = this.store.get();
        const { featureDiscount, boundaryEdges } = options;
        const settings = { featureDiscount, boundaryEdges };
        return { landmarks: landmarks ?? noLandmarks, flipped, routes, settings };
    }

    private go(edited: Edited | null, announcement: string): void {
        if (!edited) return;
        const { landmarks, flipped, routes, settings } = edited;
        const { making, placing, selected, options } = this.store.get();
        const goOn = making || placing !== null;
        const wasSolved = this.isSolved();
        this.store.update({
            ...unsolved,
            landmarks,
            flipped,
            routes,
            options: { ...options, ...settings },
            selected: selected?.kind === "edge" ? selected : null,
            placing: making
                ? landmarks.places.length
                : goOn
                  ? nextMissing(landmarks, (placing ?? 0) - 1)
                  : null,
            announcement,
        });
        this.changed(wasSolved);
    }

    private apply(landmarks: Landmarks, wasSolved = this.isSolved()): void {
        if (this.store.get().landmarks) this.history.record(this.current());
        this.store.update({ ...unsolved, landmarks });
        this.adaptRoutes();
        this.changed(wasSolved);
    }

    /** In another problem: rules that still fit stay, without the price they had. */
    private adaptRoutes(): void {
        const { landmarks, layout } = this.store.get();
        this.dropRoutes(
            (rule) => layout !== null && landmarks !== null && fits(rule, layout, landmarks),
            "it does not lead from landmark to landmark any more",
        );
        const { routes } = this.store.get();
        if (routes.some(({ costBefore }) => costBefore !== null))
            this.store.update({ routes: routes.map((rule) => ({ ...rule, costBefore: null })) });
    }

    private dropRoutes(stays: (rule: RouteRule) => boolean, why: string): void {
        const { routes, notices } = this.store.get();
        const dropped = routes.filter((rule) => !stays(rule));
        if (dropped.length === 0) return;
        this.store.update({
            routes: routes.filter(stays),
            notices: [...notices, droppedWords(dropped, why)],
        });
    }

    private isSolved(): boolean {
        const { result, preview, follow, activity } = this.store.get();
        return (
            result !== null || preview !== null || follow !== null || activity?.kind === "solving"
        );
    }

    private changed(wasSolved: boolean): void {
        this.tellHistory();
        this.listener.edited(wasSolved);
    }

    private tellHistory(): void {
        this.store.update({
            undoable: this.history.canGoBack,
            redoable: this.history.canGoForth,
        });
    }
}
