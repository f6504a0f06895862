// Pieces of the report.
import { readFileSync } from "node:fs";
import path from "node:path";

export function escape(text) {
    return String(text)
        .replaceAll("&", "&amp;")
        .replaceAll("<", "&lt;")
        .replaceAll(">", "&gt;")
        .replaceAll('"', "&quot;");
}

let folder = ".";

export function setReportFolder(output) {
    folder = output;
}

/** A picture that an experiment has made, in the page itself. */
export function picture({ file, width, height }, caption, alt = caption) {
    const data = readFileSync(path.join(folder, "pictures", file)).toString("base64");
    return `<figure class="picture"><img src="data:image/png;base64,${data}" width="${width}" height="${height}" alt="${escape(alt)}" loading="lazy"><figcaption>${escape(caption)}</figcaption></figure>`;
}

export function pictures(list) {
    // Five fit into a row as well.
    const least = list.length === 5 ? 185 : 230;
    return `<div class="pictures" style="--least:${least}px">${list.join("")}</div>`;
}

/** Cells are text; numbers go to the right. */
export function table(head, rows, note = "") {
    const cell = (value) =>
        typeof value === "number" || /^[-−+]?[\d., ]+( ?[%°]| s)?$|^–$/.test(value)
            ? `<td class="number">${escape(value)}</td>`
            : `<td>${escape(value)}</td>`;
    const body = rows.map((row) => `<tr>${row.map(cell).join("")}</tr>`);
    return `<div class="wide"><table><thead><tr>${head.map((name) => `<th>${escape(name)}</th>`).join("")}</tr></thead><tbody>${body.join("")}</tbody></table></div>${note && `<p class="note">${note}</p>`}`;
}

/** What the paper found, and what this run found; both HTML. */
export function findings(paper, ours) {
    return `<div class="findings"><div><h3>The paper</h3><p>${paper}</p></div><div><h3>This run</h3><p>${ours}</p></div></div>`;
}

export function paragraph(text) {
    return `<p>${text}</p>`;
}

export function figure(content, caption) {
    return `<figure class="block"><div class="wide">${content}</div><figcaption>${caption}</figcaption></figure>`;
}

export function percent(share, digits = 0) {
    return `${(100 * share).toFixed(digits)} %`;
}

export function number(value, digits = 2) {
    return value === null || !Number.isFinite(value) ? "–" : value.toFixed(digits);
}

export function seconds(value) {
    return value === null || !Number.isFinite(value)
        ? "–"
        : `${value < 10 ? value.toPrecision(2) : value.toFixed(0)} s`;
}

/** A whole number, digits in groups of three. */
export function integer(value) {
    return value.toLocaleString("en").replaceAll(",", " ");
}

/** "1 instance", "2 instances". */
export function count(n, word, plural = `${word}s`) {
    return `${n} ${n === 1 ? word : plural}`;
}
