import type { EmbedResult, LayoutInfo } from "layout-embedding";
import type { Actions } from "../model/actions.js";
import { formatGap, formatLength, meaning } from "../model/describe.js";
import type { AppState, Item } from "../model/state.js";
import type { Store } from "../model/store.js";
import { patchAreas } from "../view3d/geometry.js";
import { create, element, setText } from "./dom.js";

/** The figures of the result, or of the search while it runs. */
export function resultPanel(store: Store<AppState>, actions: Actions): void {
    store.watch(
        (state) => [
            state.result,
            state.preview,
            state.activity,
            state.livePaths,
            state.layout,
            state.follow,
            state.routes.length > 0,
        ],
        (result, preview, activity, livePaths, layout, follow, ruled) => {
            const total = layout?.edgeCount ?? 0;
            const quick = activity ? null : follow;
            const shown = result ?? (activity || follow ? null : preview);
            const embedded = shown?.refined || quick ? total : (livePaths?.layoutEdges.length ?? 0);
            setText("embedded", layout ? `${embedded} of ${total}` : "–");
            const figures = shown ?? (activity?.kind === "solving" ? activity : null);
            const cost = quick?.cost ?? figures?.cost ?? Infinity;
            const bound = figures?.lowerBound ?? 0;
            setText("cost", formatLength(cost));
            setText("lower-bound", bound > 0 ? formatLength(bound) : "–");
            setText(
                "gap-value",
                Number.isFinite(cost) && figures
                    ? formatGap(shown?.gap ?? (cost - bound) / cost)
                    : "–",
            );
            setText("length", shown?.refined ? formatLength(surfaceLength(shown)) : "–");
            setText(
                "meaning",
                result
                    ? meaning(result, ruled, store.get().options)
                    : (shown ?? quick)
                      ? "Quick, while the landmark moves; the shortest is looked for when it rests."
                      : "",
            );
        },
    );

    const edges = element("edges", HTMLDetailsElement);
    const patches = element("patches", HTMLDetailsElement);
    const fill = () => {
        const { result, layout } = store.get();
        const shown = result?.refined && layout ? { result, layout } : null;
        edges.hidden = patches.hidden = !shown;
        const edgeRows = shown && edges.open ? rowsOfEdges(shown.result) : [];
        element("edge-rows", HTMLElement).replaceChildren(
            ...edgeRows.map((cells, id) => line(cells, { kind: "edge", id }, actions)),
        );
        const patchRows = shown && patches.open ? rowsOfPatches(shown.result, shown.layout) : [];
        element("patch-rows", HTMLElement).replaceChildren(
            ...patchRows.map((cells, id) => line(cells, { kind: "face", id }, actions)),
        );
    };
    edges.addEventListener("toggle", fill);
    patches.addEventListener("toggle", fill);
    store.watch((state) => [state.result, state.layout], fill);
    store.watch(
        (state) => [state.highlight, state.selected],
        (highlight, selected) => {
            const marked = highlight ?? selected;
            for (const row of document.querySelectorAll<HTMLTableRowElement>("tr[data-kind]"))
                row.classList.toggle(
                    "highlighted",
                    marked?.kind === row.dataset["kind"] &&
                        String(marked?.id) === row.dataset["id"],
                );
        },
    );
}

function surfaceLength(result: EmbedResult): number {
    return result.edges.reduce((sum, edge) => sum + edge.length, 0);
}

function rowsOfEdges(result: EmbedResult): string[][] {
    const order = new Map(Array.from(result.insertionOrder, (edge, i) => [edge, i + 1]));
    return result.edges.map(({ id, layoutEdge, length }) => [
        `${layoutEdge[0]} – ${layoutEdge[1]}`,
        formatLength(length),
        String(order.get(id) ?? "–"),
    ]);
}

function rowsOfPatches({ refined }: EmbedResult, layout: LayoutInfo): string[][] {
    const areas = refined ? patchAreas(refined, layout.faceCount) : [];
    return Array.from(areas, (area, f) => {
        const corners = layout.corners.subarray(layout.offsets[f], layout.offsets[f + 1]);
        return [corners.join(", "), formatLength(area)];
    });
}

/** A row that shows what it is about in the views: under the pointer, or chosen with its button. */
function line(cells: readonly string[], item: Item, actions: Actions): HTMLElement {
    const row = create("tr");
    row.dataset["kind"] = item.kind;
    row.dataset["id"] = String(item.id);
    const header = create("th");
    header.scope = "row";
    const button = create("button", String(item.id), "plain");
    button.type = "button";
    const word = item.kind === "edge" ? "edge" : "patch";
    button.setAttribute("aria-label", `Show ${word} ${item.id}`);
    button.addEventListener("click", () => actions.select(item));
    header.append(button);
    row.append(header, ...cells.map((text) => create("td", text)));
    row.addEventListener("pointerenter", () => actions.highlight(item));
    row.addEventListener("pointerleave", () => actions.highlight(null));
    return row;
}
