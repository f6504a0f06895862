import type { LandmarkDoubt } from "layout-embedding";
import type { Actions } from "../model/actions.js";
import { sentence } from "../model/describe.js";
import type { AppState } from "../model/state.js";
import type { Store } from "../model/store.js";
import { create, element } from "./dom.js";

/** What the input may have meant instead, each with a button that changes it so. */
export function doubtsPanel(store: Store<AppState>, actions: Actions): void {
    const list = element("doubts", HTMLElement);
    store.watch(
        (state) => [state.result?.doubts],
        (doubts = []) => {
            const hadFocus = list.contains(document.activeElement);
            list.replaceChildren(...doubts.map((doubt) => note(doubt, actions)));
            if (hadFocus) element("solve", HTMLElement).focus();
        },
    );
}

function note(doubt: LandmarkDoubt, actions: Actions): HTMLElement {
    const box = create("div", "", "doubt");
    const mend = create(
        "button",
        doubt.vertices ? "Exchange these landmarks" : "Turn the layout inside out",
    );
    mend.type = "button";
    mend.addEventListener("click", () => actions.mend(doubt));
    const buttons = create("div", "", "buttons");
    buttons.append(mend);
    box.append(create("p", sentence(doubt.message)), buttons);
    return box;
}
