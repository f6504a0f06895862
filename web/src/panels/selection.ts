import type { Actions } from "../model/actions.js";
import { opponentsOf } from "../model/candidates.js";
import { formatChange, formatLength } from "../model/describe.js";
import { landmarkLabel } from "../model/landmarks.js";
import { endsOf, pricedRule } from "../model/routes.js";
import type { AppState, Item } from "../model/state.js";
import type { Store } from "../model/store.js";
import { patchAreas } from "../view3d/geometry.js";
import { element, figureRows, setText } from "./dom.js";
import { routeButtons } from "./routes.js";

/** A card with the figures of the landmark, path or patch that was chosen. */
export function selectionCard(store: Store<AppState>, actions: Actions): void {
    const card = element("selection", HTMLElement);
    const onClick = (id: string, act: (item: Item) => void) => {
        const button = element(id, HTMLButtonElement);
        button.addEventListener("click", () => {
            const { selected } = store.get();
            if (selected) act(selected);
        });
        return button;
    };
    const move = onClick("selection-move", ({ id }) => actions.landmarks.startPlacing(id));
    const remove = onClick("selection-remove", ({ id }) => actions.landmarks.remove(id));
    onClick("selection-close", () => actions.select(null));
    routeButtons(store, actions);
    store.watch(
        (state) => [
            state.selected,
            state.placing,
            state.result,
            state.candidates,
            state.landmarks,
            state.layout,
            state.routes,
        ],
        (selected, placing, ..._others) => {
            const figures = selected && figuresOf(selected, store.get());
            card.hidden = !figures || placing !== null;
            if (!selected || !figures) return;
            move.hidden = remove.hidden = selected.kind !== "vertex";
            setText("selection-title", titleOf(selected, store.get()));
            element("selection-figures", HTMLElement).replaceChildren(...figureRows(figures));
        },
    );
}

function titleOf({ kind, id }: Item, { landmarks }: AppState): string {
    if (kind === "vertex") return `Landmark ${landmarkLabel(landmarks, id)}`;
    return kind === "edge" ? `Edge ${id}` : `Patch ${id}`;
}

/** Null where the item is not there any more. */
function figuresOf({ kind, id }: Item, state: AppState): [string, string][] | null {
    const { layout, landmarks, result, candidates } = state;
    if (kind === "vertex") {
        const vertex = landmarks?.places[id];
        if (vertex === undefined) return null;
        return [["Target vertex", vertex === null ? "missing" : String(vertex)]];
    }
    if (!layout) return null;
    if (kind === "edge") {
        const edge = result?.edges[id];
        if (id >= layout.edgeCount) return null;
        const place = result?.insertionOrder.indexOf(id) ?? -1;
        const figures: [string, string][] = [
            ["Between", endsOf(id, layout, landmarks).join(" – ")],
            ["Length", edge ? formatLength(edge.length) : "–"],
            ["Cost", edge ? formatLength(edge.cost) : "–"],
        ];
        if (candidates) {
            const opponents = opponentsOf(candidates.found, id);
            figures.push(
                ["Cost alone", formatLength(candidates.found.lengths[id] ?? Infinity)],
                ["In conflict with", opponents.length > 0 ? opponents.join(", ") : "none"],
            );
        }
        const before = pricedRule(state.routes, id)?.costBefore ?? null;
        if (before !== null && result?.refined)
            figures.push(
                ["All edges before", formatLength(before)],
                ["All edges now", formatLength(result.cost)],
                ["Price of the route", formatChange(before, result.cost)],
            );
        figures.push(["Embedded as number", place >= 0 ? String(place + 1) : "–"]);
        return figures;
    }
    if (id >= layout.faceCount) return null;
    const corners = layout.corners.subarray(layout.offsets[id], layout.offsets[id + 1]);
    const refined = result?.refined;
    const areas = refined ? patchAreas(refined, layout.faceCount) : null;
    const total = areas?.reduce((sum, area) => sum + area, 0) ?? 0;
    const area = areas?.[id];
    return [
        ["Corners", [...corners].join(", ")],
        ["Area", area === undefined ? "–" : formatLength(area)],
        ["Share", area === undefined ? "–" : `${((100 * area) / total).toFixed(1)} %`],
    ];
}
