import type { EmbedResult, LayoutInfo } from "layout-embedding";
import type { Actions } from "../model/actions.js";
import { formatGap, formatLength, meaning } from "../model/describe.js";
import type { AppState } from "../model/state.js";
import type { Store } from "../model/store.js";
import { create, element, setText } from "./dom.js";

/** The figures of the result, or of the search while it runs. */
export function resultPanel(store: Store<AppState>, actions: Actions): void {
    store.watch(
        (state) => [state.result, state.activity, state.livePaths, state.layout],
        (result, activity, livePaths, layout) => {
            const total = layout?.edgeCount ?? 0;
            const embedded = result?.refined ? total : (livePaths?.layoutEdges.length ?? 0);
            setText("embedded", layout ? `${embedded} of ${total}` : "–");
            const figures = result ?? (activity?.kind === "solving" ? activity : null);
            const cost = figures?.cost ?? Infinity;
            const bound = figures?.lowerBound ?? 0;
            setText("cost", formatLength(cost));
            setText("lower-bound", bound > 0 ? formatLength(bound) : "–");
            setText(
                "gap-value",
                Number.isFinite(cost) ? formatGap(result?.gap ?? (cost - bound) / cost) : "–",
            );
            setText("length", result?.refined ? formatLength(surfaceLength(result)) : "–");
            setText("meaning", result ? meaning(result) : "");
        },
    );
    store.watch(
        (state) => [state.result, state.layout],
        (result, layout) => fillTable(result, layout, actions),
    );
    store.watch(
        (state) => [state.highlight],
        (highlight) => {
            for (const row of element("edge-rows", HTMLTableSectionElement).rows)
                row.classList.toggle(
                    "highlighted",
                    highlight?.kind === "edge" && row.dataset["edge"] === String(highlight.id),
                );
        },
    );
}

function surfaceLength(result: EmbedResult): number {
    return result.edges.reduce((sum, edge) => sum + edge.length, 0);
}

function fillTable(result: EmbedResult | null, layout: LayoutInfo | null, actions: Actions): void {
    element("edges", HTMLDetailsElement).hidden = !result?.refined || !layout;
    const order = new Map(Array.from(result?.insertionOrder ?? [], (edge, i) => [edge, i + 1]));
    const rows = (result?.edges ?? []).map((edge) => {
        const row = create("tr");
        row.dataset["edge"] = String(edge.id);
        const header = create("th", String(edge.id));
        header.scope = "row";
        row.append(
            header,
            create("td", `${edge.layoutEdge[0]} – ${edge.layoutEdge[1]}`),
            create("td", formatLength(edge.length)),
            create("td", String(order.get(edge.id) ?? "–")),
        );
        row.addEventListener("pointerenter", () =>
            actions.highlight({ kind: "edge", id: edge.id }),
        );
        row.addEventListener("pointerleave", () => actions.highlight(null));
        return row;
    });
    element("edge-rows", HTMLTableSectionElement).replaceChildren(...rows);
}
