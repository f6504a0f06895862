import type {
    CandidatePaths,
    EmbedResult,
    PathShape,
    Polylines,
    QuadMesh,
    RefinedMesh,
} from "layout-embedding";
import type { Actions } from "../model/actions.js";
import { edgesInConflict, opponentsOf } from "../model/candidates.js";
import { formatLength, formatPercent, shapeWords } from "../model/describe.js";
import { visibleDetours } from "../model/detours.js";
import { landmarkLabel } from "../model/landmarks.js";
import type { AppState, Display, Item } from "../model/state.js";
import type { Store } from "../model/store.js";
import { chainPaths } from "../view3d/geometry.js";
import { LayoutView } from "../view3d/layout_view.js";
import type { MeshView, Sighting } from "../view3d/mesh_view.js";
import { pictureOf } from "../view3d/picture.js";
import { TargetView } from "../view3d/target_view.js";
import { element, setText } from "./dom.js";
import { mapStage, shownMap } from "./map_stage.js";
import { placesOfProblems } from "./places.js";
import { bannerWhilePlacing, keysInTarget } from "./placing.js";
import { selectionCard } from "./selection.js";
import { onThemeChange } from "./theme.js";
import { viewKeys } from "./view_keys.js";

/** In the order in which they are offered. */
const pathShapes = Object.keys(shapeWords) as PathShape[];

/** What shortcuts do in the views. */
export interface Stage {
    fit(): void;
    reset(): void;
    /** Takes the chosen landmark off the target. */
    remove(): void;
    /** Stops placing landmarks; chooses nothing. */
    stop(): void;
    screenshot(): Promise<Blob>;
}

/** The 3D views, what the pointer and keys do in them, and the options beside them. */
export function stage(store: Store<AppState>, actions: Actions): Stage {
    const editor = actions.landmarks;
    const highlight = (sighting: Sighting | null) => actions.highlight(sighting?.item ?? null);
    const targetView = new TargetView(
        element("target-view", HTMLElement),
        `Target in 3D. ${viewKeys} Enter places a landmark in the middle, Shift and arrow keys move the chosen one.`,
        {
            hover: (sighting) => {
                highlight(sighting);
                const { placing } = store.get();
                const vertex = sighting?.item?.kind === "vertex" ? null : sighting?.vertex;
                targetView.setGhost(placing ?? 0, placing === null ? null : (vertex ?? null));
            },
            click: ({ item, vertex }) => {
                const { placing } = store.get();
                if (placing === null || item?.kind === "vertex") actions.select(item);
                else if (vertex !== null) editor.placeOn(vertex);
            },
            drag: (id, vertex) => editor.drag(id, vertex),
            dragEnd: () => editor.endDrag(),
        },
    );
    const layoutView = new LayoutView(
        element("layout-view", HTMLElement),
        `Layout in 3D. ${viewKeys}`,
        {
            hover: highlight,
            click: ({ item }) => {
                if (item?.kind === "vertex" && !store.get().making) editor.startPlacing(item.id);
                else actions.select(item);
            },
        },
    );
    let compareView: TargetView | null = null;
    const views: MeshView[] = [targetView, layoutView];
    link(views, store);
    onThemeChange(store, () => {
        for (const view of views) view.applyTheme();
        if (!shownMap(store.get())) targetView.setSurface(...surfaceOf(store.get()));
        compareView?.setSurface(...compareSurface(store.get()));
    });

    store.watch(
        (state) => [state.target],
        (target) => targetView.setTarget(target),
    );
    store.watch(
        (state) => [state.layout],
        (layout) => layoutView.setLayout(layout),
    );
    store.watch(surfaceInputs, () => {
        if (!shownMap(store.get())) targetView.setSurface(...surfaceOf(store.get()));
    });
    store.watch(
        (state) => [state.follow !== null],
        (follows) => targetView.setStale(follows),
    );
    store.watch(
        (state) => [state.target, state.landmarks],
        (_, landmarks) => targetView.setLandmarks(landmarks),
    );
    store.watch(
        (state) => [state.layout, state.landmarks],
        (_, landmarks) => layoutView.setLandmarks(landmarks),
    );
    let drawn: EmbedResult | null = null;
    store.watch(
        (state) => [
            state.result,
            state.preview,
            state.follow,
            state.livePaths,
            state.step,
            state.trace,
            state.candidates,
            state.candidates?.shown ? state.selected : null,
            shownQuads(state),
            shownMap(state) !== null,
        ],
        () => {
            const state = store.get();
            const paths = pathsOf(state);
            const before = drawn;
            drawn = shownResult(state);
            const { candidates, selected } = state;
            if (candidates?.shown) targetView.setPaths(paths, inTheWay(candidates.found, selected));
            else if (paths && isReshaped(before, drawn) && !wantsStillness())
                targetView.glideTo(paths);
            else targetView.setPaths(paths);
        },
    );
    store.watch(
        (state) => [state.highlight, state.selected, state.placing],
        (pointed, selected, placing) => {
            const chosen: Item | null = placing === null ? null : { kind: "vertex", id: placing };
            for (const view of views) view.highlight(pointed ?? chosen ?? selected);
            setText("target-hover", pointed ? describe(pointed, store.get()) : "");
            targetView.viewer.canvas.classList.toggle("placing", placing !== null);
            if (placing === null) targetView.setGhost(0, null);
        },
    );
    store.watch(
        (state) => [state.comparison, state.result],
        (comparison, result) => {
            const shown = comparison?.shown ?? null;
            const figure = element("compare-view", HTMLElement);
            if (shown === null) return;
            if (!compareView) {
                compareView = new TargetView(figure, `Heuristic in 3D. ${viewKeys}`, {
                    hover: highlight,
                    click: ({ item }) => actions.select(item),
                });
                compareView.applyTheme();
                views.push(compareView);
                link(views, store);
            }
            const { target, landmarks, display } = store.get();
            const other = comparison?.contenders[shown]?.result ?? null;
            compareView.setTarget(target);
            compareView.setSurface(...compareSurface(store.get()));
            compareView.setLandmarks(landmarks);
            compareView.setPaths(
                chainsOf(other),
                other && result ? visibleDetours(other, result) : new Set(),
            );
            compareView.setWireframe(display.wireframe);
            compareView.setPathsVisible(display.pathsShown);
            compareView.setDotsVisible(display.dotsShown);
            compareView.viewer.setParallel(display.orthographic);
            compareView.viewer.setPose(targetView.viewer.pose());
        },
    );
    store.watch(
        (state) => [state.display.layoutShown, state.comparison, state.tab === "map"],
        (shown, comparison, mapping) => {
            const comparing = comparison !== null && comparison.shown !== null;
            const two = comparing || mapping;
            element("layout-view", HTMLElement).hidden = !shown || two;
            element("compare-view", HTMLElement).hidden = !comparing || mapping;
            const main = element("stage", HTMLElement);
            main.classList.toggle("alone", !shown && !two);
            main.classList.toggle("comparing", two);
        },
    );
    let secondView: TargetView | null = null;
    mapStage(store, actions, targetView, (view) => {
        secondView = view;
        views.push(view);
        link(views, store);
        const { display } = store.get();
        view.setWireframe(display.wireframe);
        view.setDotsVisible(display.dotsShown);
        view.viewer.setParallel(display.orthographic);
    });
    bannerWhilePlacing(store, actions);
    selectionCard(store, actions);
    placesOfProblems(store, actions, targetView);
    keysInTarget(store, actions, targetView);

    const each = (act: (view: MeshView) => void) => () => views.forEach(act);
    const fit = each((view) => view.viewer.fit());
    const reset = each((view) => view.viewer.resetView());
    element("fit-view", HTMLButtonElement).addEventListener("click", fit);
    element("reset-view", HTMLButtonElement).addEventListener("click", reset);
    checkbox("show-patches", "patchesShown");
    checkbox("show-paths", "pathsShown", (on) => views.forEach((view) => view.setPathsVisible(on)));
    checkbox("show-dots", "dotsShown", (on) => views.forEach((view) => view.setDotsVisible(on)));
    checkbox("show-wireframe", "wireframe", (on) => {
        for (const view of views) if (view !== layoutView) view.setWireframe(on);
    });
    checkbox("show-layout", "layoutShown");
    checkbox("link-cameras", "camerasLinked");
    const shape = element("shape", HTMLSelectElement);
    shape.append(...pathShapes.map((name) => new Option(shapeWords[name], name)));
    shape.addEventListener("change", () => {
        const chosen = pathShapes.find((name) => name === shape.value);
        if (chosen) actions.setShape(chosen);
    });
    store.watch(
        (state) => [state.options.shape],
        (name) => {
            shape.value = name;
        },
    );
    checkbox("orthographic", "orthographic", (on) =>
        views.forEach((view) => view.viewer.setParallel(on)),
    );
    const clip = element("clip", HTMLInputElement);
    clip.addEventListener("input", () => actions.show({ clip: clip.valueAsNumber }));
    store.watch(
        (state) => [state.display.clip, state.target],
        (share, _target) => {
            clip.value = String(share);
            clip.setAttribute(
                "aria-valuetext",
                share === 0 ? "nothing cut away" : `${formatPercent(share)} cut away`,
            );
            targetView.setClip(share);
        },
    );
    return {
        fit,
        reset,
        remove: () => {
            const { selected, placing } = store.get();
            const id = selected?.kind === "vertex" ? selected.id : placing;
            if (id !== null) editor.remove(id);
        },
        stop: () => {
            editor.startPlacing(null);
            actions.select(null);
        },
        screenshot: () => {
            const { tab } = store.get();
            const seen = tab === "map" && secondView ? [targetView, secondView] : [targetView];
            return pictureOf(seen.map(({ viewer }) => viewer));
        },
    };

    function checkbox(
        id: string,
        field: { [F in keyof Display]: Display[F] extends boolean ? F : never }[keyof Display],
        apply: (on: boolean) => void = () => undefined,
    ): void {
        const box = element(id, HTMLInputElement);
        box.addEventListener("change", () => actions.show({ [field]: box.checked }));
        store.watch(
            (state) => [state.display[field]],
            (on) => {
                box.checked = on;
                apply(on);
            },
        );
    }
}

/** Cameras that follow each other, while they are linked. */
function link(views: readonly MeshView[], store: Store<AppState>): void {
    for (const view of views)
        view.viewer.onPoseChange = () => {
            if (!store.get().display.camerasLinked) return;
            for (const other of views) if (other !== view) other.viewer.setPose(view.viewer.pose());
        };
}

/** Of the candidate paths, those in conflict: with the chosen one, or with any. */
const inTheWay = (candidates: CandidatePaths, selected: Item | null): ReadonlySet<number> =>
    selected?.kind === "edge"
        ? new Set(opponentsOf(candidates, selected.id))
        : edgesInConflict(candidates);

/** The embedding whose patches and paths are shown; null for none. */
const shownResult = ({
    result,
    preview,
    follow,
    step,
    candidates,
}: AppState): EmbedResult | null =>
    step === null && !candidates?.shown && !follow ? (result ?? preview) : null;

/** Its patches; those from before, while only the paths follow a landmark. */
const shownPatches = (state: AppState): RefinedMesh | null =>
    shownResult({ ...state, follow: null })?.refined ?? null;

/** Whether one is the other in another shape: the same search made both. */
const isReshaped = (before: EmbedResult | null, now: EmbedResult | null): boolean =>
    before?.refined !== now?.refined &&
    before?.exactCost === now?.exactCost &&
    before?.counters.work === now?.counters.work;

const wantsStillness = () => matchMedia("(prefers-reduced-motion: reduce)").matches;

/** What the target's surface is made from: building it anew is dear, so nothing else counts. */
const surfaceInputs = (state: AppState) =>
    [
        state.target,
        state.display.patchesShown ? shownPatches(state) : null,
        state.layout,
        shownQuads(state),
        // Patches come back when the map goes.
        shownMap(state) !== null,
    ] as const;

function surfaceOf(state: AppState): [RefinedMesh | null, AppState["layout"], QuadMesh | null] {
    const [, refined, layout, quads] = surfaceInputs(state);
    return [refined, layout, quads];
}

/** The quad mesh that is shown instead of patches and paths; null for none. */
const shownQuads = ({ tab, quadMesh }: AppState): QuadMesh | null =>
    tab === "quads" ? quadMesh.mesh : null;

function compareSurface({
    comparison,
    layout,
    display,
}: AppState): [RefinedMesh | null, AppState["layout"]] {
    const result = comparison?.contenders[comparison.shown ?? -1]?.result ?? null;
    return [display.patchesShown ? (result?.refined ?? null) : null, layout];
}

function chainsOf(result: EmbedResult | null): Polylines | null {
    return result?.refined ? chainPaths(result.edges, result.refined) : null;
}

function pathsOf(state: AppState): Polylines | null {
    const { step, trace, livePaths, candidates, follow, layout } = state;
    // The optimised map has moved the paths.
    if (shownMap(state)) return null;
    const quads = shownQuads(state);
    if (quads)
        return chainPaths(
            quads.chains.slice(0, layout?.edgeCount).map((chain, id) => ({ id, chain })),
            quads,
        );
    if (step !== null) return trace.incumbents[step]?.paths ?? null;
    if (candidates?.shown) return candidates.found.paths;
    return follow?.paths ?? chainsOf(shownResult(state)) ?? livePaths;
}

function describe(item: Item, state: AppState): string {
    const { layout, landmarks } = state;
    if (item.kind === "vertex") {
        const vertex = landmarks?.places[item.id];
        return (
            `Landmark ${landmarkLabel(landmarks, item.id)}` +
            (vertex === null || vertex === undefined ? ", missing" : ` on target vertex ${vertex}`)
        );
    }
    if (item.kind === "face") return `Patch ${item.id}`;
    const ends = layout ? [...layout.edges.subarray(2 * item.id, 2 * item.id + 2)] : [];
    const length = shownResult(state)?.edges[item.id]?.length;
    return (
        `Edge ${item.id}, from ${ends.join(" to ")}` +
        (length === undefined ? "" : `, ${formatLength(length)} long`)
    );
}
