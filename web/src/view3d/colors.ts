import type { LayoutInfo } from "layout-embedding";

/**
 * Fills that stay apart for all common kinds of colour vision and carry dark lines and numbers: Paul
 * Tol's "light" scheme without its grey and olive.
 */
const fills = [0x77aadd, 0xee8866, 0xeedd88, 0x44bb99, 0xffaabb, 0x99ddff, 0xbbcc33];

/** A landmark's colour, and that of the number on it. */
export interface DotColor {
    readonly fill: string;
    readonly text: string;
}

/**
 * Colours for landmarks, told apart by people with any common kind of colour vision: the scheme of
 * Okabe and Ito. With more landmarks they come again; the numbers tell those apart.
 */
const dotColors: readonly DotColor[] = [
    { fill: "#0072b2", text: "#ffffff" },
    { fill: "#e69f00", text: "#000000" },
    { fill: "#007a5a", text: "#ffffff" },
    { fill: "#cc79a7", text: "#000000" },
    { fill: "#56b4e9", text: "#000000" },
    { fill: "#b84a00", text: "#ffffff" },
    { fill: "#f0e442", text: "#000000" },
];

export const dotColor = (id: number): DotColor => dotColors[id % dotColors.length]!;

/** Place in `fills` per layout face: neighbours across an edge always differ. */
export function patchColors(layout: LayoutInfo): Uint32Array {
    const faceCount = layout.offsets.length - 1;
    const facesOfVertex = new Map<number, number[]>();
    const cornersOf = (f: number) =>
        layout.corners.subarray(layout.offsets[f], layout.offsets[f + 1]);
    for (let f = 0; f < faceCount; ++f)
        for (const v of cornersOf(f)) {
            const list = facesOfVertex.get(v);
            if (list) list.push(f);
            else facesOfVertex.set(v, [f]);
        }
    const place = new Int32Array(faceCount).fill(-1);
    const used = new Float64Array(fills.length);
    for (let f = 0; f < faceCount; ++f) {
        // Faces that share two vertices are neighbours; those that share one should differ if possible.
        const shared = new Map<number, number>();
        for (const v of cornersOf(f))
            for (const g of facesOfVertex.get(v)!) shared.set(g, (shared.get(g) ?? 0) + 1);
        const penalty = used.map((count) => count / (faceCount + 1));
        for (const [g, count] of shared)
            if (g !== f && place[g]! >= 0) penalty[place[g]!]! += count > 1 ? 1000 : 10;
        const best = penalty.indexOf(Math.min(...penalty));
        place[f] = best;
        used[best]! += 1;
    }
    return Uint32Array.from(place, (i) => fills[i]!);
}

/** The page's colours inside the 3D views; they follow the style sheet's theme. */
export interface ViewTheme {
    readonly background: string;
    readonly clay: string;
    readonly ink: string;
    readonly accent: string;
    readonly warn: string;
    readonly dot: string;
    readonly dotText: string;
}

export function currentTheme(): ViewTheme {
    const style = getComputedStyle(document.documentElement);
    const color = (name: string) => style.getPropertyValue(`--view-${name}`).trim();
    return {
        background: color("background"),
        clay: color("clay"),
        ink: color("ink"),
        accent: color("accent"),
        warn: color("warn"),
        dot: color("dot"),
        dotText: color("dot-text"),
    };
}
