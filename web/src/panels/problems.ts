import type { Actions } from "../model/actions.js";
import type { AppState, Problem } from "../model/state.js";
import type { Store } from "../model/store.js";
import { create, element } from "./dom.js";

/** Errors as title, cause and advice, each until it is dismissed. */
export function problemsPanel(store: Store<AppState>, actions: Actions): void {
    const list = element("problems", HTMLElement);
    const shown = new Map<number, HTMLElement>();
    store.watch(
        (state) => [state.problems],
        (problems) => {
            const wanted = new Set(problems.map((p) => p.id));
            for (const [id, card] of shown)
                if (!wanted.has(id)) {
                    // Keyboard users must not lose their place with the card.
                    if (card.contains(document.activeElement))
                        element("panel", HTMLElement).focus();
                    card.remove();
                    shown.delete(id);
                }
            // Cards that stay are left alone, or a screen reader would read them again.
            for (const problem of problems)
                if (!shown.has(problem.id)) {
                    const made = card(problem, actions);
                    shown.set(problem.id, made);
                    list.append(made);
                }
        },
    );
    store.watch(
        (state) => [state.shownPlace, state.problems],
        (shownPlace, _problems) => {
            for (const [id, card] of shown)
                card.querySelector(".show-place")?.setAttribute(
                    "aria-pressed",
                    String(id === shownPlace),
                );
        },
    );
}

function card(problem: Problem, actions: Actions): HTMLElement {
    const box = create("div", "", "problem");
    const title = create("strong", problem.title);
    const code = create("code", problem.code);
    const text = create("div");
    const head = create("p");
    head.append(title, " ", code);
    text.append(head, create("p", problem.cause, "cause"));
    if (problem.line !== null) {
        const line = create("pre");
        line.append(create("code", problem.line));
        text.append(line);
    }
    if (problem.advice !== "") text.append(create("p", problem.advice, "advice"));
    const buttons = create("div", "", "buttons");
    if (problem.place) {
        const show = create("button", "Show where", "show-place");
        show.type = "button";
        show.addEventListener("click", () => {
            const isShown = show.getAttribute("aria-pressed") === "true";
            actions.showPlace(isShown ? null : problem.id);
        });
        buttons.append(show);
    }
    if (problem.remedy) {
        const { label, apply } = problem.remedy;
        const mend = create("button", label);
        mend.type = "button";
        mend.addEventListener("click", () => {
            actions.dismiss(problem.id);
            apply();
        });
        buttons.append(mend);
    }
    const dismiss = create("button", "Dismiss");
    dismiss.type = "button";
    dismiss.setAttribute("aria-label", `Dismiss: ${problem.title}`);
    dismiss.addEventListener("click", () => actions.dismiss(problem.id));
    buttons.append(dismiss);
    box.append(text, buttons);
    return box;
}
