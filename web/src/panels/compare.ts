import type { EmbedResult } from "layout-embedding";
import type { Actions } from "../model/actions.js";
import { algorithmWords, formatChange, formatLength } from "../model/describe.js";
import { longestDetour } from "../model/detours.js";
import type { AppState } from "../model/state.js";
import type { Store } from "../model/store.js";
import { create, element, setText } from "./dom.js";

/** The greedy heuristics beside the result: costs and detours in a table, one of them in a view. */
export function comparePanel(store: Store<AppState>, actions: Actions): void {
    const button = element("compare", HTMLButtonElement);
    button.addEventListener("click", () => void actions.compare());
    element("compare-close", HTMLButtonElement).addEventListener("click", () => {
        actions.showContender(null);
        button.focus();
    });
    store.watch(
        (state) => [state.result, state.activity],
        (result, activity) => {
            button.disabled = !result?.refined || activity !== null;
        },
    );
    store.watch(
        (state) => [state.comparison, state.result],
        (comparison, result) => {
            element("comparison", HTMLElement).hidden = !comparison;
            if (!comparison || !result) return;
            const rows = comparison.contenders.map(({ algorithm, result: other }, i) => {
                const line = create("tr");
                const head = create("th", algorithmWords(algorithm));
                head.scope = "row";
                const show = create("button", "Show");
                show.type = "button";
                show.setAttribute("aria-label", `Show ${algorithmWords(algorithm)}`);
                show.setAttribute("aria-pressed", String(i === comparison.shown));
                show.disabled = !other?.refined;
                show.addEventListener("click", () => {
                    actions.showContender(i === comparison.shown ? null : i);
                    // The table is made anew; whoever used the keyboard stays in place.
                    element("contenders", HTMLElement).querySelectorAll("button")[i]?.focus();
                });
                const cell = create("td");
                cell.append(show);
                line.append(
                    head,
                    create("td", other ? excessWords(other, result) : "–", "whole"),
                    create("td", other ? detourWords(other, result) : "–", "whole"),
                    cell,
                );
                return line;
            });
            element("contenders", HTMLTableSectionElement).replaceChildren(...rows);
            const shown =
                comparison.shown === null ? null : comparison.contenders[comparison.shown];
            if (!shown?.result) return;
            setText("compare-title", algorithmWords(shown.algorithm));
            setText("compare-caption", costWords(shown.result, result));
        },
    );
}

function costWords(other: EmbedResult, result: EmbedResult): string {
    if (!other.refined) return excessWords(other, result);
    return `${formatLength(other.cost)} (${excessWords(other, result)})`;
}

function excessWords(other: EmbedResult, result: EmbedResult): string {
    if (!other.refined) return "dead end";
    if (other.cost === result.cost) return "the same";
    return formatChange(result.cost, other.cost);
}

function detourWords(other: EmbedResult, result: EmbedResult): string {
    const longest = longestDetour(other, result);
    if (longest && longest.ratio < 1.005) return "none";
    return longest ? `${longest.edge} (×${longest.ratio.toFixed(2)})` : "–";
}
