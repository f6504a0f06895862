// The instances of the benchmark, and where their files are: below the data folder (`shared`), or
// made here and kept in the build folder (`generate`). `quick` marks the ones of --quick.
import { existsSync, mkdirSync } from "node:fs";
import path from "node:path";
import { hashOf, once, root } from "../../.dev/run.mjs";
import {
    convexHull,
    displaced,
    hullOfLandmarks,
    nearestVertices,
    randomDirections,
    readLandmarks,
    readPositions,
    sphere,
    withBumps,
    writeLandmarks,
    writeObj,
} from "./generate.mjs";

const range = (n) => Array.from({ length: n }, (_, i) => i + 1);

/** Layouts that lie in the target's frame. */
function controlMesh(name) {
    return {
        name,
        family: "real",
        shared: { layout: `data/${name}_control_mesh.obj`, target: `data/${name}.obj` },
    };
}

/** Landmarks on a real mesh, with the triangulation of the sphere that they suggest. */
function landmarksOnly(name) {
    return {
        name,
        family: "real",
        shared: { target: `data/${name}.obj`, landmarks: `data/${name}.txt` },
        generate: (files) => {
            const all = readPositions(files.target);
            const positions = readLandmarks(files.landmarks).map((vertex) => all[vertex]);
            writeObj(files.layout, { positions, faces: hullOfLandmarks(positions) });
        },
        quick: true,
    };
}

function cubeOnSphere(level, seed) {
    return {
        name: `cube sphere${level} ${seed}`,
        family: `sphere${level}`,
        shared: {
            layout: "instances/sphere_cube/cube_layout.obj",
            target: `instances/sphere${level}.obj`,
            landmarks: `instances/sphere_cube/sphere${level}_seed${seed}.txt`,
        },
        seed,
        quick: level === 5 && seed >= 7,
    };
}

function icosahedron(percent, seed) {
    return {
        name: `ico p${percent} ${seed}`,
        family: "ico",
        shared: {
            layout: "instances/icosahedron/icosahedron.obj",
            target: "instances/sphere5.obj",
            landmarks: `instances/icosahedron/ico_p${percent}_s${seed}.txt`,
        },
        displacement: percent,
        quick: percent === 20,
    };
}

function hull(points, percent) {
    const file = `instances/hull/hull${points}_p${percent}_s1`;
    return {
        name: `hull${points} p${percent}`,
        family: "hull",
        shared: {
            layout: `${file}.obj`,
            target: "instances/sphere5.obj",
            landmarks: `${file}.txt`,
        },
        displacement: percent,
        quick: percent === 10,
    };
}

/** Where no insertion sequence is optimal. */
function counterexample(layout, landmarks, level) {
    const file = (name) => `instances/counterexamples/${name}`;
    return {
        name: `${layout} sphere${level}`,
        family: "counterexample",
        shared: {
            layout: file(`${layout}.obj`),
            target: `instances/sphere${level}.obj`,
            landmarks: file(`${landmarks}.txt`),
        },
        quick: level === 3,
    };
}

/**
 * The hull of random points of the sphere as the layout, a bumpy sphere of 20 n^2 triangles as the
 * target, and landmarks displaced by three quarters of the points' mean distance. The same points, bumps and displacements for all n.
 */
function bumpySphere(family, name, n, landmarks) {
    return {
        name,
        family,
        shared: {},
        generate: (files) => {
            const { positions, faces } = sphere(n);
            const points = randomDirections(landmarks, 1);
            const apart = Math.sqrt(12.566 / landmarks);
            writeObj(files.layout, { positions: points, faces: convexHull(points) });
            writeObj(files.target, { positions: withBumps(positions, 3), faces });
            writeLandmarks(
                files.landmarks,
                nearestVertices(positions, displaced(points, 0.75 * apart, 2)),
            );
        },
    };
}

/** Growing targets: 980 triangles to a million, and one of a hundred thousand. */
const meshSizes = [7, 14, 28, 56, 71, 112, 224].map((n) =>
    bumpySphere("mesh size", `mesh ${(20 * n * n).toString()}`, n, 20),
);
/** Growing layouts on 20 480 triangles. */
const layoutSizes = [8, 12, 20, 35, 60, 100, 200].map((count) =>
    bumpySphere("layout size", `layout ${count}`, 32, count),
);

export const instances = [
    ...["spot", "penguin"].map(controlMesh),
    landmarksOnly("spot_fourleg"),
    ...[5, 6].flatMap((level) => range(10).map((seed) => cubeOnSphere(level, seed))),
    ...[20, 35, 50, 100].flatMap((p) => range(3).map((seed) => icosahedron(p, seed))),
    ...[12, 20, 30].flatMap((points) => [10, 20, 30, 50].map((p) => hull(points, p))),
    ...[3, 4, 5, 6].map((level) => counterexample("prism3", "prism3_on_sphere3456", level)),
    counterexample("cube", "cube_on_sphere3", 3),
    ...meshSizes,
    ...layoutSizes,
];

/**
 * The files of an instance: { layout, target, landmarks }, the last one "proximity" where there is
 * none. Generates what has to be generated; { missing } names a shared file that is not there.
 */
export async function filesOf({ name, shared, generate }, dataFolder) {
    const files = Object.fromEntries(
        Object.entries(shared).map(([role, file]) => [role, path.join(dataFolder, file)]),
    );
    const missing = Object.values(files).find((file) => !existsSync(file));
    if (missing !== undefined) {
        return { missing };
    }
    if (generate) {
        const folder = path.join("build", "bench-instances", name.replaceAll(" ", "_"));
        const made = {};
        for (const [role, file] of [
            ["layout", "layout.obj"],
            ["target", "target.obj"],
            ["landmarks", "landmarks.txt"],
        ]) {
            if (files[role] === undefined) {
                made[role] = path.join(folder, file);
                files[role] = path.join(root, made[role]);
            }
        }
        const sources = hashOf([
            "tests/bench/generate.mjs",
            "tests/bench/instances.mjs",
            "tests/bench/vectors.mjs",
        ]);
        await once(path.join(folder, "stamp"), sources, Object.values(made), () => {
            mkdirSync(path.join(root, folder), { recursive: true });
            generate(files);
        });
    }
    return { landmarks: "proximity", ...files };
}
