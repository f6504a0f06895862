import type { Actions } from "../model/actions.js";
import { candidateWords } from "../model/describe.js";
import type { AppState } from "../model/state.js";
import type { Store } from "../model/store.js";
import { element, setText } from "./dom.js";

/** The paths that the edges would take alone, instead of the embedding's, and what they tell. */
export function candidatesPanel(store: Store<AppState>, actions: Actions): void {
    const button = element("candidates", HTMLButtonElement);
    button.addEventListener("click", () => void actions.toggleCandidates());
    store.watch(
        (state) => [state.result, state.activity, state.candidates],
        (result, activity, candidates) => {
            const shown = candidates?.shown ?? false;
            button.disabled = !result?.refined || activity !== null;
            button.setAttribute("aria-pressed", String(shown));
            setText(
                "candidates-text",
                shown && candidates && result ? candidateWords(candidates.found, result) : "",
            );
        },
    );
}
