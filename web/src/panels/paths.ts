import type { Actions } from "../model/actions.js";
import { formatPercent } from "../model/describe.js";
import type { AppState } from "../model/state.js";
import type { Store } from "../model/store.js";
import { element, setText } from "./dom.js";

/** What paths cost, and where they have to run: each change is an edit and solves anew. */
export function pathsPanel(store: Store<AppState>, actions: Actions): void {
    const features = element("features", HTMLInputElement);
    const show = (discount: number) => {
        const words = discount === 0 ? "off" : formatPercent(discount);
        setText("features-text", words);
        features.setAttribute(
            "aria-valuetext",
            discount === 0 ? "off" : `up to ${words} less along sharp edges`,
        );
    };
    // Shown while it is pulled; solved when it is let go.
    features.addEventListener("input", () => show(features.valueAsNumber / 100));
    features.addEventListener("change", () => {
        const featureDiscount = features.valueAsNumber / 100;
        if (featureDiscount !== store.get().options.featureDiscount)
            actions.setPathSettings({ featureDiscount });
    });
    const follow = element("boundary-edges", HTMLInputElement);
    follow.addEventListener("change", () =>
        actions.setPathSettings({ boundaryEdges: follow.checked ? "follow" : "free" }),
    );
    store.watch(
        (state) => [state.options.featureDiscount, state.options.boundaryEdges, state.target],
        (discount, boundaryEdges, target) => {
            features.value = String(Math.round(100 * discount));
            show(discount);
            follow.checked = boundaryEdges === "follow";
            // Without a boundary there is nothing to follow; what was asked for is shown all the same.
            const isOpen = (target?.boundaryLoopCount ?? 0) > 0;
            element("boundary-row", HTMLElement).hidden = !isOpen && !follow.checked;
        },
    );
}
