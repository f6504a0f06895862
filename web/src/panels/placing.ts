import type { Actions } from "../model/actions.js";
import { landmarkLabel } from "../model/landmarks.js";
import type { AppState } from "../model/state.js";
import type { Store } from "../model/store.js";
import type { TargetView } from "../view3d/target_view.js";
import { element, setText } from "./dom.js";
import { arrowSteps } from "./view_keys.js";

/** Says which landmark the next click places. */
export function bannerWhilePlacing(store: Store<AppState>, actions: Actions): void {
    const banner = element("placing", HTMLElement);
    element("placing-stop", HTMLButtonElement).addEventListener("click", () =>
        actions.landmarks.startPlacing(null),
    );
    store.watch(
        (state) => [state.placing, state.landmarks, state.making],
        (placing, landmarks, making) => {
            const begins = banner.hidden && placing !== null;
            banner.hidden = placing === null;
            if (placing === null) return;
            // On a phone the target may be far above the button.
            if (begins) element("target-view", HTMLElement).scrollIntoView({ block: "nearest" });
            const label = landmarkLabel(landmarks, placing);
            setText(
                "placing-text",
                making ? `Click to add landmark ${label}` : `Click where landmark ${label} goes`,
            );
        },
    );
}

/** Landmarks by keyboard, in the target's view. */
export function keysInTarget(store: Store<AppState>, actions: Actions, view: TargetView): void {
    const editor = actions.landmarks;
    const { canvas } = view.viewer;
    /** Shows where Enter would place the landmark, to those who work with the keys. */
    const aim = () => {
        const { placing } = store.get();
        if (placing !== null && canvas.matches(":focus-visible"))
            view.setGhost(placing, view.vertexInTheMiddle());
    };
    canvas.addEventListener("focus", aim);
    store.watch((state) => [state.placing, state.landmarks], aim);
    // After the view itself has turned.
    canvas.addEventListener("keydown", aim);
    canvas.addEventListener("keydown", (event) => {
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        const { landmarks, selected, placing } = store.get();
        const step = event.shiftKey ? arrowSteps[event.key] : undefined;
        if (step && selected?.kind === "vertex") {
            const vertex = landmarks?.places[selected.id];
            const next =
                vertex === null || vertex === undefined ? null : view.neighbour(vertex, ...step);
            if (next !== null) editor.place(selected.id, next);
        } else if (event.key === "Enter" && placing !== null) {
            const vertex = view.vertexInTheMiddle();
            if (vertex !== null) editor.placeOn(vertex);
        } else {
            return;
        }
        event.preventDefault();
    });
}
