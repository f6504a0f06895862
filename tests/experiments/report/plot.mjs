// Plots as inline SVG.
import { escape } from "./html.mjs";

export const colours = {
    exact: "#0072b2",
    bound: "#56b4e9",
    branchAndBound: "#009e73",
    branchAndBoundBound: "#8fd6bf",
    praun: "#e69f00",
    kraevoy: "#f0c808",
    schreiner: "#d55e00",
    greedy: "#cc79a7",
    grey: "#777",
};

const margin = { left: 58, right: 14, top: 12, bottom: 44 };

/**
 * A plot of marks: { type: "line" | "steps" | "points" | "ticks" | "bars", data: [[x, y]...], colour,
 * name, dashed, titles }. `ticks` are short horizontal lines; `bars` go up from the axis; `names`
 * below, one per unit from 0, replace the numbers of x. Axes: { label, log, from, to, format }.
 */
export function plot({ width = 640, height = 300, x, y, marks, names, label }) {
    const points = marks.flatMap(({ data }) => data);
    const scaleX = scaleFor(
        x,
        points.map((p) => p[0]),
        margin.left,
        width - margin.right,
    );
    const scaleY = scaleFor(
        y,
        points.map((p) => p[1]),
        height - margin.bottom,
        margin.top,
    );
    const parts = [axes(scaleX, scaleY, x, y, width, height, names)];
    for (const mark of marks) {
        parts.push(drawMark(mark, scaleX, scaleY));
    }
    return `<svg class="plot" viewBox="0 0 ${width} ${height}" style="max-width:${width}px" role="img" aria-label="${escape(label)}">${parts.join("")}</svg>${legend(marks)}`;
}

export function legend(marks) {
    const named = marks.filter(({ name }) => name !== undefined);
    const items = named.map(
        ({ name, colour, dashed, type }) =>
            `<span><i class="${type === "points" ? "dot" : dashed ? "dashed" : "line"}" style="--c:${colour}"></i>${escape(name)}</span>`,
    );
    return items.length > 0 ? `<p class="legend">${items.join(" ")}</p>` : "";
}

function scaleFor({ log = false, from, to }, values, low, high) {
    const finite = values.filter((value) => Number.isFinite(value) && (!log || value > 0));
    let min = from ?? Math.min(...finite);
    let max = to ?? Math.max(...finite);
    if (!(max > min)) {
        [min, max] = log ? [min / 2, min * 2] : [min - 1, min + 1];
    }
    if (!log && from === undefined) {
        min -= 0.04 * (max - min);
    }
    if (!log && to === undefined) {
        max += 0.04 * (max - min);
    }
    const f = log ? Math.log10 : (value) => value;
    const scale = (value) => {
        const share = (f(Math.max(value, log ? min : -Infinity)) - f(min)) / (f(max) - f(min));
        return Number((low + share * (high - low)).toFixed(1));
    };
    return Object.assign(scale, {
        ticks: log && max > 4 * min ? logTicks(min, max) : linearTicks(min, max),
    });
}

function linearTicks(min, max) {
    const rough = (max - min) / 5;
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = power * [1, 2, 5, 10].find((factor) => factor * power >= rough);
    const ticks = [];
    for (let i = Math.ceil(min / step - 1e-9); i * step <= max + 1e-9 * step; ++i) {
        ticks.push(Number((i * step).toPrecision(12)));
    }
    return ticks;
}

function logTicks(min, max) {
    const decades = Math.log10(max / min);
    const factors = decades > 4 ? [1] : decades > 1.5 ? [1, 3] : [1, 2, 5];
    const ticks = [];
    for (let power = Math.floor(Math.log10(min)); 10 ** power <= max; ++power) {
        for (const factor of factors) {
            const tick = Number((factor * 10 ** power).toPrecision(6));
            if (tick >= min * 0.999 && tick <= max * 1.001) {
                ticks.push(tick);
            }
        }
    }
    return ticks;
}

function axes(scaleX, scaleY, x, y, width, height, names) {
    const bottom = height - margin.bottom;
    const right = width - margin.right;
    const parts = [];
    const text = (px, py, content, extra = "") =>
        `<text x="${px}" y="${py}"${extra}>${escape(content)}</text>`;
    for (const tick of scaleY.ticks) {
        const at = scaleY(tick);
        parts.push(`<line class="grid" x1="${margin.left}" x2="${right}" y1="${at}" y2="${at}"/>`);
        const shown = y.format ? y.format(tick) : short(tick);
        parts.push(text(margin.left - 6, at + 4, shown, ' text-anchor="end"'));
    }
    if (names === undefined) {
        for (const tick of scaleX.ticks) {
            const at = scaleX(tick);
            parts.push(
                `<line class="axis" x1="${at}" x2="${at}" y1="${bottom}" y2="${bottom + 4}"/>`,
            );
            const shown = x.format ? x.format(tick) : short(tick);
            parts.push(text(at, bottom + 17, shown, ' text-anchor="middle"'));
        }
    } else {
        names.forEach((name, i) => {
            parts.push(text(scaleX(i), bottom + 17, name, ' text-anchor="middle"'));
        });
    }
    parts.push(
        `<line class="axis" x1="${margin.left}" x2="${right}" y1="${bottom}" y2="${bottom}"/>`,
    );
    parts.push(text((margin.left + right) / 2, height - 8, x.label, ' text-anchor="middle"'));
    const middle = (margin.top + bottom) / 2;
    parts.push(
        text(14, middle, y.label, ` text-anchor="middle" transform="rotate(-90 14 ${middle})"`),
    );
    return parts.join("");
}

function drawMark({ type, data, colour, dashed, titles, size = 3.5 }, scaleX, scaleY) {
    const at = data
        .filter((point) => point.every(Number.isFinite))
        .map(([px, py]) => [scaleX(px), scaleY(py)]);
    const title = (i) => (titles ? `<title>${escape(titles[i])}</title>` : "");
    switch (type) {
        case "line":
        case "steps": {
            const path = at.map(([px, py], i) =>
                i === 0 ? `M${px} ${py}` : type === "steps" ? `H${px}V${py}` : `L${px} ${py}`,
            );
            return `<path d="${path.join("")}" fill="none" stroke="${colour}" stroke-width="2"${dashed ? ' stroke-dasharray="5 4"' : ""}/>`;
        }
        case "points":
            return at
                .map(
                    ([px, py], i) =>
                        `<circle cx="${px}" cy="${py}" r="${size}" fill="${colour}" fill-opacity="0.85">${title(i)}</circle>`,
                )
                .join("");
        case "ticks":
            return at
                .map(
                    ([px, py], i) =>
                        `<line x1="${px - 5}" x2="${px + 5}" y1="${py}" y2="${py}" stroke="${colour}" stroke-width="2.5">${title(i)}</line>`,
                )
                .join("");
        case "bars": {
            const zero = scaleY(0);
            return at
                .map(
                    ([px, py], i) =>
                        `<rect x="${px - size}" width="${2 * size}" y="${Math.min(py, zero)}" height="${Math.abs(zero - py).toFixed(1)}" fill="${colour}">${title(i)}</rect>`,
                )
                .join("");
        }
        default:
            throw new Error(`there is no mark ${type}`);
    }
}

/** A number as short as a tick wants it. */
export function short(value) {
    if (value === 0) {
        return "0";
    }
    const size = Math.abs(value);
    if (size >= 1e6) {
        return `${Number((value / 1e6).toPrecision(3))} M`;
    }
    if (size >= 1e4) {
        return `${Number((value / 1e3).toPrecision(3))} k`;
    }
    return String(Number(value.toPrecision(4)));
}
