import type { Actions } from "../model/actions.js";
import { formatGap, formatLength, formatSeconds } from "../model/describe.js";
import type { AppState } from "../model/state.js";
import type { Store } from "../model/store.js";
import type { Trace, TracePoint } from "../model/trace.js";
import { element, setText } from "./dom.js";

const width = 300;
const height = 120;
const margin = { left: 2, right: 2, top: 8, bottom: 18 };

/** Both bounds over time, and a slider through the improvements. */
export function plotPanel(store: Store<AppState>, actions: Actions): void {
    const figure = element("plot", HTMLElement);
    const area = element("plot-area", HTMLElement);
    store.watch(
        (state) => [state.trace, state.step],
        (trace, step) => {
            const last = trace.points.at(-1);
            // A search that was over at once has nothing to tell.
            const first = trace.points.find(({ cost }) => Number.isFinite(cost));
            const moved = first?.cost !== last?.cost || first?.lowerBound !== last?.lowerBound;
            const open = last !== undefined && last.cost > last.lowerBound;
            figure.hidden = !first || (!moved && !open);
            if (figure.hidden || !last) return;
            area.replaceChildren(drawing(trace, step));
            setText("plot-gap", `gap ${formatGap((last.cost - last.lowerBound) / last.cost)}`);
        },
    );

    const steps = element("steps", HTMLElement);
    const slider = element("step", HTMLInputElement);
    slider.addEventListener("input", () => {
        const { incumbents } = store.get().trace;
        const place = slider.valueAsNumber;
        actions.showStep(place < incumbents.length - 1 ? place : null);
    });
    store.watch(
        (state) => [state.trace, state.step, state.result],
        ({ incumbents }, step, result) => {
            steps.hidden = incumbents.length < 2 || !result;
            if (steps.hidden) return;
            slider.max = String(incumbents.length - 1);
            const place = step ?? incumbents.length - 1;
            slider.value = String(place);
            const shown = incumbents[place];
            const text = shown
                ? `${place + 1} of ${incumbents.length}: ${formatLength(shown.cost)} after ${formatSeconds(shown.seconds)}`
                : "";
            setText("step-text", text);
            slider.setAttribute("aria-valuetext", text);
        },
    );
}

/** A picture of the trace; colours come from the style sheet. */
function drawing({ points, incumbents }: Trace, step: number | null): SVGSVGElement {
    const last = points.at(-1)!;
    const first = points.find((point) => Number.isFinite(point.cost)) ?? last;
    const begin = points[0]!.seconds;
    const duration = Math.max(last.seconds - begin, 1e-6);
    // Bounds of before the first embedding would press everything else into a line.
    const low = Math.min(last.lowerBound, Math.max(first.lowerBound, 0.5 * last.cost));
    const high = first.cost;
    const span = Math.max(high - low, 1e-3 * high);
    const x = (seconds: number) =>
        margin.left + ((seconds - begin) / duration) * (width - margin.left - margin.right);
    const y = (value: number) => {
        const share = (Math.min(high, Math.max(low, value)) - low) / span;
        return height - margin.bottom - share * (height - margin.top - margin.bottom);
    };

    const svg = make("svg", { viewBox: `0 0 ${width} ${height}`, role: "img" });
    svg.setAttribute(
        "aria-label",
        `After ${formatSeconds(last.seconds)} the best embedding costs ${formatLength(last.cost)}, ` +
            `none can cost less than ${formatLength(last.lowerBound)}.`,
    );
    const upper = thinned(points.filter((point) => Number.isFinite(point.cost)));
    const lower = thinned(points);
    const upperLine = steps(upper, (point) => [x(point.seconds), y(point.cost)]);
    const lowerLine = steps(lower, (point) => [x(point.seconds), y(point.lowerBound)]);
    const gap = [
        ...upperLine,
        ...steps(
            lower.filter(({ seconds }) => seconds >= first.seconds),
            (point) => [x(point.seconds), y(point.lowerBound)],
        ).reverse(),
    ];
    svg.append(
        make("path", { class: "gap", d: `M${gap.join("L")}Z` }),
        make("path", { class: "lower", d: `M${lowerLine.join("L")}` }),
        make("path", { class: "upper", d: `M${upperLine.join("L")}` }),
    );
    incumbents.forEach((incumbent, i) => {
        const isShown = i === step;
        svg.append(
            make("circle", {
                class: isShown ? "incumbent shown" : "incumbent",
                cx: x(incumbent.seconds).toFixed(1),
                cy: y(incumbent.cost).toFixed(1),
                r: isShown ? "5" : "2.6",
            }),
        );
    });
    const label = (text: string, at: number, anchor: string) => {
        const node = make("text", { x: String(at), y: String(height - 4), "text-anchor": anchor });
        node.textContent = text;
        svg.append(node);
    };
    label(formatSeconds(begin), margin.left, "start");
    label(formatSeconds(last.seconds), width - margin.right, "end");
    return svg;
}

/** A line that keeps its height until the next point. */
function steps(
    points: readonly TracePoint[],
    at: (point: TracePoint) => readonly [number, number],
): string[] {
    const line: string[] = [];
    let before: number | null = null;
    for (const point of points) {
        const [x, y] = at(point);
        if (before !== null) line.push(`${x.toFixed(1)},${before.toFixed(1)}`);
        line.push(`${x.toFixed(1)},${y.toFixed(1)}`);
        before = y;
    }
    return line;
}

/** At most about 600 points, more than there are pixels. */
function thinned(points: readonly TracePoint[]): readonly TracePoint[] {
    const stride = Math.ceil(points.length / 600);
    return points.filter((_, i) => i % stride === 0 || i === points.length - 1);
}

function make<Tag extends keyof SVGElementTagNameMap>(
    tag: Tag,
    attributes: Record<string, string>,
): SVGElementTagNameMap[Tag] {
    const node = document.createElementNS("http://www.w3.org/2000/svg", tag);
    for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
    return node;
}
