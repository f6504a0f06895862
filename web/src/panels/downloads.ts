import type { Actions } from "../model/actions.js";
import type { AppState } from "../model/state.js";
import type { Store } from "../model/store.js";
import { download, element } from "./dom.js";

/** Buttons for the result's files and a picture; returns what the shortcut does. */
export function downloadsPanel(
    store: Store<AppState>,
    actions: Actions,
    screenshot: () => Promise<Blob>,
): () => void {
    const save = async (wanted: (name: string) => boolean) => {
        const files = await actions.exportFiles();
        for (const [name, bytes] of Object.entries(files))
            if (wanted(name))
                download(name, new Blob([new Uint8Array(bytes)], { type: typeOf(name) }));
    };
    const buttons = [...document.querySelectorAll<HTMLButtonElement>("button[data-file]")];
    for (const button of buttons)
        button.addEventListener(
            "click",
            () => void save((name) => name === button.dataset["file"]),
        );
    element("screenshot", HTMLButtonElement).addEventListener("click", () => {
        screenshot().then(
            (picture) => download("embedding.png", picture),
            (error: unknown) => actions.report(error),
        );
    });
    store.watch(
        (state) => [state.result],
        (result) => {
            for (const button of buttons) button.disabled = !result?.refined;
        },
    );
    return () => {
        if (store.get().result?.refined) void save(() => true);
    };
}

const typeOf = (name: string) => (name.endsWith(".json") ? "application/json" : "model/obj");
