import type { Actions } from "../model/actions.js";
import { endsOf, keptRule, ruleWords, type RouteRule } from "../model/routes.js";
import type { AppState } from "../model/state.js";
import type { Store } from "../model/store.js";
import { create, element } from "./dom.js";

/** The rules for routes that are in force, in words, each with a button that ends it. */
export function routesPanel(store: Store<AppState>, actions: Actions): void {
    const box = element("routes", HTMLElement);
    const list = element("route-rules", HTMLElement);
    store.watch(
        (state) => [state.routes, state.layout, state.landmarks],
        (routes, ..._others) => {
            const focused = [...list.children].findIndex((row) =>
                row.contains(document.activeElement),
            );
            box.hidden = routes.length === 0;
            list.replaceChildren(...routes.map((rule) => row(rule, store.get(), actions)));
            if (focused < 0) return;
            const next = list.children[Math.min(focused, routes.length - 1)];
            (next?.querySelector<HTMLElement>(".remove") ?? element("solve", HTMLElement)).focus();
        },
    );
}

function row(rule: RouteRule, { layout, landmarks }: AppState, actions: Actions): HTMLElement {
    const line = create("li");
    const edge = create("button", `Edge ${rule.edge}`, "plain");
    edge.type = "button";
    edge.addEventListener("click", () => actions.select({ kind: "edge", id: rule.edge }));
    const ends = layout ? endsOf(rule.edge, layout, landmarks).join(" to ") : "";
    const words = create("span", `from ${ends} ${ruleWords(rule)}`);
    const remove = create("button", "Remove", "plain remove");
    remove.type = "button";
    remove.setAttribute("aria-label", `Remove: edge ${rule.edge} ${ruleWords(rule)}`);
    remove.addEventListener("click", () => void actions.routes.remove(rule));
    line.append(edge, words, remove);
    return line;
}

/** The buttons on the card of an edge that ask for another route, or for this one to stay. */
export function routeButtons(store: Store<AppState>, actions: Actions): void {
    const another = element("route-another", HTMLButtonElement);
    const keep = element("route-keep", HTMLButtonElement);
    const edge = () => {
        const { selected } = store.get();
        return selected?.kind === "edge" ? selected.id : null;
    };
    another.addEventListener("click", () => anotherRoute(store, actions));
    keep.addEventListener("click", () => keepRoute(store, actions));
    store.watch(
        (state) => [state.selected, state.result, state.routes, state.activity],
        (_selected, result, routes, activity) => {
            const id = edge();
            another.hidden = keep.hidden = id === null;
            // Not disabled: that would take the focus away while the other route is looked for.
            const idle = String(!result?.refined || activity !== null);
            another.setAttribute("aria-disabled", idle);
            keep.setAttribute("aria-disabled", idle);
            keep.setAttribute("aria-pressed", String(id !== null && keptRule(routes, id) !== null));
        },
    );
}

/** Another route for the chosen edge. */
export function anotherRoute(store: Store<AppState>, actions: Actions): void {
    const { selected } = store.get();
    if (selected?.kind === "edge") void actions.routes.another(selected.id);
}

/** The chosen edge keeps its route, or need not any more. */
export function keepRoute(store: Store<AppState>, actions: Actions): void {
    const { selected } = store.get();
    if (selected?.kind === "edge") actions.routes.toggleKept(selected.id);
}
