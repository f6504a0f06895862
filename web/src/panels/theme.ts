import type { Actions } from "../model/actions.js";
import type { AppState, Theme } from "../model/state.js";
import type { Store } from "../model/store.js";
import { element } from "./dom.js";

const place = "layout-embedding-theme";
const isTheme = (text: string | null): text is Theme => /^(system|light|dark)$/.test(text ?? "");

/** Light, dark, or as the system is; remembered in this browser. */
export function themePanel(store: Store<AppState>, actions: Actions): void {
    const select = element("theme", HTMLSelectElement);
    const remembered = readTheme();
    if (remembered) actions.show({ theme: remembered });
    select.addEventListener("change", () => {
        if (isTheme(select.value)) actions.show({ theme: select.value });
    });
    store.watch(
        (state) => [state.display.theme],
        (theme) => {
            select.value = theme;
            document.documentElement.dataset["theme"] = theme;
            try {
                localStorage.setItem(place, theme);
            } catch {
                // Storage may be closed to the page: then it forgets.
            }
        },
    );
}

function readTheme(): Theme | null {
    try {
        const text = localStorage.getItem(place);
        return isTheme(text) ? text : null;
    } catch {
        return null;
    }
}

/** Calls `listener` whenever the page's colours have changed. */
export function onThemeChange(store: Store<AppState>, listener: () => void): void {
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", listener);
    store.watch(
        (state) => [state.display.theme],
        () => listener(),
    );
}
