import type { Actions } from "../model/actions.js";
import { formatCount } from "../model/describe.js";
import { countPlaced } from "../model/landmarks.js";
import type { AppState } from "../model/state.js";
import type { Store } from "../model/store.js";
import { create, element, setText } from "./dom.js";

/** Files, layouts made here, and what was noticed about them. */
export function inputPanel(
    store: Store<AppState>,
    actions: Actions,
    openFiles: (files: readonly File[]) => void,
): void {
    const onFiles = (id: string, open: (files: readonly File[]) => void) => {
        const input = element(id, HTMLInputElement);
        input.addEventListener("change", () => {
            const files = [...(input.files ?? [])];
            // So that choosing the same file again counts as a change.
            input.value = "";
            if (files.length > 0) open(files);
        });
    };
    onFiles("any-file", openFiles);
    onFiles("layout-file", ([file]) => file && void actions.openAs("layout", file));
    onFiles("target-file", ([file]) => file && void actions.openAs("target", file));
    onFiles("landmarks-file", ([file]) => file && void actions.openLandmarks(file));

    const onClick = (id: string, act: () => void) => {
        const button = element(id, HTMLButtonElement);
        button.addEventListener("click", act);
        return button;
    };
    const swap = onClick("swap", () => void actions.swap());
    const make = ["make-layout", "make-layout-2"].map((id) =>
        onClick(id, () => void actions.setMaking(true)),
    );
    const done = onClick("making-done", () => void actions.setMaking(false));
    onClick("making-cancel", () => actions.landmarks.clear());
    const repair = element("repair", HTMLInputElement);
    repair.addEventListener("change", () => actions.setRepair(repair.checked));
    const quads = element("quads", HTMLInputElement);
    quads.addEventListener("change", () => actions.setQuads(quads.checked));

    store.watch(
        (state) => [state.layout, state.target],
        (layout, target) => {
            setText("layout-name", layout?.name ?? "none");
            setText("target-name", target?.name ?? "none");
            const parts = layout && [
                formatCount(layout.vertexCount, "vertex", "vertices"),
                formatCount(layout.edgeCount, "edge"),
                formatCount(layout.faceCount, "face"),
            ];
            setText("layout-caption", parts?.join(", ") ?? "");
            setText("target-caption", target ? formatCount(target.faceCount, "triangle") : "");
            element("target-empty", HTMLElement).hidden = target !== null;
            swap.disabled = !layout || !target;
        },
    );
    store.watch(
        (state) => [state.layout, state.target, state.making, state.makingHint, state.landmarks],
        (layout, target, making, hint, landmarks) => {
            for (const button of make) button.disabled = !target;
            make[1]!.hidden = making;
            element("make-layout", HTMLElement).hidden = making;
            element("layout-empty", HTMLElement).hidden = layout !== null;
            element("making", HTMLElement).hidden = !making;
            done.disabled = !layout;
            const count = landmarks ? countPlaced(landmarks) : 0;
            const words = makingWords(count, layout !== null, hint);
            setText("making-text", making ? words : "");
            setText("layout-hint", making ? words : target ? "No layout yet." : "");
        },
    );
    store.watch(
        (state) => [state.landmarks],
        (landmarks) => {
            setText("landmarks-name", landmarks ? landmarkWords(landmarks) : "none");
        },
    );
    store.watch(
        (state) => [state.repair, state.quads],
        (repairs, withQuads) => {
            repair.checked = repairs;
            quads.checked = withQuads;
        },
    );
    store.watch(
        (state) => [state.notices],
        (notices) => {
            element("notices", HTMLElement).replaceChildren(
                ...notices.map((notice) => create("li", notice)),
            );
        },
    );
}

function landmarkWords(landmarks: NonNullable<AppState["landmarks"]>): string {
    const count = landmarks.places.length;
    const placed = countPlaced(landmarks);
    return placed === count
        ? `${count}, ${landmarks.source}`
        : `${placed} of ${count}, ${landmarks.source}`;
}

function makingWords(count: number, made: boolean, hint: string | null): string {
    if (made)
        return `Layout of ${formatCount(count, "landmark")}. Click on the target to add more, drag to move.`;
    if (hint && count >= 4) return hint;
    return count === 0
        ? "Click on the target to place landmarks: tips, joints, corners. Four or more make a layout."
        : `${formatCount(count, "landmark")} so far. Click on the target to add more.`;
}
