import type { Actions } from "../model/actions.js";
import { formatGap, formatLength, formatSeconds, statusWords } from "../model/describe.js";
import type { AppState, BatchEntry } from "../model/state.js";
import type { Store } from "../model/store.js";
import { create, download, element, setText } from "./dom.js";
import { zipped } from "./downloads.js";

/** A dialog for one layout in many targets; returns what takes dropped files while it is open. */
export function batchPanel(
    store: Store<AppState>,
    actions: Actions,
): (files: readonly File[]) => boolean {
    const dialog = element("batch", HTMLDialogElement);
    const onClick = (id: string, act: () => void) => {
        const button = element(id, HTMLButtonElement);
        button.addEventListener("click", act);
        return button;
    };
    const open = onClick("batch-button", () => dialog.showModal());
    const cancel = onClick("batch-cancel", () => actions.cancelBatch());
    const save = onClick("batch-zip", () => {
        zipped(actions.batchFiles()).then(
            (zip) => download("batch.zip", zip),
            (error: unknown) => actions.report(error),
        );
    });
    const start = (files: readonly File[]) => void actions.runBatch(files);
    const input = element("batch-files", HTMLInputElement);
    input.addEventListener("change", () => {
        const files = [...(input.files ?? [])];
        input.value = "";
        start(files);
    });

    store.watch(
        (state) => [state.layout],
        (layout) => {
            open.disabled = !layout;
            setText("batch-layout", layout?.name ?? "");
        },
    );
    store.watch(
        (state) => [state.batch],
        (batch) => {
            const entries = batch?.entries ?? [];
            element("batch-result", HTMLElement).hidden = !batch;
            cancel.disabled = !batch?.running;
            save.disabled = !entries.some(({ figures }) => typeof figures?.length === "number");
            setText("batch-note", batch?.note ?? "");
            const over = entries.filter(({ state }) => state === "done" || state === "failed");
            setText(
                "batch-count",
                !batch
                    ? ""
                    : `${over.length} of ${entries.length} done` +
                          (batch.running ? " …" : ", with the layout " + batch.layoutName),
            );
            element("batch-rows", HTMLTableSectionElement).replaceChildren(
                ...entries.map((entry) =>
                    row(entry, () => {
                        dialog.close();
                        void actions.openTarget(entry.target, entry.landmarks);
                    }),
                ),
            );
        },
    );
    return (files) => {
        if (dialog.open) start(files);
        return dialog.open;
    };
}

function row(entry: BatchEntry, open: () => void): HTMLElement {
    const { target, landmarks, state, figures } = entry;
    const line = create("tr");
    const head = create("th", target.name);
    head.scope = "row";
    const embedded = figures !== null && figures.length !== null;
    const cells = [
        landmarks?.name ?? "by proximity",
        outcome(entry),
        embedded ? formatLength(figures.cost) : "–",
        embedded ? formatGap(figures.gap) : "–",
        embedded && figures.length !== null ? formatLength(figures.length) : "–",
        figures ? formatSeconds(figures.seconds) : "–",
    ];
    const button = create("button", "Open");
    button.type = "button";
    button.setAttribute("aria-label", `Open ${target.name}`);
    button.disabled = state === "waiting" || state === "running";
    button.addEventListener("click", open);
    const last = create("td");
    last.append(button);
    line.append(
        head,
        ...cells.map((text, place) => create("td", text, place === 1 ? "" : "whole")),
        last,
    );
    line.classList.toggle("failed", state === "failed");
    return line;
}

function outcome({ state, figures, error }: BatchEntry): string {
    if (state === "waiting") return "waits";
    if (state === "running") return "is being solved …";
    return figures ? statusWords[figures.status] : (error ?? "failed");
}
