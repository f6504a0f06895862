// Pictures of embeddings, quad meshes and textured surfaces, as PNG files in one folder. What a function
// returns, { file, width, height }, is what the report needs to show it.
import { writeFileSync } from "node:fs";
import path from "node:path";
import { pngOf } from "./png.mjs";
import { Raster, cameraFor } from "./raster.mjs";

let folder = ".";

export function setPictureFolder(output) {
    folder = path.join(output, "pictures");
}

const size = { width: 340, height: 300 };
const dark = [40, 40, 48];
const red = [214, 39, 40];

/** From where shapes are seen unless something is to be shown elsewhere. */
export const frontView = { direction: [0.55, 0.25, 0.8], up: [0, 1, 0] };

const views = [
    frontView,
    ...[
        [-0.55, 0.25, 0.8],
        [0.9, 0.2, 0.1],
        [-0.9, 0.2, 0.1],
        [0.55, 0.25, -0.8],
        [-0.55, 0.25, -0.8],
    ].map((direction) => ({ direction, up: [0, 1, 0] })),
    // Unusual, only where they show much more.
    { direction: [0.1, -0.9, 0.3], up: [0, 1, 0], weight: 0.6 },
    { direction: [0.1, 0.95, 0.3], up: [0, 0, -1], weight: 0.6 },
];

function write(name, raster) {
    const file = `${name.replace(/[^\w.-]+/g, "_")}.png`;
    const { width, height } = raster.camera;
    writeFileSync(path.join(folder, file), pngOf(width, height, raster.pixels()));
    return { file, width, height };
}

/** A light colour per id, neighbours in number far apart in hue. */
export function pastel(id) {
    if (id < 0) {
        return [225, 225, 225];
    }
    const hue = (id * 0.61803398875) % 1;
    return [0, 1 / 3, 2 / 3].map((shift) => {
        const wave = Math.abs(((hue + shift) % 1) * 6 - 3) - 1;
        return 255 * (0.66 + 0.3 * Math.min(1, Math.max(0, wave)));
    });
}

function chainPoints(refined, chain) {
    return Array.from(chain).flatMap((v) =>
        Array.from(refined.positions.subarray(3 * v, 3 * v + 3)),
    );
}

/**
 * The view of those above that shows the given edges of an embedding best, in pixels seen; the front
 * where it shows nearly as much.
 */
export function viewOfEdges(result, edges) {
    const { refined } = result;
    let best = frontView;
    let most = -1;
    for (const view of views) {
        const raster = new Raster(cameraFor(refined.positions, { ...view, width: 80, height: 70 }));
        raster.triangles(refined.positions, refined.corners, () => dark);
        let seen = 0;
        for (const edge of edges) {
            seen += raster.line(chainPoints(refined, result.edges[edge].chain), red, 1);
        }
        seen *= view.weight ?? 1;
        if (seen > 1.15 * most) {
            best = view;
            most = seen;
        }
    }
    return best;
}

/** An embedding: patches in colours, paths dark, `highlight`ed layout edges red. */
export function embeddingPicture(name, result, { view = frontView, highlight = [] } = {}) {
    const { refined, edges } = result;
    const raster = new Raster(cameraFor(refined.positions, { ...size, ...view }));
    raster.triangles(refined.positions, refined.corners, (t) => pastel(refined.patches[t]));
    for (const { id, chain } of edges) {
        if (!highlight.includes(id)) {
            raster.line(chainPoints(refined, chain), dark, 1.6);
        }
    }
    for (const id of highlight) {
        raster.line(chainPoints(refined, edges[id].chain), red, 2.6);
    }
    for (const vertex of result.landmarks) {
        raster.dot(refined.positions.subarray(3 * vertex, 3 * vertex + 3), dark, 5);
    }
    return write(name, raster);
}

/**
 * A partial embedding: the target grey, the given layout edges of a complete one, the last of them
 * red.
 */
export function insertionPicture(name, result, edges, { view = frontView } = {}) {
    const { refined } = result;
    const raster = new Raster(cameraFor(refined.positions, { ...size, ...view }));
    raster.triangles(refined.positions, refined.corners, () => [214, 218, 226]);
    edges.forEach((edge, i) => {
        const isLast = i === edges.length - 1;
        const points = chainPoints(refined, result.edges[edge].chain);
        raster.line(points, isLast ? red : dark, isLast ? 3 : 2);
    });
    for (const vertex of result.landmarks) {
        raster.dot(refined.positions.subarray(3 * vertex, 3 * vertex + 3), dark, 6);
    }
    return write(name, raster);
}

/** A quad mesh with its base complex. */
export function quadPicture(name, { positions, quads, faces, chains }, { view = frontView } = {}) {
    const raster = new Raster(cameraFor(positions, { ...size, ...view }));
    const corners = new Uint32Array((quads.length / 4) * 6);
    for (let q = 0; 4 * q < quads.length; ++q) {
        const [a, b, c, d] = quads.subarray(4 * q, 4 * q + 4);
        corners.set([a, b, c, a, c, d], 6 * q);
    }
    raster.triangles(positions, corners, (t) => pastel(faces[t >> 1]));
    const at = (v) => Array.from(positions.subarray(3 * v, 3 * v + 3));
    for (let q = 0; q < quads.length; q += 4) {
        const ring = [0, 1, 2, 3, 0].map((k) => quads[q + k]);
        raster.line(ring.flatMap(at), [120, 120, 130], 0.5);
    }
    for (const chain of chains) {
        raster.line(Array.from(chain).flatMap(at), dark, 1.8);
    }
    return write(name, raster);
}

/** A surface coloured point by point: see Raster.triangles(). `lines` are polylines on it. */
export function texturePicture(
    name,
    positions,
    corners,
    colourOf,
    { view = frontView, lines = [] },
) {
    const raster = new Raster(cameraFor(positions, { ...size, ...view }));
    raster.triangles(positions, corners, colourOf);
    for (const line of lines) {
        raster.line(line, dark, 1.4);
    }
    return write(name, raster);
}
