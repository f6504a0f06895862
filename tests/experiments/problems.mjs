// The problems of the experiments: the project's own shapes, and layouts on spheres, as input for
// loadProblem() in solving.mjs.
import { readFileSync } from "node:fs";
import path from "node:path";
import { hashOf, once, output, root, run } from "../../.dev/run.mjs";
import {
    convexHull,
    displaced,
    nearestVertices,
    randomDirections,
    sphere as sphereMesh,
} from "../bench/generate.mjs";
import { normalized } from "../bench/vectors.mjs";

const generator = path.join(root, "build/release/core/shapes/generate_shapes");

/** The size of the largest members that are used. */
const largest = 10_000;
/** How many members of a class are used at most. */
const most = 6;

const asFile = (file) => ({ bytes: readFileSync(file), name: path.basename(file) });

/** A member of a class of shapes: { target, landmarks }, as the package takes them. */
export function readMember({ folder, mesh, landmarks }) {
    return {
        target: asFile(path.join(folder, mesh)),
        landmarks: asFile(path.join(folder, landmarks)),
    };
}

/** The small members that come with the page: two of each class. */
export function shippedShapes() {
    return readIndex(path.join(root, "web/public/shapes"));
}

/** Six members of each class, of 2 to 10 thousand vertices, made unless they are there already. */
export async function generatedShapes() {
    const folder = "build/experiments-shapes";
    const listed = output(generator, ["--list"]).matchAll(
        /^ +(\d+) (\S+) +(\d+) vertices$|^(\S+) \(/gm,
    );
    const classes = [];
    for (const [, index, , vertices, name] of listed) {
        if (name !== undefined) {
            classes.push({ name, members: [] });
        } else if (Number(vertices) <= largest && classes.at(-1).members.length < most) {
            classes.at(-1).members.push(index);
        }
    }
    for (const { name, members } of classes) {
        const place = path.join(folder, name);
        const sources = hashOf(["core/shapes", "core/base", "core/mesh"], members.join());
        await once(path.join(place, "stamp"), sources, [path.join(place, "index.json")], () =>
            run(generator, [
                ...["--class", name, "--output", path.join(root, place)],
                ...members.flatMap((member) => ["--member", member]),
            ]),
        );
    }
    return classes.flatMap(({ name }) => readIndex(path.join(root, folder, name)));
}

function readIndex(folder) {
    const { classes } = JSON.parse(readFileSync(path.join(folder, "index.json"), "utf8"));
    return classes.map((shapeClass) => ({
        ...shapeClass,
        members: shapeClass.members.map((member) => ({ folder, ...member })),
    }));
}

export function arraysOf({ positions, faces }) {
    const offsets = [0];
    for (const face of faces) {
        offsets.push(offsets.at(-1) + face.length);
    }
    return { positions: positions.flat(), corners: faces.flat(), offsets };
}

/** The cube with corners at distance 1. */
export const cube = {
    positions: Array.from({ length: 8 }, (_, i) =>
        [i & 1, i & 2, i & 4].map((bit) => (bit ? 1 : -1) / Math.sqrt(3)),
    ),
    faces: [
        [0, 2, 3, 1],
        [4, 5, 7, 6],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 4, 6, 2],
        [1, 3, 7, 5],
    ],
};

/** The triangular prism. */
export const prism = {
    positions: [-0.5, 0.5].flatMap((z) =>
        [0, 1, 2].map((i) => {
            const x = [1, -0.5, -0.5][i];
            const y = ([0, 1, -1][i] * Math.sqrt(3)) / 2;
            return normalized([x, y, z]);
        }),
    ),
    faces: [
        [2, 1, 0],
        [3, 4, 5],
        [0, 1, 4, 3],
        [1, 2, 5, 4],
        [2, 0, 3, 5],
    ],
};

/** The convex hull of random points on the sphere. */
export function randomHull(points, seed) {
    const positions = randomDirections(points, seed);
    return { positions, faces: convexHull(positions) };
}

/** A layout on a sphere of 20 n^2 triangles with a landmark per direction; meshes as lists. */
export function sphereProblemAt(layout, n, directions) {
    const target = sphereMesh(n);
    return { layout, target, landmarks: nearestVertices(target.positions, directions) };
}

/** With random landmarks. */
export function sphereProblem(layout, n, seed) {
    return sphereProblemAt(layout, n, randomDirections(layout.positions.length, seed));
}

/** With landmarks displaced from the layout's own vertices, which lie on the sphere. */
export function displacedProblem(layout, n, distance, seed) {
    return sphereProblemAt(layout, n, displaced(layout.positions, distance, seed));
}

/** Meshes as lists to what the package takes. */
export function problemOf({ layout, target, landmarks }) {
    return { layout: arraysOf(layout), target: arraysOf(target), landmarks };
}
