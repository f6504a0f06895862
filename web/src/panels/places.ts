import type { Actions } from "../model/actions.js";
import type { AppState } from "../model/state.js";
import type { Store } from "../model/store.js";
import { PlaceView } from "../view3d/place_view.js";
import type { TargetView } from "../view3d/target_view.js";
import { element, setText } from "./dom.js";
import { viewKeys } from "./view_keys.js";
import { onThemeChange } from "./theme.js";

/** Shows where problems lie: a refused mesh over the target's view, a landmark in that view. */
export function placesOfProblems(
    store: Store<AppState>,
    actions: Actions,
    target: TargetView,
): void {
    const figure = element("place-view", HTMLElement);
    let view: PlaceView | null = null;
    element("place-close", HTMLButtonElement).addEventListener("click", () =>
        actions.showPlace(null),
    );
    onThemeChange(store, () => view?.applyTheme());
    store.watch(
        (state) => [state.shownPlace],
        (id) => {
            const { problems, landmarks } = store.get();
            const problem = problems.find((one) => one.id === id);
            const place = problem?.place ?? null;
            figure.hidden = place?.kind !== "mesh";
            if (!problem || !place) return;
            if (place.kind === "landmarks") {
                const vertex = landmarks?.places[place.ids[0]!] ?? null;
                actions.select({ kind: "vertex", id: place.ids[0]! });
                if (vertex !== null) target.focusOn(vertex);
                return;
            }
            figure.scrollIntoView({ block: "nearest" });
            setText("place-name", `${place.name}, as it was read`);
            view ??= new PlaceView(figure, `Place of the problem in 3D. ${viewKeys}`);
            view.show(place);
        },
    );
}
