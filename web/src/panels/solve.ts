import { algorithmNames } from "layout-embedding/worker";
import type { Actions } from "../model/actions.js";
import { algorithmWords, formatSeconds, statusWords } from "../model/describe.js";
import { needsExact } from "../model/solve_options.js";
import { completeIds, countPlaced } from "../model/landmarks.js";
import type { AppState } from "../model/state.js";
import type { Store } from "../model/store.js";
import { element, setText } from "./dom.js";

/** Milliseconds in which a solve begins after an edit, if one does. */
const moment = 60;

/** The best first. */
const algorithms = [...algorithmNames].reverse();

/** Options, the button that solves and cancels, progress. */
export function solvePanel(store: Store<AppState>, actions: Actions): void {
    const button = element("solve", HTMLButtonElement);
    button.addEventListener("click", () => toggleSolve(store, actions));
    optionInputs(store, actions);

    const progress = element("progress", HTMLElement);
    const bar = element("progress-bar", HTMLProgressElement);
    let ticking: ReturnType<typeof setInterval> | undefined;
    store.watch(
        (state) => [state.activity, state.layout, state.target, state.landmarks],
        (activity, layout, target, landmarks) => {
            const solving = activity?.kind === "solving";
            const ready = layout && target && landmarks && completeIds(landmarks);
            button.textContent = solving
                ? activity.cancelling
                    ? "Cancelling …"
                    : "Cancel"
                : "Solve";
            button.disabled = solving ? activity.cancelling : !ready || activity !== null;
            button.classList.toggle("cancel", solving);
            progress.hidden = !activity;
            clearInterval(ticking);
            if (!activity) return;
            setText("phase", `${activity.phase} …`);
            if (activity.progress === null) bar.removeAttribute("value");
            else bar.value = activity.progress;
            const tick = () => {
                setText("elapsed", formatSeconds((performance.now() - activity.startedAt) / 1000));
            };
            tick();
            ticking = setInterval(tick, 100);
        },
    );

    // Phases and outcomes are announced, each once, never figures that change all the time.
    let waiting: ReturnType<typeof setTimeout> | undefined;
    store.watch(
        (state) => [
            state.activity?.phase,
            state.result,
            state.landmarks,
            state.layout,
            state.target,
        ],
        () => {
            const { activity, result } = store.get();
            clearTimeout(waiting);
            if (result) return setText("status", statusSentence(store.get()));
            setText("status", "");
            // After an edit a solve begins at once: what is waited for till then is not worth a word.
            if (!activity)
                waiting = setTimeout(() => setText("status", waitingSentence(store.get())), moment);
        },
    );
}

/** Starts a solve, or cancels the one that runs. */
export function toggleSolve(store: Store<AppState>, actions: Actions): void {
    if (store.get().activity?.kind === "solving") actions.cancel();
    else void actions.solve();
}

function statusSentence({ result, routes }: AppState): string {
    if (!result) return "";
    const words = statusWords[result.status];
    if (!result.refined)
        return routes.length > 0
            ? `${words} with these rules for routes. Undo, or remove one of them.`
            : `${words}.`;
    return `${words}. It took ${formatSeconds(result.seconds)}.`;
}

function waitingSentence({ layout, target, landmarks }: AppState): string {
    if (!layout && !target) return "Choose a layout and a target.";
    if (!layout) return "Choose a layout.";
    if (!target) return "Choose a target.";
    if (!landmarks) return "Choose landmarks, or place them by proximity.";
    const missing = landmarks.places.length - countPlaced(landmarks);
    if (missing === 0) return "Ready to solve.";
    return missing === landmarks.places.length
        ? "Choose landmarks, or place them by proximity."
        : `Landmarks missing: ${missing}.`;
}

function optionInputs(store: Store<AppState>, actions: Actions): void {
    const algorithm = element("algorithm", HTMLSelectElement);
    algorithm.append(
        new Option("Default", ""),
        ...algorithms.map((name) => new Option(algorithmWords(name), name)),
    );
    algorithm.addEventListener("change", () => {
        const chosen = algorithms.find((name) => name === algorithm.value) ?? null;
        actions.setOptions({ algorithm: chosen });
    });
    const gap = element("gap", HTMLInputElement);
    const timeLimit = element("time-limit", HTMLInputElement);
    const workLimit = element("work-limit", HTMLInputElement);
    const seed = element("seed", HTMLInputElement);
    const number = (input: HTMLInputElement) =>
        input.value !== "" && input.validity.valid ? input.valueAsNumber : null;
    gap.addEventListener("change", () => {
        const percent = number(gap);
        if (percent !== null) actions.setOptions({ gap: percent / 100 });
    });
    timeLimit.addEventListener("change", () =>
        actions.setOptions({ timeLimit: number(timeLimit) }),
    );
    workLimit.addEventListener("change", () => {
        const millions = number(workLimit);
        actions.setOptions({ workLimit: millions === null ? null : 1e6 * millions });
    });
    seed.addEventListener("change", () => {
        const value = number(seed);
        if (value !== null) actions.setOptions({ seed: value });
    });
    store.watch(
        (state) => [state.options, state.routes],
        (options, routes) => {
            const overruled =
                options.algorithm !== null &&
                options.algorithm !== "exact" &&
                needsExact(options, routes);
            element("algorithm-note", HTMLElement).hidden = !overruled;
            algorithm.value = options.algorithm ?? "";
            gap.value = String(Number((100 * options.gap).toPrecision(12)));
            timeLimit.value = options.timeLimit === null ? "" : String(options.timeLimit);
            workLimit.value = options.workLimit === null ? "" : String(options.workLimit / 1e6);
            seed.value = String(options.seed);
        },
    );
}
