import type { Actions } from "../model/actions.js";
import type { FacePoint, Side } from "../model/correspondence.js";
import { formatCount } from "../model/describe.js";
import { placedLandmarks } from "../model/landmarks.js";
import { shownTexture } from "../model/maps.js";
import type { AppState } from "../model/state.js";
import type { Store } from "../model/store.js";
import { carriedColors } from "../view3d/carried_surface.js";
import type { Sighting } from "../view3d/mesh_view.js";
import { TargetView } from "../view3d/target_view.js";
import { element, setText } from "./dom.js";
import { arrowSteps, viewKeys } from "./view_keys.js";

/** The map that is shown on both targets; null for none. */
export const shownMap = ({ tab, map }: AppState) => (tab === "map" ? map.map : null);

/**
 * The second target beside the first one while the map's tab is open, what the map carries on both,
 * and the cursor on both. `opened` is told of the second view when it is made.
 */
export function mapStage(
    store: Store<AppState>,
    actions: Actions,
    first: TargetView,
    opened: (view: TargetView) => void,
): void {
    const figure = element("map-view", HTMLElement);
    let second: TargetView | null = null;
    const point = (from: Side) => (sighting: Sighting | null) => {
        const view = from === "a" ? first : second;
        const at: FacePoint | null = sighting?.hit ? (view?.pointAt(sighting.hit) ?? null) : null;
        if (store.get().tab === "map" && at) actions.map.pointAt(from, at);
    };
    first.onSight = point("a");
    cursorKeys(store, actions, first, "a");
    store.watch(
        (state) => [state.tab],
        (tab) => {
            figure.hidden = tab !== "map";
            if (tab !== "map" || second) return;
            second = new TargetView(
                figure,
                `Second target in 3D. ${viewKeys} Shift and arrow keys move the cursor from vertex to vertex.`,
                { hover: () => undefined, click: () => undefined },
            );
            second.applyTheme();
            second.onSight = point("b");
            cursorKeys(store, actions, second, "b");
            opened(second);
            showTarget();
            draw();
        },
    );
    const showTarget = () => {
        const { target, landmarks } = store.get().map;
        element("map-empty", HTMLElement).hidden = target !== null;
        setText(
            "map-caption",
            target ? `${target.name}, ${formatCount(target.faceCount, "triangle")}` : "",
        );
        second?.setTarget(target);
        second?.setSurface(null, null);
        second?.setLandmarks(
            landmarks && placedLandmarks(landmarks, "", store.get().landmarks?.names),
        );
        second?.viewer.setPose(first.viewer.pose());
    };
    store.watch((state) => [state.map.target, state.map.landmarks], showTarget);
    const draw = () => {
        const state = store.get();
        const map = shownMap(state);
        const texture = shownTexture(state.map);
        if (!map || !state.layout) {
            second?.setSurface(null, null);
            return;
        }
        const carried = {
            texture,
            colors: carriedColors(map, state.layout, texture),
            coordinates: state.map.coordinates,
        };
        first.setCarried(map, "a", carried);
        second?.setCarried(map, "b", carried);
    };
    // After the first view has drawn what it shows without a map.
    store.watch((state) => [shownMap(state), shownTexture(state.map), state.target], draw);
    store.watch(
        (state) => [state.tab === "map" ? state.map.cursor : null],
        (cursor) => {
            first.setCursor(cursor?.a ?? null);
            second?.setCursor(cursor?.b ?? null);
        },
    );
}

/** The cursor from vertex to vertex, beginning in the middle of the view. */
function cursorKeys(store: Store<AppState>, actions: Actions, view: TargetView, side: Side): void {
    // On its way down: before landmarks are moved by the same keys.
    view.viewer.canvas.parentElement?.addEventListener(
        "keydown",
        (event) => {
            const { tab, map } = store.get();
            const step = event.shiftKey ? arrowSteps[event.key] : undefined;
            if (tab !== "map" || !step || event.target !== view.viewer.canvas) return;
            event.preventDefault();
            event.stopPropagation();
            const { cursor } = map;
            const from = cursor?.from === side ? cursor.vertex : null;
            const next =
                from === null ? view.vertexInTheMiddle() : view.neighbour(from, ...step, false);
            if (next !== null) actions.map.pointAtVertex(side, next);
        },
        { capture: true },
    );
}
