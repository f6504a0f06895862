import type { Actions } from "../model/actions.js";
import { landmarkFile } from "../model/landmark_file.js";
import { completeIds, countPlaced } from "../model/landmarks.js";
import type { AppState } from "../model/state.js";
import type { Store } from "../model/store.js";
import { dotColor } from "../view3d/colors.js";
import { create, download, element, setText } from "./dom.js";

/** Landmarks as a table: all that can be done in the views can be done here. */
export function landmarksPanel(store: Store<AppState>, actions: Actions): void {
    const editor = actions.landmarks;
    const onClick = (id: string, act: () => void) => {
        const button = element(id, HTMLButtonElement);
        button.addEventListener("click", act);
        return button;
    };
    const next = onClick("next-missing", () => editor.placeNext());
    const proximity = onClick("proximity", () => void actions.landmarksByProximity());
    const clear = onClick("clear-landmarks", () => editor.clear());
    const save = onClick("save-landmarks", () => saveLandmarks(store));
    const undo = onClick("undo", () => editor.undo());
    const redo = onClick("redo", () => editor.redo());
    const live = element("live", HTMLInputElement);
    live.addEventListener("change", () => actions.setLive(live.checked));

    const align = element("align", HTMLInputElement);
    align.addEventListener("change", () => actions.setAlign(align.checked));

    const table = element("landmark-table", HTMLDetailsElement);
    const rows: Row[] = [];
    const body = element("landmark-rows", HTMLTableSectionElement);
    const showRows = () => {
        const { landmarks, making } = store.get();
        // Rows of a closed table cost time and are of no use to anybody.
        const count = table.open ? (landmarks?.places.length ?? 0) : 0;
        while (rows.length > count) rows.pop()?.line.remove();
        while (rows.length < count) {
            const row = makeRow(rows.length, actions);
            rows.push(row);
            body.append(row.line);
        }
        rows.forEach((row, id) => {
            const vertex = landmarks?.places[id] ?? null;
            setValue(row.name, landmarks?.names[id] ?? "");
            setValue(row.vertex, vertex === null ? "" : String(vertex));
            row.remove.disabled = vertex === null;
            row.place.hidden = making;
        });
    };
    table.addEventListener("toggle", showRows);

    store.watch(
        (state) => [state.landmarks, state.layout, state.target, state.making],
        (landmarks, layout, target, making) => {
            const placed = landmarks ? countPlaced(landmarks) : 0;
            const count = landmarks?.places.length ?? 0;
            setText("landmarks-count", landmarks ? `${placed} of ${count} placed` : "");
            next.disabled = !making && (!landmarks || placed === count);
            proximity.disabled = !layout || !target || making;
            clear.disabled = placed === 0;
            save.disabled = !landmarks || completeIds(landmarks) === null;
            showRows();
        },
    );
    store.watch(
        (state) => [state.undoable, state.redoable],
        (undoable, redoable) => {
            undo.disabled = !undoable;
            redo.disabled = !redoable;
        },
    );
    store.watch(
        (state) => [state.live, state.align],
        (follows, aligns) => {
            live.checked = follows;
            align.checked = aligns;
        },
    );
    store.watch(
        (state) => [state.announcement],
        (text) => setText("announcement", text),
    );
    store.watch(
        (state) => [state.selected, state.highlight, state.placing],
        (selected, highlight, placing) => {
            const marked = highlight ?? selected;
            rows.forEach(({ line, place }, id) => {
                const isMarked = marked?.kind === "vertex" && marked.id === id;
                line.classList.toggle("highlighted", isMarked);
                place.setAttribute("aria-pressed", String(placing === id));
            });
        },
    );
}

interface Row {
    readonly line: HTMLTableRowElement;
    readonly name: HTMLInputElement;
    readonly vertex: HTMLInputElement;
    readonly place: HTMLButtonElement;
    readonly remove: HTMLButtonElement;
}

function makeRow(id: number, actions: Actions): Row {
    const editor = actions.landmarks;
    const line = create("tr");
    const head = create("th");
    head.scope = "row";
    const chip = create("span", String(id), "chip");
    const { fill, text } = dotColor(id);
    chip.style.background = fill;
    chip.style.color = text;
    head.append(chip);

    const name = create("input");
    name.type = "text";
    name.setAttribute("aria-label", `Name of landmark ${id}`);
    name.addEventListener("change", () => editor.rename(id, name.value));

    const vertex = create("input");
    vertex.type = "number";
    vertex.min = "0";
    vertex.step = "1";
    vertex.placeholder = "missing";
    vertex.setAttribute("aria-label", `Target vertex of landmark ${id}`);
    vertex.addEventListener("change", () => {
        if (vertex.value === "") editor.remove(id);
        else editor.place(id, vertex.valueAsNumber);
        vertex.classList.toggle("refused", vertex.value !== "" && !isPlaced(actions, id, vertex));
    });

    const place = create("button", "Place");
    place.type = "button";
    place.setAttribute("aria-label", `Place landmark ${id} with a click`);
    place.setAttribute("aria-pressed", "false");
    place.addEventListener("click", () => editor.startPlacing(id));
    const remove = create("button", "✕");
    remove.type = "button";
    remove.setAttribute("aria-label", `Remove landmark ${id}`);
    remove.addEventListener("click", () => editor.remove(id));

    const cells = [name, vertex].map((input) => {
        const cell = create("td");
        cell.append(input);
        return cell;
    });
    const buttons = create("td");
    buttons.append(place, remove);
    line.append(head, ...cells, buttons);
    line.addEventListener("pointerenter", () => actions.highlight({ kind: "vertex", id }));
    line.addEventListener("pointerleave", () => actions.highlight(null));
    return { line, name, vertex, place, remove };
}

const isPlaced = (actions: Actions, id: number, input: HTMLInputElement): boolean =>
    actions.saved().landmarks?.places[id] === input.valueAsNumber;

function setValue(input: HTMLInputElement, value: string): void {
    input.classList.remove("refused");
    if (input.value !== value) input.value = value;
}

function saveLandmarks(store: Store<AppState>): void {
    const { landmarks, target } = store.get();
    const ids = landmarks && completeIds(landmarks);
    if (!ids || !target) return;
    const name = target.name.replace(/\.[^.]*$/, "");
    download(
        `${name}_landmarks.txt`,
        new Blob([landmarkFile(ids, target)], { type: "text/plain" }),
    );
}
