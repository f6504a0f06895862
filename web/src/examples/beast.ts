import { cellSurface, subdivided, triangulated, type Polygons } from "./polygons.js";

// Lattice lines of the cage; the first entry of each belongs to lattice coordinate `first`.
const along = { first: -1, at: [-2.5, -1.55, -0.75, 0.75, 1.6, 2.75] };
const up = { first: -2, at: [-1.75, -0.85, 0, 1.05, 2.0] };
const across = { first: 0, at: [-0.85, -0.3, 0.3, 0.85] };

function place(i: number, j: number, k: number): readonly [number, number, number] {
    let x = along.at[i - along.first]!;
    let y = up.at[j - up.first]!;
    let z = across.at[k - across.first]!;
    if (j < 0) {
        // Feet stand a little apart and forward.
        z *= 1.12;
        x += 0.12;
    }
    if (i === -1) {
        // The tail's tip is thin and points up.
        y = y * 0.45 + 1.15;
        z *= 0.45;
    }
    if (j === 2) x += 0.25;
    if (i >= 3 && j >= 1 && (j === 2 || i === 4)) {
        // The head: wide at the neck, a snout in front.
        z *= i === 4 ? 1.15 : 1.7;
        if (i === 4) y = y * 0.72 + 0.42;
        else if (j === 2) y += 0.2;
    }
    return [x, y, z];
}

/** A four-legged animal: a cage of quads, and the smooth surface that grows from it. */
export function beast(): { layout: Polygons; target: Polygons; landmarks: number[] } {
    const cells: [number, number, number][] = [];
    for (const i of [0, 1, 2]) for (const k of [0, 1, 2]) cells.push([i, 0, k]);
    for (const i of [0, 2]) for (const k of [0, 2]) for (const j of [-1, -2]) cells.push([i, j, k]);
    cells.push([2, 1, 1], [3, 1, 1], [-1, 0, 1]);
    const layout = cellSurface(cells, place);
    let surface = layout;
    for (let level = 0; level < 3; ++level) surface = subdivided(surface);
    // Subdivision keeps the cage's ids, so that its vertices are the landmarks.
    return {
        layout,
        target: triangulated(surface),
        landmarks: Array.from({ length: layout.positions.length / 3 }, (_, v) => v),
    };
}
