import type { LayoutInfo } from "layout-embedding";

/**
 * Fills that stay apart for all common kinds of colour vision and carry dark lines and numbers: Paul
 * Tol's "light" scheme without its grey and olive.
 */
const fills = [0x77aadd, 0xee8866, 0xeedd88, 0x44bb99, 0xffaabb, 0x99ddff, 0xbbcc33];

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
    readonly halo: string;
    readonly accent: string;
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
        halo: color("halo"),
        accent: color("accent"),
        dot: color("dot"),
        dotText: color("dot-text"),
    };
}

/** Calls `listener` whenever the system switches between light and dark. */
export function onThemeChange(listener: () => void): void {
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", listener);
}
