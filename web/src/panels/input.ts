import { examples } from "../examples/index.js";
import type { Actions } from "../model/actions.js";
import { formatCount } from "../model/describe.js";
import type { AppState } from "../model/state.js";
import type { Store } from "../model/store.js";
import { create, element, setText } from "./dom.js";

/** Examples, files, landmarks. */
export function inputPanel(store: Store<AppState>, actions: Actions): void {
    const select = element("example", HTMLSelectElement);
    select.append(...examples.map(({ title }, i) => new Option(title, String(i))));
    const own = new Option("Your files", "");
    own.hidden = true;
    select.append(own);
    select.addEventListener("change", () => {
        const example = examples[Number(select.value)];
        if (example) void actions.openExample(example);
    });

    const onFiles = (id: string, open: (files: readonly File[]) => void) => {
        const input = element(id, HTMLInputElement);
        input.addEventListener("change", () => {
            const files = [...(input.files ?? [])];
            // So that choosing the same file again counts as a change.
            input.value = "";
            if (files.length === 0) return;
            select.value = "";
            open(files);
        });
    };
    onFiles("any-file", (files) => void actions.openFiles(files));
    onFiles("layout-file", ([file]) => file && void actions.openAs("layout", file));
    onFiles("target-file", ([file]) => file && void actions.openAs("target", file));
    onFiles("landmarks-file", ([file]) => file && void actions.openLandmarks(file));

    const proximity = element("proximity", HTMLButtonElement);
    proximity.addEventListener("click", () => void actions.landmarksByProximity());
    const swap = element("swap", HTMLButtonElement);
    swap.addEventListener("click", () => void actions.swap());
    const repair = element("repair", HTMLInputElement);
    repair.addEventListener("change", () => actions.setRepair(repair.checked));

    store.watch(
        (state) => [state.layout, state.target],
        (layout, target) => {
            setText("layout-name", layout?.name ?? "none");
            setText("target-name", target?.name ?? "none");
            setText(
                "layout-caption",
                layout
                    ? `${formatCount(layout.vertexCount, "vertex").replace("vertexs", "vertices")}, ${formatCount(layout.edgeCount, "edge")}, ${formatCount(layout.faceCount, "face")}`
                    : "",
            );
            setText("target-caption", target ? formatCount(target.faceCount, "triangle") : "");
            element("target-empty", HTMLElement).hidden = target !== null;
            proximity.disabled = swap.disabled = !layout || !target;
        },
    );
    store.watch(
        (state) => [state.landmarks],
        (landmarks) => {
            setText(
                "landmarks-name",
                landmarks ? `${landmarks.ids.length}, ${landmarks.source}` : "none",
            );
        },
    );
    store.watch(
        (state) => [state.repair],
        (on) => {
            repair.checked = on;
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
