import type { Actions } from "../model/actions.js";
import { tabs, type AppState } from "../model/state.js";
import type { Store } from "../model/store.js";
import { element } from "./dom.js";

/** What a tab has to say: its own words, or what it waits for while there is no embedding. */
export function tabWords({ result, activity }: AppState, own: string, missing: string): string {
    if (result?.refined) return own;
    return activity ? `${activity.phase} …` : missing;
}

/** The tabs above the controls: arrow keys go from one to the next, as everywhere. */
export function tabList(store: Store<AppState>, actions: Actions): void {
    const buttons = tabs.map((tab) => element(`tab-${tab}`, HTMLButtonElement));
    buttons.forEach((button, place) => {
        const goTo = (other: number) => {
            const next = (other + tabs.length) % tabs.length;
            actions.openTab(tabs[next]!);
            buttons[next]!.focus();
        };
        button.addEventListener("click", () => actions.openTab(tabs[place]!));
        button.addEventListener("keydown", ({ key }) => {
            if (key === "ArrowRight") goTo(place + 1);
            else if (key === "ArrowLeft") goTo(place - 1);
            else if (key === "Home") goTo(0);
            else if (key === "End") goTo(-1);
        });
    });
    store.watch(
        (state) => [state.tab],
        (open) => {
            tabs.forEach((tab, place) => {
                buttons[place]!.setAttribute("aria-selected", String(tab === open));
                buttons[place]!.tabIndex = tab === open ? 0 : -1;
                element(`${tab}-tab`, HTMLElement).hidden = tab !== open;
            });
        },
    );
}
